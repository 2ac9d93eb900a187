"""Whatever is in a file or an option, a command does its work or says one sentence."""

import errno
import json
import os
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from typed import arm_motions, refused, typed, write_csv

SHORT = ("--levels", "10:3,3:15", "--epochs", "100", "--held-out", "0")
READING = {
    "import": ("import", "{}", "--out", "new.npz"),
    "inspect": ("inspect", "{}", "--plot", "new.svg"),
    "train": ("train", "{}", "--out", "new.safetensors", *SHORT),
    "recognise": ("recognise", "arm.safetensors", "{}", "--initial", "new.json"),
    "online": ("recognise", "arm.safetensors", "{}", "--out", "new.csv", "--online", "--window=4"),
    "export": ("export", "{}", "--out", "new.csv"),
    "measure": ("measure", "{}", "--out", "new.csv"),
}
"""Every command that reads recordings, with a place for the recording."""
MODELS = {
    "recognise": ("recognise", "{}", "demos.csv", "--initial", "new.json"),
    "online": ("recognise", "{}", "demos.csv", "--out", "new.csv", "--online", "--window=4"),
    "generate": ("generate", "{}", "--like", "lift", "--out", "new.csv"),
    "onnx": ("export", "{}", "--onnx", "new.onnx"),
}
"""Every command that reads a model, with a place for the model."""


def line(command, path):
    return [part.format(path) for part in command]


def bad_recordings():
    """Write one recording for each fault; return what is said about it."""
    motions = arm_motions()
    write_csv("nan.csv", cell=("wave", 3, 2, "nan"))
    write_csv("inf.csv", cell=("wave", 3, 2, "-inf"))
    write_csv("word.csv", cell=("wave", 3, 2, "left"))
    write_csv("one.csv", {n: v[:1] for n, v in motions.items()})
    write_csv("flat.csv", {n: v * [1, 0, 1, 1] for n, v in motions.items()})
    write_csv("late.csv", cell=("wave", 3, 0, "0.1"))
    text = {
        "empty.csv": b"",
        "header.csv": b"episode,time,x\n",
        "values.csv": b"0.1,0.2\n0.3,0.4\n0.5,wave\n",
        "binary.csv": bytes(range(256)),
        "binary.npz": bytes(range(256)),
        "empty.npz": b"",
        "cut.npz": b"PK\x03\x04",
        "foreign.json": b"{}",
        "empty.hdf5": b"",
        "binary.mcap": bytes(range(256)),
    }
    for name, content in text.items():
        Path(name).write_bytes(content)
    np.savez("foreign.npz", a=np.zeros(3))
    return {
        "nan.csv": "nan.csv: episode 'wave', row 3, channel 'x': values must be finite, got nan",
        "inf.csv": "inf.csv: episode 'wave', row 3, channel 'x': values must be finite, got -inf",
        "word.csv": "word.csv, line",
        "one.csv": "one.csv: episode 'lift' has 1 row; at least 2 are needed",
        "flat.csv": "flat.csv: channel 'elbow' is always 0: give its range or leave it out",
        "empty.csv": "empty.csv: the file is empty",
        "header.csv": "header.csv: holds no rows below its header",
        "values.csv": "values.csv, line 3, column 'column_1': expected a number, got 'wave'",
        "binary.csv": "binary.csv: not a text file (byte 128)",
        "binary.npz": "binary.npz: ",
        "empty.npz": "empty.npz: ",
        "cut.npz": "cut.npz: ",
        "foreign.npz": "foreign.npz: ",
        "foreign.json": "foreign.json: not a recording that is read here",
        "empty.hdf5": "empty.hdf5: ",
        "binary.mcap": "binary.mcap: ",
        "nothing": "nothing: there is no such file or folder",
        "folder": "folder: not a recording that is read here",
    }


