"""A person's demonstrations as data: written for others, and read for the experiment.

A recording's episodes are named by what they show, "UR ↓←" or "UR ↓← (2)"; its channels are the
hand's position in the robot's world [m]. Where a motion was not recorded the scripted caregiver
shows it, so that an experiment needs no whole set.
"""

import hashlib
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import projected
from motionese.caregiver import (
    PUSHING_BUTTONS,
    Demonstrating,
    RecordedCaregiver,
    ScriptedCaregiver,
)
from motionese.errors import RecordingError, TaskError
from motionese.recordings import Episode, Recording, choose, prepare, read
from motionese.teaching.drawing import lasting, moving
from motionese.teaching.files_kept import DEMONSTRATIONS
from motionese.teaching.notebook import Entry
from motionese.teaching.reading import corners_of, motion_read

CHANNELS = ("hand_x", "hand_y", "hand_z")
REACHABLE_CM = 5.0
"""A recorded hand may be so far from what the arm reaches; the nearest way is shown."""
SEVERAL = re.compile(r" \(\d+\)$")


@dataclass(frozen=True)
class Recorded:
    """Recorded demonstrations, ready for the experiment.

    Attributes:
        caregiver: Shows them, and in the scripted way what was not recorded.
        motions: Names of the recorded motions.
        digest: Tells these demonstrations from others.
    """

    caregiver: RecordedCaregiver
    motions: tuple[str, ...]
    digest: str


def recording_of(entries: Iterable[Entry], rate_hz: float) -> Recording | None:
    """Return what a notebook's entries show, in their own time; None if there are none."""
    episodes: list[Episode] = []
    counts: dict[str, int] = {}
    for entry in entries:
        number = counts[entry.motion] = counts.get(entry.motion, 0) + 1
        name = entry.motion if number == 1 else f"{entry.motion} ({number})"
        mask = np.ones(entry.drawn.shape, dtype=bool)
        episodes.append(Episode(name, None, entry.drawn, mask))
    if not episodes:
        return None
    return Recording(
        Path(DEMONSTRATIONS), CHANNELS, ("m",) * 3, {}, rate_hz, tuple(episodes), CHANNELS
    )


def recorded(path: Path, manner: Demonstrating, rate_hz: float) -> Recorded:
    """Read recorded demonstrations; each is played at the tempo of the scripted caregiver.

    Args:
        path: A session's folder, or recordings in any format whose channels are the hand's
            position.
        manner: The scripted caregiver's way of moving: corners and tempo.
        rate_hz: The body's rate.

    Raises:
        MotioneseError: No such recordings, none of a motion of the task, one that shows another
            motion than its name says, or a hand out of reach.
    """
    file = path / DEMONSTRATIONS if (path / DEMONSTRATIONS).is_file() else path
    recording = prepare(read(file), choose(channels=CHANNELS, resample_hz=rate_hz))
    paths: dict[str, list[Float[ndarray, "_ 3"]]] = {}
    digest = hashlib.sha256()
    for episode in recording.episodes:
        try:
            motion = PUSHING_BUTTONS.motion(SEVERAL.sub("", episode.name))
        except TaskError:
            continue
        hand = moving(_within_reach(file, episode), manner.rest_steps)
        shows = motion_read(hand, corners_of(manner))
        if shows != motion:
            what = shows.name if shows else "no motion of the task"
            raise RecordingError(f"{file}: episode '{episode.name}' shows {what}")
        paths.setdefault(motion.name, []).append(lasting(hand, manner.rows(motion)))
        digest.update(motion.name.encode() + paths[motion.name][-1].tobytes())
    if not paths:
        raise RecordingError(
            f"{file}: no episode is named by a motion of the task, such as 'UR ↓←'"
        )
    caregiver = RecordedCaregiver(paths, ScriptedCaregiver(manner))
    return Recorded(caregiver, tuple(paths), digest.hexdigest()[:12])


def _within_reach(file: Path, episode: Episode) -> Float[ndarray, "R 3"]:
    near = projected(episode.values)
    miss = 100 * float(np.linalg.norm(near - episode.values, axis=1).max())
    if not miss <= REACHABLE_CM:
        raise RecordingError(
            f"{file}: episode '{episode.name}': the hand is {miss:.1f} cm from what the robot's "
            f"hand reaches, {REACHABLE_CM:g} cm are allowed"
        )
    return near
