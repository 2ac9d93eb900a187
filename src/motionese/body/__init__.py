"""Simulated robots, and what any robot must offer.

A robot is a folder of this room and a row of `BODIES`: its settings, and its class.
"""

from motionese.body.graphics_library import without_graphics
from motionese.errors import SettingError, needs

try:
    with without_graphics():
        import mujoco
except ModuleNotFoundError as fault:
    raise needs("mujoco-core", "experiment", "a simulated robot") from fault

from typing import Annotated, Any

from pydantic import Field

from motionese.body.actroid import Actroid, ActroidSettings
from motionese.body.desk_arm import DeskArm, DeskArmSettings
from motionese.body.geometry import Geometry
from motionese.body.protocol import Robot, SimulatedRobot
from motionese.body.rendering import pictures
from motionese.body.settings import SimulationSettings
from motionese.body.tabletop_robot import TabletopRobot
from motionese.task import Task

BodySettings = Annotated[ActroidSettings | DeskArmSettings, Field(discriminator="name")]
"""The settings of any simulated robot; their `name` says of which."""

BODIES: dict[str, tuple[type[SimulationSettings], type[TabletopRobot[Any]]]] = {
    "actroid": (ActroidSettings, Actroid),
    "desk_arm": (DeskArmSettings, DeskArm),
}
"""Every simulated robot by its name in settings: its settings and its class."""


def open_body(settings: BodySettings, task: Task) -> SimulatedRobot:
    """Return a robot at a task.

    Raises:
        SettingError: The robot commands joints that it does not sense.
        RenderingError: Rendered pictures are asked for, and this machine renders none.
    """
    _, robot = BODIES[settings.name]
    missing = [joint for joint in robot.joints if joint not in robot.channels.names]
    if missing:
        raise SettingError(
            f"body {settings.name} commands {', '.join(missing)}, which it does not sense: the "
            f"joints must be among its channels, which are {', '.join(robot.channels.names)}"
        )
    return robot(settings, task)


def load_model(settings: BodySettings, task: Task) -> mujoco.MjModel:
    """Return the MuJoCo model of a robot at a task, for pictures and shapes without a trial."""
    return BODIES[settings.name][1].load_model(settings, task)


__all__ = [
    "BODIES",
    "BodySettings",
    "Geometry",
    "Robot",
    "SimulatedRobot",
    "SimulationSettings",
    "TabletopRobot",
    "load_model",
    "open_body",
    "pictures",
]
