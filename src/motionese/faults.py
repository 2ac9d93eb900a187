"""The first fault that pydantic finds in what was given: where it is, and what, in a few words."""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from pydantic import ValidationError

from motionese.errors import SettingError, kind_of, unknown


class Fault(NamedTuple):
    """What is wrong with settings.

    Attributes:
        kind: What pydantic calls it, such as "missing".
        path: The names and places that lead to it in what was given.
        value: What stands there; None where it is missing.
        what: What would be right, to follow a name and a colon.
    """

    kind: str
    path: list[str]
    value: Any
    what: str

    @property
    def name(self) -> str:
        """The full name of the setting."""
        return ".".join(self.path)


def first_fault(error: ValidationError, given: Mapping[str, Any]) -> Fault:
    """Return the first fault of settings that were made from a table."""
    first = error.errors(include_url=False)[0]
    # Of a location, only what stands in the table: not which of several types was tried.
    path: list[str] = []
    here: Any = given
    missing = first["loc"][-1:] if first["type"] == "missing" else ()
    for part in first["loc"]:
        if isinstance(here, list | tuple) and isinstance(part, int) and part < len(here):
            path, here = [*path, str(part)], here[part]
        elif isinstance(here, Mapping) and (part in here or part in missing):
            path, here = [*path, str(part)], here.get(part)
    what = first["msg"].removeprefix("Value error, ")
    kind = "extra_forbidden" if first["loc"][-1:] == ("[key]",) else first["type"]
    return Fault(kind, path, here, what[:1].lower() + what[1:])


def refusal(fault: Fault, known: Iterable[str]) -> SettingError:
    """Return the error that names a setting, its value, and what would be right.

    Args:
        fault: Of settings.
        known: The settings that there are, for one that is none of them.
    """
    if fault.kind == "extra_forbidden":
        return SettingError(unknown("setting", fault.name, known))
    got = "" if isinstance(fault.value, Mapping) else f" = {kind_of(fault.value)}"
    return SettingError(f"setting {fault.name}{got}: {fault.what}" if fault.path else fault.what)


def described(error: ValidationError) -> str:
    """Return the first fault of a file on one line: where in it, and what."""
    first = error.errors(include_url=False)[0]
    where = ".".join(str(part) for part in first["loc"])
    what = first["msg"].removeprefix("Value error, ")
    return " ".join(f"{where}: {what}".split()) if where else what
