"""What the imitation of motions needs of a robot, and what a simulated one offers beside."""

from abc import abstractmethod
from collections.abc import Mapping
from typing import Protocol, runtime_checkable

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.channels import Channels


@runtime_checkable
class Robot(Protocol):
    """A robot that senses D channels, J of which are joints that are commanded, and has a clock.

    Time passes in `step` only: a real robot waits there for the end of its control period.
    """

    channels: Channels
    """What `sense` returns, in order."""
    joints: tuple[str, ...]
    """The commanded joints, by the names of the channels that hold their angles [rad]."""
    command_range: Float[ndarray, "2 J"]
    """Lowest and highest angles [rad] that may be commanded."""
    rate_hz: float
    """Control periods a second."""

    def reset(self, posture: Float[ndarray, " J"], rng: np.random.Generator) -> None:
        """Begin a trial: joints settled at the commanded angles [rad], eye on its own hand.

        Whatever is random until the next call (sensor noise) is drawn from `rng`.
        """

    def sense(self) -> Float[ndarray, " D"]:
        """Return the channels' values now, in the channels' units; NaN where not observed."""

    def command(self, angles: Float[ndarray, " J"]) -> None:
        """Command joint angles [rad], in force from now on; clamped to `command_range`."""

    def step(self) -> None:
        """Let one control period, 1/`rate_hz`, pass."""


@runtime_checkable
class SimulatedRobot(Robot, Protocol):
    """A robot in MuJoCo, at a task, with a caregiver's hand before its eye.

    A trial begins with `reset` (the robot acts) or `watch` (the robot sees a demonstration). Both
    restore the whole simulation: a trial depends on its own calls and its generator alone.
    """

    model: mujoco.MjModel
    """Robot, the task's things, the caregiver's hand (a mocap body, the only one)."""
    eye_position: Float[ndarray, "3"]
    """Where the eye is [m, world]; it stays there while the gaze turns."""

    def watch(self, position: Float[ndarray, "3"], rng: np.random.Generator) -> None:
        """Begin to watch: the caregiver's marker at a position [m, world], the eye on it."""

    def move_caregiver(self, position: Float[ndarray, "3"]) -> None:
        """Set where the caregiver's marker will be [m, world] at the end of the coming `step`."""

    def caregiver_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the caregiver's marker [m, world]."""

    def hand_position(self) -> Float[ndarray, "3"]:
        """Return the true position of the robot's own marker [m, world]."""

    def effects(self) -> Mapping[str, float]:
        """Return what the task's things tell now, by the effect's name, such as depths [mm]."""

    def pose(self) -> Float[ndarray, " P"]:
        """Return what pictures need to draw this moment: `qpos`, and where the mocap body is."""

    def command_reaching(
        self, position: Float[ndarray, "3"], *, tolerance_m: float = ..., name: str = ...
    ) -> Float[ndarray, " J"]:
        """Return the command [rad] under which the marker settles at a position [m, world].

        Raises:
            TaskError: The marker stays further away than `tolerance_m` [m]; names the position.
        """

    @abstractmethod
    def reachable(self, path: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return the points [m, world] that the marker reaches nearest to those of a path."""

    @abstractmethod
    def bearing(self, values: Float[ndarray, "*shape D"]) -> Float[ndarray, "*shape 2"]:
        """Return azimuth (to the robot's left) and elevation [rad] of the hand that is seen."""

    @abstractmethod
    def met(self, rays: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return where rays from the eye meet the surface on which the marker moves [m, world]."""
