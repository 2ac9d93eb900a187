"""Conditions: a choice for every factor that is varied, such as teaching (TD, TND)."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

from motionese.errors import SettingError, unknown


@dataclass(frozen=True)
class Condition:
    """One cell of the design: the choice of every factor, in order, such as ('TD', 'MD')."""

    choices: tuple[str, ...]

    @property
    def name(self) -> str:
        """How it is called, such as 'TD/MD'."""
        return "/".join(self.choices)

    @property
    def folder(self) -> str:
        """The name of its folder, such as 'TD-MD'."""
        return "-".join(self.choices)


def conditions_of(factors: Mapping[str, tuple[str, ...]]) -> tuple[Condition, ...]:
    """Return all conditions of a design, the first factor changing slowest."""
    return tuple(Condition(choices) for choices in product(*factors.values()))


def condition_named(name: str, factors: Mapping[str, tuple[str, ...]]) -> Condition:
    """Return the condition of a name; `SettingError` with the nearest one if there is none."""
    by_name = {c.name.casefold(): c for c in conditions_of(factors)}
    if name.casefold() not in by_name:
        raise SettingError(unknown("condition", name, (c.name for c in by_name.values())))
    return by_name[name.casefold()]
