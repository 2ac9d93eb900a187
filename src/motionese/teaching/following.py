"""The robot's arm follows the pen: what online recognition says of the arm is commanded at once."""

from motionese.body import open_body
from motionese.imitation import Performance, Scene, Trial, generator_for
from motionese.runtime.belief import NONE
from motionese.teaching.online_recogniser import Understanding

LAG = 2
"""The arm is so many rows behind the pen; what is commanded in a row is done in the next."""


class Following:
    """One motion of the own arm, beside the pen that it follows."""

    def __init__(self, scene: Scene, start: str, first: Understanding) -> None:
        """Begin in the posture of a start place, with what is understood of the first row."""
        # The scene's own body is watching meanwhile.
        body = open_body(scene.settings.body, scene.task)
        posture = scene.postures[start]
        body.reset(posture, generator_for(scene.seed, "following"))
        self._trial, self._joints = Trial(body, posture), scene.joints
        self._latest = first
        self._think()

    def follow(self, understood: Understanding) -> None:
        """Let a control period pass for every row that is new."""
        new = understood.result.row > self._latest.result.row
        self._latest = understood
        if new:
            self._step(LAG)

    def catch_up(self) -> None:
        """Do the rows that the arm is late, when the pen has been lifted."""
        for lag in range(LAG - 1, 0, -1):
            self._step(lag)

    @property
    def performance(self) -> Performance:
        """What the arm has done so far."""
        return self._trial.performance()

    def _step(self, lag: int) -> None:
        """Command what the arm is understood to do so many rows back, or what it was last."""
        path = self._latest.result.path
        holds = self._latest.likeliest == NONE or len(path) < lag
        command = self._trial.commanded[-1] if holds else path[-lag, self._joints]
        self._think()
        self._trial.step(command)

    def _think(self) -> None:
        result = self._latest.result
        self._trial.think(result.path[-1], result.potentials)
