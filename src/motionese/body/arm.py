"""The arm's low-level control: commanded angles become pressures."""

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.model import ARM_ACTUATORS, area

COMMAND_RANGE: Float[ndarray, "2 2"] = np.radians([[-10.0, -30.0], [50.0, 30.0]])
"""Lowest and highest angles [rad] of shoulder and armpit that may be commanded."""
HANGING: Float[ndarray, "2"] = np.radians([100.0, 0.0])
"""The arm at rest beside the body [rad]: out of the eye's view, away from the buttons."""


class PneumaticArm:
    """Sets the pressures that would hold the arm at the commanded angles, were nothing touched.

    The sensed angle is not fed back: whatever pushes against the arm deflects it.
    """

    def __init__(self, model: mujoco.MjModel, stiffness: float) -> None:
        self._stiffness = stiffness
        joints = [model.joint(name) for name in ("shoulder", "armpit")]
        self._qpos = np.array([j.qposadr[0] for j in joints])
        self._dof = np.array([j.dofadr[0] for j in joints])
        cylinders = [model.actuator(name) for name in ARM_ACTUATORS]
        self._ctrl = np.array([c.id for c in cylinders])
        self._act = np.array([c.actadr[0] for c in cylinders])

    def press(self, data: mujoco.MjData, command: Float[ndarray, "2"]) -> None:
        """Set the pressures [share of supply] at which spring and weight balance at `command`."""
        torque = self._stiffness * command + data.qfrc_bias[self._dof]
        half = torque / area(self._stiffness) / 2
        data.ctrl[self._ctrl] = 0.5 + np.array([half[0], -half[0], half[1], -half[1]])

    def place(self, model: mujoco.MjModel, data: mujoco.MjData, arm: Float[ndarray, "2"]) -> None:
        """Put the arm at rest at these angles [rad], cylinders and dead time filled accordingly."""
        data.qpos[self._qpos] = arm
        mujoco.mj_forward(model, data)
        self.press(data, arm)
        data.act[self._act] = data.ctrl[self._ctrl]
        for cylinder in self._ctrl:
            samples = int(model.actuator_history[cylinder, 0])
            past = np.full(samples, data.ctrl[cylinder])
            mujoco.mj_initCtrlHistory(model, data, cylinder, None, past)
