"""Which figures the report shows, and what their captions say."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import pandas as pd
from matplotlib import rc_context
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.changes_figure import changes_figure
from motionese.analysis.curves import along_stages, error_sources, learning_curves, success
from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.film import film
from motionese.analysis.inside import Performed, inside
from motionese.analysis.map_figure import slow_state_map
from motionese.analysis.map_numbers import level_names
from motionese.analysis.mochizuki2013 import CONVERGED_CM, has_its_design
from motionese.analysis.new_sequences import new_sequences
from motionese.analysis.paths import paths
from motionese.analysis.roles.role_figures import role_figures
from motionese.analysis.seed_measures import Measures, typical_seed
from motionese.analysis.while_shown import following, noticing
from motionese.figure_style import SETTINGS, Drawing, finished
from motionese.imitation import sample_sequence

OVER_SEEDS = (
    "Lines are medians over seeds of a loop's mean over its motions, bands their bootstrap 95 % "
    "intervals."
)


class Shown(NamedTuple):
    """A figure with its name, the report's section it belongs to, and its caption."""

    name: str
    section: str
    caption: str
    drawing: Drawing


def figures(
    data: ExperimentData,
    measures: Measures,
    by_seed: pd.DataFrame,
    changed: pd.DataFrame | None = None,
) -> Iterator[Shown]:
    """Draw all figures that the runs allow, one after the other.

    `by_seed` has the measures of every run in one table, as of `seed_table`; `changed`, as of
    `changes`, when lesson and network changed, where that answers the learner.
    """
    with rc_context(SETTINGS):
        roles = [_shown(n, "roles", said, f) for n, said, f in role_figures(data, by_seed)]
        if changed is not None:
            said = (
                "When lesson and network changed: the share of runs in which each change had come "
                "after so many loops, and in which the last lesson had been mastered (below 2 cm "
                "for three loops in a row)."
            )
            roles.append(_shown("changes", "changes", said, changes_figure(changed, data.looks)))
    yield from roles
    for draw in (_over_loops, _of_new_sequences, _while_shown, _of_the_map, _of_the_inside):
        with rc_context(SETTINGS):
            drawn = list(draw(data, measures))
        yield from drawn


def _shown(name: str, section: str, caption: str, figure: Figure) -> Shown:
    return Shown(name, section, caption, finished(figure, name))


def _over_loops(data: ExperimentData, measures: Measures) -> Iterator[Shown]:
    loops, looks = along_stages(data.loops), data.looks
    converged, stages = CONVERGED_CM if has_its_design(data.study) else None, ""
    if len(data.study.stages) > 1:
        stages = (
            " Upright lines are changes of stage: what is taught changes, or a level of the "
            "network opens."
        )
    if not loops["loop"].equals(data.loops["loop"]):
        stages += (
            " Runs took different numbers of loops over a stage: each stage begins after the "
            "longest run of the one before, and its last loops are those of the slowest runs alone."
        )
    yield _shown(
        "learning_curves",
        "learning",
        "Imitation error over the loops: mean distance of the robot's hand from the shown one. "
        f"{OVER_SEEDS}{stages}",
        learning_curves(loops, looks, converged),
    )
    yield _shown(
        "error_sources",
        "learning",
        "Where the error comes from: what was recognised against what was shown, what the body did "
        "against what the network predicted, and what the trained network reproduces of its own "
        f"experience. {OVER_SEEDS}",
        error_sources(loops, looks),
    )
    yield _shown(
        "success",
        "success",
        "What was achieved, all seeds and motions of a loop together: "
        f"{'; '.join(outcome.title for outcome in data.task.outcomes)}.",
        success(loops, looks, data.task.outcomes),
    )


def _of_new_sequences(data: ExperimentData, measures: Measures) -> Iterator[Shown]:
    present = set(data.new_sequences["condition"])
    looks = {name: look for name, look in data.looks.items() if name in present}
    if looks:
        yield _shown(
            "new_sequences",
            "new sequences",
            "Imitation of new sequences after the last loop, none of which was taught as a whole: "
            "of taught pairs (trained), and with a pair that was never taught (untrained). A point "
            "is a seed's mean over sequences, joined across the two; black bars beside them are "
            "medians over seeds with their bootstrap 95 % intervals.",
            new_sequences(measures, looks),
        )


