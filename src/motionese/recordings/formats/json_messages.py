"""Messages of JSON: where their numbers stand names them."""

import json
from collections.abc import Iterator
from typing import Any

from motionese.recordings.formats.conventions import WIDEST, is_bookkeeping, strings


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """Yield (path, number) for every number in `value`: `.a.b` in objects, `.a[0]` in arrays.

    An object with a list of strings `name`, such as a JointState, names the columns of its other
    lists of that length: `.position.elbow`. Truth values, text and null are no numbers.
    """
    if isinstance(value, dict):
        labels = strings(value.get("name")) or ()
        labels = labels if len(set(labels)) == len(labels) else ()
        for key, part in value.items():
            if labels and isinstance(part, list) and len(part) == len(labels):
                for label, item in zip(labels, part, strict=True):
                    yield from numbers(item, f"{path}.{key}.{label}")
            else:
                yield from numbers(part, f"{path}.{key}")
    elif isinstance(value, list):
        if len(value) <= WIDEST:
            for i, item in enumerate(value):
                yield from numbers(item, f"{path}[{i}]")
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, float(value)


class JsonMessages:
    """The messages of one topic; the paths of their numbers tell whether two are alike."""

    further: tuple[tuple[int, list[float]], ...] = ()
    shortened = 0
    wide: tuple[str, ...] = ()

    def value(self, data: bytes) -> Any:
        """Return what a message says."""
        return json.loads(data)

    def numbers(self, data: bytes) -> tuple[tuple[str, ...], int, list[float]]:
        """Return the paths of a message's numbers, no stamp, and the numbers."""
        found = list(numbers(json.loads(data)))
        self._paths = tuple(path for path, _ in found)
        return self._paths, 0, [number for _, number in found]

    def columns(self) -> list[tuple[str, str, bool]]:
        """Return path, unit and whether it is usual, of every number of the last message."""
        return [(path, "", not is_bookkeeping(path)) for path in self._paths]
