"""What may be chosen about every simulated robot."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator

PICTURES_HZ = 20.0
"""Pictures a second, each followed by a correction of what the actuators are given."""


class SimulationSettings(BaseModel):
    """Clock and sight of a robot; defaults are those of the standard experiment."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    rate_hz: float = Field(default=10.0, gt=0, le=PICTURES_HZ)
    """How often a second is sensed and commanded; hence the network's steps."""
    vision: Literal["projection", "rendered"] = "projection"
    """The seen hand is its exact projection, or a blob in a rendered picture."""
    pixel_noise: float = Field(default=0.3, ge=0.0, le=5.0)
    """Root mean square [px] of the noise added to each coordinate of a projected hand."""

    @field_validator("rate_hz")
    @classmethod
    def _divides_pictures(cls, rate_hz: float) -> float:
        if (PICTURES_HZ / rate_hz) % 1:
            raise ValueError(
                f"a control period must hold a whole number of the {PICTURES_HZ:g} pictures a "
                f"second: 20, 10, 5, 4, 2 or 1 Hz, got {rate_hz:g}"
            )
        return rate_hz
