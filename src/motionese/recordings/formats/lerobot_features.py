"""What a LeRobotDataset's meta/info.json says, and how its features become named channels."""

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.errors import RecordingError
from motionese.faults import described
from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import WIDEST, numbered, strings

STATE, ACTION = "observation.state", "action"
VERSIONS = ("v3.0", "v2.1", "v2.0")
"""The versions of the format that are read."""
BOOKKEEPING = ("timestamp", "frame_index", "episode_index", "index", "task_index")
"""Features that every dataset has and that are no channels."""
FLOATS = re.compile("float(16|32|64)")
NUMBERS = re.compile("bool|u?int(8|16|32|64)|float(16|32|64)")


class _Loose(BaseModel):
    """Part of a file that others write and extend: only what is needed is looked at."""

    model_config = ConfigDict(frozen=True, extra="ignore", strict=True)


class _Version(_Loose):
    codebase_version: str


class FeatureInfo(_Loose):
    """One feature: a column of the data files that holds an array of one shape in every row."""

    dtype: str
    shape: tuple[int, ...]
    names: Any = None
    units: Any = None
    derived_from: Any = None


class Info(_Loose):
    """The dataset: its rate `fps` [Hz], its features by name, and how much of it there is.

    What only datasets that we wrote tell, here and in the features, lerobot does not look at.
    """

    fps: Annotated[float, Field(gt=0, allow_inf_nan=False)]
    features: dict[str, FeatureInfo]
    total_episodes: int | None = None
    total_frames: int | None = None
    splits: Any = None
    episode_names: tuple[str, ...] = ()


class Feature(NamedTuple):
    """A feature whose columns are channels: their names, unique in the dataset, and units."""

    key: str
    channels: tuple[str, ...]
    units: tuple[str, ...]


def read_info(path: Path) -> Info:
    """Read meta/info.json of the dataset in the folder `path`."""
    file = path / "meta" / "info.json"
    try:
        content = file.read_bytes()
        version = _Version.model_validate_json(content).codebase_version
        if version not in VERSIONS:
            raise RecordingError(
                f"{file}: codebase_version {version!r} is not read; "
                f"LeRobotDataset {', '.join(VERSIONS)} are"
            )
        return Info.model_validate_json(content)
    except OSError as error:
        raise RecordingError(f"{file}: cannot be read: {error.strerror or error}") from error
    except ValidationError as error:
        raise RecordingError(
            f"{file}: not the info.json of a LeRobotDataset: {described(error)}"
        ) from error


def features_of(info: Info) -> tuple[Feature, ...]:
    """Return the features that are channels: vectors [n] of floating-point numbers, and of others.

    Whole numbers and truth values are channels among observations and actions; elsewhere they
    count, or tell whether something is done.

    Channels of `observation.state` keep their plain names, all others are FEATURE.NAME
    (`action.elbow`). Columns without names are numbered: state_0, action_0, and plainly FEATURE
    where there is one. A name that occurs twice in a feature gets its column's number.
    """
    features: list[Feature] = []
    taken: set[str] = set()
    for key, told in info.features.items():
        if not (_holds_numbers(key, told) and _is_vector(told)):
            continue
        width = told.shape[0] if told.shape else 1
        channels = _channels(key, _names(told.names, width), width)
        if taken & set(channels):
            channels = tuple(f"{key}.{name}" for name in channels)
        taken |= set(channels)
        features.append(Feature(key, channels, strings(told.units, width) or ("",) * width))
    return tuple(features)


def features_told(path: Path, info: Info) -> Iterator[Finding]:
    """Yield what is to be known of features: left out, or their columns told apart."""
    for key, told in info.features.items():
        if not _holds_numbers(key, told):
            continue
        if not _is_vector(told) and len(told.shape) < 3:  # what has more dimensions is a picture
            what = f"a feature of shape {[*told.shape]} is left out: no vector of up to {WIDEST}"
            yield Finding("left out", path, what, channel=key)
        elif _is_vector(told):
            count = Counter(_names(told.names, told.shape[0] if told.shape else 1))
            for name in [name for name, times in count.items() if times > 1]:
                what = f"{count[name]} of its columns are called '{name}': told apart by number"
                yield Finding("column", path, what, channel=key)


def _holds_numbers(key: str, told: FeatureInfo) -> bool:
    """Tell whether a feature is of numbers that are measured, and not computed from others."""
    kinds = NUMBERS if key.startswith(("observation", ACTION)) else FLOATS
    is_own = key not in BOOKKEEPING and told.derived_from is None
    return is_own and kinds.fullmatch(told.dtype) is not None


def _is_vector(told: FeatureInfo) -> bool:
    return len(told.shape) <= 1 and all(0 < n <= WIDEST for n in told.shape)


def _channels(key: str, names: tuple[str, ...] | None, width: int) -> tuple[str, ...]:
    if names is None:
        return numbered(key.rpartition(".")[2] if key == STATE else key, width)
    count = Counter(names)
    unique = [n if count[n] == 1 else f"{n}_{i}" for i, n in enumerate(names)]
    return tuple(unique if key == STATE else [f"{key}.{n}" for n in unique])


def _names(told: Any, width: int) -> tuple[str, ...] | None:
    """Return the columns' names of any of the shapes in which datasets give them, or None."""
    if isinstance(told, dict) and all(isinstance(v, int) for v in told.values()):
        told = sorted(told, key=told.__getitem__)
    elif isinstance(told, dict):
        told = [part for part in told.values() if isinstance(part, list)]
    if isinstance(told, list) and all(isinstance(part, list) for part in told):
        told = [name for part in told for name in part]
    return strings(told, width)
