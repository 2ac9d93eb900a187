"""The simulated robot: pneumatic arm, neck, eye and buttons in MuJoCo, and the body protocol."""

from motionese.errors import RenderingError

try:
    import mujoco  # noqa: F401
except AttributeError as fault:
    # MUJOCO_GL names a GL library that this machine lacks: MuJoCo itself then fails to import.
    raise RenderingError(
        "MuJoCo cannot load the GL library that the environment variable MUJOCO_GL asks for; "
        "unset it, or install libegl1 and libgl1 (Debian, Ubuntu)"
    ) from fault

from motionese.body.actroid import CHANNELS, PRESSED_MM, Actroid
from motionese.body.arm import COMMAND_RANGE
from motionese.body.film import pictures
from motionese.body.gaze import EYE_POSITION, bearing
from motionese.body.geometry import Geometry
from motionese.body.protocol import Body
from motionese.body.reach import (
    CORNER_POSTURES,
    CORNERS,
    arm_reaching,
    marker_at,
    on_reach,
    projected,
)
from motionese.body.settings import BodySettings

__all__ = [
    "CHANNELS",
    "COMMAND_RANGE",
    "CORNERS",
    "CORNER_POSTURES",
    "EYE_POSITION",
    "PRESSED_MM",
    "Actroid",
    "Body",
    "BodySettings",
    "Geometry",
    "arm_reaching",
    "bearing",
    "marker_at",
    "on_reach",
    "pictures",
    "projected",
]
