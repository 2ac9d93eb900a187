"""Where training is logged: lines of JSON, TensorBoard, Rerun; several at once if asked for.

Recognition while it happens is logged so too, by rows where training counts epochs.

A log lies beside the model that is trained, OUT: `robot.safetensors` is logged to
`robot.log.jsonl`, `robot.tensorboard/` and `robot.rrd`. Every number is on disk when `write`
returns (TensorBoard's and Rerun's within a second), so that a training that is killed leaves what
it told.
"""

import json
import math
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Protocol, runtime_checkable

from motionese.errors import SettingError, StorageError, needs, unknown
from motionese.files import write_whole

FLUSH_EVERY_S = 0.5
"""How often a Rerun recording is flushed at most."""


@runtime_checkable
class Log(Protocol):
    """What takes numbers while a network is trained."""

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write numbers by name, as they are after `epoch` epochs."""

    def close(self) -> None:
        """Finish the log; nothing is written to it afterwards."""


class Logs(ExitStack):
    """Several logs written side by side; a context manager that closes them all.

    They are opened with the first numbers: a training that is refused leaves none, and none of a
    training before it is lost.
    """

    def __init__(self, openers: Sequence[Callable[[], Log]]) -> None:
        super().__init__()
        self._openers = list(openers)
        self._logs: list[Log] = []

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write numbers by name to every log, as they are after `epoch` epochs.

        Raises:
            StorageError: A log that cannot be gone on with.
        """
        while self._openers:
            log = self._openers.pop(0)()
            self.callback(log.close)
            self._logs.append(log)
        for log in self._logs:
            log.write(epoch, numbers)


def open_logs(kinds: Sequence[str], out: Path, after: int = 0, timeline: str = "epoch") -> Logs:
    """Return the logs of a training, whose files are opened with the first numbers.

    Args:
        kinds: Of `jsonl`, `tensorboard` (extra `[tensorboard]`) and `rerun` (extra `[rerun]`).
        out: The model's file; logs are called after it and lie beside it.
        after: Epochs that were trained before a training that is resumed: its logs go on, and
            forget what they hold of later epochs. 0 begins them anew.
        timeline: What is counted, if not epochs.

    Raises:
        SettingError: An unknown kind.
        MissingPackageError: A kind's package is not installed.
    """
    for kind in kinds:
        if kind not in _OPENERS:
            raise SettingError(unknown("log", kind, _OPENERS))
    for kind in [each for each in kinds if each in _PACKAGES]:
        module, package = _PACKAGES[kind]
        try:
            import_module(module)
        except ImportError as error:
            raise needs(package, kind, f"the log '{kind}'") from error
    return Logs([partial(_OPENERS[kind], out, after, timeline) for kind in dict.fromkeys(kinds)])


class JsonLines:
    """One JSON object a line: the epoch and the numbers; null where a number is not finite."""

    def __init__(self, out: Path, after: int, timeline: str) -> None:
        path, self._timeline = out.with_name(f"{out.stem}.log.jsonl"), timeline
        kept = _lines_until(path, after) if after and path.exists() else []
        write_whole(path, "".join(kept))
        self._file = path.open("a", encoding="utf-8")

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write one line."""
        finite = {k: float(v) if math.isfinite(v) else None for k, v in numbers.items()}
        self._file.write(json.dumps({self._timeline: epoch} | finite) + "\n")
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()


def _lines_until(path: Path, epoch: int) -> list[str]:
    """Return a log's lines up to an epoch, without one that a kill has cut short."""
    kept = []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines(keepends=True):
        try:
            told = json.loads(line)["epoch"]
        except (ValueError, TypeError, KeyError, RecursionError):
            continue
        if line.endswith("\n") and told <= epoch:
            kept.append(line)
    return kept


class TensorBoard:
    """Scalars by name in TensorBoard's event files."""

    def __init__(self, out: Path, after: int, timeline: str) -> None:
        # Event files are called after the second they are opened in; the suffix keeps a training
        # resumed within that second from overwriting what it goes on with.
        self._writer = import_module("tensorboardX").SummaryWriter(
            str(out.with_name(f"{out.stem}.tensorboard")),
            purge_step=after + 1 if after else 0,
            filename_suffix=f".{after:09d}",
            flush_secs=1,
        )

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write one scalar a number, with the epoch as its step."""
        for name, number in numbers.items():
            self._writer.add_scalar(name, number, epoch)

    def close(self) -> None:
        """Close the event file."""
        self._writer.close()


class Rerun:
    """Scalars by name on a timeline of a Rerun recording; no viewer is started."""

    def __init__(self, out: Path, after: int, timeline: str) -> None:
        path, self._timeline = out.with_suffix(".rrd"), timeline
        # A recording cannot be appended to: what it holds is read, and written to the new one.
        before = _scalars_until(path, after) if after and path.exists() else []
        self._rerun = import_module("rerun")
        self._stream = self._rerun.RecordingStream("motionese")
        self._stream.save(path)
        self._stream.send_recording_name(out.stem)
        for epoch, name, number in before:
            self._log(epoch, name, number)
        self._stream.flush()
        self._flushed = -FLUSH_EVERY_S

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write one scalar a number at the epoch."""
        for name, number in numbers.items():
            self._log(epoch, name, number)
        # What is flushed by itself takes a kilobyte a number: rows come by the hundred a second.
        if time.monotonic() - self._flushed > FLUSH_EVERY_S:
            self._stream.flush()
            self._flushed = time.monotonic()

    def close(self) -> None:
        """Finish the recording."""
        self._stream.disconnect()

    def _log(self, epoch: int, name: str, number: float) -> None:
        self._stream.set_time(self._timeline, sequence=epoch)
        # Given as parts, a name may hold what a path must not: spaces, brackets.
        self._stream.log([p for p in name.split("/") if p], self._rerun.Scalars(number))


def _scalars_until(path: Path, epoch: int) -> list[tuple[int, str, float]]:
    """Return epoch, name and number of all scalars in a recording up to an epoch."""
    try:
        with warnings.catch_warnings():
            # A training that was killed leaves a recording without its last part, an index.
            warnings.simplefilter("ignore")
            chunks = list(import_module("rerun.chunk").RrdReader(path).stream())
    except RuntimeError as error:
        raise StorageError(
            f"{path}: this log cannot be read and gone on with ({error}); move it away"
        ) from error
    scalars = []
    for chunk in chunks:
        if "epoch" in chunk.timeline_names:
            rows = chunk.to_record_batch()
            columns = (rows.column(of).to_pylist() for of in ("epoch", "Scalars:scalars"))
            name = chunk.entity_path.removeprefix("/")
            scalars += [(at, name, n) for at, (n,) in zip(*columns, strict=True) if at <= epoch]
    return scalars


_OPENERS: dict[str, Callable[[Path, int, str], Log]] = {
    "jsonl": JsonLines,
    "tensorboard": TensorBoard,
    "rerun": Rerun,
}

_PACKAGES = {"tensorboard": ("tensorboardX", "tensorboardX"), "rerun": ("rerun", "rerun-sdk")}
"""The module that a kind imports and the package that brings it; its extra is called as it is."""
