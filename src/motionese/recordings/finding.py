"""What the user of a recording should know before it is learned from, with where and a remedy."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from motionese.errors import RecordingError

Kind = Literal["leap", "column", "time", "unit", "left out", "converted", "layout"]
"""A step that no arm makes; a column, the times or the units misjudged, perhaps; what reading left
out, or took for something else than what stands there; what is so in every file of a layout, which
is worth knowing and no fault."""


@dataclass(frozen=True)
class Finding:
    """One thing that was found in a recording, or done to it without being asked for.

    Attributes:
        kind: What it is about.
        source: The file or folder it is in.
        what: What was found or done, in words, with its size in the channel's unit.
        remedy: The option that puts it right or undoes it, as it is typed; empty where none does.
        episode: The first that it is in; empty where it is in none or in all of them.
        channel: The channel or column; empty where it is no matter of one.
        row: The first, counted from 0 in the episode; None where it is no matter of one.
        size: How large it is [the channel's unit]; None where it has no size.
        count: How often it is there.
    """

    kind: Kind
    source: Path
    what: str
    remedy: str = ""
    episode: str = ""
    channel: str = ""
    row: int | None = None
    size: float | None = None
    count: int = 1

    @property
    def sentence(self) -> str:
        """Return the finding on one line, from where it is to what puts it right."""
        where = [
            f"episode '{self.episode}'" if self.episode else "",
            "" if self.row is None else f"row {self.row}",
            f"channel '{self.channel}'" if self.channel else "",
        ]
        place = ", ".join(part for part in where if part)
        again = f" ({self.count} times)" if self.count > 1 else ""
        remedy = f"; {self.remedy}" if self.remedy else ""
        text = f"{self.source}: {place}{': ' if place else ''}{self.what}{again}{remedy}"
        return " ".join(text.split())


def merged(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return the findings with those of one kind and channel as one, the first of them, counted."""
    first: dict[tuple[str, str, str], Finding] = {}
    for finding in findings:
        # What differs between two places of the same thing is a number or a file.
        alike = (finding.kind, finding.channel, re.sub(r"[0-9.]+", "", finding.what))
        found = first.get(alike)
        count = finding.count + (found.count if found else 0)
        first[alike] = replace(found or finding, count=count)
    return tuple(first.values())


def refuse_any(findings: Iterable[Finding]) -> None:
    """Raise the first finding that may be a fault, and how many more may, as a `RecordingError`."""
    found = [finding for finding in findings if finding.kind != "layout"]
    if found:
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        raise RecordingError(f"{found[0].sentence}{more}; refused as --strict asks for")
