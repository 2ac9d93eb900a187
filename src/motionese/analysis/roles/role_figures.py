"""The figures of what role each level plays, and what their captions say."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import pandas as pd
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks, along_stages
from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import level_names
from motionese.analysis.roles.branching import Lesson, branch_chance, ways_on
from motionese.analysis.roles.decoding_figure import order_decoded
from motionese.analysis.roles.lesion_figure import lesions
from motionese.analysis.roles.order_map_figure import order_map
from motionese.analysis.roles.recall import strokes_recalled
from motionese.analysis.roles.recall_figure import recall
from motionese.analysis.roles.symbols_figure import symbols
from motionese.analysis.roles.triangle import triangle
from motionese.analysis.seed_measures import typical_seed

MEDIANS = "Large markers are medians over seeds, with bootstrap 95 % intervals; "
AMBIGUOUS = (
    "A stroke is ambiguous if another motion of the lesson goes on otherwise after the same "
    "beginning."
)


class RoleFigure(NamedTuple):
    """A figure with its name and its caption."""

    name: str
    caption: str
    figure: Figure


def role_figures(data: ExperimentData, table: pd.DataFrame) -> Iterator[RoleFigure]:
    """Draw what runs tell of the roles of their levels, as far as their lesson has cases of it.

    Args:
        data: The runs.
        table: Their measures, as of `seed_table`.
    """
    looks = data.looks
    lessons = last_lessons(data)
    chances = pd.Series([branch_chance(lesson) for lesson in lessons.values()])
    shown = data.symbols[
        (data.symbols["demonstration"] == 1)
        & (data.symbols["level"] == level_names(data.study)[0])
        & (data.symbols["reference"] == "taught")
    ]
    seeds = _typical(table, "symbols_right")
    examples = {c: _of(shown, c, seed) for c, seed in seeds.items()}
    yield from table_figures(table, looks, float(chances.mean()), examples=examples)
    yield from _recall(data)
    yield from _maps(data, table, lessons)
    yield from _decoded(data)


def last_lessons(data: ExperimentData) -> dict[str, Lesson]:
    """Return the lesson of the last stage, by condition that has an ended run."""
    conditions = {c.name: c for c in data.study.conditions if c.name in data.looks}
    return {name: data.study.development(c)[-1].lesson for name, c in conditions.items()}


def table_figures(
    table: pd.DataFrame,
    looks: Looks,
    chance: float,
    yours: pd.DataFrame | None = None,
    examples: Mapping[str, pd.DataFrame] | None = None,
) -> Iterator[RoleFigure]:
    """Draw who is followed, lesions and symbols from a table of measures alone.

    Args:
        table: A row per condition and seed, as of `seed_table`.
        looks: How each condition is drawn.
        chance: The share of ambiguous strokes that are right by chance.
        yours: The same of other runs, which are drawn as points over it.
        examples: By condition, what was read out of one run.
    """
    points = "points are single runs." if yours is None else "points are your runs."
    if table[["first_by_cf", "order_by_cf"]].notna().any(axis=None):
        yield RoleFigure(
            "who_is_followed",
            "Who is followed. Of two motions that start in the same place the network generates "
            "with Cf₀ of the one and Cs₀ of the other, both recognised from fresh demonstrations "
            "by least squares. Left: motions whose first strokes differ. Right: motions that "
            "differ only later, after the same beginning, where nothing but memory tells which "
            "stroke follows. A point is a run: the nearer to a corner, the larger the share of "
            "strokes that follow it; lines are quarters. Runs that coincide are one larger point "
            "with their number; conditions that coincide lie around their place."
            + (" Black: your runs." if yours is not None else ""),
            triangle(table, looks, yours),
        )
    if table["first_intact"].notna().any():
        yield RoleFigure(
            "lesions",
            "Lesions. The share of strokes that go within 45° of the shown one, intact, with the "
            "initial state of one level set to its mean over the lesson, and with Cs cut off from "
            f"Cf. {AMBIGUOUS} {MEDIANS}{points}",
            lesions(table, looks, chance, yours),
        )
    if table["symbols_right"].notna().any():
        said = (
            " On the right, what is read in the first demonstrations of the median run of each "
            "condition; in pink: wrong."
        )
        yield RoleFigure(
            "symbols",
            "Primitives as symbols. While the network generates a motion that it has recognised, "
            "its sequence is read out of the activity of Cf, by that of the lesson's strokes in "
            "other demonstrations, and without being told how many there are or where one ends. "
            "Sequence read right: of edit distance 0; boundaries: of those, all within two steps "
            "of where the strokes were shown to begin. "
            f"{MEDIANS}{points}{said if examples else ''}",
            symbols(table, looks, examples or {}, yours),
        )


def _recall(data: ExperimentData) -> Iterator[RoleFigure]:
    strokes = strokes_recalled(along_stages(data.loops), data.task)
    if strokes["ambiguous"].any():
        yield RoleFigure(
            "recall",
            "Recall stroke by stroke over the loops: distance of the seen hand that the network "
            "generates, after training, from the initial states it has learned, from what its own "
            f"body did. {AMBIGUOUS} Medians over seeds with bootstrap 95 % intervals. Upright "
            "line: change of stage, where what is taught changes (TD) or a level opens (MD).",
            recall(strokes, data.looks),
        )


def _maps(
    data: ExperimentData, table: pd.DataFrame, lessons: Mapping[str, Lesson]
) -> Iterator[RoleFigure]:
    ways = {first: on for lesson in lessons.values() for first, on in ways_on(lesson).items()}
    seeds = _typical(table, "order_on_map")
    if not ways or not seeds:
        return
    first, on = next(iter(ways.items()))
    points = data.slow_state_map[data.slow_state_map["primitive"] == first]
    maps = {c: _of(points, c, seed) for c, seed in seeds.items()}
    told = ", ".join(f"{condition} {seed}" for condition, seed in seeds.items())
    yield RoleFigure(
        "order_map",
        f"Two maps of Cs₀ for one Cf₀, that of {first}. Above: the direction of the first stroke, "
        "by colour. Below: the second stroke, after which the lesson goes on in different ways, "
        "in the colour of the way that it is within 45° of. Where Cf holds the direction and Cs "
        "the order, the upper map is of one colour and the lower one is divided. Shown is the "
        f"seed of median order over the map: {told}.",
        order_map(maps, first, {way: data.strokes[way][0] for way in on}, level_names(data.study)),
    )


def _decoded(data: ExperimentData) -> Iterator[RoleFigure]:
    below, top = level_names(data.study)
    if not (data.decoding["what"] == "order").any():
        return
    titles = {below: f"Decoded from {below.capitalize()}", top: f"Decoded from {top.capitalize()}"}
    yield RoleFigure(
        "order_decoded",
        "The order, decoded from the activity of each level at every moment: the share of fresh "
        "demonstrations of which a linear decoder, fitted to others, tells which way the motion "
        "goes on. Time is counted from where the ways part (upright line): before it only memory "
        "can tell. What a level holds need not be heard by the others; that lesions and exchanges "
        "show. Medians over seeds with bootstrap 95 % intervals; dotted: chance.",
        order_decoded(data.decoding, data.looks, titles, data.robot.rate_hz),
    )


def _typical(table: pd.DataFrame, column: str) -> dict[str, int]:
    """Return the seed of median value of every condition that has one."""
    by_condition = table.dropna(subset=[column]).groupby("condition", sort=False)
    return {str(c): typical_seed(own.set_index("seed")[column]) for c, own in by_condition}


def _of(rows: pd.DataFrame, condition: str, seed: int) -> pd.DataFrame:
    return rows[(rows["condition"] == condition) & (rows["seed"] == seed)]
