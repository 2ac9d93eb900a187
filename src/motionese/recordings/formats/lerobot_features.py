"""What a LeRobotDataset's meta/info.json says, and how its features become named channels."""

from collections import Counter
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import WIDEST, fault, numbered, strings

STATE, ACTION = "observation.state", "action"
VERSIONS = ("v3.0", "v2.1")
"""The versions of the format that are read."""
BOOKKEEPING = ("timestamp", "frame_index", "episode_index", "index", "task_index")
"""Features that every dataset has and that are no channels."""


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
                f"LeRobotDataset {' and '.join(VERSIONS)} are"
            )
        return Info.model_validate_json(content)
    except OSError as error:
        raise RecordingError(f"{file}: cannot be read: {error.strerror or error}") from error
    except ValidationError as error:
        raise RecordingError(
            f"{file}: not the info.json of a LeRobotDataset: {fault(error)}"
        ) from error


def features_of(info: Info) -> tuple[Feature, ...]:
    """Return the features that are channels: floating point, of shape [n].

    Channels of `observation.state` keep their plain names, all others are FEATURE.NAME
    (`action.elbow`). Columns without names are numbered: state_0, action_0, and plainly FEATURE
    where there is one. A name that occurs twice in a feature gets its column's number.
    """
    features: list[Feature] = []
    taken: set[str] = set()
    for key, told in info.features.items():
        is_vector = len(told.shape) <= 1 and all(0 < n <= WIDEST for n in told.shape)
        is_float = told.dtype in {"float32", "float64"}
        if key in BOOKKEEPING or told.derived_from is not None or not (is_float and is_vector):
            continue
        width = told.shape[0] if told.shape else 1
        channels = _channels(key, _names(told.names, width), width)
        if taken & set(channels):
            channels = tuple(f"{key}.{name}" for name in channels)
        taken |= set(channels)
        features.append(Feature(key, channels, strings(told.units, width) or ("",) * width))
    return tuple(features)


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
