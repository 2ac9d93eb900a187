"""Sweeps: one preset at several points of its settings; those that come with motionese as TOML."""

import json
import re
import tomllib
from collections.abc import Iterable
from importlib import resources
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import Field, field_validator, model_validator

from motionese.errors import RunFolderError, SettingError, unknown
from motionese.experiment.presets import read_table
from motionese.imitation import Group, checked

SWEEPS = (*("slow_tau", "sizes", "bound_and_noise", "pauses", "training_per_loop", "phase_change"),)
SWEPT = "sweep.json"
"""Where a sweep stands in the folder that holds the run folders of its points."""
MOST_POINTS = 200
NAME = "name"
"""Of a point in `[[settings]]`, beside its settings."""


class Point(NamedTuple):
    """Settings at which a preset is run.

    Attributes:
        label: What it is called, such as "cs.tau=50"; its run folder is called so too.
        overrides: Its settings, as `read_settings` takes them.
    """

    label: str
    overrides: tuple[str, ...]


class Sweep(Group):
    """What is varied: numbers of one setting, a grid of several, or any settings, point by point.

    Attributes:
        title: What is asked, in a line.
        preset: The preset, or the path of its file.
        conditions: Conditions that are run; all if empty.
        vary: By setting, the numbers that it takes; several settings make a grid.
        settings: Settings of every point, with a `name` where they do not make one.
    """

    title: str = ""
    preset: str = "default"
    conditions: tuple[str, ...] = ()
    vary: dict[str, list[Any]] = Field(default_factory=dict)
    settings: list[dict[str, Any]] = Field(default_factory=list)

    @field_validator("vary")
    @classmethod
    def _numbers(cls, vary: dict[str, list[Any]]) -> dict[str, list[Any]]:
        for name, values in vary.items():
            odd = [v for v in values if not isinstance(v, int | float) or isinstance(v, bool)]
            if odd:
                raise ValueError(
                    f"{name} is to be varied over numbers, got {odd[0]!r}; other values are for "
                    "[[settings]], point by point"
                )
            if len(set(values)) < len(values) or not values:
                raise ValueError(f"{name} needs numbers, each of them once; got {values}")
        return vary

    @model_validator(mode="after")
    def _has_points(self) -> "Sweep":
        if bool(self.vary) == bool(self.settings):
            raise ValueError("a sweep has either [vary] or [[settings]]")
        labels = [point.label for point in self.points]
        if not 2 <= len(labels) <= MOST_POINTS:
            raise ValueError(f"a sweep has 2 to {MOST_POINTS} points, got {len(labels)}")
        if doubled := {label for label in labels if labels.count(label) > 1}:
            raise ValueError(f"several points are called '{doubled.pop()}'; give each a name")
        return self

    @property
    def points(self) -> list[Point]:
        """The points, the last setting changing fastest."""
        if self.vary:
            grid = product(*self.vary.values())
            tables = [dict(zip(self.vary, values, strict=True)) for values in grid]
        else:
            tables = self.settings
        short = _short_names({name for table in tables for name in table if name != NAME})
        return [_point(table, short) for table in tables]


def read_sweep(name: str) -> Sweep:
    """Return a sweep that comes with motionese, or that of a TOML file.

    Raises:
        SettingError: There is none, or a setting is wrong.
    """
    if name in SWEEPS:
        return checked(Sweep, tomllib.loads(_text(name)))
    if not Path(name).is_file():
        raise SettingError(f"{unknown('sweep', name, SWEEPS)}, or the path of a TOML file")
    table = read_table(Path(name))
    try:
        return checked(Sweep, table)
    except SettingError as error:
        raise SettingError(f"{name}: {error}") from error


def sweep_in(folder: Path) -> Sweep | None:
    """Return the sweep whose run folders lie in a folder, None if there is none.

    Raises:
        RunFolderError: It cannot be read.
    """
    file = folder / SWEPT
    if not file.is_file():
        return None
    try:
        return Sweep.model_validate_json(file.read_bytes())
    except (OSError, ValueError) as error:
        raise RunFolderError(
            f"{file} cannot be read; remove it, and the same `motionese sweep` command writes it"
        ) from error


def titles() -> list[tuple[str, str]]:
    """Return the sweeps that come with motionese, by name, with their titles."""
    return [(name, read_sweep(name).title) for name in SWEEPS]


def read_varied(texts: Iterable[str]) -> dict[str, list[Any]]:
    """Return the settings of texts such as 'network.levels.cs.tau=30,50,70', with their numbers.

    Raises:
        SettingError: A text that is not of this form.
    """
    vary = {}
    for text in texts:
        name, equals, values = text.partition("=")
        try:
            vary[name.strip()] = [json.loads(value) for value in values.split(",")]
        except ValueError as error:
            what = f"takes NAME=NUMBER,NUMBER …, got '{text}'" if not equals else f"{text}"
            raise SettingError(f"--vary {what}: a sweep is over numbers") from error
    return vary


def _text(name: str) -> str:
    return resources.files(__name__).joinpath(f"{name}.toml").read_text("utf-8")


def _short_names(names: Iterable[str]) -> dict[str, str]:
    """Return what settings are called in labels: their last parts, two at least if there are."""
    short = {}
    for name in names:
        parts = name.split(".")
        ends = (".".join(parts[-count:]) for count in range(2, len(parts) + 1))
        others = [each for each in names if each != name]
        short[name] = next(
            (end for end in ends if not any(o.endswith(f".{end}") for o in others)), name
        )
    return short


def _point(table: dict[str, Any], short: dict[str, str]) -> Point:
    settings = {name: json.dumps(value) for name, value in table.items() if name != NAME}
    made = ",".join(f"{short[name]}={value}" for name, value in settings.items())
    label = str(table.get(NAME, made)).replace('"', "")
    if not re.fullmatch(r"[\w=.,+\- ]{1,100}", label):
        raise ValueError(
            f"point '{label}' needs a name of letters, digits, spaces and = . , + - _ alone: its "
            "run folder is called so"
        )
    return Point(label, tuple(f"{name}={value}" for name, value in settings.items()))
