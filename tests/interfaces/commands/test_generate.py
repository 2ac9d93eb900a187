"""`motionese generate`: a model and initial states in, a motion out: a recording or a picture."""

import json
import re

import numpy as np
import pytest
from typed import arm_motions, refused, typed

from motionese import Motions, generate, load
from motionese.errors import SettingError


def generated(*arguments, out="new.csv"):
    """Generate; return the path that was written, and what was told."""
    status, output, errors = typed("generate", "arm.safetensors", "--out", out, *arguments)
    assert (status, errors) == (0, ""), errors
    (path,) = Motions.read(out).values
    return path, output


@pytest.mark.parametrize("out", ["new.csv", "new.npz", "new.hdf5", "new.mcap"])
def test_a_learned_motion_is_written_as_a_recording(arm, out):
    path, told = generated("--like", "wave", out=out)

    fit = load("arm.safetensors")
    np.testing.assert_allclose(
        path, generate(fit.network, fit.initial_states[2], 22), rtol=1e-5, atol=1e-6
    )
    assert re.match(
        rf"{out}: wave, 22 rows, 1.05 s; fastest in its range is \w+ with \S+ \w+/s", told
    )
    read = Motions.read(out)
    assert (read.rate_hz, read.channels.names) == (20, fit.network.channels.names)


def test_pictures_are_drawn(arm):
    for out, begins in (("new.svg", b"<?xml"), ("new.PNG", b"\x89PNG")):
        status, told, errors = typed("generate", "arm.safetensors", "--like", "lift", "--out", out)
        assert (status, errors) == (0, "")
        assert told.startswith(f"{out}: lift, 20 rows")
        assert (arm / out).read_bytes().startswith(begins)
    assert ">arm.safetensors: lift<" in (arm / "new.svg").read_text()


def test_what_was_recognised_is_generated(arm):
    path, _ = generated("--initial", "seen.json", "--like", "push")

    state = json.loads((arm / "seen.json").read_text())["motions"]["push"]["initial_state"]
    expected = generate(load("arm.safetensors").network, np.array(state), 23)
    np.testing.assert_allclose(path, expected, rtol=1e-5, atol=1e-6)


def test_all_that_was_recognised_is_generated_where_none_is_named(arm):
    path, told = generated("--initial", "seen.json")

    assert len(path) == sum(map(len, arm_motions().values()))
    assert "lift + reach + wave + push + pull" in told


@pytest.mark.parametrize("blend", [(), ("--blend", "6")])
def test_motions_follow_one_another_without_a_jump(arm, blend):
    path, told = generated("--like", "wave", "lift", *blend)

    assert told.startswith("new.csv: wave + lift, 42 rows")
    alone = [generated("--like", name)[0] for name in ("wave", "lift")]
    np.testing.assert_allclose(path[:22], alone[0], rtol=1e-5, atol=1e-6)
    steps = max(np.abs(np.diff(one, axis=0)).max() for one in alone)
    assert np.abs(np.diff(path, axis=0)).max() < 2 * steps


def test_a_motion_begins_where_the_robot_is(arm):
    path, _ = generated("--like", "wave", "--start", "shoulder=0.3", "elbow=0.2")

    np.testing.assert_allclose(path[0, :2], [0.3, 0.2], atol=1e-5)
    np.testing.assert_allclose(path[0, 2:], generated("--like", "wave")[0][0, 2:], atol=1e-6)


@pytest.mark.parametrize(("scale", "rows"), [("0.5", 11), ("0.75", 15), ("1.5", 29), ("2", 39)])
def test_a_motion_lasts_longer_or_shorter(arm, scale, rows):
    path, _ = generated("--like", "lift", "--duration-scale", scale)

    whole, _ = generated("--like", "lift")
    assert len(path) == rows
    spans = load("arm.safetensors").network.channels.spans
    assert (np.abs(path[-1] - whole[-1]) / spans).max() < 0.25


def test_rows_are_as_many_as_asked_for(arm):
    assert len(generated("--like", "lift", "--steps", "7")[0]) == 7
    assert len(generated("--like", "lift", "wave", "--steps", "30")[0]) == 60


