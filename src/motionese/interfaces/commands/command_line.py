"""The command line: the experiment's commands, and below them those for one's own robot.

Everything that takes time to import is imported by the command that needs it, so that help and
complaints come at once.
"""

import sys
from collections.abc import Callable, Sequence
from importlib import metadata
from typing import Annotated

import typer
from typer import Option

from motionese.interfaces.commands import experiment_commands, model_commands, recording_commands

app = typer.Typer(
    help="Developmental imitation learning: the experiment, and your own robot's recordings.",
    no_args_is_help=True,
    add_completion=False,
    # The tables of locals in Typer's own tracebacks hide the line that matters.
    pretty_exceptions_enable=False,
)
PANELS: dict[str, dict[str, Callable[..., None]]] = {
    "The experiment": {
        "reproduce": experiment_commands.reproduce,
        "sweep": experiment_commands.sweep,
        "report": experiment_commands.report,
        "presets": experiment_commands.presets,
        "teach": experiment_commands.teach,
    },
    "Your own robot": {
        "import": recording_commands.import_recordings,
        "inspect": recording_commands.inspect,
        "measure": recording_commands.measure,
        "export": recording_commands.export,
        "train": model_commands.train,
        "recognise": model_commands.recognise,
        "generate": model_commands.generate,
    },
}
SEVERAL = (
    *("--preset", "--conditions", "--set", "--channels", "--exclude", "--unit", "--range"),
    *("--episodes", "--skip", "--columns", "--unwrap", "--quaternion", "--binary", "--topic"),
    *("--observed", "--log", "--like", "--start", "--hand", "--vary"),
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
        Option(
            "--version", callback=_show_version, is_eager=True, help="Show the version and leave."
        ),
    ] = False,
) -> None:
    """Take what stands before a command."""


for panel, commands in PANELS.items():
    for name, command in commands.items():
        app.command(name, rich_help_panel=panel)(command)
