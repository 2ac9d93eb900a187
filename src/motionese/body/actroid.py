"""The simulated robot as the imitation loop meets it: trials, senses, commands, time."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.arm import COMMAND_RANGE, HANGING
from motionese.body.eye import ProjectedEye, open_eye
from motionese.body.gaze import Hand, aimed_at, followed
from motionese.body.reach import arm_reaching, beyond_tolerance, marker_at
from motionese.body.settings import GAZE_HZ, BodySettings
from motionese.body.simulation import Simulation
from motionese.channels import Channel, Channels
from motionese.errors import MotionError

CHANNELS = Channels(
    [
        Channel("shoulder", "rad", 0.05, 0.78),
        Channel("armpit", "rad", -0.30, 0.30),
        Channel("pan", "rad", -0.70, -0.05),
        Channel("tilt", "rad", 0.38, 0.92),
        Channel("u", "px", -10.0, 10.0),
        Channel("v", "px", -10.0, 10.0),
    ]
)
"""What the body senses, with ranges a little wider than what occurs in the experiment's motions."""
PRESSED_MM = 5.0
"""A button that is deeper than this counts as pressed [mm]; its stroke is 15 mm."""

_SETTLING = round(1.5 * GAZE_HZ)
_AWAY = np.array([1.30, 1.10, 0.95])


class Actroid:
    """A seated robot whose pneumatic right arm pushes two buttons; fills the `Body` protocol.

    A trial begins with `reset` (the robot acts) or `watch` (the robot sees a demonstration). Both
    restore the whole simulation: a trial depends on its own calls and its generator alone.

    Raises:
        RenderingError: The settings ask for a rendered view, and this machine renders no pictures.
    """

    def __init__(self, settings: BodySettings | None = None) -> None:
        self.settings = settings or BodySettings()
        self.channels = CHANNELS
        self.rate_hz = self.settings.rate_hz
        self._simulation = Simulation(self.settings)
        self._eye = open_eye(self._simulation.model, self.settings)
        self._noiseless = ProjectedEye(self._simulation.model, noise_px=0.0)
        self._seen = np.zeros(2)
        self._deepest = np.zeros(2)
        self._caregiver = self._caregiver_goal = _AWAY
        self.reset(np.zeros(2), np.random.default_rng(0))

    def reset(self, posture: Float[ndarray, "2"], rng: np.random.Generator) -> None:
        """Begin to act: arm settled at the commanded angles [rad], eye on its own hand.

        The caregiver's hand is away. `rng` gives the noise of all pictures until the next trial.
        """
        arm = np.clip(posture, *COMMAND_RANGE)
        self._begin("own", arm, aimed_at(marker_at(arm)), _AWAY, rng)

    def watch(self, position: Float[ndarray, "3"], rng: np.random.Generator) -> None:
        """Begin to watch: the caregiver's marker at a position [m, world], the eye on it.

        The robot's arm hangs beside it. `rng` gives the noise of all pictures until the next trial.
        """
        self._begin("caregiver", HANGING, aimed_at(position), position, rng)

    def command(self, arm: Float[ndarray, "2"]) -> None:
        """Command arm angles [rad], in force from now on; clamped to `COMMAND_RANGE`."""
        if not np.isfinite(arm).all():
            raise MotionError(f"commanded arm angles must be finite, got {arm} rad")
        self._command = np.clip(arm, *COMMAND_RANGE)

    def move_caregiver(self, position: Float[ndarray, "3"]) -> None:
        """Set where the caregiver's marker will be [m, world] at the end of the coming `step`."""
        self._caregiver_goal = np.array(position)

    def step(self) -> None:
        """Let one control period, 1/`rate_hz`, pass; the caregiver's hand moves in a line."""
        start, goal = self._caregiver, self._caregiver_goal
        pictures, substeps = round(GAZE_HZ / self.rate_hz), self._simulation.substeps
        share = np.arange(1, pictures * substeps + 1)[:, None] / (pictures * substeps)
        moves = not np.array_equal(start, goal)
        way = (start + share * (goal - start)).reshape(pictures, substeps, 3)
        for stretch in way:
            self._advance(stretch if moves else None)
            self._seen = self._eye.see(self._simulation.data, self._followed, self._seen, self._rng)
            self._deepest = np.maximum(self._deepest, self.button_depths())
        self._caregiver = goal

    def sense(self) -> Float[ndarray, "6"]:
        """Return shoulder, armpit, pan, tilt [rad] and the followed hand's u, v [px] now."""
        return np.concatenate([self._simulation.angles, self._seen])

    def hand_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the robot's own marker [m, world]."""
        return self._simulation.marker("own")

    def caregiver_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the caregiver's marker [m, world]."""
        return self._simulation.marker("caregiver")

    def button_depths(self) -> Float[ndarray, "2"]:
        """Return how deep the right and the left button are pressed now [mm]."""
        return self._simulation.button_depths

    def deepest_press(self) -> Float[ndarray, "2"]:
        """Return how deep the right and the left button were pressed in this trial so far [mm]."""
        return self._deepest.copy()

    def pose(self) -> Float[ndarray, " P"]:
        """Return what `pictures` needs to draw this moment."""
        data = self._simulation.data
        return np.concatenate([data.qpos, data.mocap_pos[0]])

    def command_reaching(
        self,
        position: Float[ndarray, "3"],
        *,
        tolerance_m: float = 0.01,
        name: str = "the position",
    ) -> Float[ndarray, "2"]:
        """Return the command [rad] under which the marker settles at a position [m, world].

        Where the fist presses a button the arm gives way, and the command lies beyond the angles.

        Raises:
            TaskError: The marker stays further away than `tolerance_m` [m]; names the position.
        """
        target = arm_reaching(position, tolerance_m=tolerance_m, name=name)
        trial, command, neck = Simulation(self.settings), target, np.zeros(2)
        for _ in range(12):
            trial.place(command, neck, _AWAY)
            for _ in range(_SETTLING):
                trial.advance(command, neck)
            command = np.clip(command + target - trial.angles[:2], *COMMAND_RANGE)
        miss = float(np.linalg.norm(trial.marker("own") - position))
        if miss > tolerance_m:
            raise beyond_tolerance(name, position, miss, tolerance_m)
        return command

    def _begin(
        self,
        hand: Hand,
        arm: Float[ndarray, "2"],
        neck: Float[ndarray, "2"],
        caregiver: Float[ndarray, "3"],
        rng: np.random.Generator,
    ) -> None:
        self._followed, self._command, self._neck, self._rng = hand, arm, neck, rng
        self._caregiver = self._caregiver_goal = np.array(caregiver)
        self._simulation.place(arm, neck, caregiver)
        self._seen = np.zeros(2)
        for _ in range(_SETTLING):
            self._advance(None)
            self._seen = self._noiseless.see(self._simulation.data, hand, self._seen, rng)
        self._seen = self._eye.see(self._simulation.data, hand, self._seen, rng)
        self._deepest = self.button_depths()

    def _advance(self, caregiver_way: Float[ndarray, "S 3"] | None) -> None:
        self._neck = followed(self._neck, self._seen)
        self._simulation.advance(self._command, self._neck, caregiver_way)
