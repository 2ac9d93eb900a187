"""What is in recordings, as tables and a plot, whatever is wrong with them."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from rich.console import Console
from rich.table import Table

from motionese.errors import MotioneseError
from motionese.interfaces.commands.motion_figure import MOST, write_figure
from motionese.interfaces.commands.outputs import PICTURES, check_apart, check_output
from motionese.interfaces.commands.terminal import number_table, tell_findings
from motionese.recordings import (
    OPTIONS,
    Choice,
    Episode,
    Finding,
    Recording,
    Survey,
    choose,
    chosen,
    examined,
    finished,
    read,
    refuse_any,
    survey,
    with_binary,
)

MOST_EPISODES = 40
"""Rows of the table of episodes; the rest is summed up in one."""


def inspect_recordings(
    console: Console, source: Path, plot: Path, reading: Mapping[str, Any]
) -> None:
    """Print what is in a file or folder of recordings, read as `Motions.read` would; draw it."""
    check_output("--plot", plot, PICTURES)
    check_apart([source], plot)
    columns = {name: reading[name] for name in ("format", *OPTIONS) if name in reading}
    choice = choose(**{name: told for name, told in reading.items() if name not in columns})
    found = with_binary(examined(chosen(read(source, **columns), choice), choice), choice)
    numbers = survey(found)
    told, refusal = _learned(found, choice, numbers.rate_hz)
    rate = numbers.rate_hz or choice.rate_hz
    console.print(_heading(found, numbers, rate), soft_wrap=True)
    console.print(_channels(numbers))
    console.print(_episodes(numbers, rate))
    tell_findings(console, told)
    if refusal:
        console.print(f"! As it stands it cannot be learned from: {refusal}", soft_wrap=True)
    drawn = [e for e in found.episodes if len(e.values)]
    paths = [_path(e.part(columns=slice(MOST))) for e in drawn]
    channels = list(zip(found.channels, found.units, strict=True))
    title = f"{source.name}: {len(found.episodes)} episodes"
    write_figure(plot, paths, [e.name for e in drawn], channels, rate, title)
    console.print(f"Plot: {plot}")
    if choice.strict:
        refuse_any(told)


def _learned(
    found: Recording, choice: Choice, rate_hz: float | None
) -> tuple[tuple[Finding, ...], str]:
    """Return what is told of a recording when it is learned from, and why it cannot be.

    That no rate is known stands above the tables already.
    """
    rate = choice.rate_hz if rate_hz is not None else choice.rate_hz or 1.0
    try:
        given = choice.model_copy(update={"strict": False, "rate_hz": rate})
        return finished(found, given).findings, ""
    except MotioneseError as error:
        return found.findings, str(error)


def _heading(found: Recording, numbers: Survey, rate: float | None) -> str:
    rows = sum(e.rows for e in numbers.episodes)
    told = f"{rate:g} Hz" if rate else "no rate told (give it with --rate when it is learned from)"
    jitter = f", intervals within {numbers.jitter:.1%}" if numbers.jitter is not None else ""
    return (
        f"{found.source}: {_counted(len(found.episodes), 'episode')}, {rows} rows, "
        f"{_counted(len(found.channels), 'channel')}, {told}{jitter}"
    )


def _channels(numbers: Survey) -> Table:
    headings = ("low", "high", "mean\nstep", "still", "gaps", "NaN", "inf")
    table = number_table("channel", "unit", *headings)
    table.columns[1].justify = "left"
    for c in numbers.channels:
        values = ("–" if v is None else f"{v:.3g}" for v in (c.low, c.high, c.mean_step))
        shares = f"{c.still:.0%}", f"{c.unobserved:.0%}"
        table.add_row(
            c.name,
            c.unit or ("binary" if c.binary else "–"),
            *values,
            *shares,
            *map(_count, (c.nan, c.infinite)),
        )
    return table


def _episodes(numbers: Survey, rate: float | None) -> Table:
    table = number_table("episode", "rows", "s", "still (ends)", "gaps", "holes", "NaN", "inf")
    for e in numbers.episodes[:MOST_EPISODES]:
        seconds = e.duration_s if e.duration_s is not None or not rate else (e.rows - 1) / rate
        table.add_row(
            e.name,
            str(e.rows),
            "–" if seconds is None else f"{seconds:.2f}",
            f"{e.still:.0%} ({e.still_start:.0%}, {e.still_end:.0%})",
            f"{e.unobserved:.0%}",
            *map(_count, (e.holes, e.nan, e.infinite)),
        )
    further = numbers.episodes[MOST_EPISODES:]
    if further:
        rows = str(sum(e.rows for e in further))
        counts = (sum(getattr(e, n) for e in further) for n in ("holes", "nan", "infinite"))
        table.add_row(f"{len(further)} more", rows, *["–"] * 3, *map(_count, counts))
    return table


def _path(episode: Episode) -> Float[ndarray, "T D"]:
    """Return an episode's values, NaN where nothing was observed or they are not finite."""
    known = episode.observed & np.isfinite(episode.values)
    return episode.values if known.all() else np.where(known, episode.values, np.nan)


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _count(number: int) -> str:
    return str(number) if number else "–"
