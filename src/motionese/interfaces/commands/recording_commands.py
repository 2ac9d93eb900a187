"""Commands for recordings: import, inspect, export."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated

import typer

from motionese.interfaces.commands import recording_options as options
from motionese.interfaces.commands.exit_status import plainly

PANEL = "Your own robot"

Source = Annotated[Path, typer.Argument(metavar="SOURCE", help="A file or folder of recordings.")]


def add_to(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    app.command("import", rich_help_panel=PANEL)(import_recordings)
    app.command("inspect", rich_help_panel=PANEL)(inspect)
    app.command("export", rich_help_panel=PANEL)(export)


def import_recordings(
    source: Source,
    out: Annotated[Path, typer.Option(metavar="DATA.npz", help="The file to write.")],
    channels: options.Channels = None,
    exclude: options.Exclude = None,
    format: options.Format = None,
    episode: options.EpisodeColumn = None,
    time: options.TimeColumn = None,
    rate: options.Rate = None,
    resample: options.Resample = None,
    trim: options.Trim = 0.0,
    nan: options.Nan = "refuse",
    units: options.Units = None,
    ranges: options.Ranges = None,
    margin: options.Margin = None,
) -> None:
    """Read recordings, choose and prepare what is to be learned, and write it as one file.

    SOURCE is a CSV or a folder of them, a LeRobot folder, robomimic HDF5, an EIPL folder, MCAP
    with JSON messages, or .npz that motionese wrote.
    """
    with plainly("stopped; nothing was written"):
        from rich.console import Console

        from motionese.interfaces.commands.convert import import_motions

        chosen = options.choice(channels, exclude, rate, resample, trim, nan, units, ranges, margin)
        import_motions(
            Console(markup=False, highlight=False, soft_wrap=True),
            source,
            out,
            columns={"format": format, "episode": episode, "time": time},
            choice=chosen,
        )


def inspect(
    source: Source,
    plot: Annotated[
        Path | None, typer.Option(metavar="FILE.svg|.png", help="The plot; default: NAME.svg here.")
    ] = None,
    channels: options.Channels = None,
    exclude: options.Exclude = None,
    format: options.Format = None,
    episode: options.EpisodeColumn = None,
    time: options.TimeColumn = None,
    rate: options.Rate = None,
) -> None:
    """Show what is in recordings: episodes, lengths, rate, ranges, still shares, gaps, NaN."""
    with plainly("stopped; nothing was written"):
        from rich.console import Console

        from motionese.interfaces.commands.inspect import inspect_recordings

        inspect_recordings(
            Console(markup=False, highlight=False),
            source,
            plot or Path(f"{source.resolve().stem}.svg"),
            columns={"format": format, "episode": episode, "time": time},
            channels=options.separated(channels) or None,
            exclude=options.separated(exclude),
            rate_hz=rate,
        )


def export(
    source: Annotated[
        Path, typer.Argument(metavar="MODEL|DATA", help="A trained model, or recordings.")
    ],
    onnx: Annotated[
        Path | None, typer.Option(metavar="FILE.onnx", help="One step of the model.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="PATH", help="The file or folder to write data to.")
    ] = None,
    to: Annotated[
        str | None,
        typer.Option(
            metavar="csv|npz|eipl|robomimic|lerobot|mcap",
            help="As what; else by the suffix of PATH.",
        ),
    ] = None,
) -> None:
    """Write a model's step as ONNX (--onnx), or recordings in another format (--out)."""
    with plainly("stopped; nothing was written"):
        from rich.console import Console

        from motionese.interfaces.commands.convert import export_model, export_motions

        console = Console(markup=False, highlight=False, soft_wrap=True)
        if onnx is not None and out is None and to is None:
            export_model(console, source, onnx)
        elif out is not None and onnx is None:
            export_motions(console, source, out, to)
        else:
            from motionese.errors import SettingError

            raise SettingError("say what to write: --onnx FILE for a model, or --out PATH for data")
