"""Where the eye sees a marker: from the exact projection, or from the pixels of a picture."""

import math

import mujoco
import numpy as np
from jaxtyping import Float, UInt8
from numpy import ndarray

from motionese.body.composition import MARKERS, Hand
from motionese.body.rendering import HEAD_GROUP, open_renderer
from motionese.body.settings import SimulationSettings
from motionese.errors import RenderingError

IMAGE_SIZE = (128, 96)
"""Width and height of the eye's picture [px]."""
REDNESS = 90
"""How far red must exceed green and blue [of 255] in a pixel of the marker."""

_MIDDLE = np.array(IMAGE_SIZE) / 2
"""The view's middle [px], counted from the picture's upper left edge, as MuJoCo projects."""
_MIDDLE_PIXEL = _MIDDLE - 0.5
"""The view's middle [px], counted from the upper left pixel's centre, as OpenCV does."""


class ProjectedEye:
    """The marker's exact projection, with noise; also for a marker beyond the picture's edge."""

    def __init__(self, model: mujoco.MjModel, noise_px: float) -> None:
        self._noise_px = noise_px
        self._adr = {hand: int(model.sensor(f"{hand}_in_view").adr[0]) for hand in MARKERS}

    def see(
        self, data: mujoco.MjData, hand: Hand, last: Float[ndarray, "2"], rng: np.random.Generator
    ) -> Float[ndarray, "2"]:
        """Return the projection (u, v) [px] with the noise of one picture."""
        adr = self._adr[hand]
        exact = np.array(data.sensordata[adr : adr + 2]) - _MIDDLE
        return exact + self._noise_px * rng.standard_normal(2)


class RenderedEye:
    """The red blob nearest to where the marker was last seen; NaN while nothing red is in view."""

    def __init__(self, model: mujoco.MjModel) -> None:
        try:
            import cv2  # noqa: PLC0415
        except ImportError as fault:
            raise RenderingError(
                "the rendered view needs OpenCV: pip install 'motionese[vision]' and the library "
                f"libgl1 (the reason given: {fault})"
            ) from fault
        self._cv2 = cv2
        model.vis.quality.offsamples = 0
        self._renderer = open_renderer(model, *IMAGE_SIZE)
        self._renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        self._renderer.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = 0
        self._option = mujoco.MjvOption()
        self._option.geomgroup[HEAD_GROUP] = 0

    def picture(self, data: mujoco.MjData) -> UInt8[ndarray, "96 128 3"]:
        """Return what the eye sees now, in red, green and blue."""
        self._renderer.update_scene(data, camera="eye", scene_option=self._option)
        return np.asarray(self._renderer.render())

    def see(
        self, data: mujoco.MjData, hand: Hand, last: Float[ndarray, "2"], rng: np.random.Generator
    ) -> Float[ndarray, "2"]:
        """Return the middle (u, v) [px] of the blob nearest to `last`."""
        red, green, blue = self._cv2.split(self.picture(data))
        redness = self._cv2.subtract(red, self._cv2.max(green, blue))
        _, blobs = self._cv2.threshold(redness, REDNESS, 255, self._cv2.THRESH_BINARY)
        count, _, _, middles = self._cv2.connectedComponentsWithStats(blobs)
        if count < 2:
            return np.full(2, np.nan)
        seen = np.array(middles[1:]) - _MIDDLE_PIXEL
        return np.array(seen[np.argmin(np.linalg.norm(seen - last, axis=-1))])


Eye = ProjectedEye | RenderedEye
"""Finds a hand, last seen at `last`, in the view: (u, v) [px from the view's middle; right, down],
both NaN where it is not seen."""


def focal_px(fovy: float) -> float:
    """Return the focal length [px] of an eye with this vertical field of view [degrees]."""
    return IMAGE_SIZE[1] / 2 / math.tan(math.radians(fovy) / 2)


def open_eye(model: mujoco.MjModel, settings: SimulationSettings) -> Eye:
    """Return the eye that the settings ask for; `RenderingError` where it cannot be opened."""
    if settings.vision == "rendered":
        return RenderedEye(model)
    return ProjectedEye(model, settings.pixel_noise)
