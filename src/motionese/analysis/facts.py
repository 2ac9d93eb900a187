"""What a run folder says of itself: its settings, and the machine and versions it ran on."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from motionese.errors import RunFolderError, SettingError
from motionese.experiment import Study
from motionese.experiment.digests import DIGESTS
from motionese.experiment.presets import study_of
from motionese.experiment.run_folder import ENVIRONMENT, SETTINGS, run_settings


@dataclass(frozen=True)
class Facts:
    """Settings of a run folder, what stands beside them such as the preset, and environment."""

    study: Study
    record: dict[str, Any]
    environment: dict[str, Any]


def read_facts(folder: Path) -> Facts:
    """Read `settings.json`, and `environment.json` if it is there, of a run folder.

    Raises:
        RunFolderError: One of them has changed since it was written or cannot be read, there are
            no settings, or not of this version.
    """
    try:
        study = study_of(run_settings(folder))
    except SettingError as error:
        raise RunFolderError(
            f"{folder / SETTINGS} does not fit this version of motionese: {error}"
        ) from error
    if not (folder / DIGESTS).is_file():
        raise RunFolderError(
            f"{folder} has no {DIGESTS}: the same `motionese reproduce` command writes it again"
        )
    record = _json(folder / SETTINGS)
    record.pop("settings", None)
    return Facts(study, record, _json(folder / ENVIRONMENT))


def flat(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Yield every entry of nested tables as a dotted name with its value in words."""
    for name, value in table.items():
        listed = isinstance(value, list) and value and isinstance(value[0], Mapping)
        within = {str(i): each for i, each in enumerate(value)} if listed else value
        if isinstance(within, Mapping) and within:
            yield from flat(within, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", _in_words(value)


def _in_words(value: Any) -> str:
    if value is None or value == {}:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list | tuple):
        return ", ".join(_in_words(each) for each in value)
    return str(value)


def _json(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text()) if path.is_file() else {}
    except (OSError, ValueError, RecursionError) as error:
        raise RunFolderError(f"{path}: not a JSON object: {error}") from error
    if not isinstance(found, dict):
        raise RunFolderError(f"{path}: not a JSON object, got {type(found).__name__}")
    return found
