"""MuJoCo's renderer, or what is missing on this machine, and pictures of poses that were kept."""

import os
from typing import Literal

import mujoco
import numpy as np
from jaxtyping import Float, UInt8
from numpy import ndarray

from motionese.body.composition import ROOM
from motionese.body.graphics_library import NAME, choose_graphics
from motionese.errors import RenderingError

HEAD_GROUP = 2
"""Geoms of this group surround the eye and are left out of its pictures."""
_refused: list[RenderingError] = []
"""The first failure, if any: MuJoCo ends the whole process when a failed GL library is retried."""


def open_renderer(model: mujoco.MjModel, width: int, height: int) -> mujoco.Renderer:
    """Return a renderer for pictures of width × height [px]; `close` it, or use it in a `with`.

    Raises:
        RenderingError: There is no GL library, or it cannot open a picture.
    """
    if _refused:
        raise _refused[0]
    asked = os.environ.get(NAME)
    try:
        choose_graphics()
        return mujoco.Renderer(model, height, width)
    except (ImportError, AttributeError, OSError, RuntimeError, mujoco.FatalError) as fault:
        unset = f"unset {NAME} (it asks for '{asked}'), or " if asked else ""
        refusal = RenderingError(
            f"pictures cannot be rendered on this machine: {unset}install the libraries libegl1 "
            "and libgl1 (Debian, Ubuntu) and the Python packages of pip install "
            "'motionese[vision]' "
            f"(the reason given: {str(fault) or type(fault).__name__})"
        )
        _refused.append(refusal)
        raise refusal from fault


def pictures(
    model: mujoco.MjModel,
    poses: Float[ndarray, "N P"],
    *,
    camera: Literal["outside", "eye"] = "outside",
    size: tuple[int, int] = (320, 240),
) -> UInt8[ndarray, "N height width 3"]:
    """Draw what a robot's `pose` returned as pictures in red, green and blue.

    Args:
        camera: "outside", beside the table, or "eye", from where the robot sees.
        size: Width and height [px], at most 640 × 480.
    """
    data = mujoco.MjData(model)
    option = mujoco.MjvOption()
    option.geomgroup[HEAD_GROUP] = camera != "eye"
    name = camera if camera == "eye" else ROOM + camera
    width, height = size
    drawn = np.empty((len(poses), height, width, 3), dtype=np.uint8)
    with open_renderer(model, width, height) as renderer:
        for picture, pose in zip(drawn, poses, strict=True):
            data.qpos[:], data.mocap_pos[0] = pose[: model.nq], pose[model.nq :]
            mujoco.mj_forward(model, data)
            renderer.update_scene(data, camera=name, scene_option=option)
            renderer.render(out=picture)
    return drawn
