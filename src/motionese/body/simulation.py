"""Robot, table, buttons and caregiver's hand in MuJoCo, from one picture of the eye to the next."""

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.arm import PneumaticArm
from motionese.body.gaze import Hand
from motionese.body.model import load_model
from motionese.body.settings import GAZE_HZ, BodySettings

_BUTTONS_DOWN_M = -0.015
_FREE_SHOULDER = np.radians(35.0)


class Simulation:
    """The physics and its sensors; `place` restores all of it, so that no earlier use is felt."""

    def __init__(self, settings: BodySettings) -> None:
        self.model = load_model(settings)
        self.data = mujoco.MjData(self.model)
        self.substeps = round(1 / GAZE_HZ / self.model.opt.timestep)
        self._arm = PneumaticArm(self.model, settings.stiffness)
        model = self.model
        self._neck_qpos = [model.joint(n).qposadr[0] for n in ("pan", "tilt")]
        self._neck_ctrl = [model.actuator(n).id for n in ("pan", "tilt")]
        self._neck_act = [model.actuator(n).actadr[0] for n in ("pan", "tilt")]
        self._button_qpos = [model.joint(f"{s}_button").qposadr[0] for s in ("right", "left")]
        self._angles = [model.sensor(n).adr[0] for n in ("shoulder", "armpit", "pan", "tilt")]

    def place(
        self, arm: Float[ndarray, "2"], neck: Float[ndarray, "2"], caregiver: Float[ndarray, "3"]
    ) -> None:
        """Restore everything: arm and neck at rest at these angles [rad], caregiver's marker [m].

        The buttons rise from below the fist, and an arm that would stand in the table starts above
        it: both come to rest as time passes.
        """
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[self._button_qpos] = _BUTTONS_DOWN_M
        self.data.qpos[self._neck_qpos] = neck
        self.data.act[self._neck_act] = neck
        self.data.mocap_pos[0] = caregiver
        above = arm[0] if arm[0] > np.pi / 2 else min(arm[0], _FREE_SHOULDER)
        self._arm.place(self.model, self.data, np.array([above, arm[1]]))

    def advance(
        self,
        command: Float[ndarray, "2"],
        neck: Float[ndarray, "2"],
        caregiver_way: Float[ndarray, "S 3"] | None = None,
    ) -> None:
        """Let the time between two pictures pass, under commanded arm and neck angles [rad].

        The caregiver's marker rests, or goes its way [m, world], one position a physics step.
        """
        model, data = self.model, self.data
        self._arm.press(data, command)
        data.ctrl[self._neck_ctrl] = neck
        if caregiver_way is None:
            mujoco.mj_step(model, data, nstep=self.substeps)
        else:
            for position in caregiver_way:
                data.mocap_pos[0] = position
                mujoco.mj_step(model, data)
        # The sensors of mj_step belong to the state before its last integration.
        mujoco.mj_kinematics(model, data)
        mujoco.mj_camlight(model, data)
        mujoco.mj_sensorPos(model, data)

    @property
    def angles(self) -> Float[ndarray, "4"]:
        """Sensed shoulder, armpit, pan and tilt [rad]."""
        return np.array(self.data.sensordata[self._angles])

    @property
    def button_depths(self) -> Float[ndarray, "2"]:
        """How deep the right and the left button are pressed [mm]."""
        return np.array(np.maximum(0.0, -1000.0 * self.data.qpos[self._button_qpos]))

    def marker(self, hand: Hand) -> Float[ndarray, "3"]:
        """Return where the marker of a hand is [m, world]."""
        return np.array(self.data.sensor(f"{hand}_marker").data)
