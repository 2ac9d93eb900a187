"""Motions drawn with their pauses, and the measures of two groups beside each other."""

from collections.abc import Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy import ndarray

from motionese.analysis.statistics import estimate
from motionese.figure_style import FAINT, HUES, INK, PAPER, WIDTH
from motionese.interfaces.commands.motion_figure import write_drawing
from motionese.kinematics import Measures

MOST, ROW_HEIGHT = 6, 2.6
"""Motions drawn at most, and the height of one [inch]."""
POINTS_A_SECOND = 260.0
"""Area of a pause [points²] for every second it lasts."""
WAY, PAUSE, SHADE = HUES[0][0], HUES[1][0], HUES[1][1]
COLUMNS, PANEL_HEIGHT = 4, 2.0
"""Panels of measures side by side, and their height [inch]."""


def write_pauses_figure(
    path: Path, measured: Mapping[str, Measures], channels: Sequence[str], unit: str, title: str
) -> None:
    """Draw motions: the way in a plane with pauses as dots, and speed over time.

    Args:
        path: The file to write; PNG if it ends so, else SVG.
        measured: The motions by name; those that could not be smoothed are left out.
        channels: Names of the D columns. The two that extend furthest make the plane.
        unit: Of all of them; empty where unknown.
        title: The figure's.

    Raises:
        StorageError: A file that cannot be written.
    """
    drawn = {name: m for name, m in measured.items() if m.tracks}
    if len(drawn) > MOST:
        title += f" (the first {MOST} are drawn)"
    shown = dict(list(drawn.items())[:MOST])
    write_drawing(path, "pauses", lambda: _pauses_figure(shown, channels, unit, title))


def _pauses_figure(
    measured: Mapping[str, Measures], channels: Sequence[str], unit: str, title: str
) -> Figure:
    rows = max(len(measured), 1)
    figure = Figure(figsize=(WIDTH, rows * ROW_HEIGHT + 0.9))
    panels = figure.subplots(rows, 2, squeeze=False, width_ratios=[2, 3])
    for (place, course), (name, one) in zip(panels, measured.items(), strict=False):
        _draw_way(place, one, channels, unit)
        _draw_speed(course, one, unit)
        course.set_title(name)
    for panel in panels[len(measured) :].ravel():
        panel.set_visible(False)
    panels[max(len(measured), 1) - 1, 1].set_xlabel("time [s]")
    figure.legend(handles=_legend(), loc="outside lower left", ncols=6)
    figure.suptitle(title, x=0.01, ha="left")
    return figure


def _draw_way(panel: Axes, one: Measures, channels: Sequence[str], unit: str) -> None:
    """Draw a way in the plane of the two channels that extend furthest."""
    positions = np.concatenate([track.positions for track in one.tracks])
    wide = np.sort(np.argsort(-np.ptp(positions, axis=0), kind="stable")[:2])
    plane = wide if len(wide) == 2 else np.array([0, 0])
    for track in one.tracks:
        panel.plot(*track.positions[:, plane].T, color=WAY, linewidth=1.3)
    panel.plot(*positions[0, plane], "o", color=WAY, markerfacecolor=PAPER, markersize=6, zorder=4)
    for number, pause in enumerate(one.pauses, 1):
        place, area = pause.position[plane], POINTS_A_SECOND * pause.seconds
        panel.scatter(place[0], place[1], s=area, color=PAUSE, alpha=0.75, linewidths=0, zorder=3)
        panel.annotate(str(number), place, fontsize=7.5, color=INK, ha="center", va="center")
    labels = [f"{channels[c]}{f' [{unit}]' if unit else ''}" for c in plane]
    panel.set(xlabel=labels[0], ylabel=labels[1])
    panel.set_aspect("equal", adjustable="datalim")
    panel.margins(0.15)
    panel.grid(visible=True, color=FAINT, alpha=0.2)


