"""Options that say how recordings are read, the same for every command that reads them."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

import typer

from motionese.errors import SettingError

PANEL = "How the recordings are read"


def _option(*names: str, metavar: str, help: str) -> Any:
    return typer.Option(*names, metavar=metavar, help=help, rich_help_panel=PANEL)


Channels = Annotated[
    list[str] | None,
    _option("--channels", metavar="PATTERN …", help="Channels to take, in this order: 'arm_*'."),
]
Exclude = Annotated[
    list[str] | None, _option("--exclude", metavar="PATTERN …", help="Channels to leave out.")
]
Format = Annotated[
    str | None,
    _option(
        "--format",
        metavar="csv|npz|eipl|robomimic|lerobot|mcap",
        help="What SOURCE is; else found out.",
    ),
]
EpisodeColumn = Annotated[
    str | None,
    _option("--episode", metavar="COLUMN", help="The column of a CSV that names the episode."),
]
TimeColumn = Annotated[
    str | None, _option("--time", metavar="COLUMN", help="The column of a CSV that is the time.")
]
Rate = Annotated[
    float | None,
    _option("--rate", metavar="HZ", help="Rows a second, where the recording does not tell."),
]
Resample = Annotated[
    float | None, _option("--resample", metavar="HZ", help="Rows a second to resample to.")
]
Trim = Annotated[
    float,
    _option(
        "--trim",
        metavar="SHARE",
        help="Cut still ends: rows in which nothing moves by more than this share of its range.",
    ),
]
Nan = Annotated[
    str, _option("--nan", metavar="refuse|gap", help="What a NaN is: an error, or a gap.")
]
Units = Annotated[
    list[str] | None, _option("--unit", metavar="PATTERN=UNIT …", help="Units: 'arm_*=rad'.")
]
Ranges = Annotated[
    list[str] | None,
    _option("--range", metavar="PATTERN=LOW:HIGH …", help="Ranges; else the data's and a margin."),
]
Margin = Annotated[
    float | None,
    _option("--margin", metavar="SHARE", help="How far ranges reach beyond the data; 0.05."),
]


def separated(texts: Sequence[str] | None) -> tuple[str, ...]:
    """Return the parts of texts that may hold several, with commas between them."""
    return tuple(part for text in texts or () for part in text.split(",") if part)


def read_units(texts: Sequence[str] | None) -> dict[str, str]:
    """Return the units of texts such as 'arm_*=rad', by pattern."""
    return dict(_pair("--unit", text, "rad") for text in texts or ())


def read_ranges(texts: Sequence[str] | None) -> dict[str, tuple[float, float]]:
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


def read_values(option: str, texts: Sequence[str] | None) -> dict[str, float]:
    """Return the numbers of texts such as 'shoulder=0.3', by name."""
    values = {}
    for text in separated(texts):
        name, told = _pair(option, text, "0.3")
        try:
            values[name] = float(told)
        except ValueError as error:
            raise SettingError(f"{option} {text}: '{told}' is no number") from error
    return values


def choice(
    channels: Sequence[str] | None,
    exclude: Sequence[str] | None,
    rate: float | None,
    resample: float | None,
    trim: float,
    nan: str,
    units: Sequence[str] | None,
    ranges: Sequence[str] | None,
    margin: float | None,
) -> Mapping[str, Any]:
    """Return what was chosen on the command line as `Motions.read` takes it."""
    return {
        "channels": separated(channels) or None,
        "exclude": separated(exclude),
        "rate_hz": rate,
        "resample_hz": resample,
        "trim": trim,
        "nan": nan,
        "units": read_units(units),
        "ranges": read_ranges(ranges),
        "margin": margin,
    }


def _pair(option: str, text: str, example: str) -> tuple[str, str]:
    name, equals, told = text.rpartition("=")
    if not (name and equals and told):
        raise SettingError(f"{option} {text}: write NAME={example}")
    return name, told
