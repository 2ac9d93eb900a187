"""Pneumatic arm and servo-driven neck: commanded angles become pressures and set points."""

import math
from typing import Literal

import mujoco
import numpy as np
from jaxtyping import Float
from mujoco import MjData, MjModel
from numpy import ndarray
from pydantic import Field

from motionese.body.settings import SimulationSettings

ARM_ACTUATORS = ("shoulder_down", "shoulder_up", "armpit_left", "armpit_right")

# A joint of k = 30 Nm/rad was tuned by hand to a quick step response without ringing; the laws
# below keep its shape for other stiffnesses: constant damping ratio, valve lag in proportion.
_TUNED_STIFFNESS = 30.0
_TUNED_DAMPING = 3.0
_TUNED_VALVE_S = 0.06
_AREA = 2.0
"""A cylinder's torque at full supply pressure [Nm] for each Nm/rad, enough for rest at ±2 rad."""

_FREE_SHOULDER = np.radians(35.0)


class ActroidSettings(SimulationSettings):
    """The Actroid; every field has the value of the standard experiment as its default."""

    name: Literal["actroid"] = "actroid"
    stiffness: float = Field(default=30.0, ge=15.0, le=80.0)
    """Stiffness [Nm/rad] of each joint's pair of pneumatic actuators; a softer arm is slower."""


def with_pneumatics(model: MjModel, stiffness: float) -> MjModel:
    """Give a model's pneumatic actuators a stiffness [Nm/rad]; returns the model.

    Each joint has two cylinders of force area·p − (k/2)·length − (d/2)·speed, one pulling each way:
    together they are a spring of stiffness k and a damper d whose rest angle is set by p1 − p2.
    """
    softness = math.sqrt(_TUNED_STIFFNESS / stiffness)
    for name in ARM_ACTUATORS:
        cylinder = model.actuator(name).id
        model.actuator_biasprm[cylinder, 1] = -stiffness / 2
        model.actuator_biasprm[cylinder, 2] = -_TUNED_DAMPING / softness / 2
        model.actuator_gainprm[cylinder, 0] = _AREA * stiffness
        model.actuator_dynprm[cylinder, 0] = _TUNED_VALVE_S * softness
    return model


class ActroidDrive:
    """Sets the pressures that would hold the arm at the commanded angles, were nothing touched.

    The sensed angle is not fed back: whatever pushes against the arm deflects it.
    """

    def __init__(self, model: MjModel, stiffness: float) -> None:
        self._model, self._stiffness = model, stiffness
        joints = [model.joint(name) for name in ("shoulder", "armpit")]
        self._qpos = np.array([j.qposadr[0] for j in joints])
        self._dof = np.array([j.dofadr[0] for j in joints])
        cylinders = [model.actuator(name) for name in ARM_ACTUATORS]
        self._ctrl = np.array([c.id for c in cylinders])
        self._act = np.array([c.actadr[0] for c in cylinders])
        self._neck_qpos = [model.joint(n).qposadr[0] for n in ("pan", "tilt")]
        self._neck_ctrl = [model.actuator(n).id for n in ("pan", "tilt")]
        self._neck_act = [model.actuator(n).actadr[0] for n in ("pan", "tilt")]

    def press(self, data: MjData, angles: Float[ndarray, "2"], gaze: Float[ndarray, "2"]) -> None:
        """Set pressures [share of supply] at which spring and weight balance at commanded angles.

        The neck's set points are the angles of the gaze.
        """
        torque = self._stiffness * angles + data.qfrc_bias[self._dof]
        half = torque / (_AREA * self._stiffness) / 2
        data.ctrl[self._ctrl] = 0.5 + np.array([half[0], -half[0], half[1], -half[1]])
        data.ctrl[self._neck_ctrl] = gaze

    def place(self, data: MjData, angles: Float[ndarray, "2"], gaze: Float[ndarray, "2"]) -> None:
        """Put arm and neck at rest [rad], cylinders and dead time filled accordingly.

        An arm that would stand in the table starts above it; one that hangs does not.
        """
        shoulder, armpit = angles
        above = shoulder if shoulder > np.pi / 2 else min(shoulder, _FREE_SHOULDER)
        arm = np.array([above, armpit])
        data.qpos[self._neck_qpos] = gaze
        data.act[self._neck_act] = gaze
        data.qpos[self._qpos] = arm
        mujoco.mj_forward(self._model, data)
        self.press(data, arm, gaze)
        data.act[self._act] = data.ctrl[self._ctrl]
        for cylinder in self._ctrl:
            samples = int(self._model.actuator_history[cylinder, 0])
            past = np.full(samples, data.ctrl[cylinder])
            mujoco.mj_initCtrlHistory(self._model, data, cylinder, None, past)
