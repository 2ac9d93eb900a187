"""The examination of a recording before it is learned: steps that no arm makes, and their mending.

What is found is told unless the user has said what is to be done with it: `unwrap` and
`quaternions` name channels whose leaps are none, `leaps` says what becomes of all others.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings import quaternions
from motionese.recordings.angles import TURNS, turn_of, unwrapped, wraps
from motionese.recordings.choice import Choice
from motionese.recordings.finding import Finding
from motionese.recordings.leaps import ENOUGH, WIDE, leaps, spikes, usual_width
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.series import largest_steps, series_of, with_columns

MANY = 0.5
"""Share of the moving channels that leap at once where motions are glued together."""
OFTEN, SEVERAL = 0.5, 3
"""Share of the episodes, of so many at least, in which a channel leaps alone by its nature, as a
force does at every contact."""


class _Place(NamedTuple):
    """A leap or spike: its episode, the rows from the first it leads to (one: no way back)."""

    episode: int
    row: int
    size: float
    rows: int = 0


def examined(recording: Recording, choice: Choice) -> Recording:
    """Return a recording with what was found in it, and mended as the choice says.

    Raises:
        ChannelError: A channel that is no angle or no quaternion though it is said to be.
        RecordingError: A leap, where they are refused.
    """
    given = quaternions.chosen_columns(recording, choice)
    recording = quaternions.turned_back(unwrapped(recording, choice), given)
    steps = largest_steps(recording)
    findings, smooth = _wrapping(recording, steps)
    signs, smooth = _changing_signs(smooth)
    if findings or signs:
        steps = largest_steps(smooth)
    places = {n: _places(smooth, c, float(steps[c])) for c, n in enumerate(recording.channels)}
    glued = _glued(recording, places)
    places = {n: _unusual(recording, each, glued) for n, each in places.items()}
    findings += signs
    if choice.leaps in {"keep", "refuse"}:
        findings += [*_told_together(recording, glued, places), *_told(recording, places, glued)]
    if choice.leaps == "refuse" and findings:
        raise RecordingError(findings[0].sentence)
    if choice.leaps in {"gap", "cut"}:
        recording = _gapped(recording, places, ends=choice.leaps == "gap")
    if choice.leaps == "cut":
        recording = _cut(recording, places)
    return recording.found(*findings)


def _wrapping(
    recording: Recording, largest: Float[ndarray, " D"]
) -> tuple[list[Finding], Recording]:
    """Return what is told of angles that wrap, and the recording as if they did not."""
    findings, changed = [], {}
    for column in np.flatnonzero(largest > min(TURNS) / 2).tolist():
        name, series = recording.channels[column], series_of(recording, column)
        if (turn := turn_of([s.values for s in series], recording.units[column])) is None:
            continue
        steps = [wraps(s.values, turn) for s in series]
        first = next(i for i, found in enumerate(steps) if len(found))
        one, step = series[first], int(steps[first][0])
        size = float(abs(one.values[step + 1] - one.values[step]))
        what = (
            f"leaps from {one.values[step]:.6g} to {one.values[step + 1]:.6g}, an angle that wraps"
        )
        findings.append(
            Finding(
                kind="leap",
                source=recording.source,
                what=what,
                remedy=f"--unwrap {name}",
                episode=recording.episodes[first].name,
                channel=name,
                row=int(one.rows[step + 1]),
                size=size,
                count=sum(map(len, steps)),
            )
        )
        whole = [e.values[:, column].copy() for e in recording.episodes]
        for values, each in zip(whole, series, strict=True):
            values[each.rows] = np.unwrap(each.values, period=turn)
        changed[column] = whole
    return findings, with_columns(recording, changed)


def _changing_signs(recording: Recording) -> tuple[list[Finding], Recording]:
    """Return what is told of quaternions that change their sign, and the recording without."""
    findings, found = [], []
    for four in quaternions.groups(recording.episodes):
        rows = [quaternions.changes(e, four) for e in recording.episodes]
        if not any(rows):
            continue
        first = next(i for i, each in enumerate(rows) if each)
        names = [recording.channels[c] for c in four]
        findings.append(
            Finding(
                kind="leap",
                source=recording.source,
                what="a quaternion that flips its sign, which is no rotation but a leap",
                remedy=f"--quaternion {' '.join(names)}",
                episode=recording.episodes[first].name,
                channel=", ".join(names),
                row=rows[first][0],
                count=sum(map(len, rows)),
            )
        )
        found.append(four)
    return findings, quaternions.turned_back(recording, found)


def _places(recording: Recording, column: int, largest: float) -> list[_Place]:
    """Return where a channel leaps; a spike's leaps there and back are one place."""
    every = sum(len(e.values) for e in recording.episodes) // ENOUGH
    # A few of very many rows show of most channels that they cannot leap.
    if every > 1 and largest < WIDE / 2 * usual_width(series_of(recording, column, every)):
        return []
    series = series_of(recording, column)
    found = leaps(series) if largest >= WIDE * usual_width(series) else []
    there_and_back = spikes(found, series)
    paired = {leap for pair in there_and_back for leap in pair}
    places = [
        _Place(one.series, int(series[one.series].rows[one.step + 1]), one.size)
        for one in found
        if one not in paired
    ]
    for out, back in there_and_back:
        rows = series[out.series].rows
        first, last = int(rows[out.step + 1]), int(rows[back.step])
        places.append(_Place(out.series, first, out.size, last - first + 1))
    return sorted(places)


