"""The MuJoCo model of robot, table, buttons and caregiver's hand, loaded with its settings."""

import math
from importlib.resources import files

import mujoco

from motionese.body.settings import BodySettings

ARM_ACTUATORS = ("shoulder_down", "shoulder_up", "armpit_left", "armpit_right")

# A joint of k = 30 Nm/rad was tuned by hand to a quick step response without ringing; the laws
# below keep its shape for other stiffnesses: constant damping ratio, valve lag in proportion.
_TUNED_STIFFNESS = 30.0
_TUNED_DAMPING = 3.0
_TUNED_VALVE_S = 0.06


def load_model(settings: BodySettings) -> mujoco.MjModel:
    """Compile the model and give its pneumatic actuators the stiffness asked for.

    Each joint has two cylinders of force area·p − (k/2)·length − (d/2)·speed, one pulling each way:
    together they are a spring of stiffness k and a damper d whose rest angle is set by p1 − p2.
    """
    text = files("motionese.body").joinpath("actroid.xml").read_text(encoding="utf-8")
    model = mujoco.MjModel.from_xml_string(text)
    softness = math.sqrt(_TUNED_STIFFNESS / settings.stiffness)
    for name in ARM_ACTUATORS:
        cylinder = model.actuator(name).id
        model.actuator_biasprm[cylinder, 1] = -settings.stiffness / 2
        model.actuator_biasprm[cylinder, 2] = -_TUNED_DAMPING / softness / 2
        model.actuator_gainprm[cylinder, 0] = area(settings.stiffness)
        model.actuator_dynprm[cylinder, 0] = _TUNED_VALVE_S * softness
    return model


def area(stiffness: float) -> float:
    """Return a cylinder's torque at full supply pressure [Nm], enough for rest angles of ±2 rad."""
    return 2.0 * stiffness
