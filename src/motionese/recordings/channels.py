"""Choosing channels by name or pattern, and giving them units."""

from collections.abc import Iterable
from dataclasses import replace
from fnmatch import fnmatchcase

from motionese.errors import ChannelError, unknown
from motionese.recordings.choice import Choice
from motionese.recordings.recording import Recording


def chosen(recording: Recording, choice: Choice) -> Recording:
    """Return the recording with the chosen channels only, in the order chosen.

    Raises:
        ChannelError: A name or pattern that fits no channel, or no channel that is left.
    """
    everything = recording.channels
    taken = recording.usual
    if choice.channels is not None:
        taken = _all_matching(recording, choice.channels, everything)
    dropped = _all_matching(recording, choice.exclude, everything)
    kept = tuple(c for c in taken if c not in dropped)
    if not kept:
        raise ChannelError(
            f"{recording.source}: no channel is left; there are: {', '.join(everything)}"
        )
    columns = [everything.index(c) for c in kept]
    units = {c: recording.units[i] for c, i in zip(kept, columns, strict=True)}
    for pattern, unit in choice.units.items():
        units |= dict.fromkeys(matching(recording, pattern, kept), unit)
    episodes = tuple(
        replace(e, values=e.values[:, columns], observed=e.observed[:, columns])
        for e in recording.episodes
    )
    return replace(
        recording,
        channels=kept,
        units=tuple(units.values()),
        ranges={c: r for c, r in recording.ranges.items() if c in kept},
        episodes=episodes,
        usual=kept,
    )


def matching(recording: Recording, pattern: str, names: Iterable[str]) -> tuple[str, ...]:
    """Return the channels of this name, or else those that fit the pattern; at least one."""
    known = tuple(names)
    # A name first: those of messages hold brackets, as in "/joints.position[0]".
    found = (pattern,) if pattern in known else tuple(n for n in known if fnmatchcase(n, pattern))
    if not found:
        raise ChannelError(f"{recording.source}: {unknown('channel', pattern, known)}")
    return found


def _all_matching(
    recording: Recording, patterns: Iterable[str], names: tuple[str, ...]
) -> tuple[str, ...]:
    found = [name for pattern in patterns for name in matching(recording, pattern, names)]
    return tuple(dict.fromkeys(found))
