"""The files of one ended run, read whole or not at all.

A table that was cut short would change every number that is drawn from it, and nobody would be
told; so whatever does not read as it was written is refused.
"""

import csv
import io
import struct
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy import ndarray

from motionese.errors import RunFolderError
from motionese.experiment.run import ENDED, Run

ENDINGS = ("finished", "diverged")
WHOLE_NUMBERS = (
    "seed", "loop", "phase", "levels", "lag", "demonstration", "stroke", "edit_distance"
)  # fmt: skip
KEPT = ("activity", "commanded", "sensed", "begins", "poses")
"""What `inside.npz` holds beside paths and effects."""
WORDS = (
    "condition", "motion", "primitive", "status", "repertoire_status", "first", "second",
    "recognition", "motion_lower", "motion_upper", "split", "kind", "follows", "lesion", "level",
    "what", "reference", "true",
)  # fmt: skip
MAY_BE_EMPTY = ("reproduction_strokes_cm", "read")
"""Words of which there may be none."""
YES_OR_NO = ("trained", "taught", "ambiguous", "right")
AGAIN = "the same `motionese reproduce` command writes the tables again from the checkpoints"


def read_end(run: Run) -> dict[str, Any] | None:
    """Return how a run ended, or None while it has not; `RunFolderError` if it does not tell."""
    end = run.ended()
    if end is None and not (run.folder / ENDED).is_file():
        return None
    if (
        end is not None
        and end.get("status") in ENDINGS
        and isinstance(end.get("seconds", 0.0), int | float)
        and isinstance(end.get("rows", {}), dict)
    ):
        return end
    raise RunFolderError(
        f"{run.folder / ENDED} does not tell how the run ended: remove it, and {AGAIN}"
    )


def read_table(
    run: Run, name: str, columns: Sequence[str], rows: int | None, *, may_be_empty: bool
) -> pd.DataFrame:
    """Read a table of a run; `RunFolderError` if it is missing, or not as it was written.

    Args:
        name: The table's name, such as "loops".
        columns: Columns that it must have.
        rows: How many rows were written; None where that is not known.
        may_be_empty: Whether a table of no rows, which has no columns either, is a right one.
    """
    path = run.folder / f"{name}.csv"
    try:
        table = _parsed(path.read_bytes().decode(), may_be_empty=may_be_empty)
        if len(table):
            _check_columns(table, columns)
            if not ((table["condition"] == run.condition.name) & (table["seed"] == run.seed)).all():
                raise ValueError(f"rows of another run than {run.name}")
        if rows is not None and len(table) != rows:
            raise ValueError(f"{len(table)} rows of {rows}")
    except FileNotFoundError as error:
        raise _refusal(path, "is missing") from error
    except UnicodeDecodeError as error:
        raise _refusal(path, "is damaged (not a text)") from error
    except OSError as error:
        raise _refusal(path, f"cannot be read ({error.strerror})") from error
    except (ValueError, TypeError, csv.Error) as error:
        raise _refusal(path, f"is damaged ({' '.join(str(error).split())})") from error
    return table


def read_inside(path: Path) -> dict[str, ndarray]:
    """Read what was kept of a run's performances; `RunFolderError` if it is not as written."""
    try:
        with zipfile.ZipFile(path) as archive:
            names = [name.removesuffix(".npy") for name in archive.namelist()]
        missing = [name for name in KEPT if name not in names]
        if missing:
            raise ValueError(f"no {', '.join(missing)}")
        with np.load(path, allow_pickle=False) as kept:
            return {name: kept[name] for name in names}
    except (
        OSError, EOFError, ValueError, KeyError, RuntimeError, struct.error, zipfile.BadZipFile,
        zlib.error,
    ) as error:  # fmt: skip
        raise _refusal(path, f"is damaged ({' '.join(str(error).split())})") from error


def _parsed(text: str, *, may_be_empty: bool) -> pd.DataFrame:
    if text == "\n" and may_be_empty:
        return pd.DataFrame()
    if not text.strip():
        raise ValueError("it is empty")
    if not text.endswith("\n"):
        raise ValueError("its last line is cut short")
    # pandas would fill a line that is cut short with missing values.
    head, *lines = csv.reader(io.StringIO(text))
    for number, line in enumerate(lines, start=1):
        if len(line) != len(head):
            raise ValueError(f"row {number} has {len(line)} of {len(head)} columns")
    if not lines:
        raise ValueError("it has no rows")
    return pd.read_csv(io.StringIO(text), index_col=False)


def _check_columns(table: pd.DataFrame, columns: Sequence[str]) -> None:
    missing = [column for column in columns if column not in table]
    if missing:
        raise ValueError(f"no column {', '.join(missing)}")
    for column in table.columns:
        if (column in columns or column.startswith("rms_")) and not _fits(column, table[column]):
            raise ValueError(f"not every {column} is one")


def _fits(column: str, values: "pd.Series[Any]") -> bool:
    if column in WORDS:
        return bool(values.notna().all())
    if column in MAY_BE_EMPTY:
        return True
    if column in YES_OR_NO:
        return values.dtype.kind == "b"
    return values.dtype.kind in ("i" if column in WHOLE_NUMBERS else "iuf")


def _refusal(path: Path, what: str) -> RunFolderError:
    return RunFolderError(f"{path} {what}: remove {ENDED} beside it, and {AGAIN}")
