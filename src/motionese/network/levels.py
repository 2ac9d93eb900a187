"""One level of an MTRNN: how many units it has and how slowly they change."""

from collections.abc import Sequence
from dataclasses import dataclass

from motionese.errors import SettingError

LONGEST = 1e30
"""Time constant [steps] that is still finite in single precision, and any sum of them."""
DEFAULT_NAMES = ("io", "cf", "cs")
"""Input–output, fast context, slow context: the paper's IO, Cf and Cs."""


@dataclass(frozen=True)
class Level:
    """A level of `size` units with time constant τ [steps].

    Attributes:
        size: Number of units, at least 1.
        tau: Time constant [steps], at least 1: one value for the level, or one per unit.
            With 1 a unit forgets its potential at every step; the larger, the slower it changes.
        name: How settings and reports call the level; empty for the default of its place
            (io, cf, cs, then c4, c5, …).
    """

    size: int
    tau: float | tuple[float, ...]
    name: str = ""

    def __post_init__(self) -> None:
        called = f"level '{self.name}'" if self.name else "a level"
        if isinstance(self.size, bool) or not isinstance(self.size, int) or self.size < 1:
            raise SettingError(f"{called}: size must be a whole number ≥ 1, got {self.size}")
        if isinstance(self.tau, Sequence) and len(self.tau) != self.size:
            raise SettingError(
                f"{called}: tau must be one value or one per unit ({self.size}), "
                f"got {len(self.tau)} values"
            )
        wrong = [t for t in self.taus if not 1 <= t <= LONGEST]
        if wrong:
            raise SettingError(
                f"{called}: tau must be finite and ≥ 1 step, at most {LONGEST:g}, got {wrong[0]:g}"
            )

    @property
    def taus(self) -> tuple[float, ...]:
        """The time constant of every unit [steps]."""
        return self.tau if isinstance(self.tau, tuple) else (float(self.tau),) * self.size


def named(levels: Sequence[Level]) -> tuple[Level, ...]:
    """Give every unnamed level the default name of its place; names must be unique."""
    if len(levels) < 2:
        raise SettingError(f"an MTRNN has the level io and at least one context, got {len(levels)}")
    result = []
    for place, level in enumerate(levels):
        default = DEFAULT_NAMES[place] if place < len(DEFAULT_NAMES) else f"c{place + 1}"
        result.append(Level(level.size, level.tau, level.name or default))
    names = [level.name for level in result]
    if len(set(names)) < len(names):
        raise SettingError(f"level names must be unique, got {', '.join(names)}")
    return tuple(result)
