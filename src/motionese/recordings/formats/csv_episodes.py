"""Which rows of a table are an episode: named by a column, or begun where time begins again."""

import re
import shlex
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int, Shaped
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.csv_columns import label_of, numbers
from motionese.recordings.formats.csv_names import folded_name
from motionese.recordings.formats.csv_table import Table
from motionese.recordings.nature import GLANCE, counts_episodes, runs

Rows = slice | Int[ndarray, " T"]
CALLED = re.compile(
    r"(ep|episode|run|take|rep|repetition|recording|trial|demo|demonstration|traj|trajectory|rollout"
    r"|sequence|motion)s?[ _.-]?(id|nr|no|num|number|index|idx|name)?"
)
"""Names that a number of episodes may have."""
AGAIN = 2.0
"""Usual intervals by which time goes back where it begins again, and at most goes on after it."""
BREAK = 5.0
"""Usual intervals from which on rows are no longer one motion's."""


@dataclass(frozen=True)
class Part:
    """Rows that are one episode; `times` [s] are theirs, None where the table tells none."""

    name: str
    rows: Rows
    times: Float[ndarray, " T"] | None


def may_name(name: str) -> bool:
    """Tell whether a column of this name may hold the numbers or names of episodes."""
    return CALLED.fullmatch(folded_name(name)) is not None


def by_nature(
    table: Table, taken: Sequence[int], stamps: Float[ndarray, " N"] | None
) -> tuple[int | None, list[Finding]]:
    """Return the column of a lone table that names the episodes, whatever its name is, if any."""
    begins = None if stamps is None else _beginnings(stamps)
    columns = [i for i, name in enumerate(table.header) if name and i not in taken]
    for column in sorted(columns, key=lambda i: not may_name(table.header[i])):
        name, _ = label_of(table, column)
        sure, maybe = _names_episodes(table, column, stamps, begins)
        option = f"--episode {shlex.quote(name)}"
        if sure:
            what = "is taken for what names the episodes, as it stays the same for rows at a time"
            remedy = f"{option} says so"
            return column, [Finding("column", table.path, what, remedy, channel=name)]
        if maybe:
            what = "holds whole numbers that stay for some rows and rise by one, as episodes' do"
            remedy = f"{option}, if it names them"
            return None, [Finding("column", table.path, what, remedy, channel=name)]
    return None, []


def parts_of(
    table: Table, column: int | None, stamps: Float[ndarray, " N"] | None, *, alone: bool
) -> tuple[list[Part], list[Finding]]:
    """Return the episodes of a table, and what was done to its rows.

    Raises:
        RecordingError: A row without an episode or a time, or a time that goes back or stands.
    """
    groups, findings = _groups(table, column)
    parts: list[Part] = []
    for name, rows in groups:
        called = name if alone and column is not None else table.path.stem
        called = f"{called}/{name}" if not alone and column is not None else called
        if stamps is None:
            parts.append(Part(called, rows, None))
            continue
        _check_finite(table, stamps, rows, called)
        pieces = _pieces(stamps, rows)
        if len(pieces) > 1:
            first = _row(pieces[1], 0)
            what = f"time begins again at line {table.lines[first]}: each beginning is an episode"
            remedy = "--episode COLUMN, if a column names them"
            findings.append(
                Finding("time", table.path, what, remedy, called, count=len(pieces) - 1)
            )
        for i, piece in enumerate(pieces):
            bare = alone and column is None
            label = called if len(pieces) == 1 else f"{i}" if bare else f"{called}/{i}"
            part, dropped = _rising(table, stamps, piece, label)
            parts.append(part)
            findings += dropped
    return parts, findings


def _names_episodes(
    table: Table,
    column: int,
    stamps: Float[ndarray, " N"] | None,
    begins: Int[ndarray, " _"] | None,
) -> tuple[bool, bool]:
    """Tell whether a column surely names the episodes, and whether it may."""
    values = _whole_or_words(table, column)
    starts = runs(values)
    together = len(np.unique(values[starts])) == len(starts)
    if not together or len(starts) < 2 or 2 * len(starts) > len(values):
        return False, False
    again = begins is not None and np.array_equal(begins, starts)
    if again or may_name(table.header[column]):
        return True, True
    if values.dtype.kind != "f" or not counts_episodes(values):
        return False, False
    if stamps is None:
        return True, True
    steps = np.diff(stamps)
    breaks, usual = steps[starts[1:] - 1], float(np.median(steps))
    return bool(((breaks > BREAK * usual) | (breaks <= 0)).all()), True


