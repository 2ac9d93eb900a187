"""The robot and the caregiver face to face: what one can see and do of the other's motions."""

from jaxtyping import Float
from numpy import ndarray

from motionese.body import Actroid
from motionese.caregiver import Caregiver, Motion, ScriptedCaregiver
from motionese.experiment.keys import generator_for
from motionese.experiment.perform import ARM, Performance, Watched, babble, perform, watch
from motionese.experiment.settings import Settings
from motionese.network import MTRNN


class Scene:
    """A body, a caregiver, and the postures from which motions start.

    Attributes:
        settings: All settings of the experiment.
        seed: What everything random depends on, beside its purpose.
        body: The robot.
        postures: Commanded arm angles [rad] that hold the hand in a corner.
    """

    def __init__(self, settings: Settings, seed: int, caregiver: Caregiver | None = None) -> None:
        """Build the scene; `TaskError` if the robot cannot reach a corner."""
        self.settings, self.seed = settings, seed
        self.caregiver = caregiver or ScriptedCaregiver(settings.caregiver)
        self.body = Actroid(settings.body)
        corners = ("UR", "UL", "LR", "LL")
        self.postures = {
            corner: self.body.command_reaching(
                settings.caregiver.corner(corner), name=f"corner {corner}"
            )
            for corner in corners
        }
        self._arms = {corner: self._arm_at(corner) for corner in corners}

    def show(self, motion: Motion, *occasion: str | int) -> Watched:
        """Let the caregiver show a motion; on the same occasion it is the same to the bit."""
        rng = generator_for(self.seed, "demonstration", *occasion, motion.name)
        return watch(self.body, self.caregiver.demonstrate(motion, rng), rng)

    def as_own(self, motion: Motion, watched: Watched) -> Float[ndarray, "T 6"]:
        """Return what was watched with the own arm where it will start from, in every row."""
        values = watched.sensed.copy()
        values[:, ARM] = self._arms[motion.start]
        return values

    def perform(
        self,
        network: MTRNN,
        initial_state: Float[ndarray, " N"],
        motion: Motion,
        steps: int,
        *occasion: str | int,
    ) -> Performance:
        """Let the robot perform a motion from its start corner."""
        rng = generator_for(self.seed, "performance", *occasion, motion.name)
        posture = self.postures[motion.start]
        imitation = self.settings.imitation
        return perform(self.body, network, initial_state, posture, steps, imitation, rng)

    def babble(self, index: int) -> Performance:
        """Let the robot make one babbled movement, as long as a primitive."""
        manner = self.settings.caregiver
        rng = generator_for(self.seed, "babbling", index)
        return babble(self.body, manner.stroke_steps + manner.rest_steps, manner.stroke_steps, rng)

    def _arm_at(self, corner: str) -> Float[ndarray, "2"]:
        """Return the arm channels' values [rad] while the hand rests in a corner."""
        if self.settings.imitation.efference_copy:
            return self.postures[corner]
        self.body.reset(self.postures[corner], generator_for(self.seed, "posture", corner))
        return self.body.sense()[ARM]
