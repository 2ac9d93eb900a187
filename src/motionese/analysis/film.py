"""A film strip of one performance: rendered, or drawn from the side from the robot's shapes."""

from collections.abc import Mapping

import mujoco
import numpy as np
from jaxtyping import Float, Int
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from numpy import ndarray
from scipy.spatial import ConvexHull

from motionese.body import Geometry, pictures
from motionese.errors import RenderingError
from motionese.figure_style import WIDTH

FRAMES, COLUMNS = 8, 4
ROUND = np.linspace(0, 2 * np.pi, 24, endpoint=False)


def moments(effects: Mapping[str, Float[ndarray, " T"]], rows: int) -> Int[ndarray, " F"]:
    """Return the rows to show: from the start over the first strongest effect to its end.

    Where nothing was brought about, they lie evenly over the performance's `rows`.
    """
    strongest = max(effects.values(), key=lambda values: float(values.max()), default=np.zeros(1))
    pressed = int(strongest.argmax())
    deepest = pressed if pressed else rows // 2
    end = min(2 * deepest, rows - 1) if pressed else rows - 1
    before = np.linspace(0, deepest, FRAMES // 2 + 1)
    after = np.linspace(deepest, end, FRAMES // 2)[1:]
    return np.round(np.concatenate([before, after])).astype(np.int64)


def film(
    arrays: Mapping[str, ndarray], model: mujoco.MjModel, rate_hz: float
) -> tuple[Figure, str]:
    """Draw the strip; return it with a note that says why it could not be rendered, or ""."""
    effects = {name: values for name, values in arrays.items() if name.startswith("effect.")}
    rows = moments(effects, len(arrays["poses"]))
    note, rendered = "", None
    try:
        rendered = pictures(model, arrays["poses"][rows])
    except RenderingError as reason:
        note = f"Drawn from the side from the robot's shapes: {reason}."
    lines = -(-len(rows) // COLUMNS)
    figure = Figure(figsize=(WIDTH, lines * (2.05 if rendered is not None else 2.2)))
    panels = figure.subplots(lines, COLUMNS, squeeze=False).reshape(-1)
    geometry = Geometry(model)
    for place, (axes, row) in enumerate(zip(panels, rows, strict=True)):
        if rendered is not None:
            axes.imshow(rendered[place], interpolation="none")
        else:
            _from_the_side(axes, geometry, arrays["poses"][row])
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
        deepest = max((values[row] for values in effects.values()), default=None)
        pressed = "" if deepest is None else f", pressed {deepest:.1f} mm"
        axes.set_title(f"{row / rate_hz:.1f} s{pressed}", fontsize=9)
    return figure, note


def _from_the_side(axes: Axes, geometry: Geometry, pose: Float[ndarray, " P"]) -> None:
    """Draw every shape's outline in the plane ahead and up, the nearest to the viewer last."""
    bodies = geometry.placed(pose[None])[0]
    outlines = []
    for shape in geometry.shapes:
        if shape["type"] == "plane":
            continue
        body = bodies[shape["body"]]
        points = _turned(body[3:], _turned(np.array(shape["quat"]), _corners(shape)) + shape["pos"])
        outlines.append((points + body[:3], shape["rgba"]))
    for points, colour in sorted(outlines, key=lambda each: -float(each[0][:, 1].mean())):
        flat = points[:, [0, 2]]
        hull = flat[ConvexHull(flat, qhull_options="QJ").vertices]
        axes.add_patch(Polygon(hull, facecolor=colour, edgecolor="none"))
    axes.set(xlim=(-0.2, 0.9), ylim=(0.58, 1.45), aspect="equal")


def _corners(shape: Mapping[str, object]) -> Float[ndarray, "N 3"]:
    """Return points whose hull is about that of a shape, in its own frame [m]."""
    size = np.pad(np.asarray(shape["size"], dtype=np.float64), (0, 3))[:3]
    ring = np.stack([np.cos(ROUND), np.sin(ROUND), 0 * ROUND], axis=1)
    circles = np.concatenate([ring, ring[:, [0, 2, 1]], ring[:, [2, 0, 1]]])
    kind, ends = shape["type"], [np.array([0.0, 0.0, z]) for z in (-size[1], size[1])]
    if kind == "box":
        return np.asarray(size * np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T)
    if kind in ("capsule", "cylinder"):
        outline = circles if kind == "capsule" else ring
        return np.concatenate([size[0] * outline + end for end in ends])
    return np.asarray((size if kind == "ellipsoid" else size[0]) * circles)


def _turned(
    quaternion: Float[ndarray, "4"], points: Float[ndarray, "N 3"]
) -> Float[ndarray, "N 3"]:
    w, axis = quaternion[0], quaternion[1:]
    twice = 2 * np.cross(axis, points)
    return np.asarray(points + w * twice + np.cross(axis, twice))
