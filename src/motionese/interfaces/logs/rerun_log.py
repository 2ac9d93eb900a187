"""Training's numbers in a Rerun recording, a file that Rerun's viewer shows."""

import warnings
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path

from motionese.errors import StorageError


class Rerun:
    """Scalars by name on the timeline `epoch` of a Rerun recording; no viewer is started."""

    def __init__(self, out: Path, after: int) -> None:
        path = out.with_suffix(".rrd")
        # A recording cannot be appended to: what it holds is read, and written to the new one.
        before = _scalars_until(path, after) if after and path.exists() else []
        self._rerun = import_module("rerun")
        self._stream = self._rerun.RecordingStream("motionese")
        self._stream.save(path)
        self._stream.send_recording_name(out.stem)
        for epoch, name, number in before:
            self._log(epoch, name, number)
        self._stream.flush()

    def write(self, epoch: int, numbers: Mapping[str, float]) -> None:
        """Write one scalar a number at the epoch."""
        for name, number in numbers.items():
            self._log(epoch, name, number)
        self._stream.flush()

    def close(self) -> None:
        """Finish the recording."""
        self._stream.disconnect()

    def _log(self, epoch: int, name: str, number: float) -> None:
        self._stream.set_time("epoch", sequence=epoch)
        self._stream.log(name, self._rerun.Scalars(number))


def _scalars_until(path: Path, epoch: int) -> list[tuple[int, str, float]]:
    """Return epoch, name and number of all scalars in a recording up to an epoch."""
    scalars = []
    try:
        with warnings.catch_warnings():
            # A training that was killed leaves a recording without its last part, an index.
            warnings.simplefilter("ignore")
            chunks = list(import_module("rerun.chunk").RrdReader(path).stream())
    except RuntimeError as error:
        raise StorageError(
            f"{path}: this log cannot be read and gone on with ({error}); move it away"
        ) from error
    for chunk in chunks:
        if "epoch" in chunk.timeline_names:
            rows = chunk.to_record_batch()
            epochs, values = rows.column("epoch"), rows.column("Scalars:scalars")
            name = chunk.entity_path.removeprefix("/")
            for told, (number,) in zip(epochs.to_pylist(), values.to_pylist(), strict=True):
                scalars.append((told, name, number))
    return [scalar for scalar in scalars if scalar[0] <= epoch]
