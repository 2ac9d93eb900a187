"""Models and motions in the formats of others."""

from pathlib import Path

from rich.console import Console

from motionese.errors import MotioneseError, SettingError
from motionese.interfaces.commands.outputs import MODEL_SUFFIX, check_apart, check_output
from motionese.interfaces.commands.summaries import description
from motionese.interfaces.commands.terminal import tell_findings
from motionese.interfaces.onnx_export import TOLERANCE, export_onnx
from motionese.learning import Motions, load


def export_model(console: Console, model: Path, out: Path) -> None:
    """Write one step of a model as ONNX, checked against the model, and tell how it agrees."""
    check_output("--onnx", out, (".onnx",))
    check_apart([model], out)
    difference = export_onnx(out, load(model))
    console.print(
        f"{out}: one step (x, u → y, u_next); "
        f"differs from the network by at most {difference:.1e}, allowed {TOLERANCE:g}"
    )


def export_motions(console: Console, source: Path, out: Path, to: str | None) -> None:
    """Write motions in another format, and tell what was written."""
    if source.suffix == MODEL_SUFFIX:
        raise SettingError(f"{source}: a model, not recordings; write its step with --onnx FILE")
    try:
        motions = Motions.read(source)
    except MotioneseError as error:
        raise type(error)(f"{error} (with motionese import, whose .npz can be exported)") from error
    check_apart([source], out)
    motions.write(out, to)
    console.print(f"{out}: {description(motions)}")
    tell_findings(console, motions.examined)
