"""Who is followed: Cf, Cs or neither, a seed a point in a triangle of shares."""

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
import pandas as pd
from jaxtyping import Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.curves import Looks
from motionese.analysis.roles.seed_points import legend
from motionese.analysis.style import Look
from motionese.figure_style import FAINT, INK, PAPER, WIDTH

KINDS = {"first": "First strokes", "order": "Order: later strokes, after the same beginning"}
CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, np.sqrt(3) / 2]])
"""Where all strokes follow Cf, where all follow Cs, where all follow neither."""
AREA = 15.0
"""Area of a point of one seed [points²]."""
SIDE = 256.0
"""The triangle's side [points], about."""


class Crowd(NamedTuple):
    """Runs of a condition that have the same shares, those that follow Cf and Cs."""

    condition: str
    shares: tuple[float, float]
    runs: int


def triangle(
    table: pd.DataFrame, looks: Looks, yours: pd.DataFrame | None = None, suffix: str = ""
) -> Figure:
    """Draw, for first strokes and for order, who is followed in each run.

    Runs of a condition that lie at one place are one point, as large as they are many, with their
    number; several conditions at one place lie around it. Runs of `yours` are drawn over them.

    Args:
        table: A row per condition and seed.
        looks: How each condition is drawn.
        yours: The same of other runs.
        suffix: Of the columns, for states that were recognised in another way.
    """
    columns = {kind: [f"{kind}_by_{level}{suffix}" for level in ("cf", "cs")] for kind in KINDS}
    kinds = [kind for kind in KINDS if table[columns[kind]].notna().any(axis=None)]
    figure = Figure(figsize=(WIDTH / 2 * max(len(kinds), 1), 4.5))
    panels = figure.subplots(1, max(len(kinds), 1), squeeze=False)[0]
    for axes, kind in zip(panels, kinds, strict=False):
        _frame(axes, KINDS[kind])
        theirs = list(crowds(table, columns[kind], looks))
        own = [] if yours is None else list(crowds(yours, columns[kind], looks))
        aside = _aside([*theirs, *own], looks)
        for crowd in theirs:
            _draw(axes, crowd, looks[crowd.condition], aside(crowd), pale=yours is not None)
        for crowd in own:
            _mark(axes, crowd, looks[crowd.condition], aside(crowd))
    legend(figure, looks, yours)
    return figure


def crowds(table: pd.DataFrame, columns: Sequence[str], looks: Looks) -> Iterator[Crowd]:
    """Yield the places of runs in the triangle, each with how many there are."""
    for name in looks:
        own = table.loc[table["condition"] == name, list(columns)].dropna().astype(float)
        places, counts = np.unique(own.round(3), axis=0, return_counts=True)
        for (cf, cs), count in zip(places, counts, strict=True):
            yield Crowd(name, (float(cf), float(cs)), int(count))


def place(shares: tuple[float, float]) -> Float[ndarray, "2"]:
    """Return where shares that follow Cf and Cs lie in the triangle; the rest follows neither."""
    cf, cs = shares
    return np.asarray(np.array([cf, cs, 1 - cf - cs]) @ CORNERS)


def _aside(crowds: Sequence[Crowd], looks: Looks) -> Callable[[Crowd], Float[ndarray, "2"]]:
    """Return how far from its place a crowd lies: nowhere if no other condition is there."""
    there: dict[tuple[float, float], list[Crowd]] = {}
    for crowd in crowds:
        there.setdefault(crowd.shares, []).append(crowd)
    turns = {name: np.pi * (0.75 - 2 * k / len(looks)) for k, name in enumerate(looks)}

    def aside(crowd: Crowd) -> Float[ndarray, "2"]:
        others, turn = there[crowd.shares], turns[crowd.condition]
        alone = len({each.condition for each in others}) == 1
        reach = 1.3 * _radius(max(each.runs for each in others)) / SIDE
        return (0.0 if alone else reach) * np.array([np.cos(turn), np.sin(turn)])

    return aside


def _radius(runs: int) -> float:
    """Return half the width of a point [points]."""
    return float(np.sqrt(AREA * runs)) / 2


def _draw(axes: Axes, crowd: Crowd, look: Look, aside: Float[ndarray, "2"], *, pale: bool) -> None:
    x, y = place(crowd.shares) + aside
    axes.scatter(
        x, y, s=AREA * crowd.runs, marker=look.marker, linewidth=1.4, zorder=3,
        facecolor=look.colour if look.line == "-" else PAPER, edgecolor=look.colour,
        alpha=0.55 if pale else 1.0,
    )  # fmt: skip
    if crowd.runs > 1 and not pale:
        out = aside / np.linalg.norm(aside) if aside.any() else np.array([0.9, 0.5])
        right, up = (_radius(crowd.runs) + 6) * out
        axes.annotate(
            str(crowd.runs), (x, y), xytext=(right, up),
            textcoords="offset points", ha="center", va="center", fontsize=8,
        )  # fmt: skip


def _mark(axes: Axes, crowd: Crowd, look: Look, aside: Float[ndarray, "2"]) -> None:
    x, y = place(crowd.shares) + aside
    axes.scatter(
        x, y, s=1.5 * AREA * crowd.runs, marker=look.marker, linewidth=1.4, zorder=4,
        facecolor=PAPER, edgecolor=INK,
    )  # fmt: skip


def _frame(axes: Axes, title: str) -> None:
    """Draw the triangle with a faint line at every quarter of a share."""
    for share, level in product((0.25, 0.5, 0.75), range(3)):
        shares = np.zeros((2, 3))
        shares[:, level] = share
        shares[[0, 1], [level - 1, level - 2]] = 1 - share
        axes.plot(*(shares @ CORNERS).T, color=FAINT, alpha=0.35, linewidth=0.6, zorder=1)
    axes.plot(*CORNERS[[0, 1, 2, 0]].T, color=FAINT, linewidth=1.0, zorder=2)
    for at, followed in zip(CORNERS, ("Cf₀", "Cs₀", "neither"), strict=True):
        below = at[1] == 0
        axes.annotate(
            f"all follow {followed}", at, xytext=(0, -26 if below else 14), fontweight="bold",
            textcoords="offset points", ha="center", va="top" if below else "bottom",
        )  # fmt: skip
    axes.set(title=title, aspect="equal", xlim=(-0.16, 1.16), ylim=(-0.17, 0.98))
    axes.axis("off")
