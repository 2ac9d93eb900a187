"""What a topic that we wrote tells beside its JSON messages, in its MCAP channel's metadata."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.errors import RecordingError
from motionese.recordings.formats.fault import fault

METADATA_KEY = "motionese"


class Told(BaseModel):
    """The episode's name, its channels with their units, and its rate [Hz] where there is one."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    version: Literal[1] = 1
    episode: str
    channels: tuple[str, ...]
    units: tuple[str, ...]
    rate_hz: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None

    def named_units(self) -> Iterator[tuple[str, str]]:
        """Yield every channel with its unit."""
        return zip(self.channels, self.units, strict=False)

    @classmethod
    def read(cls, file: Path, text: str) -> "Told":
        """Read the metadata's text; `RecordingError` where it is of no version that is read."""
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:
            raise RecordingError(
                f"{file}: its metadata '{METADATA_KEY}' is not what this version writes: "
                f"{fault(error)}"
            ) from error
