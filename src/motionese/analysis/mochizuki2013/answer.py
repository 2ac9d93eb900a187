"""The answer to the question in three sentences, computed from the measures of runs.

The first says in which conditions the roles of the levels are separated where a lesson asks for
order, the second what that takes, the third what it is good for. How they are worded follows the
verdicts of the planned tests, whichever they are.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.analysis.cells import listed, number, with_interval
from motionese.analysis.mochizuki2013.claims import OTHERS, TD_MD, TND_MD
from motionese.analysis.mochizuki2013.findings import (
    CLEAR,
    DEFAULT,
    FREE,
    GENERALISATION,
    LEARNING,
    MAP,
    NEW,
    ORDER,
    SEPARATION,
    Finding,
    Tables,
    findings,
)
from motionese.analysis.statistics import LEVEL, estimate

HOLDS, FAILS = "holds", "does not hold"
UNDECIDED = "with no decided difference from"
ORDERLY = "where the lesson asks for memory of order"


def answer(tables: Tables) -> list[str]:
    """Return the answer to "When do clear primitives emerge inside the network?".

    Args:
        tables: Measures of runs (as of `seed_table`) by preset: "order", "default", "free". What a
            missing one, or one without the condition that is asked about, would tell is left out.
    """
    found = findings(tables)
    sentences = [
        [_separated(tables, found)],
        [_without_sharing(tables, found), _on_the_map(tables, found)],
        [_new_sequences(tables, found), _generalised(tables, found), _learned(tables, found)],
    ]
    told = ("; ".join(clause for clause in clauses if clause) for clauses in sentences)
    return [f"{text[0].upper()}{text[1:]}." for text in told if text]


def _separated(tables: Tables, found: Sequence[Finding]) -> str:
    if not _measured(tables, ORDER, TD_MD, "separation"):
        return ""
    main = _main(found, SEPARATION)
    compared = [f for f in found if f.family == SEPARATION and f.against in OTHERS]
    if main.verdict == HOLDS:
        what = f"clear primitives emerge when teaching and network both develop in phases ({TD_MD})"
        what += ", and only then"
    elif main.verdict != FAILS:
        what = f"whether clear primitives emerge in {TD_MD}, and only there, is {main.verdict}"
    elif main.statistic >= CLEAR:
        what = f"the roles of the levels are separated in {TD_MD}, but not only there"
    else:
        what = (
            f"no clear primitives emerge in {TD_MD}, where a separation of {CLEAR} would be clear"
        )
    first, order, both = (
        _median(tables, ORDER, TD_MD, column)
        for column in ("first_by_cf", "order_by_cs", "separation")
    )
    others = [
        f"{_middle(tables, ORDER, name, 'separation')} in {name}"
        for name in OTHERS
        if _measured(tables, ORDER, name, "separation")
    ]
    against = f", against {listed(others)}" if others else ""
    return (
        f"{ORDERLY}, {what}: the first stroke follows Cf₀ in {first} of the exchanges and the "
        f"order follows Cs₀ in {order}; the separation, the smaller of the two, is {both} in "
        f"{TD_MD}{against} ({_runs(tables, ORDER)}{_level(compared)})"
    )


def _without_sharing(tables: Tables, found: Sequence[Finding]) -> str:
    if not all(_measured(tables, preset, TD_MD, "separation") for preset in (ORDER, FREE)):
        return ""
    control = [each for each in found if each.against == FREE]
    what = _by_verdict(
        control[0],
        "separation takes initial states that motions share",
        "separation does not take initial states that motions share",
        "whether separation takes initial states that motions share",
    )
    free = _median(tables, FREE, TD_MD, "separation")
    return (
        f"{what}: with its own for every motion, the separation in {TD_MD} is {free} "
        f"({_runs(tables, FREE)}{_level(control)})"
    )


def _on_the_map(tables: Tables, found: Sequence[Finding]) -> str:
    if not _measured(tables, DEFAULT, TD_MD, "map_length_1"):
        return ""
    parts = [each for each in found if each.family == MAP and not each.main]
    groups: dict[str, list[str]] = {"the same": [], "not the same": [], "undecided": []}
    for each in parts:
        if not _measured(tables, DEFAULT, each.against, "map_length_1"):
            continue
        is_same = (each.verdict == HOLDS) == (each.against == TD_MD)
        decided = each.verdict in (HOLDS, FAILS)
        which = ("the same" if is_same else "not the same") if decided else "undecided"
        length = _middle(tables, DEFAULT, each.against, "map_length_1")
        groups[which].append(f"{each.against} ({length})")
    told = ", ".join(f"{which} in {listed(names)}" for which, names in groups.items() if names)
    claim = _by_verdict(_main(found, MAP), "holds", "does not hold", "")
    return (
        "in the paper's own lesson, which asks for no order, the direction over the map of Cs₀ is, "
        f"by mean resultant length, {told}: claim (c), that it is the same in {TD_MD} only, "
        f"{claim} ({_runs(tables, DEFAULT)})"
    )


def _new_sequences(tables: Tables, found: Sequence[Finding]) -> str:
    what = f"after the paper's own lesson {TD_MD} imitates untrained triples"
    return _errors(tables, found, (DEFAULT, TD_MD, "untrained_cm"), NEW, what)


def _generalised(tables: Tables, found: Sequence[Finding]) -> str:
    what = f"after the lesson that asks for order {TD_MD} imitates untrained triples from the "
    of = ORDER, TD_MD, "untrained_repertoire_cm"
    return _errors(tables, found, of, GENERALISATION, f"{what}repertoire")


def _learned(tables: Tables, found: Sequence[Finding]) -> str:
    what, of = f"{TND_MD} is, when stage 1 ends", (DEFAULT, TND_MD, "end_of_stage_1_cm")
    words = "farther off than", "nearer than"
    return _errors(tables, found, of, LEARNING, f"in the paper's own lesson {what}", words, ",")


def _errors(
    tables: Tables,
    found: Sequence[Finding],
    of: tuple[str, str, str],
    family: str,
    what: str,
    words: tuple[str, str] = ("better than", "worse than"),
    then: str = "",
) -> str:
    """Return what a condition's error is in comparison with the others.

    Args:
        of: The preset, the condition and the column.
        family: Of the tests that compare it.
        what: What is said of the condition, before its error.
        words: If such a test holds, and if it does not.
        then: What follows the error.
    """
    preset, condition, column = of
    if not _measured(tables, preset, condition, column):
        return ""
    own = [f for f in found if f.family == family and f.against and "spread" not in f.measured]
    told = _compared(tables, preset, column, own, words)
    error = _median(tables, preset, condition, column)
    return f"{what} ({error} cm off){then} {told} ({_runs(tables, preset)})"


def _compared(
    tables: Tables, preset: str, column: str, own: Sequence[Finding], words: tuple[str, str]
) -> str:
    """Return what something is in comparison with other conditions, each with its median."""
    groups: dict[str, list[str]] = {words[0]: [], words[1]: [], UNDECIDED: []}
    said = {HOLDS: words[0], FAILS: words[1]}
    for each in own:
        if not _measured(tables, preset, each.against, column):
            continue
        name = f"{each.against} ({_middle(tables, preset, each.against, column)})"
        groups[said.get(each.verdict, UNDECIDED)].append(name)
    told = ", ".join(f"{word} {listed(names)}" for word, names in groups.items() if names)
    return told or "with nothing to compare it with"


def _by_verdict(each: Finding, holds: str, fails: str, whether: str) -> str:
    """Return what a finding comes to; undecided as 'whether … is undecided with n seeds'."""
    return {HOLDS: holds, FAILS: fails}.get(each.verdict, f"{whether} is {each.verdict}".strip())


def _main(found: Sequence[Finding], family: str) -> Finding:
    return next(each for each in found if each.family == family and each.main)


def _median(tables: Tables, preset: str, condition: str, column: str) -> str:
    return with_interval(estimate(_values(tables, preset, condition, column)))


def _middle(tables: Tables, preset: str, condition: str, column: str) -> str:
    """Return a median without its interval."""
    return number(estimate(_values(tables, preset, condition, column)).value)


def _measured(tables: Tables, preset: str, condition: str, column: str) -> bool:
    """Whether there is anything to tell of a condition."""
    return preset in tables and bool(np.isfinite(_values(tables, preset, condition, column)).any())


def _values(tables: Tables, preset: str, condition: str, column: str) -> Float[ndarray, " n"]:
    table = tables[preset]
    return table.loc[table["condition"] == condition, column].to_numpy(dtype=np.float64)


def _runs(tables: Tables, preset: str) -> str:
    """Return which runs something is of."""
    seeds = tables[preset]["seed"].nunique()
    return f"{preset}, {seeds} seed{'' if seeds == 1 else 's'}"


def _level(own: Sequence[Finding]) -> str:
    """Return the largest corrected p of some tests, where all of them decide."""
    largest = max(each.p_corrected for each in own)
    up = np.ceil(largest * 1000) / 1000
    return f", corrected p ≤ {number(up, 3)}" if largest <= LEVEL else ""
