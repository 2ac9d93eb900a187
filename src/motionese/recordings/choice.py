"""What the user chooses about a recording, checked where it is given, and its channels."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fnmatch import fnmatchcase
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from motionese.errors import ChannelError, RecordingError, unknown
from motionese.faults import first_fault, refusal
from motionese.recordings.finding import Finding
from motionese.recordings.recording import Recording

MARGIN = 0.05
"""How far a range taken from data reaches beyond it, as a share of its width."""


def _wide(limits: tuple[float, float]) -> tuple[float, float]:
    if not limits[0] < limits[1]:
        raise ValueError(f"a range needs low < high, got {limits[0]:g} to {limits[1]:g}")
    return limits


Finite = Annotated[float, Field(allow_inf_nan=False)]
Rate = Annotated[float, Field(gt=0, le=1e6, allow_inf_nan=False)]
Range = Annotated[tuple[Finite, Finite], AfterValidator(_wide)]


class Choice(BaseModel):
    """Which channels of a recording are taken, and how they are made ready.

    A channel is chosen by its name or by a pattern such as "Head*" (`*`, `?`, `[abc]`).

    Attributes:
        channels: In the order wanted; the recording's usual ones for None.
        rate_hz: Rows per second [Hz] at which it was recorded, where the file does not tell.
        resample_hz: Rows per second [Hz] to resample to.
        trim: Rows at both ends are cut while no channel has moved by more than this share of
            its range; 0 for none.
        nan: Whether a NaN among the values is refused or taken as a gap.
        ranges: Ranges (low, high) by name or pattern; else what the file tells, else the data's.
        margin: How far a range taken from the data reaches beyond it, as a share of its width.
        episodes: Names, patterns, or ranges of numbers ("0-9") of the episodes taken; all for None.
        skip: The same, of episodes left out.
        unwrap: Channels that are angles, to go on beyond the end of a turn.
        quaternions: Channels of quaternions, whose signs are to agree from row to row.
        leaps: What is done where a channel leaps as no arm does: nothing; its rows become a gap;
            the episode is cut in two; or it is refused.
        binary: Channels of two values, to be held at them when they are generated.
        strict: Whether any finding is refused.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    channels: tuple[str, ...] | None = None
    exclude: tuple[str, ...] = ()
    rate_hz: Rate | None = None
    resample_hz: Rate | None = None
    trim: float = Field(default=0.0, ge=0, lt=1)
    nan: Literal["refuse", "gap"] = "refuse"
    units: Mapping[str, str] = {}
    ranges: Mapping[str, Range] = {}
    margin: float = Field(default=MARGIN, ge=0, le=10)
    episodes: tuple[str, ...] | None = None
    skip: tuple[str, ...] = ()
    unwrap: tuple[str, ...] = ()
    quaternions: tuple[str, ...] = ()
    leaps: Literal["keep", "gap", "cut", "refuse"] = "keep"
    binary: tuple[str, ...] = ()
    strict: bool = False


def choose(**given: Any) -> Choice:
    """Return the choice of these settings, those that are None left at their defaults.

    Raises:
        SettingError: A setting that does not exist, or a value that is not allowed.
    """
    told = {name: value for name, value in given.items() if value is not None}
    try:
        return Choice(**told)
    except ValidationError as error:
        raise refusal(first_fault(error, told), Choice.model_fields) from error


