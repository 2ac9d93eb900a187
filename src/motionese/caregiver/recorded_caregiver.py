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
from motionese.caregiver.scripted_caregiver import Manner
from motionese.caregiver.segmentation import segmented, sequence_in
from motionese.caregiver.tempo import lasting, moving
from motionese.errors import RecordingError, TaskError, unknown
from motionese.recordings import Episode, Recording, choose, prepare, read
from motionese.task import PrimitiveSequence, Task

DEMONSTRATIONS = "demonstrations.npz"
"""The file of demonstrations in a session's folder."""
CHANNELS = ("hand_x", "hand_y", "hand_z")
UNREAD = "?"
"""The name of an episode that shows no sequence of the task ends like this; it is left out."""
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
    """Demonstrations by the sequence's name, and a digest that tells them from others."""

    recordings: dict[str, list[Demonstration]]
    digest: str


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
    position.

    Raises:
        MotioneseError: No such recordings, an episode that is named by no sequence of the task or
            shows another one than its name says, or a hand out of reach.
    """
    file = path / DEMONSTRATIONS if (path / DEMONSTRATIONS).is_file() else path
    recording = prepare(read(file), choose(channels=CHANNELS, resample_hz=body.rate_hz))
    recordings: dict[str, list[Demonstration]] = {}
    digest = hashlib.sha256()
    for episode in recording.episodes:
        name = _SEVERAL.sub("", episode.name)
        if name.endswith(UNREAD):
            continue
        try:
            sequence = task.sequence(name)
        except TaskError as error:
            raise RecordingError(
                f"{file}: episode '{episode.name}' is named by no sequence of {task.name}: {error} "
                f"(a name that ends with '{UNREAD}' is left out)"
            ) from error
        hand = moving(_within_reach(file, episode, body), manner.rest_steps)
        shows = sequence_in(hand, task)
        if shows != sequence:
            what = shows.name if shows else f"no sequence of {task.name}"
            raise RecordingError(f"{file}: episode '{episode.name}' shows {what}")
        shown = lasting(hand, manner.rows(sequence))
        recordings.setdefault(sequence.name, []).append(segmented(shown, sequence, task))
        digest.update(sequence.name.encode() + shown.tobytes())
    if not recordings:
        raise RecordingError(
            f"{file}: no episode is named by a sequence of {task.name}, such as "
            f"'{task.sequences(1)[0].name}'"
        )
    return Recorded(recordings, digest.hexdigest()[:12])


def _within_reach(file: Path, episode: Episode, body: SimulatedRobot) -> Float[ndarray, "R 3"]:
    near = body.reachable(episode.values)
    miss = 100 * float(np.linalg.norm(near - episode.values, axis=1).max())
    if not miss <= REACHABLE_CM:
        raise RecordingError(
            f"{file}: episode '{episode.name}': the hand is {miss:.1f} cm from what the robot's "
            f"hand reaches, {REACHABLE_CM:g} cm are allowed"
        )
    return near
