"""The four conditions: teaching in phases or not (TD, TND), a growing network or not (MD, MND)."""

from dataclasses import dataclass
from typing import Literal

from motionese.errors import SettingError, unknown

Teaching = Literal["TD", "TND"]
Structuring = Literal["MD", "MND"]


@dataclass(frozen=True)
class Condition:
    """One cell of the 2 × 2 design.

    Attributes:
        teaching: TD, primitives first and then sequences; TND, sequences from the start.
        structuring: MD, IO–Cf first and then IO–Cf–Cs; MND, all levels from the start.
    """

    teaching: Teaching
    structuring: Structuring

    @property
    def name(self) -> str:
        """The paper's name, such as 'TD/MD'."""
        return f"{self.teaching}/{self.structuring}"

    @property
    def folder(self) -> str:
        """The name of its folder, such as 'TD-MD'."""
        return f"{self.teaching}-{self.structuring}"


CONDITIONS = (
    Condition("TD", "MD"),
    Condition("TD", "MND"),
    Condition("TND", "MD"),
    Condition("TND", "MND"),
)


def condition(name: str) -> Condition:
    """Return the condition of a name; `SettingError` with the nearest one if there is none."""
    by_name = {c.name: c for c in CONDITIONS}
    if name.upper() not in by_name:
        raise SettingError(unknown("condition", name, by_name))
    return by_name[name.upper()]
