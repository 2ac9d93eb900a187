"""Pictures of what the robot did, drawn afterwards from the poses that were kept."""

from typing import Literal

import mujoco
import numpy as np
from jaxtyping import Float, UInt8
from numpy import ndarray

from motionese.body.composition import ROOM
from motionese.body.eye import HEAD_GROUP
from motionese.body.rendering import open_renderer


def pictures(
    model: mujoco.MjModel,
    poses: Float[ndarray, "N P"],
    *,
    camera: Literal["outside", "eye"] = "outside",
    size: tuple[int, int] = (320, 240),
) -> UInt8[ndarray, "N height width 3"]:
    """Draw kept poses as pictures in red, green and blue.

    Args:
        model: The model of the robot whose poses they are, see `load_model`.
        poses: What the robot's `pose` returned at the wanted moments.
        camera: "outside", beside the table, or "eye", from where the robot sees.
        size: Width and height [px], at most 640 × 480.

    Raises:
        RenderingError: No pictures can be rendered on this machine.
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
