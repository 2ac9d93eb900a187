"""From what a file holds to what can be learned from: chosen, finite, even, with ranges."""

from collections.abc import Mapping
from dataclasses import replace
from shlex import quote

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError, MotionError, MotioneseError, RecordingError
from motionese.recordings.binary import held, with_binary
from motionese.recordings.choice import Choice, chosen, given_ranges
from motionese.recordings.examination import examined
from motionese.recordings.finding import Finding, refuse_any
from motionese.recordings.grid import even, resampled
from motionese.recordings.rate import of_one_rate, rate_of
from motionese.recordings.recording import LARGEST, Episode, Recording


def prepare(recording: Recording, choice: Choice) -> Recording:
    """Return a recording of the chosen channels at one rate, every channel with a range.

    Raises:
        ChannelError: A channel that does not exist, or whose range cannot be told, or none left.
        MotionError: A value that is not finite, or no episode of two rows or more.
        RecordingError: A rate that nobody tells or that differs, or times that do not rise, are in
            another unit, or span far more rows than there are; or, if strict, any finding.
        SettingError: A rate to resample to that is out of reach.
    """
    for step in (chosen, examined, with_binary, finished):
        try:
            recording = step(recording, choice)
        except MotioneseError as error:
            # What was found so far may tell why.
            for finding in recording.findings:
                error.add_note(finding.sentence)
            raise
    return recording


def finished(recording: Recording, choice: Choice) -> Recording:
    """Do what `prepare` does with a recording that was chosen from and examined already."""
    recording = evened(recording, choice)
    if choice.trim > 0:
        recording = trimmed(recording, choice.trim, all_ranges(recording, choice))
    recording = held(long_enough(recording))
    if choice.strict:
        refuse_any(recording.findings)
    return replace(recording, ranges=all_ranges(recording, choice))


def evened(recording: Recording, choice: Choice) -> Recording:
    """Do what `prepare` does but for ranges, which whoever does not learn has no need of."""
    recording = finite(long_enough(recording), nan_is_gap=choice.nan == "gap")
    return at_one_rate(recording, choice)


def long_enough(recording: Recording) -> Recording:
    """Return the recording without episodes of fewer than two rows, which is told.

    `MotionError` where no other is there.
    """
    short = [e for e in recording.episodes if len(e.values) < 2]
    if not short:
        return recording
    rows = len(short[0].values)
    told = "1 row" if rows == 1 else "no rows"
    if len(short) == len(recording.episodes):
        raise MotionError(
            f"{recording.source}: episode '{short[0].name}' has {told}; at least 2 are needed"
        )
    finding = Finding(
        kind="left out",
        source=recording.source,
        what=f"has {told}, and is left out",
        remedy=f"--skip {quote(short[0].name)} leaves it out without a word",
        episode=short[0].name,
        size=float(rows),
        count=len(short),
    )
    kept = tuple(e for e in recording.episodes if len(e.values) >= 2)
    return replace(recording, episodes=kept).found(finding)


def at_one_rate(recording: Recording, choice: Choice) -> Recording:
    """Return the recording on an even grid; episodes of different rates must be resampled.

    `RecordingError` where they differ and no rate to resample to is chosen.
    """
    parts = [replace(recording, episodes=same) for same in of_one_rate(recording)]
    if len(parts) > 1 and choice.resample_hz is None:
        told = [f"'{p.episodes[0].name}' at {rate_of(p, choice.rate_hz):g} Hz" for p in parts]
        raise RecordingError(
            f"{recording.source}: episodes differ in their rates: {', '.join(told)}; "
            f"--resample HZ brings them to one, --skip leaves some out"
        )
    ready = [even(part, rate_of(part, choice.rate_hz)) for part in parts]
    if choice.resample_hz is not None:
        ready = [resampled(part, choice.resample_hz) for part in ready]
    pairs = zip(parts, ready, strict=True)
    made = {id(was): now for p, r in pairs for was, now in zip(p.episodes, r.episodes, strict=True)}
    episodes = tuple(made[id(e)] for e in recording.episodes)
    return replace(recording, episodes=episodes, rate_hz=ready[0].rate_hz)


