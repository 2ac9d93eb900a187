"""The measures of every run in one table, a row per condition and seed.

It is small, and all that the figures of roles and the findings are made from: tables of other runs
can be kept and drawn beside one's own. Where a run has nothing to measure it has no value (NaN).
"""

import numpy as np
import pandas as pd

from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import level_names
from motionese.analysis.roles.branching import ways_on
from motionese.analysis.roles.order_on_map import order_on_map
from motionese.analysis.roles.recall import strokes_recalled
from motionese.analysis.roles.role_shares import (
    WHO,
    ByRun,
    decoded,
    followed,
    read_out,
    right_elements,
    spared,
)
from motionese.analysis.seed_measures import achieved, error_at_end, last_loops


def seed_table(data: ExperimentData) -> pd.DataFrame:
    """Return the measures of all runs that ended, those that diverged included.

    Beside `condition` and `seed`:

    - `loop_1_cm`, `end_of_stage_1_cm` …: imitation error in the first loop and at the end of each
      stage (mean over its last three loops); `pressed`: share of what was due that was achieved in
      the last three loops, where the task counts it.
    - `trained_cm`, `untrained_cm`, `untrained_spread_cm` (over the sequences): errors on new
      sequences by long search; `untrained_repertoire_cm` from all that was learned,
      `untrained_slow_alone_cm` with Cf_0 from the repertoire and only the levels above sought.
    - `map_length_1`, `map_length_2`: mean resultant lengths over the map of Cs_0;
      `own_direction`: share of it where the first stroke is the primitive's own; `order_on_map`:
      see `order_on_map`.
    - who is followed (`followed`), what lesions spare (`spared`), what is read out (`read_out`) and
      decoded (`decoded`), `right_elements`.
    - `recall_ambiguous_1_cm`, `recall_other_1_cm` …: recall error of ambiguous strokes and of all
      others, mean over the last three loops of each stage.
    """
    below, top = level_names(data.study)
    stages = range(1, len(data.study.stages) + 1)
    lessons = {c.name: data.study.development(c)[-1].lesson for c in data.study.conditions}
    numbers = data.map_numbers.set_index(WHO)
    found: ByRun = {
        **_imitation(data, stages),
        **_new_sequences(data.new_sequences),
        "map_length_1": numbers["resultant_length_1"],
        "map_length_2": numbers["resultant_length_2"],
        "own_direction": numbers["within_45_1"],
        "order_on_map": order_on_map(
            data.slow_state_map, {c: ways_on(each) for c, each in lessons.items()}, data.strokes
        ),
        **followed(data.exchanges, below),
        **spared(data.lesions, below, top),
        **read_out(data.symbols, below),
        **_recall(data, stages),
        "right_elements": right_elements(data.loops, below),
        **decoded(data.decoding, below, top),
    }
    ended = data.runs.loc[data.runs["status"] != "unfinished", WHO]
    runs = pd.MultiIndex.from_frame(ended)
    table = {name: values.reindex(runs).to_numpy(dtype=float) for name, values in found.items()}
    return pd.concat([ended.reset_index(drop=True), pd.DataFrame(table)], axis=1)


def _imitation(data: ExperimentData, stages: range) -> ByRun:
    loops, error = data.loops, "imitation_error_cm"
    shares = [each for each in data.task.outcomes if each.of]
    nothing = loops.assign(pressed=np.nan).groupby(WHO)["pressed"].mean()
    return {
        "loop_1_cm": loops[loops["loop"] == 1].groupby(WHO)[error].mean(),
        **{f"end_of_stage_{n}_cm": _by_run(error_at_end(loops, n)) for n in stages},
        "pressed": _by_run(achieved(last_loops(loops), shares[0])) if shares else nothing,
    }


def _by_run(wide: pd.DataFrame) -> "pd.Series[float]":
    """Return a table with a row per seed and a column per condition as one series."""
    return wide.melt(ignore_index=False).reset_index().set_index(WHO)["value"].astype(float)


def _new_sequences(new: pd.DataFrame) -> ByRun:
    trained, error = new["trained"].astype(bool), "imitation_error_cm"
    untrained = new[~trained]
    others = {
        f"untrained_{way}_cm": untrained.get(f"{way}_{error}", np.nan)
        for way in ("repertoire", "slow_alone")
    }
    runs = untrained.assign(**others).groupby(WHO)
    return {
        "trained_cm": new[trained].groupby(WHO)[error].mean(),
        "untrained_cm": runs[error].mean(),
        "untrained_spread_cm": runs[error].std(),
        **{name: runs[name].mean() for name in others},
    }


def _recall(data: ExperimentData, stages: range) -> ByRun:
    found: ByRun = {}
    for stage in stages:
        last = last_loops(data.loops[data.loops["phase"] == stage])
        strokes = strokes_recalled(last, data.task)
        for what, asked in (("ambiguous", True), ("other", False)):
            rows = strokes[strokes["ambiguous"] == asked]
            found[f"recall_{what}_{stage}_cm"] = rows.groupby(WHO)["recall_cm"].mean()
    return found
