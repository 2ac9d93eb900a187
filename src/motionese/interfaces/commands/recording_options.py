"""Options that say how recordings are read, the same for every command that reads them."""

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, Signature, signature
from typing import Annotated, Any

from typer import Option

from motionese.errors import SettingError

PANEL = "How the recordings are read"
Text = str | None
Texts = list[str] | None
Number = float | None


def _option(name: str, metavar: str, help: str, kind: Any, default: Any = None) -> Parameter:
    told = {"metavar": metavar} if metavar else {}
    option = Annotated[kind, Option(f"--{name}", help=help, rich_help_panel=PANEL, **told)]
    return Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=option)


FORMATS = "csv|npz|npy|eipl|hdf5|lerobot|mcap|rosbag"
STILL = "Cut still ends: rows in which nothing moves by more than this share of its range."
LEAPS = "Where a channel leaps: nothing, a gap, an episode cut in two, or an error."
OPTIONS = (
    _option("channels", "PATTERN …", "Channels to take, in this order: 'arm_*'.", Texts),
    _option("exclude", "PATTERN …", "Channels to leave out.", Texts),
    _option("format", FORMATS, "What SOURCE is; else found out.", Text),
    _option("episodes", "NAMES …", "Episodes to take: 0-9 'pick*'.", Texts),
    _option("skip", "NAMES …", "Episodes to leave out.", Texts),
    _option(
        "columns",
        "NAMES …",
        "Names of the columns of a table without a header, or of an array.",
        Texts,
    ),
    _option("episode", "COLUMN", "The column of a CSV that names the episode.", Text),
    _option("time", "COLUMN", "The column of a CSV that is the time.", Text),
    _option("topic", "PATTERN …", "Topics of a bag or MCAP to read.", Texts),
    _option("pause", "SECONDS", "A silence of so long cuts a bag or MCAP into takes.", Number),
    _option("marker", "TOPIC", "The topic of a bag or MCAP that marks its takes.", Text),
    _option("rate", "HZ", "Rows a second, where the recording does not tell.", Number),
    _option("resample", "HZ", "Rows a second to resample to.", Number),
    _option("trim", "SHARE", STILL, float, 0.0),
    _option("unwrap", "PATTERN …", "Angles that are to go on beyond a full turn.", Texts),
    _option("quaternion", "PATTERN …", "Quaternions whose signs are to agree.", Texts),
    _option("leaps", "keep|gap|cut|refuse", LEAPS, str, "keep"),
    _option("binary", "PATTERN …", "Channels to be held at their two values.", Texts),
    _option("strict", "", "Refuse what is only told of otherwise.", bool, False),
    _option("nan", "refuse|gap", "What a NaN is: an error, or a gap.", str, "refuse"),
    _option("unit", "PATTERN=UNIT …", "Units: 'arm_*=rad'.", Texts),
    _option("range", "PATTERN=LOW:HIGH …", "Ranges; else the data's and a margin.", Texts),
    _option("margin", "SHARE", "How far ranges reach beyond the data; 0.05.", Number),
)

LISTS = ("channels", "exclude", "episodes", "skip", "columns", "unwrap", "binary")
"""Options of several texts that `Motions.read` takes by the same name."""

Command = Callable[..., None]


def with_recording_options(*left_out: str) -> Callable[[Command], Command]:
    """Return a decorator that gives a command these options, but for those left out.

    The command takes what is given for them as `reading`, for `as_read`.
    """
    options = [option for option in OPTIONS if option.name not in left_out]

    def decorate(command: Command) -> Command:
        @wraps(command)
        def called(**given: Any) -> None:
            command(reading={option.name: given.pop(option.name) for option in options}, **given)

        own = signature(command).parameters.values()
        kept = [parameter for parameter in own if parameter.name != "reading"]
        called.__signature__ = Signature([*kept, *options])  # type: ignore[attr-defined]
        return called

    return decorate


def as_read(
    *,
    rate: float | None,
    resample: float | None = None,
    unit: Texts = None,
    range: Texts = None,
    quaternion: Texts = None,
    topic: Texts = None,
    **others: Any,
) -> dict[str, Any]:
    """Return what is given for these options as `Motions.read` takes it."""
    lists = {name: others.pop(name, None) for name in LISTS}
    lists |= {"quaternions": quaternion, "topics": topic}
    return {
        **{name: separated(texts) or None for name, texts in lists.items()},
        "rate_hz": rate,
        "resample_hz": resample,
        "units": read_units(unit),
        "ranges": read_ranges(range),
        **others,
    }


def separated(texts: Texts) -> tuple[str, ...]:
    """Return the parts of texts that may hold several, with commas between them."""
    return tuple(part for text in texts or () for part in text.split(",") if part)


def read_units(texts: Texts) -> dict[str, str]:
    """Return the units of texts such as 'arm_*=rad', by pattern."""
    return dict(_pair("--unit", text, "rad") for text in texts or ())


def read_ranges(texts: Texts) -> dict[str, tuple[float, float]]:
    """Return the ranges of texts such as 'arm_*=-1.5:1.5', by pattern."""
    ranges = {}
    for text in texts or ():
        pattern, told = _pair("--range", text, "LOW:HIGH")
        low, _, high = told.partition(":")
        try:
            ranges[pattern] = (float(low), float(high))
        except ValueError as error:
            raise SettingError(
                f"--range {text}: a range is two numbers, as in {pattern}=-1.5:1.5"
            ) from error
    return ranges


def read_values(option: str, texts: Texts) -> dict[str, float]:
    """Return the numbers of texts such as 'shoulder=0.3', by name."""
    values = {}
    for text in separated(texts):
        name, told = _pair(option, text, "0.3")
        try:
            values[name] = float(told)
        except ValueError as error:
            raise SettingError(f"{option} {text}: '{told}' is no number") from error
    return values


def _pair(option: str, text: str, example: str) -> tuple[str, str]:
    name, equals, told = text.rpartition("=")
    if not (name and equals and told):
        raise SettingError(f"{option} {text}: write NAME={example}")
    return name, told