def _glued(
    recording: Recording, places: Mapping[str, Sequence[_Place]]
) -> dict[tuple[int, int], int]:
    """Return the episodes and rows at which most channels that move leap at once, and how many."""
    count = Counter((p.episode, p.row) for each in places.values() for p in each if not p.rows)
    at_once = {at: n for at, n in sorted(count.items()) if n >= 2}
    if not at_once:
        return {}
    widths = (usual_width(series_of(recording, c)) for c in range(len(recording.channels)))
    moving = sum(width > 0 for width in widths)
    return {at: n for at, n in at_once.items() if n >= MANY * moving}


def _unusual(
    recording: Recording, places: Sequence[_Place], glued: Mapping[tuple[int, int], int]
) -> list[_Place]:
    """Return the places of one channel, those aside that are its nature."""
    alone = [p for p in places if (p.episode, p.row) not in glued]
    episodes = len(recording.episodes)
    if episodes >= SEVERAL and len({p.episode for p in alone}) >= OFTEN * episodes:
        return [p for p in places if p not in alone]
    return list(places)


def _told_together(
    recording: Recording,
    glued: Mapping[tuple[int, int], int],
    places: Mapping[str, Sequence[_Place]],
) -> list[Finding]:
    if not glued:
        return []
    (episode, row), count = next(iter(glued.items()))
    sizes = [
        p.size for each in places.values() for p in each if (p.episode, p.row) == (episode, row)
    ]
    return [
        Finding(
            kind="leap",
            source=recording.source,
            what=f"{count} channels leap at once: are motions glued together?",
            remedy="--leaps cut",
            episode=recording.episodes[episode].name,
            row=row,
            size=max(sizes, default=None),
            count=len(glued),
        )
    ]


def _told(
    recording: Recording,
    places: Mapping[str, Sequence[_Place]],
    glued: Mapping[tuple[int, int], int],
) -> list[Finding]:
    """Return a finding for every channel's spikes and for its other leaps."""
    findings = []
    for column, (name, each) in enumerate(places.items()):
        alone = [p for p in each if (p.episode, p.row) not in glued]
        for kind in ([p for p in alone if p.rows], [p for p in alone if not p.rows]):
            if not kind:
                continue
            first = kind[0]
            values = recording.episodes[first.episode].values[:, column]
            before, there = values[max(first.row - 1, 0)], values[first.row]
            unit = recording.units[column]
            what = (
                f"{'a spike' if first.rows else 'a leap'} from {before:.4g} to {there:.4g} {unit}"
            )
            findings.append(
                Finding(
                    kind="leap",
                    source=recording.source,
                    what=what.rstrip(),
                    remedy="--leaps gap" if first.rows else "--leaps cut, or gap",
                    episode=recording.episodes[first.episode].name,
                    channel=name,
                    row=first.row,
                    size=first.size,
                    count=len(kind),
                )
            )
    return findings


def _gapped(
    recording: Recording, places: Mapping[str, Sequence[_Place]], *, ends: bool
) -> Recording:
    """Return a recording in which spikes, and with `ends` the rows beside leaps, are gaps."""
    masks = [e.observed.copy() for e in recording.episodes]
    for column, each in enumerate(places.values()):
        for place in each:
            rows = slice(place.row, place.row + place.rows)
            if not place.rows and ends:
                rows = slice(place.row - 1, place.row + 1)
            masks[place.episode][rows, column] = False
    episodes = zip(recording.episodes, masks, strict=True)
    return replace(recording, episodes=tuple(replace(e, observed=m) for e, m in episodes))


def _cut(recording: Recording, places: Mapping[str, Sequence[_Place]]) -> Recording:
    """Return a recording whose episodes end where a channel leaps, and go on as further ones."""
    episodes: list[Episode] = []
    held_out: list[str] = []
    for i, episode in enumerate(recording.episodes):
        rows = {p.row for each in places.values() for p in each if p.episode == i and not p.rows}
        ends = [0, *sorted(rows), len(episode.values)]
        for number, (start, stop) in enumerate(pairwise(ends), 1):
            part = episode.part(slice(start, stop))
            times = None if episode.times is None else episode.times[start:stop]
            name = f"{episode.name}/{number}" if rows else episode.name
            episodes.append(replace(part, name=name, times=times))
            held_out += [name] if episode.name in recording.held_out else []
    return replace(recording, episodes=tuple(episodes), held_out=tuple(held_out))
