"""What a worker of somebody's cluster must be to do runs, looked at in its own process.

A worker that has the same versions and sees the run folders gets a mark, of which a run takes all:
so it does one run at a time, however many threads it has, and one that joins later or is started
anew is looked at too. Nothing here imports jax: its environment is not set up yet.
"""

import hashlib
import os
import sys
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING

from distributed import WorkerPlugin

from motionese.one_core import one_core

if TYPE_CHECKING:
    from distributed import Worker

MARK = "motionese"
"""What a run takes of a worker's resources."""
UNFIT = "motionese-unfit"
"""The topic under which workers tell why they are not fit: their address and a reason."""


class OneRunAtATime(WorkerPlugin):  # type: ignore[misc]
    """Marks workers that are fit, and prepares their processes for runs on one core."""

    name = MARK

    def __init__(self, versions: Mapping[str, str], files: Sequence[Path]) -> None:
        """Take the versions that are needed of packages, and files that must be seen."""
        self._versions = dict(versions)
        self._files = {str(file.resolve()): _digest(file) for file in files}

    async def setup(self, worker: "Worker") -> None:
        """Mark the worker, or tell why not."""
        reason = self._unfit()
        if reason:
            worker.log_event(UNFIT, (worker.address, reason))
        await worker.set_resources(**{MARK: 0 if reason else 1})

    def _unfit(self) -> str:
        """Return why this process is not fit; or "", and it is prepared."""
        for package, wanted in self._versions.items():
            found = _version(package)
            if found != wanted:
                return f"it has {package} {found}, this command {wanted}: the bits could differ"
        for file, digest in self._files.items():
            if not os.access(file, os.R_OK) or _digest(Path(file)) != digest:
                return f"it does not see {file}, which must lie where all workers see it"
        variables = one_core()
        if "jax" in sys.modules and any(os.environ.get(n) != v for n, v in variables.items()):
            return "jax has been used in its process with other settings; start it anew"
        os.environ.update(variables)
        return ""


def _version(package: str) -> str:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not at all"


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
