"""A film strip of the robot pressing a button: rendered, or drawn from the arm's geometry."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float, Int
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.style import ASTRAY, FAINT, INK, WIDTH
from motionese.body import EYE_POSITION, marker_at, pictures
from motionese.body.reach import MARKER_ON_ARM, SHOULDER
from motionese.errors import RenderingError

FRAMES, COLUMNS = 8, 4
TABLE_TOP_M, CAP_TOP_M, CAP_X_M = 0.7255, 0.7635, 0.4313
"""Heights [m] of table and unpressed cap, and where the caps are in front of the robot."""


def moments(depths: Float[ndarray, "T 2"]) -> Int[ndarray, " F"]:
    """Return the rows to show: from the start over the first button's deepest press to its release.

    Args:
        depths: How deep the buttons were pressed [mm].
    """
    pressed = int(depths[:, depths.max(axis=0).argmax()].argmax())
    deepest = pressed if pressed else len(depths) // 2
    end = min(2 * deepest, len(depths) - 1)
    before = np.linspace(0, deepest, FRAMES // 2 + 1)
    after = np.linspace(deepest, end, FRAMES // 2)[1:]
    return np.round(np.concatenate([before, after])).astype(np.int64)


def film(arrays: Mapping[str, ndarray], rate_hz: float) -> tuple[Figure, str]:
    """Draw the strip; return it with a note, which says why if it could not be rendered.

    Args:
        arrays: What was kept of the performance: poses, sensed arm angles, depths.
        rate_hz: Rows a second.
    """
    depths = arrays["depths"]
    rows = moments(depths)
    note = ""
    rendered = None
    try:
        rendered = pictures(arrays["poses"][rows])
    except RenderingError as reason:
        note = f"Drawn from the side from the arm's geometry: {reason}."
    lines = -(-len(rows) // COLUMNS)
    figure = Figure(figsize=(WIDTH, lines * (2.05 if rendered is not None else 2.2)))
    panels = figure.subplots(lines, COLUMNS, squeeze=False).reshape(-1)
    for axes, place in zip(panels, range(len(rows)), strict=True):
        row = rows[place]
        if rendered is not None:
            axes.imshow(rendered[place], interpolation="none")
        else:
            _from_the_side(axes, arrays["sensed"][row], float(depths[row].max()))
        axes.set_xticks([])
        axes.set_yticks([])
        axes.spines[:].set_visible(False)
        axes.set_title(f"{row / rate_hz:.1f} s, pressed {depths[row].max():.1f} mm", fontsize=9)
    return figure, note


def _from_the_side(axes: Axes, arm: Float[ndarray, "2"], depth_mm: float) -> None:
    """Draw the robot from its right side, in the plane ahead and up: marker above the fist."""
    marker = marker_at(arm)[[0, 2]]
    fist = marker - MARKER_ON_ARM[2] * np.array([np.sin(arm[0]), np.cos(arm[0])])
    ahead, up = SHOULDER[[0, 2]]
    axes.plot([ahead - 0.05, ahead], [0.6, up], color=FAINT, linewidth=9, solid_capstyle="round")
    axes.plot(*EYE_POSITION[[0, 2]], marker="o", color=FAINT, markersize=17)
    axes.plot([0.3, 0.82], [TABLE_TOP_M] * 2, color=INK, linewidth=1.5)
    cap = CAP_TOP_M - depth_mm / 1000
    axes.plot([CAP_X_M - 0.035, CAP_X_M + 0.035], [cap, cap], color=ASTRAY, linewidth=3)
    axes.plot([ahead, fist[0]], [up, fist[1]], color=INK, linewidth=4, solid_capstyle="round")
    axes.plot(*fist, marker="o", color=INK, markersize=9)
    axes.plot(*marker, marker="o", color="#ff0000", markersize=5)
    axes.set(xlim=(-0.2, 0.9), ylim=(0.58, 1.45), aspect="equal")
