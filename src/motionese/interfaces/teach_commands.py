"""The command for teaching: teach."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from motionese.interfaces.plainly import plainly

PANEL = "The experiment"


def add_to(app: typer.Typer) -> None:
    """Add the command to the command line."""
    app.command(rich_help_panel=PANEL)(teach)


def teach(
    begin: Annotated[
        str,
        typer.Option(
            metavar="babbling|RUN",
            help="A robot that has only babbled, or a run folder's (RUN/CONDITION/SEED for one).",
        ),
    ] = "",
    session: Annotated[
        Path, typer.Option(metavar="FOLDER", help="Where the session is kept, and goes on from.")
    ] = Path("session"),
    host: Annotated[
        str, typer.Option(help="The address to listen at; others need a --token.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="0: any that is free.")] = 0,
    token: Annotated[str, typer.Option(help="What a page must know to be let in.")] = "",
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the address, open nothing.")
    ] = False,
) -> None:
    """Teach the simulated robot yourself, on a page in your browser."""
    with plainly("stopped; the session is kept, the same command goes on"):
        from rich.console import Console

        from motionese.interfaces.teach.teach import teach as serve

        serve(
            Console(markup=False, highlight=False, soft_wrap=True),
            begin=begin,
            session=session,
            host=host,
            port=port,
            token=token,
            browser=not no_browser,
        )