def _draw_speed(panel: Axes, one: Measures, unit: str) -> None:
    """Draw speed over time, what is pause shaded, what is still below a line."""
    for track in one.tracks:
        panel.plot(track.times, track.speeds, color=WAY, linewidth=1.3)
    for number, pause in enumerate(one.pauses, 1):
        panel.axvspan(pause.start_s, pause.end_s, color=SHADE, alpha=0.4, linewidth=0)
        middle = (pause.start_s + pause.end_s) / 2
        panel.annotate(
            str(number),
            (middle, 0.97),
            xycoords=("data", "axes fraction"),
            fontsize=7.5,
            color=INK,
            ha="center",
            va="top",
        )
    panel.axhline(one.still, color=INK, linewidth=0.9, linestyle="--")
    panel.set_ylabel(f"speed [{unit or 'unit'}/s]")
    panel.set_ylim(bottom=0)
    panel.margins(x=0.01)
    panel.grid(visible=True, color=FAINT, alpha=0.2)


def _legend() -> list[Line2D | Patch]:
    dot: dict[str, Any] = {"linestyle": "", "marker": "o"}
    area = np.sqrt(POINTS_A_SECOND * 0.5)
    return [
        Line2D([], [], color=WAY, label="motion"),
        Line2D([], [], color=WAY, markerfacecolor=PAPER, markersize=6, label="begins", **dot),
        Line2D(
            [],
            [],
            color=PAUSE,
            alpha=0.75,
            markeredgewidth=0,
            markersize=float(area),
            label="pause of 0.5 s (area: length)",
            **dot,
        ),
        Patch(color=SHADE, alpha=0.4, linewidth=0, label="pause"),
        Line2D([], [], color=INK, linewidth=0.9, linestyle="--", label="still below"),
    ]


def write_groups_figure(
    path: Path, names: Sequence[str], values: Mapping[str, Sequence[Float[ndarray, " _"]]]
) -> None:
    """Draw the measures of two groups: every episode a point, the means with their intervals.

    Args:
        path: The file to write; PNG if it ends so, else SVG.
        names: The groups' names.
        values: Of every measure, by its label with its unit, one array a group; NaN is left out.

    Raises:
        StorageError: A file that cannot be written.
    """
    write_drawing(path, "groups", lambda: _groups_figure(names, values))


def _groups_figure(
    names: Sequence[str], values: Mapping[str, Sequence[Float[ndarray, " _"]]]
) -> Figure:
    rows = ceil(len(values) / COLUMNS)
    figure = Figure(figsize=(WIDTH, rows * PANEL_HEIGHT + 0.9))
    panels = figure.subplots(rows, COLUMNS, squeeze=False).ravel()
    for panel, (label, groups) in zip(panels, values.items(), strict=False):
        panel.set_title(label)
        for place, (group, look) in enumerate(zip(groups, _looks(), strict=True)):
            _draw_group(panel, place, group, look)
        panel.set_xlim(-0.6, len(names) - 0.4)
        panel.set_xticks(range(len(names)), "AB"[: len(names)])
        panel.grid(visible=True, axis="y", color=FAINT, alpha=0.2)
    for panel in panels[len(values) :]:
        panel.set_visible(False)
    handles = [
        Line2D([], [], linestyle="", label=f"{letter}: {name}", **look)
        for letter, name, look in zip("AB", names, _looks(), strict=True)
    ]
    handles.append(Line2D([], [], color=INK, label="mean and 95 % interval"))
    figure.legend(handles=handles, loc="outside lower left", ncols=3)
    return figure


def _looks() -> list[dict[str, Any]]:
    return [{"color": HUES[0][0], "marker": "o"}, {"color": HUES[1][0], "marker": "s"}]


def _draw_group(
    panel: Axes, place: int, group: Float[ndarray, " _"], look: Mapping[str, Any]
) -> None:
    kept = group[np.isfinite(group)]
    if not len(kept):
        panel.text(place, 0.5, "–", transform=panel.get_xaxis_transform(), ha="center")
        return
    aside = place - 0.12 + 0.16 * ((np.arange(len(kept)) * 0.618034) % 1 - 0.5)
    panel.scatter(aside, kept, s=14, alpha=0.6, linewidths=0, **look)
    mean = estimate(kept, np.mean)
    panel.plot([place + 0.16] * 2, [mean.low, mean.high], color=INK, linewidth=1.6)
    panel.plot(place + 0.16, mean.value, color=INK, marker="_", markersize=9)
