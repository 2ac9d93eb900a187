"""Context levels as they are written on the command line: `40:5,8:70`, fast levels first."""

from collections.abc import Sequence

from motionese.errors import SettingError
from motionese.network import Level

MOST_UNITS = 5000
"""Every pair of units has a weight: beyond it, no memory holds what is trained."""


def read_levels(levels: str | Sequence[tuple[int, float]]) -> list[Level]:
    """Return the context levels that a text such as `40:5,8:70` or pairs (size, τ) stand for.

    Args:
        levels: Size and time constant [steps] of every context level, from the fast one upwards.

    Raises:
        SettingError: The text is not of that form, or a level cannot have such a size or τ.
    """
    try:
        given = map(_pair, levels.split(",")) if isinstance(levels, str) else levels
        pairs = [(size, float(tau)) for size, tau in given]
    except (TypeError, ValueError) as error:
        raise SettingError(
            f"levels must be given as SIZE:TAU,SIZE:TAU such as 40:5,8:70, got {levels!r}"
        ) from error
    units = sum(size for size, _ in pairs if isinstance(size, int))
    if units > MOST_UNITS:
        raise SettingError(f"levels of {units} units in all; at most {MOST_UNITS} can be trained")
    return [Level(size, tau) for size, tau in pairs]


def _pair(text: str) -> tuple[int, float]:
    size, tau = text.split(":")
    return int(size), float(tau)
