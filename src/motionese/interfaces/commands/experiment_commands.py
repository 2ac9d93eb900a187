"""Commands for the experiment: reproduce, sweep, report, presets, teach."""
# ruff: noqa: PLC0415

import os
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from motionese.errors import SettingError, needs, unknown
from motionese.interfaces.commands.exit_status import WRONG, plainly
from motionese.interfaces.commands.recording_options import Texts

if TYPE_CHECKING:
    from motionese.experiment import StageLesson

EXPERIMENT = ("dask", "distributed", "filelock", "jinja2", "mujoco", "pandas", "scipy")
MODULES = {"experiment": EXPERIMENT, "web": (*EXPERIMENT, "starlette", "uvicorn", "websockets")}
"""What an extra brings."""


Conditions = Annotated[
    Texts, Option(metavar="NAME …", help="Such as TD/MD, of the preset's factors; default: all.")
]
Seeds = Annotated[
    str, Option(help="How many (10 means seeds 0 to 9), or which: 100-109, or 1,5,9.")
]
Overrides = Annotated[
    Texts, Option("--set", metavar="NAME=VALUE …", help="E.g. network.levels.cs.tau=40.")
]
Quick = Annotated[
    bool, Option("--quick", help="A short trial of everything; its figures mean nothing.")
]
Workers = Annotated[
    int | None, Option(min=1, help="Runs at a time on this machine; default: one a core.")
]
Scheduler = Annotated[
    str | None,
    Option(
        metavar="ADDRESS", help="Of a Dask scheduler whose workers do the runs: tcp://10.0.0.5:8786"
    ),
]
SlurmFile = Annotated[
    Path | None, Option(metavar="SETTINGS.toml", help="What Slurm is asked for, to do the runs.")
]
ShardText = Annotated[
    str | None,
    Option(metavar="I/N", help="Do the I-th of N parts of the runs only, as in a job array."),
]


