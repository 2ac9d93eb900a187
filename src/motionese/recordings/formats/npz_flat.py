"""Archives of arrays as learning from demonstrations keeps them: all rows in one array each.

Arrays such as `observations` [N, n] and `actions` [N, n] hold the episodes one after another, cut
where `terminals`, `timeouts` or `dones` are set, at `episode_ends` or `episode_starts`, or where
`episode_index` changes; or they are [episodes, rows, n]. Channels are called KEY_0, KEY_1, ….
Observations are usual; actions where there are none.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Int, Shaped
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding, merged
from motionese.recordings.formats.conventions import WIDEST, numbered
from motionese.recordings.formats.npy import NUMBERS, without_padding
from motionese.recordings.formats.numbered_columns import numbered_columns
from motionese.recordings.nature import runs
from motionese.recordings.recording import Episode, Recording

FLAGS = ("terminals", "timeouts", "dones", "done", "terminated", "truncated", "terminations")
"""Set in the last row of an episode."""
ENDS, STARTS = ("episode_ends",), ("episode_starts",)
LENGTHS = ("episode_lengths", "episode_lens", "traj_lengths", "lengths")
INDICES = ("episode_index", "episode_id", "episode_ids", "episode", "episodes", "traj_id")
"""The number of its episode in every row."""
CUTS = (*FLAGS, *ENDS, *STARTS, *LENGTHS, *INDICES)
TIMES, RATES = ("time", "times", "timestamp", "timestamps"), ("rate_hz", "fps", "hz")
MOST_ROWS = 2**48
"""More rows than any archive has."""
ACTED = ("action", "reward", "next_")
"""What the names of arrays begin with that hold no observation of the row."""

Array = Shaped[ndarray, "..."]
Arrays = Mapping[str, Array]
Rows = Shaped[ndarray, "N n"]


def read_flat(path: Path, file: Any, columns: Sequence[str] | None) -> Recording:
    """Return the recording of an opened archive; `columns` names its channels.

    Raises:
        RecordingError: No array in it holds rows of channels, or its cuts are not rows'.
        SettingError: Names for the channels, but not as many.
    """
    arrays, findings = _loaded(path, file)
    cuts, told, rest = _sorted(arrays)
    rows, ends = _rows(path, rest, cuts)
    if not rows:
        shapes = [f"{key} {array.shape}" for key, array in arrays.items()]
        what = ", ".join([*shapes, *(f"{f.channel} {f.what}" for f in findings)]) or "it is empty"
        raise RecordingError(f"{path}: no array in it holds rows of channels ({what})")
    for key, array in rest.items():
        if key not in rows:
            what = (
                f"{_what(array)} is no row of channels for each of {ends[-1]} rows; it is left out"
            )
            findings.append(Finding("left out", path, what, channel=key))
    owners = [key for key, array in rows.items() for _ in range(array.shape[1])]
    names = tuple(n for key, a in rows.items() for n in numbered(_label(key), a.shape[1]))
    if columns is not None or (len(rows) == 1 and owners[0] == "arr_0"):
        names, found = numbered_columns(path, len(names), columns)
        findings += found
    values = np.concatenate(list(rows.values()), axis=1, dtype=np.float64)
    times, rate = _times(told, len(values))
    lengths = next((a for key, a in cuts.items() if _last(key) in LENGTHS), None)
    episodes, found = _episodes(path, values, times, ends, lengths)
    usual = _usual(names, owners)
    units = ("",) * len(names)
    findings = [*findings, *found]
    return Recording(path, names, units, {}, rate, episodes, usual, findings=merged(findings))


def _loaded(path: Path, file: Any) -> tuple[dict[str, Array], list[Finding]]:
    """Return the arrays of numbers of an archive, and what is told of the others."""
    arrays, findings = {}, []
    for key in file.files:
        try:
            array = file[key]
        except ValueError as error:
            if "pickle" not in str(error) and "Python objects" not in str(error):
                raise
            what = "holds Python objects, which are not loaded: it is left out"
            findings.append(Finding("left out", path, what, channel=key))
            continue
        if isinstance(array, ndarray) and array.dtype.kind in NUMBERS:
            arrays[key] = array
        else:
            what = "holds no numbers: it is left out"
            findings.append(Finding("left out", path, what, channel=key))
    return arrays, findings


def _sorted(arrays: Arrays) -> tuple[Arrays, Arrays, Arrays]:
    """Return the arrays that cut, those that tell times or a rate, and the others."""
    cuts = {
        k: a for k, a in arrays.items() if _last(k) in CUTS and a.size == max(a.shape, default=0)
    }
    told = {k: a for k, a in arrays.items() if _last(k) in (*TIMES, *RATES) and k not in cuts}
    told = {k: a for k, a in told.items() if a.size == max(a.shape, default=1)}
    return cuts, told, {k: a for k, a in arrays.items() if k not in cuts and k not in told}


def _rows(path: Path, rest: Arrays, cuts: Arrays) -> tuple[dict[str, Rows], Int[ndarray, " E"]]:
    """Return the arrays that hold a row of channels each, and where episodes end."""
    stacks = [a.shape[:2] for a in rest.values() if a.ndim == 3 and a.dtype != np.uint8 and a.size]
    if stacks and all(_last(key) in LENGTHS for key in cuts):
        (count, length), _ = Counter(stacks).most_common(1)[0]
        stacked = {k: a for k, a in rest.items() if a.shape[:2] == (count, length) and a.ndim < 4}
        narrow = {k: a.reshape(count * length, -1) for k, a in stacked.items()}
        ends = np.arange(1, count + 1) * length
        return {k: a for k, a in narrow.items() if a.shape[1] <= WIDEST}, ends
    cuts = {key: _whole(path, key, array) for key, array in cuts.items()}
    per_row = [len(a) for key, a in cuts.items() if _last(key) in (*FLAGS, *INDICES)]
    per_row += [int(a[-1]) for key, a in cuts.items() if _last(key) in ENDS and len(a)]
    shapes = [len(a) for a in rest.values() if a.ndim == 2 and a.shape[1] <= WIDEST and a.size]
    if not (per_row or shapes):
        return {}, np.zeros(1, dtype=int)
    count = per_row[0] if per_row else Counter(shapes).most_common(1)[0][0]
    rows = {
        k: a.reshape(count, -1)
        for k, a in rest.items()
        if a.ndim in {1, 2}
        and len(a) == count
        and a.size
        and a.reshape(count, -1).shape[1] <= WIDEST
    }
    return rows, _ends(path, cuts, count)


def _whole(path: Path, key: str, array: Array) -> Int[ndarray, " _"]:
    """Return an array that cuts as whole numbers; `RecordingError` where it holds others."""
    flat = array.ravel().astype(np.float64)
    if not (np.abs(flat) < MOST_ROWS).all() or (flat != np.round(flat)).any():
        raise RecordingError(f"{path}: '{key}' tells episodes apart, but not in whole numbers")
    return flat.astype(np.int64)


def _ends(path: Path, cuts: Mapping[str, Int[ndarray, " _"]], count: int) -> Int[ndarray, " E"]:
    """Return the rows after which episodes end."""
    ends: set[int] = set()
    for key, cut in cuts.items():
        kind = _last(key)
        if kind in FLAGS:
            here = np.flatnonzero(cut) + 1
        elif kind in STARTS:
            here = np.flatnonzero(cut) if len(cut) == count and set(cut.tolist()) <= {0, 1} else cut
        elif kind in INDICES:
            here = runs(cut)
        else:
            here = np.cumsum(cut) if kind in LENGTHS else cut
        if len(here) and (here.min() < 0 or here.max() > count):
            raise RecordingError(
                f"{path}: '{key}' cuts at rows that are not there, of {count} rows"
            )
        ends |= set(here.tolist())
    return np.array(sorted((ends | {count}) - {0}), dtype=np.int64)


def _episodes(
    path: Path,
    values: Float[ndarray, "N D"],
    times: Float[ndarray, " N"] | None,
    ends: Int[ndarray, " E"],
    lengths: Array | None,
) -> tuple[tuple[Episode, ...], list[Finding]]:
    episodes, findings = [], []
    starts = [0, *ends[:-1].tolist()]
    stops = ends
    if lengths is not None and len(lengths) == len(ends):
        stops = np.clip(starts + lengths.astype(int).ravel(), starts, ends)
    for i, (start, end) in enumerate(zip(starts, stops.tolist(), strict=True)):
        name = f"{i}" if len(ends) > 1 else path.stem
        kept, cut = without_padding(path, name, values[start:end])
        here = None if times is None else times[start : start + len(kept)]
        if here is not None and not (np.diff(here) > 0).all():
            what, here = "its times do not rise and are left out", None
            findings.append(Finding("time", path, what, "--rate HZ tells the rate", name))
        episodes.append(Episode.whole(name, kept, here))
        findings += cut
    return tuple(episodes), findings


def _times(told: Arrays, count: int) -> tuple[Float[ndarray, " N"] | None, float | None]:
    """Return the times [s] of all rows, or else the rate [Hz], where the archive tells them."""
    for key, array in told.items():
        if _last(key) in TIMES and array.size == count and np.isfinite(array).all():
            return array.ravel().astype(np.float64), None
    rates = [float(a.ravel()[0]) for k, a in told.items() if _last(k) in RATES and a.size == 1]
    return None, next((rate for rate in rates if 0 < rate < np.inf), None)


def _usual(names: tuple[str, ...], owners: Sequence[str]) -> tuple[str, ...]:
    """Return the names of observations; those of actions where there are none."""
    kinds = list(map(_last, owners))
    seen = [not kind.startswith(ACTED) for kind in kinds]
    if not any(seen):
        seen = [kind.startswith("action") for kind in kinds]
    return tuple(n for n, s in zip(names, seen, strict=True) if s) or names


def _what(array: Array) -> str:
    return f"an array of {array.dtype} of shape {array.shape}"


def _last(key: str) -> str:
    return key.rpartition("/")[2].casefold()


def _label(key: str) -> str:
    return key.removeprefix("data/")
