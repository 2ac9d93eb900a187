"""HDF5 as imitation learning writes it: a file, or a folder of them, of any layout in `LAYOUTS`."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats import aloha, d4rl, maniskill, robomimic
from motionese.recordings.formats.conventions import imported, natural, why
from motionese.recordings.formats.hdf5_walk import check_walkable
from motionese.recordings.formats.robomimic import write
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredRecording

__all__ = ["read", "write"]

SUFFIXES, INSIDE = (".hdf5", ".h5"), ("*.[hH][dD][fF]5", "*.[hH]5")
LAYOUTS: dict[str, ModuleType] = {
    "robomimic": robomimic,
    "ManiSkill": maniskill,
    "ALOHA": aloha,
    "D4RL": d4rl,
}
"""Each with `WHAT` it is known by, `holds(file)`, and `recording(path, file)`."""


class _Part(NamedTuple):
    """One file of a folder."""

    layout: str
    recording: Recording


def read(path: Path) -> Recording:
    """Read the episodes of a file, or of a folder of files in natural order, whatever its layout.

    Where several files hold several episodes each, these are called FILE/EPISODE. Observations
    are usual; actions where there are none.
    """
    h5py = imported("h5py", "hdf5", "reading HDF5")
    if path.is_file():
        check_walkable([path])
        return _part(h5py, path).recording
    # Some systems leave hidden files beside those of the user.
    files = [file for file in path.glob("[!.]*") if file.suffix.lower() in SUFFIXES]
    if not files:
        raise RecordingError(f"{path}: holds no {' or '.join(SUFFIXES)} file")
    files.sort(key=lambda f: natural(f.name))
    check_walkable(files)
    return _joined(path, [_part(h5py, file) for file in files])


def stored(path: Path) -> StoredRecording:
    """Open a file of robomimic's layout, whose demonstrations are read one at a time."""
    h5py = imported("h5py", "hdf5", "reading HDF5")
    if path.is_file():
        check_walkable([path])
        with _readable(path):
            file = h5py.File(path, "r")
            if robomimic.holds(file):
                found = robomimic.stored(path, file)
                return replace(found, read=_readable(path)(found.read))
    raise RecordingError(
        f"{path}: of HDF5 one file of robomimic's layout ({robomimic.WHAT}) can be left where it "
        "is (--stored); this is another"
    )


def _part(h5py: Any, path: Path) -> _Part:
    with _readable(path), h5py.File(path, "r") as file:
        for name, layout in LAYOUTS.items():
            if layout.holds(file):
                return _Part(name, layout.recording(path, file))
        known = "; ".join(f"{name}: {layout.WHAT}" for name, layout in LAYOUTS.items())
        raise RecordingError(
            f"{path}: HDF5 of a layout that is not read here ({known}); "
            f"here are: {', '.join(file) or 'none'}"
        )


@contextmanager
def _readable(path: Path) -> Iterator[None]:
    """Refuse, in a sentence, a file that h5py cannot read."""
    try:
        yield
    except (OSError, RuntimeError, LookupError, TypeError, ValueError, MemoryError) as error:
        # What h5py raises depends on which byte is damaged.
        raise RecordingError(
            f"{path}: not an HDF5 file, cut short, or damaged ({why(error)})"
        ) from error


def _joined(path: Path, parts: Sequence[_Part]) -> Recording:
    """Return the recordings of a folder's files as one."""
    usual = _check_alike(parts)
    recordings = [part.recording for part in parts]
    rates = {r.rate_hz for r in recordings}
    rate = rates.pop() if len(rates) == 1 else None
    return replace(
        usual,
        source=path,
        rate_hz=rate,
        episodes=tuple(e for r in recordings for e in _episodes(r, usual.channels, rate)),
        held_out=tuple(_called(r, name) for r in recordings for name in r.held_out),
        findings=_merged([*(f for r in recordings for f in r.findings), *_untold(recordings)]),
    )


def _check_alike(parts: Sequence[_Part]) -> Recording:
    """Return the first recording that is like most others; refuse and name a file that is not."""
    kinds = [_kind(part) for part in parts]
    (most, _), *_ = Counter(kinds).most_common(1)
    usual = parts[kinds.index(most)].recording
    others = f"others, such as {usual.source.name},"
    for part, (layout, channels) in zip(parts, kinds, strict=True):
        here = part.recording.source
        if layout != most[0]:
            raise RecordingError(
                f"{here}: in the layout of {layout}; {others} in that of {most[0]}"
            )
        for told, extra, there in (
            ("no", most[1] - channels, "have"),
            ("a", channels - most[1], "do not have"),
        ):
            for name, unit in sorted(extra)[:1]:
                named = f"'{name}' [{unit}]" if unit else f"'{name}'"
                raise RecordingError(f"{here}: has {told} channel {named}, which {others} {there}")
    return usual


def _kind(part: _Part) -> tuple[str, frozenset[tuple[str, str]]]:
    """Return what the files of a folder have in common: the layout, and channels with units."""
    channels = zip(part.recording.channels, part.recording.units, strict=True)
    return part.layout, frozenset(channels)


def _episodes(
    recording: Recording, channels: tuple[str, ...], rate_hz: float | None
) -> Iterable[Episode]:
    """Yield the episodes with their columns in this order, and times where rates differ."""
    order = [recording.channels.index(c) for c in channels]
    for episode in recording.episodes:
        times = None if rate_hz is not None else episode.times_at(recording.rate_hz)
        name = _called(recording, episode.name)
        yield replace(episode.part(columns=order), name=name, times=times)


def _untold(recordings: Sequence[Recording]) -> Iterable[Finding]:
    """Yield every file that does not tell its rate, where others do."""
    if any(recording.rate_hz for recording in recordings):
        what = "tells no rate: taken to be at that of the other files"
        yield from (Finding("time", r.source, what) for r in recordings if not r.rate_hz)


def _called(recording: Recording, name: str) -> str:
    stem = recording.source.stem
    return name if name == stem else f"{stem}/{name}"


def _merged(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return what is the same in several files as one finding, of the first."""
    first: dict[tuple[str, ...], Finding] = {}
    for found in findings:
        key = (found.kind, found.channel, found.what)
        was = first.get(key)
        first[key] = replace(was, count=was.count + found.count) if was else found
    return tuple(first.values())
