"""The robot's shapes, and where they are in kept poses: for pictures drawn elsewhere."""

from typing import Any

import mujoco
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.composition import ROOM, TASK


class Geometry:
    """Shapes fixed to bodies; a pose of the robot says where the bodies are.

    Attributes:
        bodies: The bodies' names, in the order of `placed`.
        shapes: The geoms, each with `name`, `body` (its index), `type`, `size` [m], `pos` [m] and
            `quat` in its body, and `rgba`.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model, self._data = model, mujoco.MjData(model)
        self.bodies = tuple(_plain(model.body(i).name) for i in range(model.nbody))
        self.shapes = tuple(self._shape(i) for i in range(model.ngeom))

    def placed(self, poses: Float[ndarray, "T P"]) -> Float[ndarray, "T B 7"]:
        """Return position [m, world] and quaternion (w, x, y, z) of every body, see `pose`."""
        model, data = self._model, self._data
        bodies = np.empty((len(poses), model.nbody, 7))
        for body, pose in zip(bodies, poses, strict=True):
            data.qpos[:], data.mocap_pos[0] = pose[: model.nq], pose[model.nq :]
            mujoco.mj_kinematics(model, data)
            body[:, :3], body[:, 3:] = data.xpos, data.xquat
        return bodies

    def _shape(self, index: int) -> dict[str, Any]:
        model, geom = self._model, self._model.geom(index)
        material = int(geom.matid[0])
        rgba = model.mat_rgba[material] if material >= 0 else geom.rgba
        if material >= 0 and _plain(model.mat(material).name) == "floor":
            rgba = np.array([0.83, 0.84, 0.855, 1.0])  # the middle of its texture's two colours
        return {
            "name": _plain(geom.name),
            "body": int(geom.bodyid[0]),
            "type": mujoco.mjtGeom(int(geom.type[0])).name.removeprefix("mjGEOM_").lower(),
            "size": np.round(geom.size, 5).tolist(),
            "pos": np.round(geom.pos, 5).tolist(),
            "quat": np.round(geom.quat, 6).tolist(),
            "rgba": np.round(rgba, 4).tolist(),
        }


def _plain(name: str) -> str:
    """Return a name without what says that the task or the room brought it along."""
    return name.removeprefix(TASK).removeprefix(ROOM)
