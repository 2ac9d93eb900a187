"""What is told of measured motions: tables of episodes, of all, of two groups, and remarks."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from math import isnan, nan

import numpy as np
from rich.console import Console
from rich.table import Table

from motionese.analysis.statistics import estimate, holm
from motionese.analysis.two_groups import Difference, difference
from motionese.interfaces.commands.measured_group import Group, Manner
from motionese.interfaces.commands.terminal import number_table, tell_findings
from motionese.kinematics import MEASURES, Measures
from motionese.kinematics.tracks import window_rows

MOST_EPISODES = 40
"""Rows of the tables of episodes; all count in the last one."""
NOISY = 0.1
"""Share of the mean acceleration from which on what noise makes of it is told."""
OF_MOVING = ("duration", "speed", "peak_speed", "acceleration", "peak_acceleration")
OF_SHAPE = ("range", "roundness", "repetitiveness")
OF_PAUSING = ("pause_count", "pause", "pausing", "pace")
"""The measures of three tables, which fit 80 columns."""
Compared = Mapping[str, tuple[Difference, float]]
"""The difference in every measure, and its p corrected for their number."""


def tell_group(console: Console, group: Group, manner: Manner) -> None:
    """Print what was measured of one group: tables of episodes, one of all, and remarks."""
    recording, count = group.shown.recording, len(group.measured)
    rate_hz = recording.rate_hz or nan
    rows = window_rows(rate_hz, manner.window)
    still = (
        "5 % of each episode's peak speed, or as noise asks"
        if manner.still is None
        else f"{manner.still:g} {group.shown.unit or 'unit'}/s"
    )
    console.print(
        f"{recording.source}: {count} episode{'' if count == 1 else 's'} at {rate_hz:g} Hz, "
        f"{group.shown.what}; smoothed over {rows / rate_hz:.3g} s ({rows} rows); still below "
        f"{still}; a pause lasts {manner.pause:g} s at least",
        soft_wrap=True,
    )
    console.print(_episodes(group, OF_MOVING))
    console.print(_episodes(group, OF_SHAPE))
    console.print(_pausing(group))
    console.print(_overall(group))
    for line in _remarks(group, rate_hz):
        console.print(f"! {line}", soft_wrap=True)
    tell_findings(console, recording.findings)


def _episodes(group: Group, measures: Sequence[str]) -> Table:
    table = _episode_table(group, measures)
    for name, measured in list(group.measured.items())[:MOST_EPISODES]:
        table.add_row(name, *(_number(getattr(measured, m)) for m in measures))
    return table


def _pausing(group: Group) -> Table:
    """Return the table of pauses, with the pace at other thresholds, and the threshold itself."""
    unit = group.shown.unit or "unit"
    others = ("pace at\n½ still", "pace at\n2 × still", f"still\n[{unit}/s]")
    table = _episode_table(group, OF_PAUSING, *others)
    for name, measured in list(group.measured.items())[:MOST_EPISODES]:
        further = (measured.pace_at_half, measured.pace_at_twice, measured.still)
        numbers = (*(getattr(measured, m) for m in OF_PAUSING), *further)
        table.add_row(name, *map(_number, numbers))
    return table


def _episode_table(group: Group, measures: Sequence[str], *further: str) -> Table:
    headings = (group.label(m).replace(" [", "\n[").replace(" ", "\n", 1) for m in measures)
    return number_table("episode", *headings, *further)


def _overall(group: Group) -> Table:
    count = len(group.measured)
    table = number_table(
        f"all {count} episodes" if count > 1 else "in all", "mean", "95 % interval", "of"
    )
    for name in MEASURES:
        found = estimate(group.values(name), np.mean)
        table.add_row(
            group.label(name),
            _number(found.value),
            _interval(found.low, found.high),
            str(found.seeds),
        )
    return table


def _remarks(group: Group, rate_hz: float) -> list[str]:
    """Return what a reader of the tables should know: what is undefined, gaps, noise."""
    undefined: defaultdict[str, list[str]] = defaultdict(list)
    for name, measured in group.measured.items():
        for told_once in _undefined(measured):
            undefined[told_once].append(name)
    told = [f"{what}: {_listed(names)}" for what, names in undefined.items()]
    parted = [name for name, m in group.measured.items() if len(m.tracks) > 1]
    if parted:
        told.append(f"parted by gaps, on either side of which is measured apart: {_listed(parted)}")
    limited = [name for name, m in group.measured.items() if m.from_noise]
    if limited:
        told.append(f"what counts as still is set by noise: {_listed(limited)}")
    noise = {n: _noise(m) for n, m in group.measured.items() if _noise(m) > NOISY}
    if noise:
        told.append(
            f"noise alone would make {max(noise.values()):.0%} of the mean acceleration; a longer "
            f"--window smooths more: {_listed(list(noise))}"
        )
    return told


def _undefined(measured: Measures) -> list[str]:
    """Return what is undefined of a motion and why, a text a reason."""
    by_reason: defaultdict[str, list[str]] = defaultdict(list)
    for name, why in measured.undefined.items():
        by_reason[why].append(MEASURES[name].label)
    told = {
        why: "everything" if len(names) == len(MEASURES) else " and ".join(names)
        for why, names in by_reason.items()
    }
    return [f"undefined (–): {what}, {why}" for why, what in told.items()]


def _noise(measured: Measures) -> float:
    """Return the acceleration that noise makes as a share of the mean one; 0 if none is told."""
    largest = max((t.noise_acceleration for t in measured.tracks), default=0.0)
    return largest / measured.acceleration if measured.acceleration > 0 else 0.0


def _listed(names: Sequence[str], most: int = 5) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(f"'{name}'" for name in names[:most]) + more


def tell_comparison(console: Console, groups: Sequence[Group]) -> None:
    """Print the differences of two groups that can be compared."""
    found = _compared(groups)
    names = (
        f"{letter} is {g.name} ({len(g.measured)})" for letter, g in zip("AB", groups, strict=True)
    )
    console.print(_differences(groups, found))
    console.print(_tests(groups, found))
    console.print(
        f"{', '.join(names)}. Differences of means, A − B, with bootstrap intervals; δ: how much "
        "likelier an episode of A is larger than one of B than smaller; p of the Mann–Whitney "
        f"test, and corrected for {len(found)} measures.",
        soft_wrap=True,
    )


def _compared(groups: Sequence[Group]) -> Compared:
    """Return the difference in every measure, and its p corrected for their number."""
    one, other = groups
    found = {name: difference(one.values(name), other.values(name)) for name in MEASURES}
    corrected = holm([each.p for each in found.values()])
    return dict(zip(found, zip(found.values(), corrected, strict=True), strict=True))


def _differences(groups: Sequence[Group], compared: Compared) -> Table:
    table = number_table("measure", "A", "B", "A − B", "95 % interval")
    for name, (found, _) in compared.items():
        numbers = map(_number, (found.one.value, found.other.value, found.value))
        table.add_row(groups[0].label(name), *numbers, _interval(found.low, found.high))
    return table


def _tests(groups: Sequence[Group], compared: Compared) -> Table:
    table = number_table("measure", "effect δ", "p", "p (Holm)")
    for name, (found, corrected) in compared.items():
        effect = "–" if isnan(found.effect) else f"{found.effect:+.2f}"
        table.add_row(groups[0].label(name), effect, _p(found.p), _p(corrected))
    return table


def _number(value: float) -> str:
    """Return three digits, without an exponent where that can be."""
    return "–" if isnan(value) else f"{float(f'{value:.3g}'):g}"


def _interval(low: float, high: float) -> str:
    return "–" if isnan(low) else f"{_number(low)} to {_number(high)}"


def _p(value: float) -> str:
    if isnan(value):
        return "–"
    return "< .001" if value < 0.001 else f"{value:.3f}".removeprefix("0")
