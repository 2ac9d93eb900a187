"""What may be chosen about the simulated body."""

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator

GAZE_HZ = 20.0
"""Pictures, gaze corrections and pressure corrections a second."""


class BodySettings(BaseModel):
    """The simulated body; every field has the value of the standard experiment as its default."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    rate_hz: float = Field(default=10.0, gt=0, le=GAZE_HZ)
    """How often a second is sensed and commanded; hence the network's steps."""
    stiffness: float = Field(default=30.0, ge=15.0, le=80.0)
    """Stiffness [Nm/rad] of each joint's pair of pneumatic actuators; a softer arm is slower."""
    vision: Literal["projection", "rendered"] = "projection"
    """The seen hand is its exact projection, or a blob in a rendered picture."""
    pixel_noise: float = Field(default=0.3, ge=0.0, le=5.0)
    """Root mean square [px] of the noise added to each coordinate of a projected hand."""

    @field_validator("rate_hz")
    @classmethod
    def _divides_gaze(cls, rate_hz: float) -> float:
        if (GAZE_HZ / rate_hz) % 1:
            raise ValueError(
                f"a control period must hold a whole number of the {GAZE_HZ:g} pictures a second: "
                f"20, 10, 5, 4, 2 or 1 Hz, got {rate_hz:g}"
            )
        return rate_hz
