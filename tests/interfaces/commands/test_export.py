"""`motionese export`: a model's step as ONNX, motions in the formats of others."""

import numpy as np
import onnxruntime
import pytest
from small_models import nothing_learned
from typed import CHANNELS, NAMES, arm_motions, refused, typed

from motionese import Motions, load
from motionese.learning import write_fit

WHERE = {
    "csv": "new.csv",
    "npz": "new.npz",
    "robomimic": "new.hdf5",
    "mcap": "new mcap",
    "eipl": "new eipl",
    "lerobot": "new lerobot",
}


@pytest.mark.parametrize("format", WHERE)
def test_motions_come_back_from_every_format(arm, format):
    out = WHERE[format]
    status, output, errors = typed(
        "export", "data.npz", "--out", out, *(() if "." in out else ("--to", format))
    )
    assert (status, errors) == (0, ""), errors
    assert output == f"{out}: 5 motions of 20 to 24 rows at 20 Hz, 4 channels\n"

    status, _, errors = typed("import", out, "--out", "again.npz", "--rate", "20")
    assert (status, errors) == (0, ""), errors
    again, first = Motions.read("again.npz"), Motions.read("data.npz")
    assert len(again) == len(NAMES)
    for back, values in zip(again.values, arm_motions().values(), strict=True):
        np.testing.assert_allclose(back, values, atol=1e-6)
    if format != "eipl":
        assert [c.name for c in again.channels] == [c.name for c in first.channels]


def test_a_step_is_exported_and_agrees(arm):
    status, output, errors = typed("export", "arm.safetensors", "--onnx", "arm.onnx")

    assert (status, errors) == (0, "")
    assert "arm.onnx: one step (x, u → y, u_next); differs from the network by at most" in output
    session = onnxruntime.InferenceSession("arm.onnx", providers=["CPUExecutionProvider"])
    for leading in ((), (1,)):
        given = {"x": (*leading, len(CHANNELS)), "u": (*leading, 17)}
        fed = {name: np.full(shape, 0.5, np.float32) for name, shape in given.items()}
        assert [out.shape for out in session.run(None, fed)] == list(given.values())


def test_a_model_that_has_learned_nothing_yet_does_what_needs_no_motion(arm):
    facts = {"loop": 0, "names": ["of", "others"]}
    write_fit("new.safetensors", nothing_learned(load("arm.safetensors")), {"u": np.ones(2)}, facts)

    assert typed("export", "new.safetensors", "--onnx", "new.onnx")[::2] == (0, "")
    status, output, _ = typed("recognise", "new.safetensors", "demos.csv", "--initial", "in.json")
    assert (status, "nearest learned" in output) == (0, True)
    assert typed("generate", "new.safetensors", "--initial", "in.json", "--out", "a.csv")[0] == 0
    for like in ([], ["--like", "lift"]):
        told = refused("generate", "new.safetensors", *like, "--out", "b.csv")
        assert told == (
            "new.safetensors: the model has learned no motion yet; train it on motions first"
        )


WRONG = {
    "nothing": (["data.npz"], "say what to write: --onnx FILE for a model, or --out PATH for data"),
    "both": (["data.npz", "--onnx", "a.onnx", "--out", "a.csv"], "say what to write"),
    "to alone": (["data.npz", "--to", "csv"], "say what to write"),
    "model": (
        ["arm.safetensors", "--out", "a.csv"],
        "arm.safetensors: a model, not recordings",
    ),
    "data": (["data.npz", "--onnx", "a.onnx"], "data.npz: not a readable model file"),
    "no data": (["nothing.npz", "--out", "a.csv"], "nothing.npz: there is no such file"),
    "no model": (["nothing", "--onnx", "a.onnx"], "nothing: no such model file"),
    "format": (["data.npz", "--out", "new", "--to", "cvs"], "unknown format 'cvs'; did you mean"),
    "untold": (["data.npz", "--out", "new"], "or name the format (--to), one of npz"),
    "folder": (["data.npz", "--out", "no/a.csv"], "no/a.csv: cannot be written"),
    "in a file": (["data.npz", "--out", "data.npz/a", "--to", "lerobot"], "data.npz/a: "),
    "mcap": (["data.npz", "--out", "new.mcap"], "new.mcap: an MCAP file holds one episode, the"),
    "full folder": (["data.npz", "--out", "full", "--to", "eipl"], "full: exists already"),
    "a folder": (["data.npz", "--out", "full", "--to", "csv"], "full: cannot be written"),
    "onnx folder": (["arm.safetensors", "--onnx", "no/a.onnx"], "--onnx no/a.onnx: there is no fo"),
    "onnx name": (["arm.safetensors", "--onnx", "new"], "--onnx new: its name must end in .onnx"),
    "onnx full": (["arm.safetensors", "--onnx", "full.onnx"], "--onnx full.onnx: this is a folder"),
    "no rate": (["norate.csv", "--out", "a.npz"], "tells neither times nor a rate"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    (arm / "full").mkdir()
    (arm / "full/file").touch()
    (arm / "full.onnx").mkdir()
    (arm / "norate.csv").write_text("a,b\n1,2\n3,5\n")

    assert told in refused("export", *arguments)
