"""Claims on invented measures in which they hold, do not hold, or cannot be decided."""

import numpy as np
import pandas as pd
import pytest
from invented_runs import CONDITIONS

from motionese.analysis.mochizuki2013 import claims
from motionese.analysis.seed_measures import Measures, error_at_end, typical_seed
from motionese.analysis.verdicts import COLUMNS, Claim, Part, claims_table, judge, judge_alone

NAMES = [c.name for c in CONDITIONS]
SEEDS = 8


def by_condition(values, seeds=SEEDS, noise=0.02):
    """A table of so many seeds around a value per condition."""
    rng = np.random.default_rng(4)
    table = {n: v + noise * rng.standard_normal(seeds) for n, v in zip(NAMES, values, strict=True)}
    return pd.DataFrame(table, index=pd.Index(range(seeds), name="seed"))


def measures(**changed):
    """Measures in which all of the paper's claims hold; order TD/MD, TD/MND, TND/MD, TND/MND."""
    values = {
        "error_at_end": {p: by_condition([1.0, 1.2, 6.0, 1.1]) for p in (1, 2)},
        "achieved": {},
        "trained_error": by_condition([1.0, 1.4, 1.8, 1.2]),
        "untrained_error": by_condition([1.0, 2.2, 2.0, 1.6]),
        "untrained_spread": by_condition([0.2, 0.9, 0.8, 0.5]),
        "resultant_length": by_condition([0.99, 0.7, 0.8, 0.6], noise=0.005),
        "slow_level_part": by_condition([0.3, 0.6, 0.2, 0.6]),
    }
    return Measures(**(values | changed))


def verdicts(of):
    return {each.claim.text: each.verdict for each in map(judge, claims(of))}


def starting(found, beginning):
    (verdict,) = [v for text, v in found.items() if text.startswith(beginning)]
    return verdict


def test_all_claims_hold_where_they_do():
    assert set(verdicts(measures()).values()) == {"holds"}


def test_no_claim_holds_where_the_opposite_does():
    opposite = measures(
        error_at_end={p: by_condition([6.0, 5.9, 1.0, 5.0]) for p in (1, 2)},
        untrained_error=by_condition([2.6, 1.2, 1.4, 2.2]),
        untrained_spread=by_condition([0.9, 0.2, 0.8, 0.5]),
        resultant_length=by_condition([0.6, 0.99, 0.99, 0.99], noise=0.002),
        slow_level_part=by_condition([0.01, 0.6, 0.2, 0.6], noise=0.002),
    )
    assert set(verdicts(opposite).values()) == {"does not hold"}


def test_all_conditions_converge_so_that_one_alone_cannot_fail():
    found = verdicts(measures(error_at_end={1: by_condition([0.8, 1.0, 1.7, 1.6])}))
    assert starting(found, "(a) When stage 1 ends, TND/MD alone") == "does not hold"
    assert starting(found, "(a) When stage 1 ends, TND/MD is farther off than TD/MD") == "holds"


def test_no_condition_converges_so_that_one_alone_cannot_fail():
    found = verdicts(measures(error_at_end={1: by_condition([8.0, 8.1, 9.7, 8.6])}))
    assert starting(found, "(a) When stage 1 ends, TND/MD alone") == "does not hold"


def test_the_weakest_part_decides():
    close = measures(untrained_error=by_condition([1.2, 2.2, 1.2, 1.6], noise=0.1))
    best = next(c for c in claims(close) if "best of all" in c.text)
    found = judge(best)
    assert found.verdict == f"undecided with {SEEDS} seeds"
    assert found.part.measured.startswith("TND/MD − TD/MD")


def test_directions_that_are_the_same_everywhere_are_not_so_in_one_condition_only():
    found = verdicts(measures(resultant_length=by_condition([1.0] * 4, noise=0.002)))
    assert starting(found, "(c) With Cf₀ held, the direction is the same over the Cs₀ map in TD/MD"
                    " only") == "does not hold"  # fmt: skip


def one_part_against(differences, parts):
    for_it = Part("for it", pd.Series(np.linspace(1, 2, len(differences))))
    return Claim("a claim", (Part("against", pd.Series(differences)), *[for_it] * (parts - 1)))


def test_a_part_among_several_speaks_against_a_claim_at_a_stricter_level():
    against = -np.linspace(1, 2, 7)  # p = 2 / 2⁷ = 0.0156
    assert judge(one_part_against(against, 1)).verdict == "does not hold"
    assert judge(one_part_against(against, 3)).verdict == "does not hold"
    found = judge(one_part_against(against, 4))
    assert found.verdict == "undecided with 7 seeds" and found.part.measured == "against"
    assert judge(one_part_against(-np.linspace(1, 2, 8), 4)).verdict == "does not hold"


