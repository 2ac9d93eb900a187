"""What a page may say: types and limits of everything that comes from outside.

A message that is none of these closes the connection it came through, and nothing else.
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

MOST_BYTES = 64 * 1024
"""Of one message."""
MOST_POINTS = 512
"""Of one message; a pen of 1000 Hz has 50 in a batch."""
MOST_A_SECOND, MOST_AT_ONCE = 60.0, 120.0
"""Messages."""


class RefusedError(Exception):
    """A message that closes its connection; its text is the reason."""


class Said(BaseModel):
    """A message: complete, without unknown fields, every number finite."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, strict=True)


Time = Annotated[float, Field(ge=0, le=1e12)]
Place = Annotated[float, Field(ge=-1, le=2)]
Slow = Annotated[float, Field(ge=-100, le=100)]
Point = tuple[Time, Place, Place]
"""Time [ms], and x, y in the view; a captured pointer may leave the view."""


class Hello(Said):
    """A page begins; `take` takes the session over from another page."""

    type: Literal["hello"]
    session: Annotated[str, Field(max_length=64)] = ""
    take: bool = False


class Pen(Said):
    """Points of a drawing."""

    type: Literal["pen"]
    phase: Literal["down", "move", "up"]
    points: Annotated[list[Point], Field(max_length=MOST_POINTS)]
    source: Literal["drawn", "webcam"] = "drawn"


class Demonstrate(Said):
    """The scripted caregiver is to show a motion."""

    type: Literal["demonstrate"]
    motion: Annotated[str, Field(max_length=32)]


class Forget(Said):
    """An entry of the notebook is to be undone."""

    type: Literal["forget"]
    entry: Annotated[int, Field(ge=0, le=10**6)]


class Hover(Said):
    """The motion of a point of the map is wanted."""

    type: Literal["hover"]
    cs: tuple[Slow, Slow]
    primitive: Annotated[str, Field(max_length=32)]


class Begin(Said):
    """A new robot is wanted: after babbling, or fresh."""

    type: Literal["begin"]
    with_: Annotated[Literal["babbling", "fresh"], Field(alias="with")]


class Plain(Said):
    """A message without content."""

    type: Literal["imitate", "learn", "grow", "map", "stop"]


Message = Hello | Pen | Demonstrate | Forget | Hover | Begin | Plain
_MESSAGES: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Field(discriminator="type")])


def understood(text: str) -> Message:
    """Return the message that a text is; `RefusedError` if it is none."""
    if len(text) > MOST_BYTES:
        raise RefusedError(f"message of more than {MOST_BYTES} bytes")
    try:
        return _MESSAGES.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_input=False, include_url=False)[0]
        where = ".".join(str(part) for part in first["loc"][1:])
        raise RefusedError(
            f"malformed message: {where} {first['msg']}".replace("  ", " ")
        ) from None
