"""The Actroid: a seated humanoid whose pneumatic right arm and whose gaze do all that is done."""

from importlib.resources import files

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.actroid import gaze
from motionese.body.actroid import reach as arm
from motionese.body.actroid.drive import ActroidDrive, ActroidSettings, with_pneumatics
from motionese.body.composition import composed
from motionese.body.tabletop_robot import TabletopRobot
from motionese.channels import Channel, Channels
from motionese.task import Task


class Actroid(TabletopRobot[ActroidSettings]):
    """Shoulder and armpit are commanded; a servo of the neck keeps the hand in the view's middle.

    The arm reaches a surface, not a volume (`reach`): the direction in which a hand is seen tells
    where on it the hand is.
    """

    channels = Channels(
        [
            Channel("shoulder", "rad", 0.05, 0.78),
            Channel("armpit", "rad", -0.30, 0.30),
            Channel("pan", "rad", -0.70, -0.05),
            Channel("tilt", "rad", 0.38, 0.92),
            Channel("u", "px", -10.0, 10.0),
            Channel("v", "px", -10.0, 10.0),
        ]
    )
    joints = ("shoulder", "armpit")
    command_range = arm.COMMAND_RANGE
    folded = np.radians([100.0, 0.0])  # hanging beside the body
    eye_position = gaze.EYE_POSITION
    reach = arm.IN_WORDS

    @staticmethod
    def load_model(settings: ActroidSettings, task: Task) -> mujoco.MjModel:
        """Compile the robot at a task, with joints of the stiffness asked for."""
        xml = files(__package__).joinpath("actroid.xml").read_text(encoding="utf-8")
        return with_pneumatics(composed(xml, task), settings.stiffness)

    @staticmethod
    def open_drive(model: mujoco.MjModel, settings: ActroidSettings) -> ActroidDrive:
        """Return cylinders and neck."""
        return ActroidDrive(model, settings.stiffness)

    marker_at = staticmethod(arm.marker_at)
    angles_nearest = staticmethod(arm.arm_nearest)
    reachable = staticmethod(arm.reachable)
    aimed_at = staticmethod(gaze.aimed_at)
    followed = staticmethod(gaze.followed)
    bearing = staticmethod(gaze.bearing)

    def met(self, rays: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return where rays from the eye meet the surface on which the marker moves [m, world]."""
        return arm.on_reach(gaze.EYE_POSITION, rays)
