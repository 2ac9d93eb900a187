"""The order in which people number things: demo_2 before demo_10."""

import re


def natural(name: str) -> tuple[tuple[bool, int, str], ...]:
    """Return the key that sorts names with their numbers as numbers."""
    parts = re.split(r"([0-9]+)", name)
    return tuple((not p.isdecimal(), int(p) if p.isdecimal() else 0, p) for p in parts)
