"""The paper's claims (a), (b), (c): what each says of the measures, and the short answer.

A claim has parts, each a difference per seed that is positive where it speaks for the claim.
"""

import pandas as pd

from motionese.analysis.cells import listed
from motionese.analysis.map_numbers import NOTHING
from motionese.analysis.seed_measures import Measures
from motionese.analysis.statistics import estimate
from motionese.analysis.verdicts import Claim, Part, judge_alone

QUESTION = "When do clear primitives emerge inside the network?"
CONVERGED_CM = 3.5
"""A run has converged when its hand is off by less than the radius of a button's cap."""
SAME = 0.95
"""Directions are the same over a map from this mean resultant length on (spread of 18°)."""
NAMES = TD_MD, TD_MND, TND_MD, TND_MND = "TD/MD", "TD/MND", "TND/MD", "TND/MND"
OTHERS = NAMES[1:]
"""All but TD/MD."""


def claims(measures: Measures) -> list[Claim]:
    """Return the paper's claims and their parts, in order."""
    return [*_learning(measures), *_new_motions(measures), *_map(measures)]


def _difference(measure: pd.DataFrame, larger: str, smaller: str, what: str) -> Part:
    return Part(f"{larger} − {smaller}, {what}", measure[larger] - measure[smaller])


def _learning(measures: Measures) -> list[Claim]:
    found = []
    for stage, errors in measures.error_at_end.items():
        what = f"imitation error at the end of stage {stage} [cm]"
        alone = [Part(f"{TND_MD} − {CONVERGED_CM}, {what}", errors[TND_MD] - CONVERGED_CM)]
        others = [name for name in NAMES if name != TND_MD]
        alone += [Part(f"{CONVERGED_CM} − {n}, {what}", CONVERGED_CM - errors[n]) for n in others]
        text = f"(a) When stage {stage} ends, {TND_MD} alone has not converged"
        found.append(Claim(text, tuple(alone), main=True))
        for name in others:
            text = f"(a) When stage {stage} ends, {TND_MD} is farther off than {name}"
            found.append(Claim(text, (_difference(errors, TND_MD, name, what),)))
    return found


def _new_motions(measures: Measures) -> list[Claim]:
    errors, spread = measures.untrained_error, measures.untrained_spread
    what, spreading = "error on untrained triples [cm]", "spread over untrained triples [cm]"
    matched, mismatched = (TD_MD, TND_MND), (TD_MND, TND_MD)
    pairs = [_difference(errors, b, a, what) for a in matched for b in mismatched]
    best = [_difference(errors, name, TD_MD, what) for name in OTHERS]
    narrow = [_difference(spread, name, TD_MD, spreading) for name in OTHERS]
    td, tnd = ((errors[f"{each}/MD"] + errors[f"{each}/MND"]) / 2 for each in ("TD", "TND"))
    md, mnd = ((errors[f"TD/{each}"] + errors[f"TND/{each}"]) / 2 for each in ("MD", "MND"))
    crossed = ((errors[TD_MND] + errors[TND_MD]) - (errors[TD_MD] + errors[TND_MND])) / 2
    better = f"(b) On untrained triples {TD_MD} and {TND_MND} are better than the other two"
    match = f"(b) It helps when teaching and network match: {TD_MD}, {TND_MND} (interaction)"
    return [
        Claim(better, tuple(pairs), main=True),
        Claim(f"(b) On untrained triples {TD_MD} is the best of all", tuple(best), main=True),
        Claim(f"(b) The errors of {TD_MD} vary least", tuple(narrow), main=True),
        Claim("(b) Teaching in phases (TD) helps", (Part(f"TND − TD, {what}", tnd - td),)),
        Claim("(b) A growing network (MD) helps", (Part(f"MND − MD, {what}", mnd - md),)),
        Claim(match, (Part(f"mismatched − matched, {what}", crossed),)),
    ]


def _map(measures: Measures) -> list[Claim]:
    length, part_of_cs = measures.resultant_length, measures.slow_level_part
    what = "mean resultant length over the Cs₀ map [1]"
    same = Part(f"{TD_MD} − {SAME}, {what}", length[TD_MD] - SAME)
    only = [Part(f"{SAME} − {name}, {what}", SAME - length[name]) for name in OTHERS]
    held = "(c) With Cf₀ held, the direction is"
    second = f"{TD_MD} − {NOTHING}, share of the second segment's variance with Cs₀ [1]"
    say = Part(second, part_of_cs[TD_MD] - NOTHING)
    more = {name: (_difference(length, TD_MD, name, what),) for name in OTHERS}
    return [
        Claim(f"{held} the same over the Cs₀ map in {TD_MD} only", (same, *only), main=True),
        Claim(f"{held} the same over the Cs₀ map in {TD_MD}", (same,)),
        *(Claim(f"{held} more uniform in {TD_MD} than in {n}", part) for n, part in more.items()),
        Claim(f"(c) In {TD_MD} the slow level has a say in what follows", (say,)),
    ]


def answer_by_map(measures: Measures) -> str:
    """Return the answer to the question, from the map's numbers alone."""
    lengths = measures.resultant_length
    found: dict[str, list[str]] = {"yes": [], "no": [], "undecided": []}
    words = {"holds": "yes", "does not hold": "no"}
    for name in NAMES:
        values = lengths[name].dropna()
        if not values.empty:
            middle = estimate(values.to_numpy(dtype=float)).value
            verdict = words.get(judge_alone(values - SAME), "undecided")
            found[verdict].append(f"{name} ({middle:.2f})")
    if not any(found.values()):
        return "No run that ended has a slow level whose map could answer it."
    told = "; ".join(f"{verdict} in {listed(names)}" for verdict, names in found.items() if names)
    return (
        "A primitive is clear where its Cf₀ alone sets the direction of the hand, whatever Cs₀ is: "
        f"the directions' mean resultant length over the map of Cs₀ is then at least {SAME}. "
        f"After the last loop, with medians over the seeds: {told}."
    )
