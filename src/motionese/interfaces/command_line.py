"""The command line: the experiment's commands, and below them those for one's own robot.

Everything that takes time to import is imported by the command that needs it, so that help and
complaints come at once.
"""
# ruff: noqa: PLC0415

import os
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Annotated

import typer

from motionese.errors import SettingError, unknown
from motionese.interfaces import data_commands, model_commands, teach_commands
from motionese.interfaces.plainly import WRONG, plainly

app = typer.Typer(
    help="Developmental imitation learning: the experiment, and your own robot's recordings.",
    no_args_is_help=True,
    add_completion=False,
    # The tables of locals in Typer's own tracebacks hide the line that matters.
    pretty_exceptions_enable=False,
)
EXPERIMENT = "The experiment"
SEVERAL = (
    *("--conditions", "--set", "--channels", "--exclude", "--unit", "--range"),
    *("--observed", "--log", "--like", "--start"),
)
"""Options that may be followed by several values."""


def main() -> None:
    """Run the command line; exit status 2 for what the user can put right, 130 for Ctrl-C."""
    app(spread(sys.argv[1:]), prog_name="motionese")


def spread(arguments: Sequence[str]) -> list[str]:
    """Repeat an option before each of its values: '--set a=1 b=2' becomes '--set a=1 --set b=2'."""
    result: list[str] = []
    option = ""
    for argument in arguments:
        if argument.startswith("-"):
            option = argument if argument in SEVERAL else ""
        elif option and result[-1] != option:
            result.append(option)
        result.append(argument)
    return result


def _show_version(asked: bool) -> bool:
    if asked:
        typer.echo(f"motionese {metadata.version('motionese')}")
        raise typer.Exit
    return asked


@app.callback()
def _root(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and leave."
        ),
    ] = False,
) -> None:
    """Take what stands before a command."""


@app.command(rich_help_panel=EXPERIMENT)
def reproduce(
    conditions: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME …", help="Of TD/MD, TD/MND, TND/MD, TND/MND; default: all."),
    ] = None,
    seeds: Annotated[
        str, typer.Option(help="How many (10 means seeds 0 to 9), or which: 100-109, or 1,5,9.")
    ] = "3",
    preset: Annotated[
        str, typer.Option(metavar="default|paper|FILE", help="Settings; see `motionese presets`.")
    ] = "default",
    overrides: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE …", help="E.g. network.levels.cs.tau=40."),
    ] = None,
    vision: Annotated[
        str | None,
        typer.Option(metavar="projection|rendered", help="Where the robot sees hands from."),
    ] = None,
    caregiver: Annotated[
        str,
        typer.Option(
            metavar="scripted|recordings:FOLDER",
            help="Who shows the motions: e.g. what `motionese teach` has kept in a folder.",
        ),
    ] = "scripted",
    out: Annotated[Path | None, typer.Option(help="The run folder; default: runs/PRESET.")] = None,
    workers: Annotated[
        int | None, typer.Option(min=1, help="Runs at a time; default: one a core.")
    ] = None,
    quick: Annotated[
        bool, typer.Option("--quick", help="A short trial of everything; its figures mean nothing.")
    ] = False,
) -> None:
    """Perform the experiment, or go on with it, and report.

    Stopped or killed at any time, the same command goes on, and ends with the same results.
    """
    with plainly("stopped; the same command goes on"):
        # Networks this small are fastest on the CPU; read when jax is imported.
        os.environ.setdefault("JAX_PLATFORMS", "cpu")
        from rich.console import Console

        from motionese.interfaces.reproduce import reproduce as perform

        too_few = perform(
            Console(markup=False, highlight=False, soft_wrap=True),
            conditions=conditions or (),
            seeds=seeds,
            preset=preset,
            overrides=[*(overrides or ()), *([f"body.vision={vision}"] if vision else ())],
            out=out,
            workers=workers,
            quick=quick,
            caregiver=caregiver,
        )
    _end(too_few, trial=quick)


@app.command(rich_help_panel=EXPERIMENT)
def report(run: Annotated[Path, typer.Argument(help="A run folder.", metavar="RUN")]) -> None:
    """Write the report of a run folder again, also while its runs go on."""
    with plainly("stopped; the report was not written"):
        from rich.console import Console

        from motionese.interfaces.report import report as write

        too_few = write(run, Console(markup=False, highlight=False, soft_wrap=True))
    _end(too_few)


@app.command(rich_help_panel=EXPERIMENT)
def presets(
    name: Annotated[str | None, typer.Argument(help="The preset to print.")] = None,
) -> None:
    """List the presets, or print one to copy and edit."""
    with plainly("stopped"):
        from motionese.experiment.reading import PRESETS, preset_text

        if name is None:
            for each in PRESETS:
                typer.echo(f"{each}: {preset_text(each).splitlines()[0].removeprefix('# ')}")
        elif name in PRESETS:
            typer.echo(preset_text(name), nl=False)
        else:
            raise SettingError(unknown("preset", name, PRESETS))


teach_commands.add_to(app)
data_commands.add_to(app)
model_commands.add_to(app)


def _end(too_few: str, *, trial: bool = False) -> None:
    """Say why a statistical test is missing; that counts as an error unless this was a trial."""
    if too_few:
        typer.echo(f"motionese: {too_few}", err=True)
        if not trial:
            raise typer.Exit(WRONG)
