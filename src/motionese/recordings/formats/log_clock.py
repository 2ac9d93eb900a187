"""By which clock the topics of a log count: their messages' stamps, or the times of recording.

A topic counts by the stamps in its messages' headers where all have one and they rise. Stamps far
from the times of recording are of another clock, such as a simulation's: they count if all topics
have them, as they are nearer to what happened; where some have none, nothing else could be set
beside these.
"""

from collections.abc import Sequence

import numpy as np

from motionese.recordings.formats.message_log import Log, Track, whole

LATE_NS = 1_000_000_000
"""By so much [ns] may a stamp be off the time of recording and still be of one clock."""


def settle_times(log: Log) -> None:
    """Leave in `Rows.logged` what counts as the time of every message, and tell what is odd.

    Marks of takes have no stamps: they are set back by as much as the stamps are behind.
    """
    stamped = [track for track in log.tracks if _has_stamps(log, track)]
    behind = [int(np.median(track.offsets())) for track in stamped]
    far = [
        (track, late)
        for track, late in zip(stamped, behind, strict=True)
        if max(abs(late), _drift(track)) > LATE_NS
    ]
    if far:
        one_clock = len(stamped) == len(log.tracks) and max(behind) - min(behind) <= LATE_NS
        _tell(log, far, one_clock)
        if one_clock:
            back = int(np.median(behind))
            log.marks = [mark._replace(time=mark.time - back) for mark in log.marks]
        else:
            stamped = [track for track in stamped if all(track is not other for other, _ in far)]
    for track in stamped:
        for rows in track.rows:
            rows.logged = rows.stamped


def _has_stamps(log: Log, track: Track) -> bool:
    """Tell whether a topic's messages are all stamped, in the order in which they were recorded."""
    stamps = [
        whole(rows.stamped)[np.argsort(whole(rows.logged), kind="stable")] for rows in track.rows
    ]
    if all((s != 0).all() and (np.diff(s) > 0).all() for s in stamps):
        return True
    if any(s.any() for s in stamps):
        log.found(
            "time",
            f"topic {track.topic.name}: the stamps in its headers are not all there, or do not "
            "rise; the times at which its messages were recorded are taken",
        )
    return False


def _drift(track: Track) -> int:
    """Return by how much more the last message was late than the first [ns]."""
    late = track.offsets()
    return abs(int(late[-1] - late[0]))


def _tell(log: Log, far: Sequence[tuple[Track, int]], one_clock: bool) -> None:
    names = ", ".join(track.topic.name for track, _ in far)
    size = max((late for _, late in far), key=abs) / 1e9
    taken = "stamps" if one_clock else "times at which they were recorded"
    log.found(
        "time",
        f"the stamps in the headers of {names} are not of the clock by which they were recorded "
        f"({size:.6g} s behind it); the {taken} are taken",
        size=size,
    )
