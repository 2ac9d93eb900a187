"""What every simulated robot has: trials, senses, time, and the command that reaches a position."""

from abc import abstractmethod
from typing import ClassVar, Generic, TypeVar

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.composition import Hand
from motionese.body.eye import Eye, ProjectedEye, open_eye
from motionese.body.protocol import SimulatedRobot
from motionese.body.settings import PICTURES_HZ, SimulationSettings
from motionese.body.simulation import Drive, Simulation
from motionese.errors import MotionError, TaskError
from motionese.task import Task

_SETTLING = round(1.5 * PICTURES_HZ)
_AWAY = np.array([1.30, 1.10, 0.95])

Settings = TypeVar("Settings", bound=SimulationSettings)


class TabletopRobot(SimulatedRobot, Generic[Settings]):
    """A robot at a table, face to face with the caregiver.

    A trial begins with `reset` (the robot acts) or `watch` (the robot sees a demonstration). Both
    restore the whole simulation and let it settle for 1.5 s while the eye finds the hand.

    A robot adds its model and its actuators, its kinematics (`marker_at` and `angles_nearest`: the
    marker's position by joint angles, and back), unless its eye stands still its gaze (`aimed_at`,
    `followed`), and how the hand it sees lies in space (`bearing`, `met`).

    Attributes:
        channels: What is sensed: angles of joints [rad] by the joints' names, then u, v [px].
        folded: Angles [rad] of the arm at rest out of the eye's view, away from the task's things.
        reach: What the hand reaches, in words.
    """

    folded: ClassVar[Float[ndarray, " J"]]
    reach: ClassVar[str]

    def __init__(self, settings: Settings, task: Task) -> None:
        self.settings, self.task = settings, task
        self.rate_hz = settings.rate_hz
        self.model = self.load_model(settings, task)
        self._drive = self.open_drive(self.model, settings)
        self._simulation = self._simulate()
        self._eye = open_eye(self.model, settings)
        self._noiseless = ProjectedEye(self.model, noise_px=0.0)
        self._commanded = self.channels.indices(self.joints)
        self._caregiver = self._caregiver_goal = _AWAY
        self.reset(np.zeros(len(self.joints)), np.random.default_rng(0))

    @staticmethod
    @abstractmethod
    def load_model(settings: Settings, task: Task) -> mujoco.MjModel:
        """Compile the robot at a task, see `composed`."""

    @staticmethod
    @abstractmethod
    def open_drive(model: mujoco.MjModel, settings: Settings) -> Drive:
        """Return the actuators of a model."""

    @abstractmethod
    def marker_at(self, angles: Float[ndarray, "*shape J"]) -> Float[ndarray, "*shape 3"]:
        """Return where the marker is [m, world] when the joints stand at these angles [rad]."""

    @abstractmethod
    def angles_nearest(self, position: Float[ndarray, "3"]) -> Float[ndarray, " J"]:
        """Return the angles [rad], of those that may be commanded, nearest to a position [m]."""

    def aimed_at(self, position: Float[ndarray, "3"]) -> Float[ndarray, " G"]:
        """Return the neck's angles [rad] that bring a position [m] into the view's middle."""
        return np.zeros(0)

    def followed(
        self, gaze: Float[ndarray, " G"], seen: Float[ndarray, "2"]
    ) -> Float[ndarray, " G"]:
        """Return the neck's angles [rad], corrected for a hand seen at (u, v) [px]."""
        return gaze

    def reset(self, posture: Float[ndarray, " J"], rng: np.random.Generator) -> None:
        """Begin to act: arm settled at the commanded angles [rad]; the caregiver's hand is away."""
        arm = np.clip(posture, *self.command_range)
        self._begin("own", arm, self.aimed_at(self.marker_at(arm)), _AWAY, rng)

    def watch(self, position: Float[ndarray, "3"], rng: np.random.Generator) -> None:
        """Begin to watch the caregiver's marker at a position [m, world], the own arm folded."""
        self._begin("caregiver", self.folded, self.aimed_at(position), position, rng)

    def command(self, angles: Float[ndarray, " J"]) -> None:
        """Command joint angles [rad], in force from now on; clamped to `command_range`."""
        if not np.isfinite(angles).all():
            raise MotionError(f"commanded joint angles must be finite, got {angles} rad")
        self._command = np.clip(angles, *self.command_range)

    def move_caregiver(self, position: Float[ndarray, "3"]) -> None:
        """Set where the caregiver's marker will be [m, world] at the end of the coming `step`."""
        self._caregiver_goal = np.array(position)

    def step(self) -> None:
        """Let one control period, 1/`rate_hz`, pass; the caregiver's hand moves in a line."""
        start, goal = self._caregiver, self._caregiver_goal
        pictures, substeps = round(PICTURES_HZ / self.rate_hz), self._simulation.substeps
        share = np.arange(1, pictures * substeps + 1)[:, None] / (pictures * substeps)
        moves = not np.array_equal(start, goal)
        way = (start + share * (goal - start)).reshape(pictures, substeps, 3)
        for stretch in way:
            self._advance(stretch if moves else None)
            self._look(self._eye)
        self._caregiver = goal

    def sense(self) -> Float[ndarray, " D"]:
        """Return the joints' angles [rad] and the followed hand's u, v [px]; NaN if unseen."""
        return np.concatenate([self._simulation.angles, self._seen])

    def hand_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the robot's own marker [m, world]."""
        return self._simulation.marker("own")

    def caregiver_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the caregiver's marker [m, world]."""
        return self._simulation.marker("caregiver")

    def effects(self) -> dict[str, float]:
        """Return how deep each of the task's things is pushed down now [mm]."""
        return self._simulation.effects

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
    ) -> Float[ndarray, " J"]:
        """Return the command [rad] under which the marker settles at a position [m, world].

        Where the arm gives way (weight, a pressed button) the command lies beyond the angles.
        """

        def check_reached(marker: Float[ndarray, "3"]) -> None:
            miss = float(np.linalg.norm(marker - position))
            if not miss <= tolerance_m:
                x, y, z = position
                raise TaskError(
                    f"{name} ({x:.3f}, {y:.3f}, {z:.3f}) m is {100 * miss:.1f} cm out of the arm's "
                    f"reach, {100 * tolerance_m:g} cm are allowed: {self.reach}"
                )

        target = self.angles_nearest(position)
        check_reached(self.marker_at(target))
        trial, command, gaze = self._simulate(), target, 0.0 * self.aimed_at(position)
        for _ in range(12):
            trial.place(command, gaze, _AWAY)
            for _ in range(_SETTLING):
                trial.advance(command, gaze)
            settled = trial.angles[self._commanded]
            command = np.clip(command + target - settled, *self.command_range)
        check_reached(trial.marker("own"))
        return command

    def _simulate(self) -> Simulation:
        sensed = self.channels.names[:-2]
        return Simulation(self.model, self._drive, sensed=sensed, effects=self.task.effects)

    def _begin(
        self,
        hand: Hand,
        arm: Float[ndarray, " J"],
        gaze: Float[ndarray, " G"],
        caregiver: Float[ndarray, "3"],
        rng: np.random.Generator,
    ) -> None:
        self._hand, self._command, self._gaze, self._rng = hand, arm, gaze, rng
        self._caregiver = self._caregiver_goal = np.array(caregiver)
        self._simulation.place(arm, gaze, caregiver)
        self._seen = self._last_seen = np.zeros(2)
        for _ in range(_SETTLING):
            self._advance(None)
            self._look(self._noiseless)
        self._look(self._eye)

    def _advance(self, caregiver_way: Float[ndarray, "S 3"] | None) -> None:
        if np.isfinite(self._seen).all():
            self._gaze = self.followed(self._gaze, self._seen)
        self._simulation.advance(self._command, self._gaze, caregiver_way)

    def _look(self, eye: Eye) -> None:
        self._seen = eye.see(self._simulation.data, self._hand, self._last_seen, self._rng)
        if np.isfinite(self._seen).all():
            self._last_seen = self._seen
