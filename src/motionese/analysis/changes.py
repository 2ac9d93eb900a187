"""When lesson and network changed in every run, and how soon the last lesson was mastered.

The last lesson counts as mastered once its mean error, each motion counting by its last one, has
stayed below 2 cm for three loops in a row.
"""

from collections.abc import Sequence

import pandas as pd

from motionese.analysis.cells import NONE, Table, number
from motionese.analysis.roles.role_shares import WHO
from motionese.analysis.statistics import estimate
from motionese.experiment import Study
from motionese.experiment.run import EMERGED
from motionese.imitation import LoopDone, Settled
from motionese.imitation.readiness import lesson_errors

MASTERED = Settled(loops=3, below_cm=2.0, share=1.0)
NEEDED, DEMONSTRATIONS = "loops_needed", "demonstrations_needed"


def answers_the_learner(study: Study) -> bool:
    """Whether anything changes by what the learner does, or beside the stages."""
    endings = [
        stage.until for condition in study.conditions for stage in study.development(condition)
    ]
    adaptive = any(u.settled or u.mastered or u.emerged for u in endings)
    chosen = any(s.choosing.shown for c in study.conditions for s in study.development(c))
    return adaptive or chosen or bool(study.opens)


def changes(loops: pd.DataFrame, development: pd.DataFrame, study: Study) -> pd.DataFrame:
    """Return a row per run that ended.

    Beside `condition` and `seed`: `stage_1_ends` …, after which loop each stage but the last ended;
    `CS_opens`, of every context level but the first, after which loop it opened (0: it was open
    from the start; NaN: it did not); `loops` and `demonstrations` in all; `loops_needed` and
    `demonstrations_needed`, with which the last lesson was mastered (NaN: it was not); and
    `emerged_LEVEL` after the last loop, where that was measured.
    """
    rows = []
    known = development.set_index(WHO).sort_index()
    for (condition, seed), own in loops.groupby(WHO, sort=False):
        row = {"condition": condition, "seed": seed, **_stages(own, len(study.stages))}
        grown = known.loc[[(condition, seed)]].sort_values("loop")
        row |= _openings(grown, list(study.network.levels))
        row |= {"loops": own["loop"].max(), "demonstrations": len(own)}
        row |= _needed(own, len(study.stages))
        row |= {c: grown[c].iloc[-1] for c in map(str, grown) if c.startswith(EMERGED)}
        rows.append(row)
    return pd.DataFrame(rows)


def _stages(own: pd.DataFrame, stages: int) -> dict[str, float]:
    ends = own.groupby("phase")["loop"].max()
    reached = int(own["phase"].max())
    return {
        f"stage_{n}_ends": float(ends[n]) if n < reached else float("nan") for n in range(1, stages)
    }


def _openings(grown: pd.DataFrame, levels: Sequence[str]) -> dict[str, float]:
    opened = {level: grown.loc[grown["levels"] > n, "loop"] for n, level in enumerate(levels)}
    return {
        f"{level}_opens": float(loops.min() - 1) if len(loops) else float("nan")
        for level, loops in list(opened.items())[2:]
    }


def _needed(own: pd.DataFrame, stages: int) -> dict[str, float]:
    """Return with how many loops, and demonstrations, the last lesson was mastered."""
    last = own[own["phase"] == stages]
    by_loop = [
        LoopDone(stages - 1, dict(zip(rows["motion"], rows["imitation_error_cm"], strict=True)), 0)
        for _, rows in last.groupby("loop")
    ]
    errors = lesson_errors(by_loop, list(dict.fromkeys(last["motion"])))
    first = next(
        (
            n
            for n in range(MASTERED.loops, len(errors) + 1)
            if max(errors[n - MASTERED.loops : n]) < MASTERED.below_cm
        ),
        None,
    )
    if first is None:
        return dict.fromkeys((NEEDED, DEMONSTRATIONS), float("nan"))
    loop = int(last["loop"].min()) + first - 1
    return {NEEDED: float(loop), DEMONSTRATIONS: float((own["loop"] <= loop).sum())}


def censored(table: pd.DataFrame, column: str, of: str) -> pd.DataFrame:
    """Return a measure by seed and condition; a run that never got there has one more than all."""
    filled = table[column].fillna(table[of] + 1)
    return table.assign(value=filled).pivot(index="seed", columns="condition", values="value")


def further_measures(
    study: Study, by_seed: pd.DataFrame, changed: pd.DataFrame
) -> dict[str, pd.DataFrame]:
    """Return by their names what effects are asked of beside errors: loops needed, separation.

    Args:
        study: The settings of the runs.
        by_seed: Their measures, as of `seed_table`.
        changed: When lesson and network changed, as of `changes`.
    """
    separation = by_seed.pivot(index="seed", columns="condition", values="separation")
    tables = {
        "loops until the last lesson is mastered [loops]": censored(changed, NEEDED, "loops"),
        "separation of the roles [1]": separation.astype(float),
    }
    names = [condition.name for condition in study.conditions]
    return {name: table.reindex(columns=names) for name, table in tables.items()}


def changes_table(table: pd.DataFrame, conditions: Sequence[str]) -> Table:
    """Return medians over seeds, with the smallest and the largest value, a row per condition."""
    columns = [column for column in map(str, table) if column not in WHO]
    rows = []
    for name in conditions:
        own = table[table["condition"] == name]
        rows.append([name, *(_spread(own[column]) for column in columns)])
    return Table(["condition", *(_said(column) for column in columns)], rows)


def _said(column: str) -> str:
    level = column.removeprefix(EMERGED).capitalize()
    if column.startswith(EMERGED):
        return f"emerged in {level} at the end"
    return (
        column.removesuffix("_opens").capitalize() + " opens"
        if column.endswith("_opens")
        else column.replace("_", " ")
    )


def _spread(values: "pd.Series[float]") -> str:
    """Return the median, smallest and largest value, and how many runs have none."""
    kept, digits = values.dropna(), 0 if (values.dropna() % 1 == 0).all() else 2
    if kept.empty:
        return NONE
    middle = number(estimate(kept.to_numpy(dtype=float)).value, digits)
    ends = [number(float(end), digits) for end in (kept.min(), kept.max())]
    told = middle if ends[0] == ends[1] else f"{middle} ({ends[0]}–{ends[1]})"
    missing = len(values) - len(kept)
    return f"{told}; never in {missing}" if missing else told