@pytest.mark.parametrize("command", READING)
def test_recordings_that_cannot_be_used_are_told(arm, command):
    (arm / "folder").mkdir()
    for name, told in bad_recordings().items():
        if command == "inspect" and name in ("nan.csv", "inf.csv", "one.csv", "flat.csv"):
            continue  # These are shown.
        if command in ("recognise", "online") and name == "flat.csv":
            continue  # A model has ranges of its own.
        if command == "measure" and name == "flat.csv":
            continue  # What stays where it is has no range to be learned in, but can be measured.
        assert refused(*line(READING[command], name)).startswith(told)


@pytest.mark.parametrize("command", MODELS)
def test_models_that_cannot_be_used_are_told(arm, command):
    whole = (arm / "arm.safetensors").read_bytes()
    for content in (b"", whole[:100], whole[: len(whole) // 2], whole[:-1], bytes(range(256))):
        (arm / "cut").write_bytes(content)
        told = refused(*line(MODELS[command], "cut"))
        assert told == "cut: not a readable model file, perhaps cut short"
    (arm / "newer").write_bytes(altered(whole, version=2))
    assert refused(*line(MODELS[command], "newer")) == (
        "newer: model format 2, this version reads 1; install a newer motionese"
    )
    (arm / "foreign").write_bytes(altered(whole, format="other"))
    assert refused(*line(MODELS[command], "foreign")) == "foreign: not a model of motionese"


def altered(model: bytes, facts=None, **changes) -> bytes:
    """Return a model with other entries in its description."""
    (size,) = struct.unpack("<Q", model[:8])
    header = json.loads(model[8 : 8 + size])
    told = json.loads(header["__metadata__"]["motionese"])
    told |= changes
    told["facts"] |= facts or {}
    header["__metadata__"]["motionese"] = json.dumps(told)
    written = json.dumps(header).encode()
    return struct.pack("<Q", len(written)) + written + model[8 + size :]


FACTS = {
    "names": (["lift"], "initial_states must have shape (1, 17), got (5, 17)"),
    "lengths": ([20, 21], "lengths must have shape (5,), got (2,)"),
    "rate_hz": (0, "its rate_hz: Input should be greater than 0"),
    "validation_names": (["hit"], "validation_error must have shape (1, 4), got (0, 4)"),
    "status": ("done", "unknown status 'done'; "),
    "sentence": (None, "its sentence: Input should be a valid string"),
}


@pytest.mark.parametrize("fact", FACTS)
def test_facts_that_do_not_belong_to_a_model_are_told(arm, fact):
    wrong, told = FACTS[fact]
    whole = (arm / "arm.safetensors").read_bytes()
    (arm / "bad").write_bytes(altered(whole, {fact: wrong}))

    assert refused(*line(MODELS["generate"], "bad")).startswith(f"bad: {told}")


WORDS = st.sampled_from(
    ["", "0", "-1", "1", "nan", "inf", "1e308", "=", ":", ",", "*", "[", "shoulder", "lift", "cf:5"]
)
TEXTS = st.one_of(
    WORDS,
    st.lists(WORDS, min_size=1, max_size=4).map("".join),
    st.text(st.characters(exclude_categories=("Cs", "Cc")), max_size=8),
).filter(lambda text: not text.startswith("-"))
VALUES = st.one_of(
    st.none(), st.booleans(), st.integers(-2, 10**20), st.floats(), st.text(max_size=4)
)
ANY = st.recursive(
    VALUES, lambda some: st.lists(some, max_size=3) | st.dictionaries(st.text(), some, max_size=3)
)


def tried(*arguments):
    """Run a command; whatever it is given, it ends with status 0, or with 2 and one sentence."""
    status, _, errors = typed(*arguments)
    assert status in (0, 2), errors
    assert "Traceback" not in errors
    if status == 0:
        assert errors == ""
    elif errors.startswith("motionese: "):
        assert errors.count("\n") == 1


@pytest.mark.usefixtures("unchecked")
@pytest.mark.parametrize("command", READING)
@settings(max_examples=6)
@given(data=st.data())
def test_recordings_of_anything(arm, command, data):
    whole = arm / data.draw(st.sampled_from(["demos.csv", "data.npz", "data.hdf5"]))
    bad = f"bad{whole.suffix}"
    (arm / bad).write_bytes(damaged(whole.read_bytes(), data))
    tried(*line(READING[command], bad))


@pytest.mark.usefixtures("unchecked")
@pytest.mark.parametrize("command", MODELS)
@settings(max_examples=6)
@given(data=st.data())
def test_models_of_anything(arm, command, data):
    whole = (arm / "arm.safetensors").read_bytes()
    kinds = {
        "damaged": lambda: damaged(whole, data),
        "altered": lambda: altered(
            whole,
            **{
                data.draw(
                    st.sampled_from(["levels", "channels", "initial_io", "learned_bias", "version"])
                ): data.draw(ANY)
            },
        ),
        "facts": lambda: altered(
            whole,
            {
                data.draw(
                    st.sampled_from(["names", "lengths", "rate_hz", "status", "sentence"])
                ): data.draw(ANY)
            },
        ),
    }
    (arm / "bad").write_bytes(kinds[data.draw(st.sampled_from(sorted(kinds)))]())
    tried(*line(MODELS[command], "bad"))


@pytest.mark.usefixtures("unchecked")
@settings(max_examples=15)
@given(content=st.one_of(st.binary(max_size=50), ANY), one=ANY, name=st.text(max_size=4))
@example(content=None, one={"rows": 5, "initial_state": [1e308] * 17}, name="\n")
def test_initial_states_of_anything(arm, content, one, name):
    if content is None:
        content = {"format": "motionese-initial-states", "version": 1, "motions": {name: one}}
    written = content if isinstance(content, bytes) else json.dumps(content).encode()
    (arm / "bad.json").write_bytes(written)
    tried("generate", "arm.safetensors", "--initial", "bad.json", "--out", "new.svg")


OPTIONS = {
    "import": ("--range", "--unit", "--channels", "--exclude", "--rate", "--resample", "--trim"),
    "train": ("--levels", "--set", "--held-out", "--io-tau", "--patience", "--log", "--seed"),
    "recognise": ("--observed", "--channels", "--seed", "--nan"),
    "online": ("--observed", "--window", "--ahead", "--log"),
    "generate": ("--like", "--start", "--steps", "--duration-scale", "--blend"),
    "inspect": ("--channels", "--exclude", "--rate", "--format", "--episode", "--time"),
    "measure": (
        "--hand",
        "--still",
        "--shortest-pause",
        "--window",
        "--against",
        "--channels",
        "--unit",
    ),
}


@pytest.mark.usefixtures("unchecked")
@pytest.mark.parametrize("command", OPTIONS)
@settings(max_examples=10)
@given(data=st.data())
def test_options_of_anything(arm, command, data):
    lines = {**READING, "generate": ("generate", "arm.safetensors", "--out", "new.csv")}
    option = data.draw(st.sampled_from(OPTIONS[command]))
    text = data.draw(TEXTS)
    if option in ("--range", "--unit", "--start", "--set"):
        text = f"{data.draw(st.sampled_from(['shoulder', 'x*', 'clip', 'bound', '']))}={text}"
    tried(*line(lines[command], "demos.csv"), option, text)


def damaged(whole: bytes, data) -> bytes:
    """Return content cut short, with bytes changed, or nothing of it."""
    content = bytearray(whole)
    if data.draw(st.booleans()):
        del content[data.draw(st.integers(0, len(content))) :]
    for _ in range(data.draw(st.integers(0, 3))):
        if content:
            content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    return bytes(content) if content else data.draw(st.binary(max_size=100))


@pytest.mark.parametrize(
    "command", ["import", "train", "recognise", "online", "generate", "measure"]
)
def test_a_full_disk_is_told(arm, monkeypatch, command):
    def full(_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    lines = {**READING, "generate": ("generate", "arm.safetensors", "--out", "new.csv")}
    like = ("--like", "lift") if command == "generate" else ()
    told = refused(*line(lines[command], "demos.csv"), *like)
    assert re.fullmatch(r"new\.\w+: .*No space left on device", told)
