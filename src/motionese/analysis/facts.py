"""What a run folder says of itself: its settings, and the machine and versions it ran on."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from motionese.errors import RunFolderError, SettingError
from motionese.experiment.reading import checked, read_settings
from motionese.experiment.run_folder import ENVIRONMENT, SETTINGS, run_settings
from motionese.experiment.settings import Settings


@dataclass(frozen=True)
class Facts:
    """Settings and environment of a run folder.

    Attributes:
        settings: The experiment's settings; the default's where the folder does not tell them.
        record: Everything `settings.json` holds beside them, such as the preset.
        environment: Everything `environment.json` holds.
        told: Whether the folder tells its settings.
    """

    settings: Settings
    record: dict[str, Any]
    environment: dict[str, Any]
    told: bool


def read_facts(folder: Path) -> Facts:
    """Read `settings.json` and `environment.json` of a run folder, as far as they are there.

    Raises:
        RunFolderError: One of them is damaged, or the settings are not of this version.
    """
    record = _json(folder / SETTINGS)
    told = (folder / SETTINGS).is_file()
    settings = _settings(folder) if told else read_settings()
    record.pop("settings", None)
    return Facts(settings, record, _json(folder / ENVIRONMENT), told)


def flat(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Yield every entry of nested tables as a dotted name with its value in words."""
    for name, value in table.items():
        if isinstance(value, Mapping) and value:
            yield from flat(value, f"{prefix}{name}.")
        else:
            yield f"{prefix}{name}", _in_words(value)


def _settings(folder: Path) -> Settings:
    try:
        return checked(run_settings(folder))
    except SettingError as error:
        raise RunFolderError(
            f"{folder / SETTINGS} does not fit this version of motionese: {error}"
        ) from error


def _in_words(value: Any) -> str:
    if value is None or value == {}:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (list, tuple)):
        return ", ".join(_in_words(each) for each in value)
    return str(value)


def _json(path: Path) -> dict[str, Any]:
    if not path.is_file():
        return {}
    try:
        found = json.loads(path.read_text())
    except (OSError, ValueError) as error:
        raise RunFolderError(f"{path}: not a JSON object: {error}") from error
    if not isinstance(found, dict):
        raise RunFolderError(f"{path}: not a JSON object, got {type(found).__name__}")
    return found
