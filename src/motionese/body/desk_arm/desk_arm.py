r"""The desk arm: three servos move a hand through a volume, a camera that stands still watches it.

With pan about the vertical, lift upwards and elbow downwards, in the arm's own vertical plane

    marker = s + R_z(pan) (r, 0, h),   r + ih = L e^{i lift} + (a + ic) e^{i (lift - elbow)}

where s is the shoulder, L the upper arm's length, and (a, 0, c) the marker in the forearm's frame.
"""

from importlib.resources import files
from typing import Literal

import numpy as np
from jaxtyping import Float
from mujoco import MjData, MjModel
from numpy import ndarray

from motionese.body.composition import composed
from motionese.body.eye import focal_px
from motionese.body.settings import SimulationSettings
from motionese.body.tabletop_robot import TabletopRobot
from motionese.channels import Channel, Channels
from motionese.task import Task

SHOULDER = np.array([0.06, -0.18, 1.06])
"""Where the axes of pan and lift meet [m, world]."""
EYE_POSITION = np.array([-0.03, 0.26, 1.17])
"""The camera [m, world]."""
UPPER_ARM_M = 0.28
"""From the shoulder to the elbow [m]."""
MARKER, FINGERTIP = 0.240 + 0.050j, 0.28 + 0.0j
"""In the forearm's plane [m]: along it, and above it as the imaginary part."""
COMMAND_RANGE: Float[ndarray, "2 3"] = np.radians([[-35.0, -25.0, 30.0], [35.0, 60.0, 100.0]])
"""Lowest and highest angles [rad] of pan, lift and elbow that may be commanded."""
JOINTS = ("shoulder_pan", "shoulder_lift", "elbow")

_CLEAR_M = 0.776
"""Height [m] of a fingertip's middle that touches neither table nor a button pressed down."""


class DeskArmSettings(SimulationSettings):
    """The desk arm; every field has the value of the standard experiment as its default."""

    name: Literal["desk_arm"] = "desk_arm"


class DeskArm(TabletopRobot[DeskArmSettings]):
    """All three joints are commanded, and the hand is seen in a picture that never moves.

    The hand moves in a volume, the picture has two numbers: where a seen hand is in space is told
    for hands on a plane, the one through the task's places (`met`).
    """

    channels = Channels(
        [
            Channel("shoulder_pan", "rad", -0.32, 0.32),
            Channel("shoulder_lift", "rad", -0.15, 0.52),
            Channel("elbow", "rad", 1.03, 1.24),
            Channel("u", "px", -29.0, 22.0),
            Channel("v", "px", -33.0, 31.0),
        ]
    )
    joints = JOINTS
    command_range = COMMAND_RANGE
    eye_position = EYE_POSITION
    folded = np.radians([-115.0, 60.0, 110.0])  # to its right, behind the camera
    reach = (
        f"its marker moves up to {100 * (UPPER_ARM_M + abs(MARKER)):.1f} cm around "
        f"({SHOULDER[0]:.3f}, {SHOULDER[1]:.3f}, {SHOULDER[2]:.3f}) m, above the table, "
        "pan {:g} to {:g}°, lift {:g} to {:g}°, elbow {:g} to {:g}°".format(
            *np.degrees(COMMAND_RANGE).T.flat
        )
    )

    def __init__(self, settings: DeskArmSettings, task: Task) -> None:
        super().__init__(settings, task)
        camera = self.model.camera("eye").id
        self._camera_axes = self.model.cam_mat0[camera].reshape(3, 3).copy()
        self._focal_px = focal_px(float(self.model.cam_fovy[camera]))
        places = np.array([place.position for place in task.places.values()])
        self._middle = places.mean(axis=0)
        self._normal = np.linalg.svd(places - self._middle)[2][2]

    @staticmethod
    def load_model(settings: DeskArmSettings, task: Task) -> MjModel:
        """Compile the robot at a task."""
        xml = files(__package__).joinpath("desk_arm.xml").read_text(encoding="utf-8")
        return composed(xml, task)

    @staticmethod
    def open_drive(model: MjModel, settings: DeskArmSettings) -> "Servos":
        """Return the three servos."""
        return Servos(model)

    def marker_at(self, angles: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return where the marker is [m, world] when the joints stand at these angles [rad]."""
        pan, lift, elbow = np.moveaxis(np.asarray(angles, dtype=np.float64), -1, 0)
        in_plane = np.exp(1j * lift) * (UPPER_ARM_M + MARKER * np.exp(-1j * elbow))
        out, up = in_plane.real, in_plane.imag
        return np.asarray(SHOULDER + np.stack([out * np.cos(pan), out * np.sin(pan), up], axis=-1))

    def angles_nearest(self, position: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return the angles [rad], of those that may be commanded, nearest to a position [m]."""
        x, y, up = np.moveaxis(position - SHOULDER, -1, 0)
        out, forearm = np.hypot(x, y), abs(MARKER)
        # The law of cosines gives the bend between the upper arm and the line elbow-marker.
        cosine = (out**2 + up**2 - UPPER_ARM_M**2 - forearm**2) / (2 * UPPER_ARM_M * forearm)
        bend = np.arccos(np.clip(cosine, -1.0, 1.0))
        inner = np.angle(UPPER_ARM_M + forearm * np.exp(-1j * bend))
        lift = np.arctan2(up, out) - inner
        angles = np.stack([np.arctan2(y, x), lift, bend + np.angle(MARKER)], axis=-1)
        return np.asarray(np.clip(angles, *COMMAND_RANGE))

    def reachable(self, path: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return the points of a path [m, world], or the nearest that the arm reaches."""
        return self.marker_at(self.angles_nearest(path))

    def bearing(self, values: Float[ndarray, "*shape 5"]) -> Float[ndarray, "*shape 2"]:
        """Return azimuth and elevation [rad] of the seen hand from the camera."""
        seen = np.asarray(values, dtype=np.float64)[..., -2:]
        right, up, back = self._camera_axes.T
        u, v = seen[..., :1], seen[..., 1:]
        x, y, z = np.moveaxis(u * right - v * up - self._focal_px * back, -1, 0)
        return np.stack([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))], axis=-1)

    def met(self, rays: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
        """Return where rays from the camera meet the plane through the task's places [m, world].

        Of more than three places it is the plane with the least squared distances.
        """
        distance = (self._middle - self.eye_position) @ self._normal / (rays @ self._normal)
        return np.asarray(self.eye_position + distance[..., None] * rays)


class Servos:
    """The servos' set points; their stiffness, limits and lag are the model's."""

    def __init__(self, model: MjModel) -> None:
        self._qpos = [model.joint(name).qposadr[0] for name in JOINTS]
        self._ctrl = [model.actuator(name).id for name in JOINTS]
        self._act = [model.actuator(name).actadr[0] for name in JOINTS]

    def press(self, data: MjData, angles: Float[ndarray, "3"], gaze: Float[ndarray, "0"]) -> None:
        """Set the servos for commanded joints [rad]."""
        data.ctrl[self._ctrl] = angles

    def place(self, data: MjData, angles: Float[ndarray, "3"], gaze: Float[ndarray, "0"]) -> None:
        """Put the joints at rest [rad]; an arm that would stand in the table starts lifted."""
        pan, lift, elbow = angles
        fingertip = UPPER_ARM_M + FINGERTIP * np.exp(-1j * elbow)
        lowest = np.arcsin((_CLEAR_M - SHOULDER[2]) / abs(fingertip)) - np.angle(fingertip)
        data.qpos[self._qpos] = pan, max(lift, lowest), elbow
        data.ctrl[self._ctrl] = data.act[self._act] = angles
