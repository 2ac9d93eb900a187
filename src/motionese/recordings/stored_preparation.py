"""From a recording too large for memory to what can be learned from, episode by episode.

What only all episodes together tell is found in one pass: ranges, and whether all is finite. What
is judged (which channels are clocks, which steps are leaps) is judged by some episodes.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache, partial
from hashlib import sha256

import numpy as np

from motionese.errors import MotionError, RecordingError, SettingError
from motionese.recordings.binary import held
from motionese.recordings.choice import Choice, choose, chosen
from motionese.recordings.examination import examined
from motionese.recordings.finding import Finding, refuse_any
from motionese.recordings.grid import even, resampled
from motionese.recordings.nature import judged
from motionese.recordings.preparation import all_ranges, evened, finite
from motionese.recordings.rate import OTHER_RATE, rate_of
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredEpisode, StoredRecording
from motionese.recordings.told_rate import as_timed

JUDGED = 32
"""Episodes by which a recording is judged, evenly spread over it."""
TOGETHER = {"trim": 0.0, "unwrap": (), "quaternions": (), "leaps": "keep", "binary": ()}
"""Choices that need all episodes together, and what they are where nothing is chosen."""


def prepare_stored(
    stored: StoredRecording, choice: Choice
) -> tuple[Recording, tuple[StoredEpisode, ...]]:
    """Return a recording made ready as `prepare` makes it, and its episodes, to be read again.

    Of each episode the recording holds two rows: the lowest and highest values observed.

    Raises:
        SettingError: A choice that needs all episodes together.
        MotioneseError: Whatever `prepare` refuses.
    """
    source = stored.outline.source
    for name, nothing in TOGETHER.items():
        if getattr(choice, name) != nothing:
            raise SettingError(
                f"{source}: {name} looks at all episodes together, which cannot be done to a "
                "recording that is left where it is (--stored)"
            )
    which = choose(episodes=choice.episodes, skip=choice.skip)
    names = {e.name for e in chosen(stored.outline, which).episodes}
    numbers = [i for i, e in enumerate(stored.outline.episodes) if e.name in names]
    few = np.linspace(0, len(numbers) - 1, min(JUDGED, len(numbers))).astype(int)
    some = judged(as_timed(stored.whole(numbers[i] for i in few)))
    picked = chosen(some, choice.model_copy(update={"episodes": None, "skip": ()}))
    shown = evened(examined(picked, choice), choice)
    columns = [some.channels.index(c) for c in picked.channels]
    rate = rate_of(picked, choice.rate_hz)

    @lru_cache(maxsize=2)
    def ready(number: int) -> Episode:
        whole = replace(picked, episodes=(stored.read(number).part(columns=columns),))
        return _ready(whole, rate, choice)

    kept, extremes = [], []
    for number in numbers:
        episode = ready(number)
        if len(episode.values) > 1:
            kept.append(
                StoredEpisode(partial(ready, number), len(episode.values), _digest(episode))
            )
            extremes.append(_extremes(episode))
    if not kept:
        raise MotionError(f"{source}: no episode has 2 rows, which are needed at least")
    shown = replace(shown, episodes=tuple(extremes)).found(*_told(shown, numbers, kept))
    if choice.strict:
        refuse_any(shown.findings)
    held_out = tuple(e.name for e in extremes if e.name in stored.outline.held_out)
    return replace(shown, ranges=all_ranges(shown, choice), held_out=held_out), tuple(kept)


def _ready(one: Recording, rate: float, choice: Choice) -> Episode:
    """Return the only episode of a recording, finite and at the rate of all."""
    own = rate_of(one, choice.rate_hz)
    if abs(own - rate) > OTHER_RATE * rate:
        raise RecordingError(
            f"{one.source}: episode '{one.episodes[0].name}' is at {own:g} Hz, others are "
            f"at {rate:g} Hz"
        )
    one = even(finite(one, nan_is_gap=choice.nan == "gap"), rate)
    if choice.resample_hz is not None:
        one = resampled(one, choice.resample_hz)
    return held(one).episodes[0]


def _extremes(episode: Episode) -> Episode:
    """Return an episode of the lowest and the highest values observed."""
    seen = episode.observed.any(axis=0)
    low, high = (
        reduced(episode.values, axis=0, where=episode.observed, initial=initial)
        for reduced, initial in ((np.min, np.inf), (np.max, -np.inf))
    )
    values = np.where(seen, np.stack([low, high]), 0.0)
    return Episode(episode.name, None, values, np.stack([seen, seen]))


def _digest(episode: Episode) -> str:
    return sha256(episode.values.tobytes() + episode.observed.tobytes()).hexdigest()


def _told(
    recording: Recording, numbers: Sequence[int], kept: Sequence[StoredEpisode]
) -> list[Finding]:
    """Return what was not looked at, or left out."""
    told, short = [], len(numbers) - len(kept)
    if len(numbers) > JUDGED:
        what = f"looked for leaps and clocks in {JUDGED} of {len(numbers)} episodes"
        told.append(Finding("layout", recording.source, what))
    if short:
        what = "has fewer than two rows, and is left out"
        told.append(Finding("left out", recording.source, what, count=short))
    return told
