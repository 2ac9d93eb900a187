"""One level of an MTRNN: how many units it has and how slowly they change."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from motionese.arguments import refusing
from motionese.errors import SettingError

LONGEST = 1e30
"""Time constant [steps] that is still finite in single precision, and any sum of them."""
DEFAULT_NAMES = ("io", "cf", "cs")
"""Input–output, fast context, slow context: the paper's IO, Cf and Cs."""


@refusing()
@dataclass(frozen=True)
class Level:
    """A level as it is drawn: `size` units with time constant τ [steps].

    Attributes:
        size: Number of units, at least 1.
        tau: Time constant [steps], at least 1: one value for the level, or one per unit.
            With 1 a unit forgets its potential at every step; the larger, the slower it changes.
        name: How settings and reports call the level; empty for the default of its place
            (io, cf, cs, then c4, c5, …).
    """

    size: int
    tau: float | Sequence[float]
    name: str = ""

    def __post_init__(self) -> None:
        called = f"level '{self.name}'" if self.name else "a level"
        # Whatever they were given as: levels are compared, and written as JSON.
        object.__setattr__(self, "size", int(self.size))
        taus = np.asarray(self.tau, dtype=np.float64)
        object.__setattr__(self, "tau", tuple(taus.tolist()) if taus.ndim else taus.item())
        if self.size < 1:
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
        return (self.tau,) * self.size if isinstance(self.tau, float) else tuple(self.tau)


def named(levels: Sequence[Level]) -> tuple[Level, ...]:
    """Give every unnamed level the default name of its place."""
    defaults = (*DEFAULT_NAMES, *(f"c{place + 1}" for place in range(3, len(levels))))
    return tuple(
        replace(level, name=level.name or default)
        for level, default in zip(levels, defaults, strict=False)
    )