def _while_shown(data: ExperimentData, measures: Measures) -> Iterator[Shown]:
    online, turns = data.online, data.switches
    if len(online):
        looks = {n: look for n, look in data.looks.items() if n in set(online["condition"])}
        yield _shown(
            "following",
            "online",
            "The robot imitates while it watches: imitation error by how many rows it is behind. "
            "With a lag of 0 it commands what it predicts. On the right the same demonstrations, "
            "recognised as a whole and then performed. Medians over seeds of the mean over "
            "sequences, with bootstrap 95 % intervals.",
            following(online, looks),
        )
    first = turns.drop_duplicates(["condition", "seed"]).set_index("condition")
    seeds = {str(c): int(own["seed"].iloc[0]) for c, own in first.groupby(level=0, sort=False)}
    kept = {c: arrays for c, s in seeds.items() if (arrays := data.inside(c, s))}
    kept = {c: arrays for c, arrays in kept.items() if "switch" in arrays}
    if kept:
        yield _shown(
            "noticing",
            "online",
            "Belief against time while a demonstration turns, in mid-stroke, into another motion "
            "(upright line); dashed: the row from which the robot believes in what is shown now. "
            f"Shown is the first turn of the first seed: {_in_words({c: seeds[c] for c in kept})}.",
            noticing(kept, first[~first.index.duplicated()], data.looks, data.robot.rate_hz),
        )


def _of_the_map(data: ExperimentData, measures: Measures) -> Iterator[Shown]:
    shown = _typical(measures.resultant_length)
    if not shown:
        return
    below, top = (name.capitalize() for name in level_names(data.study))
    for segment, what, right in (
        (1, "the first segment", "the primitive's own direction"),
        (2, "the second segment", "the direction of a primitive that may follow"),
    ):
        yield _shown(
            f"slow_state_map_{segment}",
            "map",
            f"The map of {top}₀, {what}: where the hand goes, as the robot sees it, when each "
            f"primitive's {below}₀ is held and {top}₀ is varied. In the condition's colour: within "
            f"45° of {right}; in pink: beyond. An arrow fills its cell where the hand goes as far "
            "as the stroke is long. Shown is the seed of median resultant length: "
            f"{_in_words(shown)}; the numbers below are over all seeds.",
            slow_state_map(data, shown, segment),
        )


def _of_the_inside(data: ExperimentData, measures: Measures) -> Iterator[Shown]:
    """Draw paths, activity and a film strip of each condition's run of median error."""
    new, error = data.new_sequences, "imitation_error_cm"
    errors = new.pivot_table(error, index="seed", columns="condition", aggfunc="mean")
    seeds = _typical(errors.reindex(columns=list(data.looks)))
    kept = {c: arrays for c, s in seeds.items() if (arrays := data.inside(c, s))}
    sample = sample_sequence(data.task)
    if not kept or sample is None:
        return
    chosen = f"Shown is the seed of median error: {_in_words({c: seeds[c] for c in kept})}."
    yield _shown(
        "paths",
        "inside",
        "The hand's path (coloured) against the shown one (grey), as the robot sees them, for "
        "every new sequence; the dot is where it starts, bars are where something is to be "
        f"pressed. {chosen}",
        paths(kept, data),
    )
    yield _shown(
        "inside",
        "inside",
        f"The network while it performs {sample.name}: activity of every unit, the slowest level "
        "on top, and the way of the context units through the plane of their largest variance. "
        "Upright lines and circled numbers: where the next primitive begins in what was shown; "
        f"dot: start; square: end. {chosen}",
        inside({c: _performed(a, data) for c, a in kept.items()}, sample.name, data.looks),
    )
    strongest = max(kept, key=lambda c: _strongest_effect(kept[c]))
    strip, note = film(kept[strongest], data.robot.model, data.robot.rate_hz)
    yield _shown(
        "film",
        "inside",
        f"The robot performs {sample.name}: {strongest}, seed {seeds[strongest]}. {note}".strip(),
        strip,
    )


def _strongest_effect(kept: Mapping[str, ndarray]) -> float:
    return max((float(v.max()) for n, v in kept.items() if n.startswith("effect.")), default=0.0)


def _performed(kept: Mapping[str, ndarray], data: ExperimentData) -> Performed:
    activity, levels, begin = kept["activity"], {}, 0
    for level in data.study.network.drawn_levels(data.robot.channels):
        if begin < activity.shape[1]:
            levels[level.name] = slice(begin, begin + level.size)
            begin += level.size
    boundaries = [int(row) for row in kept["begins"][1:]]
    return Performed(activity, levels, boundaries, data.robot.rate_hz)


def _typical(by_seed: pd.DataFrame) -> dict[str, int]:
    """Return the seed of median value of every condition that has one."""
    return {str(c): typical_seed(by_seed[c]) for c in by_seed if by_seed[c].notna().any()}


def _in_words(shown: Mapping[str, int]) -> str:
    return ", ".join(f"{condition} {seed}" for condition, seed in shown.items())
