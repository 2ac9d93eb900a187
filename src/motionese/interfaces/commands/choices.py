"""What is written after --conditions and --seeds, and how it is written back."""

import re
from collections.abc import Iterable, Sequence

from motionese.errors import SettingError
from motionese.experiment import Condition, Study, condition_named
from motionese.interfaces.commands.model_commands import LARGEST_SEED

MOST_SEEDS = 10_000


def read_conditions(texts: Iterable[str], study: Study) -> list[Condition]:
    """Return the conditions of names, commas between them, in the study's order; all of no name.

    Raises:
        SettingError: A condition that does not exist.
    """
    names = [name.strip() for text in texts for name in text.split(",")]
    named = [condition_named(name, study.factors) for name in names if name]
    return [c for c in study.conditions if not named or c in named]


def read_seeds(text: str) -> list[int]:
    """Return the seeds of "10" (0 to 9), "100-109", "1,5,9", or "1,5-9", in rising order.

    Raises:
        SettingError: No seeds, too many or too large ones, or something else.
    """
    if re.fullmatch(r"\s*\d+\s*", text):
        ranges = [(0, int(text) - 1)]
    else:
        ranges = [_range(part, text) for part in text.split(",")]
    if any(last < first for first, last in ranges):
        raise SettingError(f"--seeds {text}: there are no such seeds; {_HOW}")
    if max(last for _, last in ranges) > LARGEST_SEED:
        raise SettingError(f"--seeds {text}: the largest seed is {LARGEST_SEED}")
    if sum(last - first + 1 for first, last in ranges) > MOST_SEEDS:
        raise SettingError(f"--seeds {text}: these are more than {MOST_SEEDS} seeds")
    return sorted({seed for first, last in ranges for seed in range(first, last + 1)})


def as_ranges(seeds: Sequence[int]) -> str:
    """Write rising seeds the short way, such as '0–2, 7'."""
    runs: list[list[int]] = []
    for seed in seeds:
        if runs and seed == runs[-1][1] + 1:
            runs[-1][1] = seed
        else:
            runs.append([seed, seed])
    return ", ".join(str(a) if a == b else f"{a}–{b}" for a, b in runs)


_HOW = "write a number of them (10 means 0 to 9), a range (100-109) or a list (1,5,9)"


def _range(part: str, text: str) -> tuple[int, int]:
    found = re.fullmatch(r"\s*(\d+)\s*(?:[-–]\s*(\d+)\s*)?", part)
    if not found:
        raise SettingError(f"--seeds {text}: '{part.strip()}' is no seed; {_HOW}")
    return int(found[1]), int(found[2] or found[1])
