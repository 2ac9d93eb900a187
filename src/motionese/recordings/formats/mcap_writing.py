"""Writing MCAP with JSON messages, one file an episode, for Foxglove and whatever reads JSON."""

import json
import re
from io import BytesIO
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from jaxtyping import Int
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.errors import RecordingError
from motionese.faults import described
from motionese.recordings.formats.conventions import imported
from motionese.recordings.formats.writing import new_folder, write_file
from motionese.recordings.recording import Episode, Recording

TOPIC = "/motion"
METADATA_KEY = "motionese"


class TopicMetadata(BaseModel):
    """What a topic that we wrote tells beside its JSON messages, in its MCAP channel's metadata.

    The episode's name, its channels with their units, and its rate [Hz] where there is one.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    version: Literal[1] = 1
    episode: str
    channels: tuple[str, ...]
    units: tuple[str, ...]
    rate_hz: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None

    @classmethod
    def read(cls, file: Path, text: str) -> "TopicMetadata":
        """Read the metadata's text; `RecordingError` where it is of no version that is read."""
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:
            raise RecordingError(
                f"{file}: its metadata '{METADATA_KEY}' is not what this version writes: "
                f"{described(error)}"
            ) from error


def write(path: Path, recording: Recording) -> None:
    """Write a new folder of files, or one file where `path` ends in .mcap.

    Every row is a message {"NAME": value, …} on the topic /motion at its time, counted from the
    first; what was not observed is left out of it. Several episodes for one file, an empty one,
    unknown times and values that are not finite are refused.
    """
    if wrong := recording.first(lambda e: e.observed & ~np.isfinite(e.values)):
        raise RecordingError(f"{path}: {wrong[0]}: JSON cannot hold {wrong[1]}")
    if path.suffix.lower() != ".mcap":
        contents = [_content(path, episode, recording) for episode in recording.episodes]
        with new_folder(path) as folder:
            for i, (episode, content) in enumerate(zip(recording.episodes, contents, strict=True)):
                # The number keeps the episodes' order, the name is for people.
                name = re.sub(r"[^\w.-]+", "_", episode.name)[:60]
                (folder / f"{i:04d}_{name}.mcap").write_bytes(content)
        return
    if len(recording.episodes) != 1:
        raise RecordingError(
            f"{path}: an MCAP file holds one episode, the recording has "
            f"{len(recording.episodes)}: give the name of a folder, without .mcap"
        )
    write_file(path, _content(path, recording.episodes[0], recording))


def _content(path: Path, episode: Episode, recording: Recording) -> bytes:
    mcap = imported("mcap.writer", "mcap", "writing MCAP")
    channels, units, rate = recording.channels, recording.units, recording.rate_hz
    stamps = _stamps(path, episode, rate)
    properties = {
        name: {"type": "number", **({"description": f"[{unit}]"} if unit else {})}
        for name, unit in zip(channels, units, strict=True)
    }
    schema = json.dumps({"type": "object", "properties": properties})
    told = TopicMetadata(episode=episode.name, channels=channels, units=units, rate_hz=rate)
    content = BytesIO()
    writer = mcap.Writer(content)
    writer.start(profile="", library="motionese")
    topic = writer.register_channel(
        topic=TOPIC,
        message_encoding="json",
        schema_id=writer.register_schema("motion", "jsonschema", schema.encode()),
        metadata={METADATA_KEY: told.model_dump_json()},
    )
    for row, stamp in enumerate(stamps.tolist()):
        cells = zip(channels, episode.values[row], episode.observed[row], strict=True)
        message = {name: float(value) for name, value, seen in cells if seen}
        writer.add_message(topic, stamp, json.dumps(message).encode(), stamp, row)
    writer.finish()
    return content.getvalue()


def _stamps(path: Path, episode: Episode, rate_hz: float | None) -> Int[ndarray, " T"]:
    """Return every row's time [ns] from the first."""
    where = f"{path}: episode '{episode.name}'"
    if not len(episode.values):
        raise RecordingError(f"{where} has no rows; an MCAP file needs at least one")
    times = episode.times_at(rate_hz)
    if times is None:
        raise RecordingError(f"{where} has no times, and the recording no known rate")
    stamps: Int[ndarray, " T"] = np.rint((times - times[0]) * 1e9).astype(np.int64)
    if np.any(np.diff(stamps) <= 0):
        raise RecordingError(f"{where}: its times do not rise from row to row")
    return stamps
