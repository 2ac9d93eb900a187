"""Where runs are done, as --workers, --scheduler, --slurm and --shard say."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from dask.system import CPU_COUNT

from motionese.errors import SettingError
from motionese.experiment.many_runs import Job
from motionese.experiment.run_folder import SETTINGS
from motionese.experiment.shard import Shard, read_shard
from motionese.experiment.slurm import Slurm, read_slurm, workers_of_slurm
from motionese.experiment.workers import OpenedWorkers, client_of, local_workers, workers_of


class Workplace(NamedTuple):
    """Where runs are done.

    Attributes:
        processes: Workers on this machine.
        scheduler: Address of a Dask scheduler whose workers do them instead; empty for none.
        slurm: What Slurm is asked for instead.
        shard: Which part of the runs is done; all for None.
    """

    processes: int
    scheduler: str = ""
    slurm: Slurm | None = None
    shard: Shard | None = None

    def told(self, runs: int) -> str:
        """Say how so many runs are done."""
        if self.slurm:
            return f"in {self.slurm.jobs} jobs of {self.slurm.workers} workers"
        if self.scheduler:
            return f"by the workers of {self.scheduler}"
        return f"{min(self.processes, runs)} at a time"

    def workers(self, jobs: Sequence[Job], told: Callable[[str], None]) -> OpenedWorkers:
        """Return the workers that do runs; what has to be said of some is `told`."""
        folders = dict.fromkeys(job.run.folder.parent.parent for job in jobs)
        files = [folder / SETTINGS for folder in folders]
        if self.slurm:
            return workers_of_slurm(self.slurm, files, told)
        if self.scheduler:
            return workers_of(self.scheduler, files, told)
        return local_workers(min(self.processes, len(jobs)), told)


def read_workplace(
    workers: int | None, scheduler: str | None, slurm: Path | None, shard: str | None
) -> Workplace:
    """Return where runs are done; all options may be left out.

    Raises:
        SettingError: Options that exclude each other, one that is wrong, or a scheduler that does
            not answer.
    """
    options = {"--workers": workers, "--scheduler": scheduler, "--slurm": slurm}
    given = [name for name, value in options.items() if value is not None]
    if len(given) > 1:
        raise SettingError(f"{given[0]} and {given[1]} exclude each other; choose one")
    if scheduler is not None:
        client_of(scheduler).close()
    return Workplace(
        workers or CPU_COUNT,
        scheduler or "",
        None if slurm is None else read_slurm(slurm),
        None if shard is None else read_shard(shard),
    )
