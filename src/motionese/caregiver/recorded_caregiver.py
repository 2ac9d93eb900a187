"""A person's demonstrations as data: written for others, and read to be shown.

A recording's episodes are named by what they show, 'UR ↓←' or 'UR ↓← (2)'; its channels are the
hand's position in the robot's world [m]. Where a sequence was not recorded the scripted caregiver
shows it, so that an experiment needs no whole set.
"""

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import SimulatedRobot
from motionese.caregiver.demonstration import Caregiver, Demonstration
from motionese.caregiver.hypotheses import sequence_in
from motionese.caregiver.scripted_caregiver import Manner
from motionese.caregiver.segmentation import segmented
from motionese.caregiver.tempo import lasting, moving
from motionese.errors import RecordingError, TaskError, unknown
from motionese.recordings import Episode, Recording, choose, prepare, read
from motionese.task import PrimitiveSequence, Task

DEMONSTRATIONS = "demonstrations.npz"
"""The file of demonstrations in a session's folder."""
CHANNELS = ("hand_x", "hand_y", "hand_z")
REACHABLE_CM = 5.0
"""A recorded hand may be so far from what the arm reaches; the nearest way is shown."""
_SEVERAL = re.compile(r" \(\d+\)$")


class RecordedCaregiver:
    """Recorded demonstrations in the place of the scripted caregiver."""

    def __init__(
        self, recordings: Mapping[str, list[Demonstration]], otherwise: Caregiver | None = None
    ) -> None:
        """Take demonstrations by the sequence's name; `otherwise` shows what was not recorded."""
        self.recordings, self.otherwise = dict(recordings), otherwise

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Return one of the sequence's recordings; `TaskError` if nobody can show it."""
        recorded = self.recordings.get(sequence.name)
        if not recorded and self.otherwise is not None:
            return self.otherwise.demonstrate(sequence, rng)
        if not recorded:
            raise TaskError(unknown("recorded sequence", sequence.name, self.recordings))
        return recorded[int(rng.integers(len(recorded)))]


class Recorded(NamedTuple):
    """Demonstrations that can be shown.

    Attributes:
        recordings: By the sequence's name.
        digest: Tells them from others.
        skipped: Which episodes were left out and why, a sentence each.
    """

    recordings: dict[str, list[Demonstration]]
    digest: str
    skipped: tuple[str, ...] = ()


def recording_of(
    paths: Iterable[tuple[str, Float[ndarray, "_ 3"]]], rate_hz: float
) -> Recording | None:
    """Return hands' paths [m, world] by what they show as a recording; None if there are none."""
    episodes: list[Episode] = []
    counts = Counter[str]()
    for shows, path in paths:
        counts[shows] += 1
        name = shows if counts[shows] == 1 else f"{shows} ({counts[shows]})"
        episodes.append(Episode.whole(name, path))
    file, units = Path(DEMONSTRATIONS), ("m",) * 3
    whole = Recording(file, CHANNELS, units, {}, rate_hz, tuple(episodes), CHANNELS)
    return whole if episodes else None


def read_recorded(path: Path, task: Task, manner: Manner, body: SimulatedRobot) -> Recorded:
    """Read recorded demonstrations; each is played at the tempo of the scripted caregiver.

    They lie in a session's folder, or are recordings in any format whose channels are the hand's
    position. An episode that is not named by a sequence of the task, does not show the one that
    its name says, or leaves the arm's reach, is skipped.

    Raises:
        MotioneseError: No such recordings, or no episode that can be shown.
    """
    file = path / DEMONSTRATIONS if (path / DEMONSTRATIONS).is_file() else path
    recording = prepare(read(file), choose(channels=CHANNELS, resample_hz=body.rate_hz))
    recordings: dict[str, list[Demonstration]] = {}
    digest, skipped = hashlib.sha256(), list[str]()
    for episode in recording.episodes:
        try:
            sequence, hand = _read(episode, task, manner, body)
        except TaskError as error:
            skipped.append(f"'{episode.name}' {error}")
            continue
        shown = lasting(hand, manner.to_adults().rows(sequence))
        recordings.setdefault(sequence.name, []).append(segmented(shown, sequence, task))
        digest.update(sequence.name.encode() + shown.tobytes())
    if not recordings:
        raise RecordingError(
            f"{file}: no episode shows a sequence of {task.name} that its name says, such as "
            f"'{task.sequences(1)[0].name}': {'; '.join(skipped)}"
        )
    return Recorded(recordings, digest.hexdigest()[:12], tuple(skipped))


def _read(
    episode: Episode, task: Task, manner: Manner, body: SimulatedRobot
) -> tuple[PrimitiveSequence, Float[ndarray, "M 3"]]:
    """Return what an episode shows, and the moving hand; `TaskError` where it cannot be shown."""
    try:
        sequence = task.sequence(_SEVERAL.sub("", episode.name))
    except TaskError as error:
        raise TaskError(f"is named by no sequence of {task.name}") from error
    near = body.reachable(episode.values)
    miss = 100 * float(np.linalg.norm(near - episode.values, axis=1).max())
    if not miss <= REACHABLE_CM:
        raise TaskError(
            f"leads {miss:.1f} cm from what the robot's hand reaches, "
            f"{REACHABLE_CM:g} cm are allowed"
        )
    hand = moving(near, manner.rest_steps)
    shows = sequence_in(hand, task)
    if shows != sequence:
        raise TaskError(f"shows {shows.name if shows else f'no sequence of {task.name}'}")
    return sequence, hand
