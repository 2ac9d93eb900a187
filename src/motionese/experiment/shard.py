"""A shard: the part of a study's runs that one of several commands does, as in a job array."""

import re
from collections.abc import Sequence
from typing import NamedTuple, TypeVar

from motionese.errors import SettingError

MOST_SHARDS = 10_000
Each = TypeVar("Each")


class Shard(NamedTuple):
    """The `number`-th of so many `parts`, from 1."""

    number: int
    parts: int

    def __str__(self) -> str:
        """Return it as it is asked for."""
        return f"{self.number}/{self.parts}"

    def part(self, runs: Sequence[Each]) -> list[Each]:
        """Return its runs. Neighbours, which may be the conditions of a seed, are dealt in turn."""
        dealt = ((place + place // self.parts) % self.parts for place in range(len(runs)))
        return [run for run, to in zip(runs, dealt, strict=True) if to == self.number - 1]


def read_shard(text: str) -> Shard:
    """Return the shard of a text such as "2/8".

    Raises:
        SettingError: It is none.
    """
    found = re.fullmatch(r"\s*(\d{1,9})\s*/\s*(\d{1,9})\s*", text)
    shard = Shard(*map(int, found.groups())) if found else Shard(0, 0)
    if not 1 <= shard.number <= shard.parts <= MOST_SHARDS:
        raise SettingError(
            f"--shard {text}: write I/N, the I-th of N parts, such as 2/8; at most {MOST_SHARDS}"
        )
    return shard