def finite(recording: Recording, *, nan_is_gap: bool) -> Recording:
    """Return the recording with finite values wherever something was observed."""
    if nan_is_gap:
        recording = recording.map(lambda e: replace(e, observed=e.observed & ~np.isnan(e.values)))
    # The extremes tell of nearly all recordings that nothing is to be looked for, without a copy.
    if all(
        e.values.min(initial=0.0) >= -LARGEST and e.values.max(initial=0.0) <= LARGEST
        for e in recording.episodes
    ):
        return recording
    if wrong := recording.first(lambda e: e.observed & ~(np.abs(e.values) <= LARGEST)):
        where, value = wrong
        hint = "; --nan gap takes NaN as not observed" if np.isnan(value) else ""
        raise MotionError(
            f"{recording.source}: {where}: values must be finite, got {value:g}{hint}"
        )
    return recording


def trimmed(
    recording: Recording, share: float, ranges: Mapping[str, tuple[float, float]]
) -> Recording:
    """Return the recording without the still ends of its episodes.

    A row is still while no channel has moved by more than `share` of its range from the first
    row (from the last, at the end). Of either end the last still row is kept. An episode that
    is still throughout has no ends, and is kept whole.
    """
    widths = np.array([ranges[c][1] - ranges[c][0] for c in recording.channels])

    def without_ends(episode: Episode) -> Episode:
        start, end = still_ends(episode, share * widths)
        stop = len(episode.values) - end
        return episode.part(slice(start, stop)) if stop - start >= 2 else episode

    return recording.map(without_ends)


def still_ends(episode: Episode, limits: Float[ndarray, " D"]) -> tuple[int, int]:
    """Return how many rows at the start and at the end can be cut, one still row being kept."""
    backwards = episode.part(slice(None, None, -1))
    return _still_rows(episode, limits), _still_rows(backwards, limits)


def range_of(name: str, seen: Float[ndarray, " K"], margin: float) -> tuple[float, float]:
    """Return the lowest and highest value, widened on both sides by a share of their distance.

    `ChannelError` if nothing was observed, or always the same.
    """
    if not len(seen) or seen.min() == seen.max():
        what = f"is always {seen[0]:g}" if len(seen) else "is never observed"
        raise ChannelError(f"channel '{name}' {what}: give its range or leave it out")
    low, high = float(seen.min()), float(seen.max())
    return low - margin * (high - low), high + margin * (high - low)


def all_ranges(recording: Recording, choice: Choice) -> Mapping[str, tuple[float, float]]:
    """Return the range of every channel: given by the user, told by the file, or of the data."""
    ranges, still, told = given_ranges(recording, choice), [], ""
    seen = list(map(_extremes, recording.episodes))
    for column, name in enumerate(recording.channels):
        if name not in ranges:
            here = np.concatenate([each[column] for each in seen])
            try:
                ranges[name] = range_of(name, here, choice.margin)
            except ChannelError as error:
                still.append(name)
                told = told or str(error)
    if still:
        more = f"; the same of {', '.join(still[1:])}" if still[1:] else ""
        names = " ".join(map(quote, still))
        raise ChannelError(
            f"{recording.source}: {told} (--range {still[0]}=LOW:HIGH, --exclude {names}){more}"
        )
    return {name: ranges[name] for name in recording.channels}


def _extremes(episode: Episode) -> list[Float[ndarray, " K"]]:
    """Return what was observed of every channel, or its lowest and highest alone."""
    values, observed = episode.values, episode.observed
    if len(values) and observed.all():
        return list(np.stack([values.min(axis=0), values.max(axis=0)], axis=1))
    return [column[seen] for column, seen in zip(values.T, observed.T, strict=True)]


def _still_rows(episode: Episode, limits: Float[ndarray, " D"]) -> int:
    """Return the rows before the last one that is still at its channels' first values."""
    values, observed = episode.values, episode.observed
    if not len(values):
        return 0
    began = 0 if observed[0].all() else np.argmax(observed, axis=0)
    first, start = values[began, np.arange(len(limits))], 0
    # Most begin to move early.
    for here, seen in episode.blocks():
        # What was not observed may be NaN or infinite.
        with np.errstate(invalid="ignore"):
            moved = ((np.abs(here - first) > limits) & seen).any(axis=1)
        if moved.any():
            return max(start + int(np.argmax(moved)) - 1, 0)
        start += len(here)
    return len(values) - 1
