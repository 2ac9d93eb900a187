"""The numbers in a JSON message, each under the path that leads to it."""

from collections.abc import Iterator
from typing import Any

from motionese.recordings.formats.widest import WIDEST


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """Yield (path, number) for every number in `value`: `.a.b` in objects, `.a[0]` in arrays.

    An object with a list of strings `name`, such as a JointState, names the columns of its other
    lists of that length: `.position.elbow`. Truth values, text and null are no numbers.
    """
    if isinstance(value, dict):
        labels = _labels(value.get("name"))
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


def _labels(names: Any) -> list[str] | None:
    if isinstance(names, list) and all(isinstance(n, str) for n in names):
        return names if len(set(names)) == len(names) else None
    return None