def reproduce(
    conditions: Conditions = None,
    seeds: Seeds = "3",
    preset: Annotated[
        Texts,
        Option(
            metavar="NAME|FILE …",
            help="Settings, see `motionese presets`; several get one report. Default: default.",
        ),
    ] = None,
    overrides: Overrides = None,
    vision: Annotated[
        str | None, Option(metavar="projection|rendered", help="Where the robot sees hands from.")
    ] = None,
    caregiver: Annotated[
        str,
        Option(
            metavar="scripted|recordings:FOLDER",
            help="Who shows the motions: e.g. what `motionese teach` has kept in a folder.",
        ),
    ] = "scripted",
    out: Annotated[
        Path | None,
        Option(help="The run folder, or that of several presets' run folders; else runs/PRESET."),
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    slurm: SlurmFile = None,
    shard: ShardText = None,
    quick: Quick = False,
) -> None:
    """Perform the experiment, or go on with it, and report.

    Stopped or killed at any time, the same command goes on, and ends with the same results.
    """
    with plainly("stopped; the same command goes on") as console:
        # Networks this small are fastest on the CPU; read when jax is imported.
        os.environ.setdefault("JAX_PLATFORMS", "cpu")
        _check_extra("reproduce")
        from motionese.interfaces.commands.reproduce import reproduce as perform
        from motionese.interfaces.commands.workplace import read_workplace

        too_few = perform(
            console,
            conditions=conditions or (),
            seeds=seeds,
            presets=preset or ["default"],
            overrides=[*(overrides or ()), *([f"body.vision={vision}"] if vision else ())],
            out=out,
            where=read_workplace(workers, scheduler, slurm, shard),
            quick=quick,
            caregiver=caregiver,
        )
    _end(too_few, trial=quick)


def sweep(
    name: Annotated[
        str | None,
        Argument(help="A sweep that comes with motionese, or a TOML file; none lists them."),
    ] = None,
    vary: Annotated[
        Texts,
        Option(
            metavar="NAME=N,N …",
            help="Numbers of a setting, such as network.levels.cs.tau=30,70; several make a grid.",
        ),
    ] = None,
    preset: Annotated[
        str | None, Option(metavar="NAME|FILE", help="In the place of the sweep's own.")
    ] = None,
    conditions: Conditions = None,
    seeds: Seeds = "3",
    overrides: Overrides = None,
    out: Annotated[
        Path | None, Option(help="The folder of all points' run folders; else runs/sweep-NAME.")
    ] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    slurm: SlurmFile = None,
    shard: ShardText = None,
    quick: Quick = False,
) -> None:
    """Perform a preset at several points of its settings: which findings hold where?

    Stopped or killed at any time, the same command goes on, and ends with the same results.
    """
    with plainly("stopped; the same command goes on") as console:
        os.environ.setdefault("JAX_PLATFORMS", "cpu")
        _check_extra("sweep")
        from motionese.experiment.sweeps import titles
        from motionese.interfaces.commands.sweep import sweep as perform
        from motionese.interfaces.commands.workplace import read_workplace

        if name is None and not vary:
            for each, title in titles():
                typer.echo(f"{each}: {title}")
            return
        too_few = perform(
            console,
            name,
            vary=vary or (),
            preset=preset,
            conditions=conditions or (),
            seeds=seeds,
            overrides=overrides or (),
            out=out,
            where=read_workplace(workers, scheduler, slurm, shard),
            quick=quick,
        )
    _end(too_few, trial=quick)


def report(
    run: Annotated[
        list[Path],
        Argument(help="A run folder, or a folder that run folders lie in.", metavar="RUN …"),
    ],
    out: Annotated[
        Path | None,
        Option(
            metavar="FILE",
            help="The one report of all run folders, beside the results that are kept; default: "
            "report.html in the folder around them.",
        ),
    ] = None,
) -> None:
    """Write the report of a run folder again, also while its runs go on; or that of several."""
    with plainly("stopped; the report was not written") as console:
        _check_extra("report")
        from motionese.interfaces.commands.results import write_again

        too_few = write_again(run, out, console)
    _end(too_few)


def presets(name: Annotated[str | None, Argument(help="The preset to print.")] = None) -> None:
    """List the presets with what their lessons demand of memory, or print one to copy and edit."""
    with plainly("stopped"):
        _check_extra("presets")
        from motionese.experiment import read_settings, stage_lessons
        from motionese.experiment.presets import PRESETS, preset_text

        if name is None:
            for each in PRESETS:
                typer.echo(f"{each}: {preset_text(each).splitlines()[0].removeprefix('# ')}")
                for lesson in stage_lessons(read_settings(each)):
                    typer.echo(_described(lesson))
        elif name in PRESETS:
            typer.echo(preset_text(name), nl=False)
        else:
            raise SettingError(unknown("preset", name, PRESETS))


def teach(
    begin: Annotated[
        str,
        Option(
            metavar="babbling|RUN",
            help="A robot that has only babbled, or a run folder's (RUN/CONDITION/SEED for one).",
        ),
    ] = "",
    session: Annotated[
        Path,
        Option(
            metavar="FOLDER|FILE",
            help="Where the session is kept, and goes on from; or one that was saved as a file.",
        ),
    ] = Path("session"),
    into: Annotated[
        Path | None,
        Option(metavar="FOLDER", help="Where a FILE is unpacked; beside it if left out."),
    ] = None,
    host: Annotated[
        str, Option(help="The address to listen at; others need a --token.")
    ] = "127.0.0.1",
    port: Annotated[int, Option(min=0, max=65535, help="0: any that is free.")] = 0,
    token: Annotated[str, Option(help="What a page must know to be let in.")] = "",
    no_browser: Annotated[
        bool, Option("--no-browser", help="Print the address, open nothing.")
    ] = False,
) -> None:
    """Teach the simulated robot yourself, on a page in your browser."""
    folder = session

    def stopped() -> str:
        how = "the same command goes on" if folder == session else f"--session {folder} goes on"
        return f"stopped; the session is kept, {how}"

    with plainly(stopped) as console:
        _check_extra("teach", "web")
        from motionese.interfaces.commands.shared_session import session_folder
        from motionese.interfaces.page.server import teach as serve

        folder = session_folder(session, into)
        if folder != session:
            console.print(f"{session} is unpacked into {folder}")
        serve(
            console,
            begin=begin,
            session=folder,
            host=host,
            port=port,
            token=token,
            browser=not no_browser,
        )


def _described(lesson: "StageLesson") -> str:
    """Return a stage's lesson and its demand in two lines."""
    numbers = ", ".join(f"{name} {value}" for name, value in lesson.numbers.items())
    taught = f"{lesson.name} ({lesson.sequences})" if lesson.name else lesson.sequences
    return (
        f"  stage {lesson.stage}, {lesson.conditions}: {taught}\n"
        f"    {lesson.demand.sentence} ({numbers})"
    )


def _check_extra(command: str, extra: str = "experiment") -> None:
    """Refuse a command whose packages are not installed, before they are imported."""
    for module in MODULES[extra]:
        if find_spec(module) is None:
            package = {"mujoco": "mujoco-core"}.get(module, module)
            raise needs(package, extra, command)


def _end(too_few: str, *, trial: bool = False) -> None:
    """Say why a statistical test is missing; that counts as an error unless this was a trial."""
    if too_few:
        typer.echo(f"motionese: {too_few}", err=True)
        if not trial:
            raise typer.Exit(WRONG)
