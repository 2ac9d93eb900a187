"""Reading settings: a preset or a file laid over the default, then single settings by name."""

import tomllib
from collections.abc import Iterable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from motionese.errors import SettingError, unknown
from motionese.experiment.settings import Settings

PRESETS = ("default", "paper")
OPEN_GROUPS = ("training.bound", "training.noise", "recognition.bound", "caregiver.corners")
"""Tables whose names are not fixed: levels and corners, checked with the whole."""

Table = dict[str, Any]


def read_settings(
    preset: str = "default", overrides: Iterable[str] = (), *, quick: bool = False
) -> Settings:
    """Read and check settings.

    Args:
        preset: "default", "paper", or the path of a TOML file; what a file leaves out is taken
            from the default.
        overrides: Single settings, such as "network.levels.cs.tau=40".
        quick: Lay the settings of a quick trial over them.

    Raises:
        SettingError: A file or setting that does not exist, or a value that is not allowed.
    """
    table = _preset("default")
    if preset != "default":
        above = _preset(preset) if preset in PRESETS else _file(preset)
        if isinstance(above.get("network"), Mapping) and "levels" in above["network"]:
            # A list of levels stands for itself, so that a file can leave a level out.
            table["network"] = {**table["network"], "levels": {}}
        table = _laid_over(table, above)
    if quick:
        table = _laid_over(table, _preset("quick"))
    for override in overrides:
        table = _laid_over(table, _single(override, table))
    settings = checked(_with_evaluation(table))
    for teaching in settings.teaching:
        settings.lessons(teaching)
    return settings


def _with_evaluation(table: Table) -> Table:
    """Return the table with recognition in evaluation as in learning, but for what differs."""
    learning, evaluation = table["recognition"], table["evaluation"]
    if not isinstance(learning, Mapping) or not isinstance(evaluation, Mapping):
        return table
    differing = evaluation.get("recognition")
    if not isinstance(differing, Mapping):
        return table
    whole = {**evaluation, "recognition": _laid_over(learning, differing)}
    return {**table, "evaluation": whole}


def checked(table: Table) -> Settings:
    """Return the settings of a complete table; `SettingError` names the first that is wrong."""
    try:
        return Settings.model_validate(table)
    except ValidationError as error:
        first = error.errors()[0]
        # Of a location, only what stands in the file: not which of several types was tried.
        path: list[str] = []
        here: Any = table
        for part in map(str, first["loc"]):
            stands = isinstance(here, Mapping) and (part in here or first["type"] == "missing")
            if not stands:
                break
            path, here = [*path, part], here.get(part)
        name = ".".join(path)
        if first["type"] == "extra_forbidden" or first["loc"][-1:] == ("[key]",):
            known = _known(path[:-1])
            raise SettingError(unknown("setting", name, known)) from error
        if first["type"] == "missing":
            raise SettingError(f"setting {name} is missing") from error
        got = f" = {first['input']!r}" if not isinstance(first["input"], Mapping) else ""
        what = first["msg"].removeprefix("Value error, ")
        what = what[:1].lower() + what[1:]
        raise SettingError(f"setting {name}{got}: {what}" if name else what) from error


def differences(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """Return every setting that differs, as 'name: was → now'."""
    flat_before, flat_now = dict(_flat(before)), dict(_flat(now))
    names = sorted(flat_before.keys() | flat_now.keys())
    return [
        f"{name}: {flat_before.get(name)} → {flat_now.get(name)}"
        for name in names
        if flat_before.get(name) != flat_now.get(name)
    ]


def preset_text(name: str) -> str:
    """Return a preset's file, to be copied and edited."""
    return (
        resources.files("motionese.experiment.presets").joinpath(f"{name}.toml").read_text("utf-8")
    )


def _preset(name: str) -> Table:
    return tomllib.loads(preset_text(name))


def _file(preset: str) -> Table:
    path = Path(preset)
    if not path.is_file():
        raise SettingError(f"{unknown('preset', preset, PRESETS)}, or the path of a TOML file")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SettingError(f"{path}: not a TOML file: {error}") from error
    except OSError as error:
        raise SettingError(f"{path}: cannot be read: {error.strerror}") from error


def _single(override: str, table: Table) -> Table:
    name, equals, text = override.partition("=")
    path = name.strip().split(".")
    if not equals:
        raise SettingError(f"--set takes name=value, got '{override}'")
    _check_name(path, table)
    try:
        value = tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        value = text.strip()
    for part in reversed(path):
        value = {part: value}
    return dict(value)


def _check_name(path: list[str], table: Table) -> None:
    """Check that a setting of this name exists and is not a whole group of settings."""
    here: Any = table
    for depth, part in enumerate(path):
        group = ".".join(path[:depth])
        if group in OPEN_GROUPS:
            return
        if not isinstance(here, Mapping) or (part not in here and part not in _optional(group)):
            known = _known(path[:depth])
            raise SettingError(unknown("setting", ".".join(path[: depth + 1]), known))
        here = here.get(part)
    if isinstance(here, Mapping) and ".".join(path) not in OPEN_GROUPS:
        raise SettingError(f"'{'.'.join(path)}' is a group of settings: {', '.join(here)}")


def _known(path: list[str]) -> list[str]:
    """Return the full names of the settings in a group of the default."""
    here: Any = _preset("default")
    for part in path:
        here = here.get(part, {}) if isinstance(here, Mapping) else {}
    names = [*(here if isinstance(here, Mapping) else ()), *_optional(".".join(path))]
    return [".".join([*path, name]) for name in names] or [".".join(path)]


def _optional(group: str) -> tuple[str, ...]:
    """Return what a group may hold although the default does not."""
    if group == "evaluation.recognition":
        return tuple(_preset("default")["recognition"])
    return ("corners",) if group == "caregiver" else ()


def _laid_over(below: Mapping[str, Any], above: Mapping[str, Any]) -> Table:
    result = dict(below)
    for name, value in above.items():
        old = result.get(name)
        if isinstance(old, Mapping) and isinstance(value, Mapping):
            result[name] = _laid_over(old, value)
        else:
            result[name] = value
    return result


def _flat(table: Mapping[str, Any], prefix: str = "") -> Iterable[tuple[str, Any]]:
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", value