def chosen(recording: Recording, choice: Choice) -> Recording:
    """Return the recording with the chosen episodes, and channels in the order chosen.

    Raises:
        ChannelError: A channel that does not exist, or none that is left.
        RecordingError: An episode that does not exist, or none that is left.
    """
    recording = _chosen_episodes(recording, choice)
    everything, wanted = recording.channels, choice.channels
    taken = recording.usual if wanted is None else matching(recording, wanted, everything)
    dropped = matching(recording, choice.exclude, everything)
    kept = tuple(c for c in taken if c not in dropped)
    if not kept:
        raise ChannelError(
            f"{recording.source}: no channel is left; there are: {', '.join(everything)}"
        )

    def is_told(finding: Finding) -> bool:
        """Tell whether it still matters: why a channel is not taken, unless the user says so."""
        if finding.kind == "column" and finding.channel in everything:
            return wanted is None and finding.channel not in dropped
        return finding.channel not in everything or finding.channel in kept

    columns = [everything.index(c) for c in kept]
    units = {c: recording.units[i] for c, i in zip(kept, columns, strict=True)}
    for pattern, unit in choice.units.items():
        units |= dict.fromkeys(matching(recording, [pattern], kept), unit)
    return replace(
        recording.map(lambda e: e.part(columns=columns)),
        channels=kept,
        units=tuple(units.values()),
        ranges={c: r for c, r in recording.ranges.items() if c in kept},
        binary={c: two for c, two in recording.binary.items() if c in kept},
        usual=kept,
        findings=tuple(filter(is_told, recording.findings)),
    )


def _chosen_episodes(recording: Recording, choice: Choice) -> Recording:
    names = [e.name for e in recording.episodes]
    taken = names if choice.episodes is None else _episodes(recording, choice.episodes)
    dropped = _episodes(recording, choice.skip)
    kept = [name for name in names if name in taken and name not in dropped]
    if not kept:
        raise RecordingError(
            f"{recording.source}: no episode is left; there are: {', '.join(names)}"
        )
    return replace(
        recording,
        episodes=tuple(e for e in recording.episodes if e.name in kept),
        held_out=tuple(name for name in recording.held_out if name in kept),
    )


def _episodes(recording: Recording, told: Iterable[str]) -> set[str]:
    """Return the episodes of these names, patterns or numbers.

    A number is a name where one is called so, or else counts the episodes from 0.
    """
    names, found = [e.name for e in recording.episodes], set[str]()
    for text in told:
        between = re.fullmatch(r"(\d{1,9})(?:-(\d{1,9}))?", text)
        fits = [n for n in names if n == text] or [n for n in names if fnmatchcase(n, text)]
        if between and not fits:
            first, last = int(between[1]), int(between[2] or between[1])
            numbered = {int(n): n for n in names if n.isdecimal() and len(n) <= 9}
            numbered = numbered or dict(enumerate(names))
            fits = [name for number, name in numbered.items() if first <= number <= last]
        if not fits:
            raise RecordingError(f"{recording.source}: {unknown('episode', text, names)}")
        found |= set(fits)
    return found


def given_ranges(recording: Recording, choice: Choice) -> dict[str, tuple[float, float]]:
    """Return the ranges that the file or the user tells, by channel; the user's before the file's.

    Raises:
        ChannelError: A range of a channel that is not there.
    """
    ranges = dict(recording.ranges)
    for pattern, limits in choice.ranges.items():
        ranges |= dict.fromkeys(matching(recording, [pattern], recording.channels), limits)
    return ranges


def matching(
    recording: Recording, patterns: Iterable[str], names: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the channels of these names, or else those that fit the patterns, one or more each."""
    found: dict[str, None] = {}
    for pattern in patterns:
        # A name first: those of messages hold brackets, as in "/joints.position[0]".
        fits = [pattern] if pattern in names else [n for n in names if fnmatchcase(n, pattern)]
        if not fits:
            raise ChannelError(_no_channel(recording, pattern, names))
        found |= dict.fromkeys(fits)
    return tuple(found)


def _no_channel(recording: Recording, pattern: str, names: tuple[str, ...]) -> str:
    """Return the sentence for what is no channel: why it is none, where reading found that."""
    for finding in recording.findings:
        if finding.channel not in ("", *recording.channels) and fnmatchcase(
            finding.channel, pattern
        ):
            return f"{finding.sentence}; there are: {', '.join(names)}"
    return f"{recording.source}: {unknown('channel', pattern, names)}"
