"""How logs that were read become a recording: one row for every time at which any topic spoke."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import times_unless_even
from motionese.recordings.formats.message_log import Log, whole
from motionese.recordings.formats.takes import Cuts
from motionese.recordings.rate import rate_of_times
from motionese.recordings.recording import Episode, Recording


def recording_of(path: Path, logs: list[Log], cuts: Cuts) -> Recording:
    """Return what logs told as a recording, cut into takes. The logs are used up.

    Rows are the times at which any of the topics spoke, counted from the episode's first; a
    channel is observed where its own topic did. The rate is that of the usual channel that was
    said most often.
    """
    names = ((*log.told.channels, *(n for r in log.rows for n in r.channels)) for log in logs)
    channels = tuple(dict.fromkeys(name for each in names for name in each))
    columns = {name: told for log in logs for name, told in log.columns.items()}
    units = {name: unit for name, (unit, _) in columns.items()}
    for log in logs:
        units |= dict(zip(log.told.channels, log.told.units, strict=False))
    usual = tuple(n for n in channels if n not in columns or columns[n][1]) or channels
    rate = _rate(logs, usual)
    episodes = [episode for log in logs for episode in _episodes(log, channels, cuts)]
    return Recording(
        source=path,
        channels=channels,
        units=tuple(units.get(name, "") for name in channels),
        ranges={},
        rate_hz=rate,
        episodes=cuts.named(episodes),
        usual=usual,
        findings=(*_left_out(path, logs), *(found for log in logs for found in log.findings)),
    )


def _left_out(path: Path, logs: list[Log]) -> list[Finding]:
    """Return what was left out, all in one."""
    topics: dict[str, dict[str, None]] = {}
    for log in logs:
        undefined = {n: f"{kind}, defined nowhere" for n, kind in log.undefined.items()}
        for name, kind in (log.left_out | undefined).items():
            topics.setdefault(kind, {})[name] = None
    if not topics:
        return []
    listed = "; ".join(f"{', '.join(names)} ({kind})" for kind, names in topics.items())
    what = f"topics that tell no motion are left out: {listed}"
    return [Finding("left out", path, what, "--topic names those that are to be read")]


def _rate(logs: list[Log], usual: Sequence[str]) -> float | None:
    """Return the rate [Hz] that all logs tell, or that of the channel said most often."""
    told = {log.told.rate_hz for log in logs}
    if len(told) == 1 and None not in told:
        return told.pop()
    count = Counter[str]()
    for rows in (rows for log in logs for rows in log.rows):
        count.update(dict.fromkeys(rows.channels, len(rows.logged)))
    densest = max(usual, key=lambda name: count[name])
    each = [log.times(lambda rows: densest in rows.channels) for log in logs]
    return rate_of_times([_since_first(times) for times in each])


def _since_first(times: Int[ndarray, " T"]) -> Float[ndarray, " T"]:
    """Return times [ns] as times [s] from the first; exact before they become floats."""
    return np.asarray((times - times[:1]) / 1e9)


def _episodes(log: Log, channels: tuple[str, ...], cuts: Cuts) -> list[Episode]:
    times, column = log.times(), {name: i for i, name in enumerate(channels)}
    values = np.zeros((len(times), len(channels)))
    observed = np.zeros(values.shape, dtype=bool)
    twice = 0
    for rows in log.rows:
        at = np.searchsorted(times, whole(rows.logged))
        for i, name in enumerate(rows.channels):
            values[at, column[name]] = rows.column(i)
        if rows.channels:
            seen = observed[:, column[rows.channels[0]]]
            twice += len(at) - int((~seen[np.unique(at)]).sum())
        for name in rows.channels:
            observed[at, column[name]] = True
    log.rows.clear()
    log.tracks.clear()
    if twice:
        what = f"{twice} messages are at the time of another of their topic; the last one counts"
        log.found("left out", what)
    takes, found = cuts.takes(log.source, log.told.episode, times, log.marks)
    log.findings += found
    rate = log.told.rate_hz
    return [
        Episode(n, times_unless_even(_since_first(times[p]), rate), values[p], observed[p])
        for n, p in takes
    ]
