"""A robot, a task's things and the caregiver's hand as one MuJoCo model."""

from importlib.resources import files
from typing import Literal

import mujoco

from motionese.task import Task

TASK, ROOM = "task/", "room/"
"""What the names of the task's things and of the room begin with in a model; a robot's names and
defaults are its own, so that any robot can meet any task."""
Hand = Literal["own", "caregiver"]
"""Whose hand the eye follows, by its red marker."""
MARKERS: dict[Hand, str] = {"own": "own_marker", "caregiver": f"{ROOM}caregiver_marker"}
"""The sites of the markers."""


def composed(robot: str, task: Task) -> mujoco.MjModel:
    """Compile a robot at a task, face to face with the caregiver.

    Physics and light are the room's. Two sensors are added: where in the view either marker is.

    Args:
        robot: MuJoCo XML of the robot: bodies, actuators, a site 'own_marker' on the marker of its
            hand, and a camera 'eye'.
        task: Its fixtures are attached to the world.
    """
    spec = mujoco.MjSpec.from_string(robot)
    if task.fixtures:
        things = mujoco.MjSpec.from_string(task.fixtures)
        spec.attach(things, prefix=TASK, frame=spec.worldbody.add_frame())
    xml = files("motionese.body").joinpath("room.xml").read_text(encoding="utf-8")
    room = mujoco.MjSpec.from_string(xml)
    spec.option, spec.visual, spec.stat = room.option, room.visual, room.stat
    spec.attach(room, prefix=ROOM, frame=spec.worldbody.add_frame())
    for hand, marker in MARKERS.items():
        spec.add_sensor(
            name=f"{hand}_in_view",
            type=mujoco.mjtSensor.mjSENS_CAMPROJECTION,
            objtype=mujoco.mjtObj.mjOBJ_SITE,
            objname=marker,
            reftype=mujoco.mjtObj.mjOBJ_CAMERA,
            refname="eye",
        )
    return spec.compile()
