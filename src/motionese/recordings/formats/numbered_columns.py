"""Names of columns where a file tells none: numbered, or as the user names them."""

from collections.abc import Sequence
from pathlib import Path

from motionese.errors import SettingError
from motionese.recordings.finding import Finding


def numbered_columns(
    path: Path, width: int, columns: Sequence[str] | None
) -> tuple[tuple[str, ...], list[Finding]]:
    """Return names of channels that have none, and what is told of them.

    Raises:
        SettingError: Names were given, but not as many.
    """
    if columns is None:
        names = tuple(f"column_{i}" for i in range(width))
        if not names:
            return names, []
        what = f"has no names of columns; they are called {names[0]} to {names[-1]}"
        example = ",".join("abc"[:width]) + ",…" * (width > 3)
        return names, [Finding("column", path, what, f"--columns {example} names them")]
    if len(columns) != width:
        raise SettingError(
            f"{path}: has {width} columns, --columns gives {len(columns)} names: "
            f"{', '.join(columns)}"
        )
    return tuple(columns), []