def test_a_claim_of_many_parts_holds_without_correction():
    six = Part("for it", pd.Series(np.linspace(1, 2, 6)))
    assert judge(Claim("a claim", (six,) * 4)).verdict == "holds"


def test_main_effects_and_interaction_by_hand():
    table = claims_table([judge(c) for c in claims(measures())]).set_index("claim")["statistic"]
    assert table["(b) Teaching in phases (TD) helps"] == pytest.approx(0.2, abs=0.05)
    assert table["(b) A growing network (MD) helps"] == pytest.approx(0.4, abs=0.05)
    interaction = next(v for t, v in table.items() if "interaction" in t)
    assert interaction == pytest.approx(0.8, abs=0.05)


@pytest.mark.parametrize(("seeds", "verdict"), [(1, "undecided with 1 seed"),
                                                (3, "undecided with 3 seeds")])  # fmt: skip
def test_few_seeds_decide_nothing(seeds, verdict):
    few = {
        name: {p: t.iloc[:seeds] for p, t in value.items()}
        if isinstance(value, dict)
        else value.iloc[:seeds]
        for name, value in vars(measures()).items()
    }
    assert set(verdicts(Measures(**few)).values()) == {verdict}


def test_conditions_that_were_not_run():
    partial = measures(untrained_error=by_condition([1.2, 2.2, 2.6, 1.6]).assign(
        **{"TND/MND": np.nan}
    ))  # fmt: skip
    found = verdicts(partial)
    assert starting(found, "(b) Teaching") == "undecided with 0 seeds"
    assert starting(found, "(a) When stage 2 ends, TND/MD alone") == "holds"


def test_only_common_seeds_are_compared():
    errors = by_condition([1.2, 2.2, 2.6, 1.6])
    errors.loc[:1, "TD/MD"] = np.nan
    errors.loc[6:, "TND/MD"] = np.nan
    best = next(c for c in claims(measures(untrained_error=errors)) if "best of all" in c.text)
    assert judge(best).seeds == SEEDS - 4


def test_table_of_claims():
    table = claims_table([judge(c) for c in claims(measures())])
    assert list(table.columns) == COLUMNS
    assert set(COLUMNS) >= {"claim", "statistic", "low", "high", "p", "effect", "seeds", "verdict"}
    assert (table["low"] <= table["statistic"]).all() and (table["p"] <= 0.05).all()
    assert {text[:3] for text in table["claim"]} == {"(a)", "(b)", "(c)"}


def test_a_difference_alone():
    assert judge_alone(pd.Series(np.linspace(1, 2, 7))) == "holds"


def loops(seed, errors, phases):
    rows = {"condition": "TD/MD", "seed": seed, "loop": range(1, len(errors) + 1)}
    return pd.DataFrame(rows | {"phase": phases, "imitation_error_cm": errors})


def test_error_at_the_end_of_a_stage():
    whole = loops(0, [9.0, 4.0, 3.0, 2.0, 8.0, 3.0, 2.0, 1.0], [1] * 4 + [2] * 4)
    diverged = loops(1, [9.0, 5.0], [1, 1])
    table = pd.concat([whole, diverged])
    assert error_at_end(table, 1)["TD/MD"].to_list() == pytest.approx([3.0, 7.0])
    assert error_at_end(table, 2)["TD/MD"].to_list() == pytest.approx([2.0, 7.0])


def test_every_motion_of_a_loop_counts():
    table = pd.concat([loops(0, [2.0, 2.0, 2.0], [1] * 3), loops(0, [4.0, 4.0, 4.0], [1] * 3)])
    assert error_at_end(table, 1)["TD/MD"].to_list() == [3.0]


def test_a_short_stage_is_not_mixed_with_the_one_before():
    rows = zip((1, 2, 3, 4), (1, 1, 1, 2), (8.0, 6.0, 4.0, 1.0), strict=True)
    table = pd.DataFrame(
        [
            {"condition": "TD/MD", "seed": 0, "loop": loop, "phase": phase,
             "imitation_error_cm": error}
            for loop, phase, error in rows
        ]
    )  # fmt: skip
    assert error_at_end(table, 1)["TD/MD"].to_list() == [6.0]
    assert error_at_end(table, 2)["TD/MD"].to_list() == [1.0]


def test_typical_seed_is_the_median_one():
    assert typical_seed(pd.Series({7: 3.0, 8: 1.0, 9: 2.0})) == 9
    assert typical_seed(pd.Series({7: 3.0, 8: 1.0, 9: 2.0, 10: np.nan, 11: 9.0})) == 9
    assert typical_seed(pd.Series({7: 1.0, 8: 1.0, 9: 1.0})) == 8
