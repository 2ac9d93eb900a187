"""Whether two run folders hold the same numbers to the bit, whatever wrote them.

Every table of OLD must stand in NEW with the same rows and cells; `seconds`, and columns that only
NEW has, are left aside. A digest of what was compared is printed, so that it can be noted. Ends
with 1 where anything differs.

    python benchmarks/same_tables.py OLD NEW
"""

import hashlib
import sys
from pathlib import Path

import pandas as pd


def table(path: Path) -> pd.DataFrame:
    """Read a table as text, without what depends on the machine."""
    return pd.read_csv(path, dtype=str, keep_default_na=False).drop(
        columns="seconds", errors="ignore"
    )


def difference(old: Path, new: Path) -> str:
    """Return how a table differs from the one before, or ""."""
    if not new.is_file():
        return "is missing"
    before, now = table(old), table(new)
    gone = [column for column in before if column not in now]
    if gone:
        return f"lacks {', '.join(gone)}"
    if len(before) != len(now):
        return f"has {len(now)} rows in the place of {len(before)}"
    cells = (before != now[before.columns]).to_numpy()
    return f"differs in {cells.sum()} of {cells.size} cells" if cells.any() else ""


def main() -> int:
    """Compare and print."""
    old, new = (Path(folder) for folder in sys.argv[1:3])
    paths = sorted(path.relative_to(old) for path in old.glob("*/seed-*/*.csv"))
    digest, different = hashlib.sha256(), 0
    for path in paths:
        digest.update(table(old / path).to_csv().encode())
        told = difference(old / path, new / path)
        different += bool(told)
        if told:
            print(f"{new / path} {told}")
    print(f"{len(paths)} tables compared, {different} differ; digest {digest.hexdigest()[:16]}")
    return different or not paths


if __name__ == "__main__":
    sys.exit(main())
