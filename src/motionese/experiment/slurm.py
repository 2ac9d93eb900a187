"""Workers in jobs of Slurm, as a file of settings asks for them (extra `[cluster]`)."""

import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

import dask
from distributed import Client
from pydantic import Field

from motionese.errors import SettingError, needs
from motionese.experiment.presets import read_table
from motionese.experiment.workers import Workers, prepared
from motionese.imitation import Group, checked


class Slurm(Group):
    """What is asked of Slurm.

    Attributes:
        jobs: How many jobs are kept going; one whose time is over is asked for again.
        workers: Workers of a job, each a process on a core that does a run.
        memory: Of a job, such as "8GB"; a worker needs about 1 GB.
        walltime: Time of a job, such as "04:00:00".
        queue: Partition; the cluster's default if left out.
        account: Whom it is charged to, where the cluster asks.
        interface: Network interface over which workers reach this machine, such as "ib0".
        python: Interpreter of the workers; this one if left out.
        directives: Further lines for #SBATCH, such as "--constraint=avx512".
        prologue: Commands before the worker, such as "module load gcc".
        logs: Folder of the jobs' output.
    """

    jobs: int = Field(ge=1)
    workers: int = Field(ge=1)
    memory: str = Field(pattern=r"^\d+ ?[KMGT]i?B$")
    walltime: str = Field(pattern=r"^(\d+-)?\d+(:\d\d){0,2}$")
    queue: str | None = None
    account: str | None = None
    interface: str | None = None
    python: str | None = None
    directives: tuple[str, ...] = ()
    prologue: tuple[str, ...] = ()
    logs: str | None = None


def read_slurm(file: Path) -> Slurm:
    """Return the settings of a TOML file; `SettingError` names the first that is wrong."""
    table = read_table(file)
    try:
        return checked(Slurm, table)
    except SettingError as error:
        raise SettingError(f"{file}: {error}") from error


def open_cluster(settings: Slurm) -> Any:
    """Return dask-jobqueue's cluster; its `job_script()` is what is handed to `sbatch`.

    Raises:
        MissingExtraError: dask-jobqueue is not installed.
        SettingError: The network interface does not exist.
    """
    try:
        from dask_jobqueue import SLURMCluster  # noqa: PLC0415
    except ImportError as error:
        raise needs("dask-jobqueue", "cluster", "reproduce --slurm") from error
    asked = settings.model_dump(include={"queue", "account", "interface", "python", "memory"})
    given = {name: value for name, value in asked.items() if value is not None}
    try:
        return SLURMCluster(
            cores=settings.workers,
            processes=settings.workers,
            walltime=settings.walltime,
            job_extra_directives=list(settings.directives),
            job_script_prologue=list(settings.prologue),
            log_directory=settings.logs,
            **given,
        )
    except (RuntimeError, ValueError) as error:
        raise SettingError(f"--slurm: {error}") from error


@contextmanager
def workers_of_slurm(
    settings: Slurm, files: Sequence[Path], told: Callable[[str], None]
) -> Iterator[Workers]:
    """Ask Slurm for workers, and let them go at the end; arguments as of `workers_of`.

    Raises:
        SettingError: `sbatch` does not take the jobs.
    """
    with (
        dask.config.set({"logging.distributed": "critical"}),
        open_cluster(settings) as cluster,
        Client(cluster) as client,
    ):
        _check_taken(cluster.job_script())
        cluster.adapt(minimum_jobs=settings.jobs, maximum_jobs=settings.jobs)
        yield prepared(client, "--slurm", files, told)


def _check_taken(script: str) -> None:
    """Ask `sbatch` whether it takes a job: dask-jobqueue would wait for one that it refuses."""
    with NamedTemporaryFile("w", suffix=".sh") as file:
        file.write(script)
        file.flush()
        try:
            subprocess.run(
                ["sbatch", "--test-only", file.name], check=True, capture_output=True, text=True
            )
        except FileNotFoundError as error:
            raise SettingError(
                "--slurm: there is no `sbatch` here; run this command where jobs are submitted"
            ) from error
        except subprocess.CalledProcessError as error:
            raise SettingError(f"--slurm: `sbatch` refuses the jobs: {error.stderr}") from error
