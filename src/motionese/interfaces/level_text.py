"""Context levels as they are written on the command line: `40:5,8:70`, fast levels first."""

from collections.abc import Sequence

from motionese.errors import SettingError
from motionese.network import Level


def read_levels(levels: str | Sequence[tuple[int, float]]) -> list[Level]:
    """Return the context levels that a text such as `40:5,8:70` or pairs (size, τ) stand for.

    Args:
        levels: Size and time constant [steps] of every context level, from the fast one upwards.

    Raises:
        SettingError: The text is not of that form, or a level cannot have such a size or τ.
    """
    try:
        if isinstance(levels, str):
            pairs = [pair.split(":") for pair in levels.split(",")]
            return [Level(int(size), float(tau)) for size, tau in pairs]
        return [Level(size, float(tau)) for size, tau in levels]
    except (TypeError, ValueError) as error:
        raise SettingError(
            f"levels must be given as SIZE:TAU,SIZE:TAU such as 40:5,8:70, got {levels!r}"
        ) from error
