"""No command writes over what it reads, whatever it is called."""

from pathlib import Path

import pytest
from typed import refused, write_csv

READING = {
    "import": ("import", "SOURCE", "--out", "OUT"),
    "export": ("export", "SOURCE", "--out", "OUT"),
    "recognise": ("recognise", "arm.safetensors", "SOURCE", "--out", "OUT"),
    "measure": ("measure", "SOURCE", "--out", "OUT"),
    "against": ("measure", "other.csv", "--against", "SOURCE", "--out", "OUT"),
    "online": ("recognise", "arm.safetensors", "SOURCE", "--online", "--out", "OUT"),
}


def typed_for(command, source, out):
    return [{"SOURCE": source, "OUT": out}.get(part, part) for part in READING[command]]


def spellings():
    """Names of demos.csv: its own, by another way, and links to it."""
    Path("sub").mkdir()
    write_csv("other.csv")
    Path("link.csv").symlink_to("demos.csv")
    Path("hard.csv").hardlink_to("demos.csv")
    return (
        "demos.csv",
        "sub/../demos.csv",
        str(Path("demos.csv").resolve()),
        "link.csv",
        "hard.csv",
    )


@pytest.mark.parametrize("command", READING)
def test_an_output_that_is_the_source_is_refused(arm, command):
    for out in spellings():
        told = refused(*typed_for(command, "demos.csv", out))
        assert told.startswith(f"{out}: this is what is read (demos.csv)")


@pytest.mark.parametrize("command", READING)
def test_an_output_that_would_count_as_a_recording_of_the_source_is_refused(arm, command):
    Path("takes/deep").mkdir(parents=True)
    write_csv("takes/one.csv")
    Path("other").symlink_to("takes")
    for out in ("takes/new.csv", "takes/deep/new.csv", "other/new.csv"):
        told = refused(*typed_for(command, "takes", out))
        assert told.startswith(f"{out}: lies in the folder that is read (takes)")


def test_a_model_and_initial_states_are_kept_too(arm):
    Path("model.onnx").symlink_to("arm.safetensors")
    Path("model.csv").symlink_to("arm.safetensors")
    Path("plot.svg").symlink_to("demos.csv")
    Path("new.safetensors").symlink_to("demos.csv")

    assert "this is what is read" in refused("export", "arm.safetensors", "--onnx", "model.onnx")
    line = ("generate", "arm.safetensors", "--like", "wave", "--out", "model.csv")
    assert "this is what is read" in refused(*line)
    assert "this is what is read" in refused("inspect", "demos.csv", "--plot", "plot.svg")
    assert "this is what is read" in refused("train", "demos.csv", "--out", "new.safetensors")
