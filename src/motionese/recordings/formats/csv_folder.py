"""The tables of a folder, all with the same columns, one file an episode."""

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import natural
from motionese.recordings.formats.csv_columns import label_of
from motionese.recordings.formats.csv_table import Table, holds_table, read_table

SURE = (".csv", ".tsv")
"""Of files that are tables."""
SUFFIXES = (*SURE, ".txt", ".dat", ".tab", ".asc", ".log")
"""Of files in a folder that are read; the others of them may be notes."""
SHOWN = 6
"""Names of columns that are told."""


def patterns(suffixes: Sequence[str]) -> tuple[str, ...]:
    """Return the patterns of files that end so, in small letters or capitals."""
    either = ("".join(f"[{c}{c.upper()}]" for c in suffix[1:]) for suffix in suffixes)
    return tuple(f"[!.]*.{letters}" for letters in either)


def tables_in(
    folder: Path, columns: Sequence[str] | None, is_text: Callable[[str], bool]
) -> tuple[list[Table], list[Finding]]:
    """Return the tables of a folder with their columns in the order of the first, and notes.

    Raises:
        RecordingError: No table there, or one whose columns are not those of most.
    """
    # Some systems leave hidden files beside those of the user.
    files = [file for file in folder.glob("[!.]*") if file.suffix.lower() in SUFFIXES]
    files = sorted((f for f in files if f.is_file()), key=lambda f: natural(f.name))
    notes = [file for file in files if file.suffix.lower() not in SURE and not holds_table(file)]
    kept = [file for file in files if file not in notes]
    if not kept:
        raise RecordingError(f"{folder}: holds no table ({', '.join(SUFFIXES)})")
    tables = [read_table(file, columns, is_text) for file in kept]
    shared, _ = Counter(map(_labels, tables)).most_common(1)[0]
    first = next(table for table in tables if _labels(table) == shared)
    for table in tables:
        if _labels(table) != shared:
            raise RecordingError(_misfit(table, first, len(kept)))
    found = []
    if notes:
        what = f"{notes[0].name} holds no table; it is not read"
        found = [Finding("left out", folder, what, count=len(notes))]
    return [table.in_order(first.header) for table in tables], found


def _labels(table: Table) -> frozenset[tuple[str, str]]:
    return frozenset(label_of(table, column) for column in range(len(table.header)))


def _misfit(table: Table, first: Table, count: int) -> str:
    """Return the sentence for a table whose columns are not those of most in its folder."""
    mine, theirs = (dict(label_of(t, i) for i in range(len(t.header))) for t in (table, first))
    most = f"in {first.path.name} and most of the {count} files"
    for name, unit in theirs.items():
        if name in mine and mine[name] != unit:
            what = f"column '{name}' is in [{mine[name]}], {most} it is in [{unit}]; convert it, or"
            return f"{table.path}: {what} take the file out of the folder"
    what = f"its columns are {_listed(list(mine))}, {most} they are {_listed(list(theirs))};"
    return f"{table.path}: {what} take the file out of the folder"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:SHOWN]) + (", …" if len(names) > SHOWN else "")
