"""Tables on disk: CSV files, written whole."""

import csv
import io
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from motionese.files import write_whole


def write_table(path: Path, rows: Iterable[Mapping[str, Any]]) -> None:
    """Write rows as CSV; the columns are those of all rows, in the order they first appear."""
    rows = list(rows)
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_whole(path, text.getvalue())
