"""Commands for recordings: import, inspect, measure, export."""
# ruff: noqa: PLC0415

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated, Any

from typer import Argument, Option

from motionese.errors import needs
from motionese.interfaces.commands.exit_status import plainly
from motionese.interfaces.commands.recording_options import (
    FORMATS,
    Texts,
    as_read,
    separated,
    with_recording_options,
)

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
        from motionese.interfaces.commands.summaries import description
        from motionese.interfaces.commands.terminal import tell_findings
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


@with_recording_options("trim", "range", "margin", "binary")
def measure(
    source: Annotated[Path, Argument(metavar="DATA", help="Recordings, in any format.")],
    reading: dict[str, Any],
    hand: Annotated[
        Texts,
        Option(
            metavar="X Y [Z]",
            help="Channels that are the hand's position; else found by their units or names; "
            "where there is none, the channels are joints.",
        ),
    ] = None,
    against: Annotated[
        Path | None, Option(metavar="DATA", help="Recordings to compare these with.")
    ] = None,
    still: Annotated[
        float | None,
        Option(metavar="SPEED", help="Below it the hand is still; else 5 % of its peak speed."),
    ] = None,
    shortest_pause: Annotated[
        float, Option(metavar="SECONDS", help="The shortest stillness that is a pause.")
    ] = 0.15,
    window: Annotated[
        float, Option(metavar="SECONDS", help="Over which positions are smoothed; at least 7 rows.")
    ] = 0.25,
    out: Annotated[
        Path | None, Option(metavar="TABLE.csv", help="Write the measures, a line an episode.")
    ] = None,
    plot: Annotated[
        Path | None,
        Option(
            metavar="FILE.svg|.png",
            help="Draw motions with their pauses; with --against both groups' measures.",
        ),
    ] = None,
) -> None:
    """Measure how motions are shown: speed, pauses, pace, roundness, range, repetitiveness.

    DATA holds positions of a hand, 2-D or 3-D, or joint angles. An episode is one observation.
    """
    with plainly("stopped; nothing was written", soft_wrap=False) as console:
        if find_spec("scipy") is None:
            raise needs("scipy", "experiment", "motionese measure")
        from motionese.interfaces.commands.measure import measure_recordings
        from motionese.interfaces.commands.measured_group import Manner

        measure_recordings(
            console,
            [source, *([against] if against else [])],
            separated(hand),
            Manner(still, shortest_pause, window),
            out=out,
            plot=plot,
            reading=as_read(**reading),
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
        from motionese.interfaces.commands.export import export_model, export_motions

        if onnx is not None and out is None and to is None:
            export_model(console, source, onnx)
        elif out is not None and onnx is None:
            export_motions(console, source, out, to)
        else:
            raise SettingError("say what to write: --onnx FILE for a model, or --out PATH for data")
