"""Arrays of motions that stay where they were recorded, and are read when they are asked for."""

from collections.abc import Sequence
from typing import Any, Literal, overload

from numpy import ndarray

from motionese.recordings import StoredEpisode


class StoredArrays(Sequence[ndarray]):
    """The values of motions, or what was observed of them: one array [T_i, D] a motion."""

    def __init__(
        self, motions: Sequence[StoredEpisode], part: Literal["values", "observed"]
    ) -> None:
        """Take the motions, and which part of each of them it is."""
        self.motions, self._part = tuple(motions), part

    def __len__(self) -> int:
        return len(self.motions)

    @overload
    def __getitem__(self, which: int) -> ndarray: ...
    @overload
    def __getitem__(self, which: slice) -> "StoredArrays": ...
    def __getitem__(self, which: int | slice) -> Any:
        if isinstance(which, slice):
            return StoredArrays(self.motions[which], self._part)
        return getattr(self.motions[which].read(), self._part)

    def chosen(self, rows: Sequence[int]) -> "StoredArrays":
        """Return those of some motions."""
        return StoredArrays([self.motions[i] for i in rows], self._part)
