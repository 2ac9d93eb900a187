"""Commands for recordings: import, inspect, export."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import Annotated, Any

from typer import Argument, Option

from motionese.interfaces.commands.exit_status import plainly
from motionese.interfaces.commands.recording_options import FORMATS, as_read, with_recording_options

Source = Annotated[Path, Argument(metavar="SOURCE", help="A file or folder of recordings.")]


@with_recording_options()
def import_recordings(
    source: Source,
    out: Annotated[Path, Option(metavar="DATA.npz", help="The file to write.")],
    reading: dict[str, Any],
) -> None:
    """Read recordings, choose and prepare what is to be learned, and write it as one file.

    SOURCE is a CSV or a folder of them, a LeRobot folder, HDF5 of robomimic, ALOHA,
    ManiSkill or D4RL or a folder of it, an EIPL folder, a ROS bag, MCAP with messages of JSON or
    ROS, or .npz that motionese wrote.
    """
    with plainly("stopped; nothing was written") as console:
        from motionese.interfaces.commands.outputs import check_apart
        from motionese.interfaces.commands.summaries import description, tell_findings
        from motionese.learning import Motions

        check_apart([source], out)
        motions = Motions.read(source, **as_read(**reading))
        motions.write(out)
        console.print(f"{out}: {description(motions)}")
        tell_findings(console, motions.examined)


@with_recording_options("resample", "trim", "nan", "unit", "range", "margin")
def inspect(
    source: Source,
    reading: dict[str, Any],
    plot: Annotated[
        Path | None, Option(metavar="FILE.svg|.png", help="The plot; default: NAME.svg here.")
    ] = None,
) -> None:
    """Show what is in recordings: episodes, lengths, rate, ranges, still shares, gaps, NaN."""
    with plainly("stopped; nothing was written", soft_wrap=False) as console:
        from motionese.interfaces.commands.inspect import inspect_recordings

        inspect_recordings(
            console, source, plot or Path(f"{source.resolve().stem}.svg"), as_read(**reading)
        )


def export(
    source: Annotated[Path, Argument(metavar="MODEL|DATA", help="A trained model, or recordings.")],
    onnx: Annotated[Path | None, Option(metavar="FILE.onnx", help="One step of the model.")] = None,
    out: Annotated[
        Path | None, Option(metavar="PATH", help="The file or folder to write data to.")
    ] = None,
    to: Annotated[
        str | None,
        Option(metavar=FORMATS.removesuffix("|rosbag"), help="As what; else by PATH's suffix."),
    ] = None,
) -> None:
    """Write a model's step as ONNX (--onnx), or recordings in another format (--out)."""
    with plainly("stopped; nothing was written") as console:
        from motionese.errors import SettingError
        from motionese.interfaces.commands.outputs import export_model, export_motions

        if onnx is not None and out is None and to is None:
            export_model(console, source, onnx)
        elif out is not None and onnx is None:
            export_motions(console, source, out, to)
        else:
            raise SettingError("say what to write: --onnx FILE for a model, or --out PATH for data")
