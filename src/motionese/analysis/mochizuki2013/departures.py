"""The list of departures from the paper, read from the file that the docs include."""

import re
from importlib import resources
from typing import NamedTuple

FILE = "departures.md"


class Departure(NamedTuple):
    """One departure: under which heading, what, and why."""

    heading: str
    what: str
    why: str


def departures() -> list[Departure]:
    """Return all departures, in the file's order.

    In the file, "## Heading" begins a group, and "- **What.** Why" is a departure on one line.
    """
    text = resources.files(__package__).joinpath(FILE).read_text(encoding="utf-8")
    found, heading = [], ""
    for line in text.splitlines():
        if line.startswith("## "):
            heading = line.removeprefix("## ").strip()
        elif match := re.fullmatch(r"- \*\*(.+?)\*\* (.+)", line):
            found.append(Departure(heading, match[1], match[2].replace("`", "")))
    return found
