"""Robot, things and caregiver's hand in MuJoCo, from one picture of the eye to the next."""

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

import mujoco
import numpy as np
from jaxtyping import Float
from mujoco import MjData, MjModel
from numpy import ndarray

from motionese.body.composition import MARKERS, TASK, Hand
from motionese.body.settings import PICTURES_HZ


@runtime_checkable
class Drive(Protocol):
    """A robot's actuators: what they are given so that its joints go where they are told."""

    def place(self, data: MjData, angles: Float[ndarray, " J"], gaze: Float[ndarray, " G"]) -> None:
        """Put the joints at rest at these angles [rad], or above the table they would be in.

        Actuators are as they would be after a long rest there.
        """

    def press(self, data: MjData, angles: Float[ndarray, " J"], gaze: Float[ndarray, " G"]) -> None:
        """Set the actuators for commanded joints and neck [rad], until the next picture."""


class Simulation:
    """The physics; `place` restores all of it, so that no earlier use is felt."""

    def __init__(
        self, model: MjModel, drive: Drive, *, sensed: Sequence[str], effects: Sequence[str]
    ) -> None:
        """Open a model, see `composed`; by name its sensed joints and its things' slide joints."""
        self.model, self.data, self._drive = model, MjData(model), drive
        self.substeps = round(1 / PICTURES_HZ / model.opt.timestep)
        self._sensed = [model.joint(name).qposadr[0] for name in sensed]
        things = {name: model.joint(TASK + name) for name in effects}
        self._effects = {name: joint.qposadr[0] for name, joint in things.items()}
        self._down = [joint.range[0] for joint in things.values()]
        self._markers = {hand: model.site(site).id for hand, site in MARKERS.items()}

    def place(
        self,
        angles: Float[ndarray, " J"],
        gaze: Float[ndarray, " G"],
        caregiver: Float[ndarray, "3"],
    ) -> None:
        """Restore everything: joints and neck at rest [rad], the caregiver's marker there [m].

        What can be pushed down rises from below the hand: it comes to rest as time passes.
        """
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[list(self._effects.values())] = self._down
        self.data.mocap_pos[0] = caregiver
        self._drive.place(self.data, angles, gaze)

    def advance(
        self,
        command: Float[ndarray, " J"],
        gaze: Float[ndarray, " G"],
        caregiver_way: Float[ndarray, "S 3"] | None = None,
    ) -> None:
        """Let the time between two pictures pass, under commanded joints and neck [rad].

        The caregiver's marker rests, or goes its way [m, world], one position a physics step.
        """
        model, data = self.model, self.data
        self._drive.press(data, command, gaze)
        if caregiver_way is None:
            mujoco.mj_step(model, data, nstep=self.substeps)
        else:
            for position in caregiver_way:
                data.mocap_pos[0] = position
                mujoco.mj_step(model, data)
        # What mj_step leaves behind belongs to the state before its last integration.
        mujoco.mj_kinematics(model, data)
        mujoco.mj_camlight(model, data)
        mujoco.mj_sensorPos(model, data)

    @property
    def angles(self) -> Float[ndarray, " A"]:
        """The sensed joints' angles [rad]."""
        return np.array(self.data.qpos[self._sensed])

    @property
    def effects(self) -> dict[str, float]:
        """How deep each of the task's things is pushed down [mm]."""
        height = self.data.qpos
        return {n: max(0.0, -1000.0 * float(height[adr])) for n, adr in self._effects.items()}

    def marker(self, hand: Hand) -> Float[ndarray, "3"]:
        """Return where the marker of a hand is [m, world]."""
        return np.array(self.data.site_xpos[self._markers[hand]])
