"""What a page may say, with the limits of everything that comes from outside; what it is answered.

A message that is none of these closes the connection it came through, and nothing else. Server
and robot's process share this file: nothing heavy is imported here.
"""

import time
from collections.abc import Callable
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from motionese.teaching.session_contents import LONGEST_NAME, Growth

MOST_BYTES = 64 * 1024
"""Of one message."""
MOST_POINTS = 512
"""Of one message; a pen of 1000 Hz has 40 in a batch."""
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
    """Points of a drawing; `follow`, as the pen is set down: the robot's arm is to follow it."""

    type: Literal["pen"]
    phase: Literal["down", "move", "up"]
    points: Annotated[list[Point], Field(max_length=MOST_POINTS)]
    source: Literal["drawn", "webcam"] = "drawn"
    follow: bool = False


class Demonstrate(Said):
    """The scripted caregiver is to show a motion."""

    type: Literal["demonstrate"]
    motion: Annotated[str, Field(max_length=32)]


class OfEntry(Said):
    """An entry of the notebook is to be undone, or its last try to be seen again."""

    type: Literal["forget", "replay"]
    entry: Annotated[int, Field(ge=0, le=10**6)]


class Rename(Said):
    """A motion of the person's own is to be called otherwise."""

    type: Literal["rename"]
    motion: Annotated[str, Field(max_length=64)]
    name: Annotated[str, Field(max_length=64)]


class Hover(Said):
    """The motion of a point of the map is wanted."""

    type: Literal["hover"]
    slow: tuple[Slow, Slow]
    primitive: Annotated[str, Field(max_length=32)]


RobotName = Annotated[str, Field(max_length=LONGEST_NAME)]
Id = Annotated[str, Field(max_length=64)]


class Begin(Said):
    """A new robot is wanted: after babbling, or fresh; `away` is put away for it, if any."""

    type: Literal["begin"]
    with_: Annotated[Literal["babbling", "fresh"], Field(alias="with")]
    grows: Growth = "told"
    name: RobotName = ""
    away: Id = ""


class OfRobot(Said):
    """A robot is to be taught from now on; or the one taught is to have its lessons."""

    type: Literal["teach", "repeat"]
    robot: Id


class Call(Said):
    """A robot has a name."""

    type: Literal["call"]
    robot: Id
    name: RobotName


class Open(Said):
    """A session that was sent as a file is to take the place of this one."""

    type: Literal["open"]
    file: Annotated[str, Field(pattern="^[0-9a-f]{32}$")]


class Plain(Said):
    """A message without content."""

    type: Literal["imitate", "learn", "grow", "map", "compare", "stop"]


Message = (
    Hello | Pen | Demonstrate | OfEntry | Rename | Hover | Begin | OfRobot | Call | Open | Plain
)
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
        reason = f"malformed message: {where} {first['msg']}".replace("  ", " ")
        raise RefusedError(reason) from None


class Pace:
    """A page may say so much at once, and so much a second (a leaky bucket)."""

    def __init__(self) -> None:
        """Begin with an empty bucket."""
        self._filled, self._at = 0.0, time.monotonic()

    def one_more(self) -> None:
        """Count a message; `RefusedError` if they come too fast."""
        now = time.monotonic()
        self._filled = max(0.0, self._filled - (now - self._at) * MOST_A_SECOND) + 1.0
        self._at = now
        if self._filled > MOST_AT_ONCE:
            raise RefusedError(f"more than {MOST_A_SECOND:g} messages a second")


class Strokes:
    """The order of a drawing: pen down, moves, pen up; time never goes back."""

    def __init__(self) -> None:
        """Begin with the pen up."""
        self._down, self._last = False, 0.0

    def check(self, pen: Pen) -> None:
        """Take the next part of a drawing; `RefusedError` if it is out of order."""
        if (pen.phase == "down") == self._down:
            raise RefusedError(
                f"out of order: pen {pen.phase} while the pen is {'down' if self._down else 'up'}"
            )
        if pen.phase == "down":
            self._last = 0.0
        for at, _, _ in pen.points:
            if at < self._last:
                raise RefusedError(f"out of order: a point of {at:g} ms after {self._last:g} ms")
            self._last = at
        self._down = pen.phase != "up"


Answer = dict[str, Any]
"""A message to the page."""
Tell = Callable[[Answer], None]
State = Literal["starting", "ready", "restarted", "failed"]


def worker_message(state: State, sentence: str) -> Answer:
    """Return how the robot's process is."""
    return {"type": "worker", "state": state, "sentence": sentence}
