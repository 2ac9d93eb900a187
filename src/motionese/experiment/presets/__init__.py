"""Presets of a study's settings, as TOML files to read, copy and edit; and how they are read."""

import tomllib
from collections.abc import Iterable, Mapping
from importlib import resources
from pathlib import Path
from typing import Any

from motionese.errors import SettingError, unknown
from motionese.experiment.study import Study
from motionese.imitation import checked, setting_names

PRESETS = (
    *("default", "order", "free", "paper", "three_stages", "four_levels"),
    *("settled", "adaptive", "scaffolding"),
    *("desk_arm", "shapes"),
)
WHOLE = ("network.levels", "factors")
"""Tables that stand for themselves: a file that has one leaves nothing of the default's."""
OPEN_GROUPS = (
    *("training.bound", "training.noise", "training.shared"),
    *("recognition.bound", "recognition.slower", "task.places", "opens"),
)
"""Tables whose names are not fixed: levels and places, checked with the whole."""
QUICK_LOOPS = 2
"""Loops of every stage in a quick trial."""
OLD_FORM = {
    "phases": "[[stages]], each with until = { loops = 15 }",
    "teaching": 'lesson = { TD = "primitives", TND = "taught pairs" } in every one of [[stages]]',
    "caregiver.corners": "[task] places = { UR = [0.52, -0.30, 1.05] }",
}
"""Settings of the form before, and what they have become."""

Table = dict[str, Any]


def read_settings(
    preset: str = "default", overrides: Iterable[str] = (), *, quick: bool = False
) -> Study:
    """Read and check settings.

    Args:
        preset: A preset's name, or the path of a TOML file; what a file leaves out is taken from
            the default.
        overrides: Single settings, such as "network.levels.cs.tau=40" or "stages.0.until.loops=3".
        quick: Lay the settings of a quick trial over them.

    Raises:
        SettingError: A file or setting that does not exist, or a value that is not allowed.
    """
    table = _preset("default")
    if preset != "default":
        table = _over(table, _preset(preset) if preset in PRESETS else _file(preset))
    if quick:
        table = _laid_over(table, _preset("quick"))
        for stage in table["stages"] if isinstance(table["stages"], list) else ():
            if isinstance(stage, dict):
                stage["until"] = {"loops": QUICK_LOOPS}
        table["opens"] = {level: {"loops": QUICK_LOOPS} for level in table.get("opens", {})}
    for override in overrides:
        table = _laid_over(table, _single(override, table))
    return study_of(_with_evaluation(table))


def study_of(table: Table) -> Study:
    """Return the settings of a complete table.

    Raises:
        SettingError: One that is wrong, or of the form before stages.
    """
    for old in OLD_FORM:
        group, _, name = old.rpartition(".")
        within = table.get(group) if group else table
        if isinstance(within, Mapping) and name in within:
            raise SettingError(_moved(old))
    return checked(Study, table)


def differences(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """Return every setting that differs, as 'name: was → now'."""
    old, new = dict(_flat(before)), dict(_flat(now))
    changed = [n for n in sorted(old.keys() | new.keys()) if old.get(n) != new.get(n)]
    return [f"{name}: {old.get(name)} → {new.get(name)}" for name in changed]


def preset_text(name: str) -> str:
    """Return a preset's file, to be copied and edited."""
    return resources.files(__name__).joinpath(f"{name}.toml").read_text("utf-8")


def read_table(path: Path) -> Table:
    """Return what a TOML file holds; `SettingError` where it cannot be read."""
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SettingError(f"{path}: not a TOML file: {error}") from error
    except OSError as error:
        raise SettingError(f"{path}: cannot be read: {error.strerror}") from error


def _preset(name: str) -> Table:
    return tomllib.loads(preset_text(name))


def _file(preset: str) -> Table:
    if not Path(preset).is_file():
        raise SettingError(f"{unknown('preset', preset, PRESETS)}, or the path of a TOML file")
    return read_table(Path(preset))


def _over(table: Table, above: Table) -> Table:
    """Lay a file over the default; what stands for itself leaves nothing of what was there."""
    for name in WHOLE:
        group, _, last = name.rpartition(".")
        within = above.get(group) if group else above
        if isinstance(within, Mapping) and last in within:
            table = _laid_over(table, {group: {last: None}} if group else {last: None})
    network = above.get("network")
    levels = network.get("levels") if isinstance(network, Mapping) else None
    if isinstance(levels, Mapping):  # whose top level has nothing to be shared
        shared = {name: table["training"]["shared"].get(name, "none") for name in [*levels][1:-1]}
        table = {**table, "training": {**table["training"], "shared": shared}}
    body, robot = above.get("body"), table["body"]["name"]
    if isinstance(body, Mapping) and body.get("name", robot) != robot:
        table = {**table, "body": {}}  # another robot has settings of its own
    return _laid_over(table, above)


def _with_evaluation(table: Table) -> Table:
    """Return the table with recognition in evaluation as in learning, but for what differs."""
    learning, evaluation = table["recognition"], table["evaluation"]
    if not (isinstance(learning, Mapping) and isinstance(evaluation, Mapping)):
        return table
    whole = {
        name: _laid_over(learning, differing)
        for name in ("recognition", "repertoire")
        if isinstance(differing := evaluation.get(name), Mapping)
    }
    return {**table, "evaluation": {**evaluation, **whole}}


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
        group = path[:depth]
        if ".".join(group) in OPEN_GROUPS:
            return
        known = _names_in(here, group)
        if part not in known:
            asked = ".".join(path[: depth + 1])
            if asked in OLD_FORM:
                raise SettingError(_moved(asked))
            raise SettingError(unknown("setting", asked, (".".join([*group, k]) for k in known)))
        here = here[int(part)] if isinstance(here, list) else here.get(part)
    if isinstance(here, Mapping) and ".".join(path) not in OPEN_GROUPS:
        raise SettingError(f"'{'.'.join(path)}' is a group of settings: {', '.join(here)}")


def _names_in(here: Any, group: list[str]) -> list[str]:
    """Return what a group of a table holds, and what it may hold beside."""
    if isinstance(here, list):
        return [str(number) for number in range(len(here))]
    if not isinstance(here, Mapping):
        return []
    possible = (name.rpartition(".")[2] for name in setting_names(Study, group))
    return list(dict.fromkeys([*here, *possible]))


def _moved(old: str) -> str:
    return f"setting {old} is of the form before; it is now {OLD_FORM[old]}"


def _laid_over(below: Mapping[str, Any], above: Mapping[str, Any]) -> Table:
    result = dict(below)
    for name, value in above.items():
        old = result.get(name)
        if isinstance(old, Mapping) and isinstance(value, Mapping):
            result[name] = _laid_over(old, value)
        elif isinstance(old, list) and isinstance(value, Mapping):
            numbered = {str(i): each for i, each in enumerate(old)}
            result[name] = list(_laid_over(numbered, value).values())
        else:
            result[name] = value
    return result


def _flat(table: Any, prefix: str = "") -> Iterable[tuple[str, Any]]:
    if isinstance(table, list) and any(isinstance(each, Mapping) for each in table):
        table = {str(i): each for i, each in enumerate(table)}
    if not isinstance(table, Mapping):
        yield prefix, table
        return
    for name, value in table.items():
        yield from _flat(value, f"{prefix}.{name}" if prefix else str(name))