STATES = {"format": "motionese-initial-states", "version": 1}
ONE = {"rows": 5, "initial_state": [0.0] * 17}
FILES = {
    "empty.json": "",
    "list.json": "[]",
    "deep.json": "[" * 100_000,
    "bytes.json": b"\xff\xfe\x00",
    "other.json": {"format": "something"},
    "newer.json": {**STATES, "version": 2, "motions": {"a": ONE}},
    "none.json": {**STATES, "motions": {}},
    "no motions.json": STATES,
    "other network.json": {**STATES, "motions": {"a": {**ONE, "initial_state": [0.0] * 16}}},
    "nan.json": {**STATES, "motions": {"a": {**ONE, "initial_state": [float("nan")] * 17}}},
    "huge.json": {**STATES, "motions": {"a": {**ONE, "initial_state": [1e300] * 17}}},
    "rows.json": {**STATES, "motions": {"a": {**ONE, "rows": 10**12}}},
    "no rows.json": {**STATES, "motions": {"a": {**ONE, "rows": 1}}},
    "endless.json": '{"format": "motionese-initial-states", "version": 1, "motions":'
    ' {"a": {"rows": 1e999, "initial_state": []}}}',
    "text.json": {**STATES, "motions": {"a": {**ONE, "initial_state": "much"}}},
}
TOLD = {
    "empty.json": "not a readable file of initial states",
    "list.json": "not a file of initial states; motionese recognise writes them",
    "deep.json": "not a readable file of initial states",
    "bytes.json": "not a readable file of initial states",
    "other.json": "not a file of initial states; motionese recognise writes them",
    "newer.json": "format 2, this version reads 1; install a newer motionese",
    "none.json": "holds no motion",
    "no motions.json": "its initial states are incomplete",
    "other network.json": "motion 'a' needs 17 finite numbers, one per unit of the model, got 16",
    "nan.json": "motion 'a' needs 17 finite numbers",
    "huge.json": "motion 'a' needs 17 finite numbers",
    "rows.json": "motion 'a' has 1000000000000 rows; 2 to 1000000 can be",
    "no rows.json": "motion 'a' has 1 rows; 2 to 1000000 can be",
    "endless.json": "its initial states are incomplete",
    "text.json": "its initial states are incomplete",
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_holds_no_initial_states_is_told(arm, name):
    content = FILES[name]
    text = content if isinstance(content, str | bytes) else json.dumps(content)
    (arm / name).write_bytes(text if isinstance(text, bytes) else text.encode())

    told = refused("generate", "arm.safetensors", "--initial", name, "--out", "new.csv")
    assert told.startswith(f"{name}: {TOLD[name]}")


WRONG = {
    "nothing": ([], "say what to generate: --like EPISODE, one of lift, reach, wave, push, pull"),
    "motion": (["--like", "wavee"], "--like wavee: unknown motion 'wavee'; did you mean 'wave'?"),
    "not seen": (["--like", "hit", "--initial", "seen.json"], "--like hit: unknown motion 'hit'"),
    "no states": (["--initial", "nothing.json"], "nothing.json: there is no such file"),
    "data": (["--initial", "data.npz"], "data.npz: not a readable file of initial states"),
    "model": (["--initial", "arm.safetensors"], "arm.safetensors: not a readable file of initial"),
    "longer": (["--like", "lift", "--duration-scale", "3"], "between 0.5 and 2, got 3"),
    "negative": (["--like", "lift", "--duration-scale", "-1"], "between 0.5 and 2, got -1"),
    "nan": (["--like", "lift", "--duration-scale", "nan"], "between 0.5 and 2, got nan"),
    "inf": (["--like", "lift", "--duration-scale", "inf"], "between 0.5 and 2, got inf"),
    "start": (["--like", "lift", "--start", "hip=1"], "unknown channel 'hip'"),
    "no value": (["--like", "lift", "--start", "elbow"], "--start elbow: write NAME=0.3"),
    "text": (["--like", "lift", "--start", "elbow=up"], "--start elbow=up: 'up' is no number"),
    "start far": (
        ["--like", "lift", "--start", "elbow=40"],
        "--start elbow=40: where the robot is must lie within the model's reach, -0.",
    ),
    "start nan": (["--like", "lift", "--start", "elbow=nan"], "channel 'elbow': where the robot"),
    "blend": (["--like", "lift", "wave", "--blend", "20"], "shorter than every motion (20 rows)"),
    "out": (["--like", "lift", "--out", "new"], "--out new: its name must end in "),
    "pdf": (["--like", "lift", "--out", "new.pdf"], "--out new.pdf: its name must end in "),
    "folder": (["--like", "lift", "--out", "no/new.csv"], "there is no folder no"),
    "svg": (["--like", "lift", "--out", "no/new.svg"], "there is no folder no"),
    "a folder": (["--like", "lift", "--out", "a.csv"], "--out a.csv: this is a folder"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    (arm / "a.csv").mkdir()
    out = [] if "--out" in arguments else ["--out", "new.csv"]

    assert told in refused("generate", "arm.safetensors", *out, *arguments)


def test_numbers_out_of_range_end_with_status_2(arm):
    for wrong in (("--steps", "1"), ("--steps", "1000001"), ("--blend", "-1")):
        status, _, errors = typed(
            "generate", "arm.safetensors", "--like", "lift", "--out", "new.csv", *wrong
        )
        assert status == 2
        assert wrong[0] in errors
    assert not (arm / "new.csv").exists()


@pytest.mark.slow
def test_a_held_out_motion_is_called_so_and_can_be_generated_once_recognised(arm):
    train = ("train", "data.npz", "--levels", "6:3", "--epochs", "1", "--held-out", "wave")
    assert typed(*train, "--out", "part.safetensors")[0] == 0

    told = refused("generate", "part.safetensors", "--like", "wave", "--out", "wave.csv")
    assert told.startswith("--like wave: motion 'wave' was held out of the training")
    assert "recognise" in told and "--initial FILE" in told
    with pytest.raises(SettingError, match="motion 'wave' was held out"):
        load("part.safetensors").index("wave")

    assert typed("recognise", "part.safetensors", "data.npz", "--initial", "i.json")[0] == 0
    way = ("--initial", "i.json", "--like", "wave", "--out", "wave.csv")
    assert typed("generate", "part.safetensors", *way)[0] == 0