def _whole_or_words(table: Table, column: int) -> Shaped[ndarray, " T"]:
    """Return a column that holds whole numbers alone, or words; nothing for any other."""
    try:
        found = numbers(table, column)
    except RecordingError:
        return np.empty(0)
    if found is None:
        cells = table.text(column)
        return np.array(cells) if all(cells) else np.empty(0)
    values, observed = found
    for rows in (slice(GLANCE), slice(None)):
        if not (observed[rows] & (values[rows] == np.round(values[rows]))).all():
            return np.empty(0)
    return values


def _groups(table: Table, column: int | None) -> tuple[list[tuple[str, Rows]], list[Finding]]:
    """Return the rows of every name in a column, in the order in which the names are met."""
    if column is None:
        return [("", slice(0, len(table.lines)))], []
    cells = table.text(column)
    starts = runs(cells).tolist()
    spans: dict[str, list[tuple[int, int]]] = {}
    for start, stop in zip(starts, [*starts[1:], len(cells)], strict=True):
        if not cells[start]:
            raise RecordingError(f"{table.where(start)}: the episode's name is missing")
        spans.setdefault(cells[start], []).append((start, stop))
    again = next((name for name, found in spans.items() if len(found) > 1), None)
    groups: list[tuple[str, Rows]] = []
    for name, found in spans.items():
        rows: Rows = slice(*found[0])
        if len(found) > 1:
            rows = np.concatenate([np.arange(start, stop) for start, stop in found])
        groups.append((name, rows))
    if again is None:
        return groups, []
    line = table.lines[spans[again][1][0]]
    what = f"rows go on at line {line} after those of others; rows are put together by episode"
    return groups, [Finding("converted", table.path, what, "", again)]


def _beginnings(stamps: Float[ndarray, " N"]) -> Int[ndarray, " _"]:
    """Return the rows at which time begins, the first among them."""
    steps = np.diff(stamps)
    usual = np.median(steps[steps > 0]) if (steps > 0).any() else np.inf
    back = np.flatnonzero(steps < -AGAIN * usual) + 1
    after = np.append(steps, 0.0)[back]
    return np.append(0, back[(after >= 0) & (after <= AGAIN * usual)])


def _pieces(stamps: Float[ndarray, " N"], rows: Rows) -> list[Rows]:
    """Return rows cut where their time begins again."""
    starts = _beginnings(stamps[rows])
    stops = [*starts[1:], len(stamps[rows])]
    spans = zip(starts.tolist(), map(int, stops), strict=True)
    if isinstance(rows, slice):
        return [slice(rows.start + start, rows.start + stop) for start, stop in spans]
    return [rows[start:stop] for start, stop in spans]


def _check_finite(table: Table, stamps: Float[ndarray, " N"], rows: Rows, name: str) -> None:
    if len(wrong := np.flatnonzero(~np.isfinite(stamps[rows]))):
        where = table.where(_row(rows, int(wrong[0])))
        raise RecordingError(f"{where}: episode '{name}' has a row without a time")


def _rising(
    table: Table, stamps: Float[ndarray, " N"], rows: Rows, name: str
) -> tuple[Part, list[Finding]]:
    """Return an episode without the rows whose time is that of the row before."""
    here = stamps[rows]
    steps = np.diff(here)
    if len(back := np.flatnonzero(steps < 0)):
        before, after = here[back[0] : back[0] + 2]
        raise RecordingError(
            f"{table.where(_row(rows, int(back[0]) + 1))}: time must rise inside episode '{name}', "
            f"got {after:.12g} s after {before:.12g} s; --time names another column, --episode "
            "one that tells episodes apart"
        )
    same = np.flatnonzero(steps == 0) + 1
    if not len(same):
        return Part(name, rows, here), []
    if 2 * len(same) >= len(here):
        raise RecordingError(
            f"{table.where(_row(rows, int(same[0])))}: time stands still in {len(same)} of "
            f"{len(here)} rows of episode '{name}', so it is not theirs; "
            "--time names another column"
        )
    kept = np.delete(np.arange(len(stamps))[rows], same)
    what = f"time {here[same[0]]:.12g} s is that of the row before; the later row is left out"
    row, count = int(same[0]), len(same)
    found = Finding("left out", table.path, what, "", name, row=row, count=count)
    return Part(name, kept, stamps[kept]), [found]


def _row(rows: Rows, place: int) -> int:
    """Return which row of the table stands at a place of an episode."""
    return rows.start + place if isinstance(rows, slice) else int(rows[place])
