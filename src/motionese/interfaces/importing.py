"""Recordings in, one file of motions out."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.console import Console

from motionese.interfaces.expressed import share_beyond
from motionese.learning import Motions


def import_motions(
    console: Console,
    source: Path,
    out: Path,
    *,
    columns: Mapping[str, str | None],
    choice: Mapping[str, Any],
) -> None:
    """Read and prepare recordings, write them, and tell what was written.

    Args:
        console: Where it is told.
        source: The file or folder to read.
        out: The file to write, by its suffix.
        columns: Format, episode and time column, as `Motions.read` takes them.
        choice: What else `Motions.read` takes.
    """
    motions = Motions.read(source, **columns, **choice)
    motions.write(out)
    console.print(f"{out}: {told(motions)}")


def told(motions: Motions) -> str:
    """Return in words how many motions there are, of what length and rate, and what is missing."""
    shortest, longest = min(motions.lengths), max(motions.lengths)
    rows = f"{shortest}" if shortest == longest else f"{shortest} to {longest}"
    count = f"{len(motions)} motion{'' if len(motions) == 1 else 's'}"
    width = len(motions.channels)
    seen = sum(int(mask.sum()) for mask in motions.observed)
    gaps, beyond = 1 - seen / (sum(motions.lengths) * width), share_beyond(motions)
    return (
        f"{count} of {rows} rows at {motions.rate_hz:g} Hz, "
        f"{width} channel{'' if width == 1 else 's'}"
        + (f", {gaps:.1%} not observed" if gaps else "")
        + (f", {beyond:.1%} beyond their ranges and clipped" if beyond else "")
    )
