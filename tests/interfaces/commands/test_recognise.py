"""`motionese recognise`: what the channels that were seen tell about those that were not."""

import json

import numpy as np
import pytest
from typed import CHANNELS, NAMES, arm_motions, refused, typed, write_csv

from motionese import Motions, generate, load, read_for

SEEN = ("--observed", "x", "y")


def recognised(*arguments):
    status, output, errors = typed("recognise", "arm.safetensors", *arguments)
    assert (status, errors) == (0, ""), errors
    return output


def test_every_motion_is_recognised_and_told(trained):
    told = (trained / "recognise.txt").read_text()

    assert told.startswith("demos.csv: looked at shoulder, elbow, x, y\n")
    rows = [line.split("│")[1:-1] for line in told.splitlines() if line.startswith("│")]
    assert [row[0].strip() for row in rows] == list(NAMES)
    assert [row[3].strip() for row in rows] == list(NAMES)
    assert {row[2].strip() for row in rows} == {"–"}
    assert {row[4].strip() for row in rows} == {"recognised"}


def test_initial_states_generate_what_was_recognised(trained):
    content = json.loads((trained / "seen.json").read_text())
    network = load(trained / "arm.safetensors").network

    assert content["units"] == {"io": 4, "cf": 10, "cs": 3}
    for name, values in arm_motions().items():
        one = content["motions"][name]
        assert one["rows"] == len(values)
        path = generate(network, np.array(one["initial_state"]), one["rows"])
        assert (np.abs(path - values) / network.channels.spans).max() < 0.25


def test_hidden_channels_are_written_with_the_others(arm):
    # The joints' columns are not even there.
    write_csv("hand.csv", {n: v[:, 2:] for n, v in arm_motions().items()}, channels=CHANNELS[2:])
    output = recognised("hand.csv", *SEEN, "--out", "all.csv", "--initial", "new.json")

    assert "hand.csv: looked at x, y" in output
    found = Motions.read("all.csv")
    assert found.names == NAMES
    assert [f"{c.name} [{c.unit}]" for c in found.channels] == list(CHANNELS)
    assert found.rate_hz == 20
    spans = load("arm.safetensors").network.channels.spans
    for path, values in zip(found.values, arm_motions().values(), strict=True):
        assert np.sqrt(((path - values) ** 2).mean(0) / spans**2).max() < 0.25


def test_errors_of_hidden_channels_are_told_where_they_are_known(arm):
    output = recognised("demos.csv", "--observed", "x,y", "--format", "csv")

    row = next(line for line in output.splitlines() if "│ lift" in line).split("│")
    assert row[3].strip().endswith("%")


def test_gaps_and_other_columns_are_left_aside(arm):
    motions = {n: np.column_stack([v, v[:, 0]]) for n, v in list(arm_motions().items())[:2]}
    write_csv("more.csv", motions, channels=[*CHANNELS, "hip"], cell=("lift", 2, 3, ""))

    assert "│ reach" in recognised("more.csv", *SEEN)


def test_another_rate_is_resampled(arm):
    fast = {n: np.repeat(v, 2, axis=0)[:-1] for n, v in list(arm_motions().items())[:1]}
    write_csv("fast.csv", fast, rate_hz=40.0)
    assert refused("recognise", "arm.safetensors", "fast.csv") == (
        "fast.csv: 40 rows a second, the model was trained at 20; "
        "resample it to that (--resample 20)"
    )

    assert "│ lift" in recognised("fast.csv", "--resample", "20")


def hand_first(name):
    turned = {n: v[:, [2, 3, 0, 1]] for n, v in arm_motions().items()}
    write_csv(name, turned, channels=[*CHANNELS[2:], *CHANNELS[:2]])


def test_columns_in_another_order_are_put_into_the_models(arm):
    hand_first("turned.csv")
    straight, turned = recognised("demos.csv"), recognised("turned.csv")

    assert turned.partition("Root mean")[2] == straight.partition("Root mean")[2]
    found = read_for(load("arm.safetensors"), "turned.csv").examined
    assert [(each.kind, each.what) for each in found] == [
        (
            "converted",
            "its channels are x, y, shoulder, elbow; "
            "taken in the model's order shoulder, elbow, x, y",
        )
    ]
    named = ("--channels", "shoulder,elbow,x,y")
    assert recognised("turned.csv", *named) == turned
    assert not read_for(load("arm.safetensors"), "demos.csv").examined


def test_of_a_recording_of_some_channels_these_are_looked_at(arm):
    write_csv("hand.csv", {n: v[:, 2:] for n, v in arm_motions().items()}, channels=CHANNELS[2:])

    told = recognised("hand.csv")
    assert "hand.csv: looked at x, y; not in the recording: shoulder, elbow\n" in told
    _, _, named = told.partition("\n")
    assert recognised("hand.csv", *SEEN).endswith(named)
    assert "channel 'shoulder' is missing" in refused(
        "recognise", "arm.safetensors", "hand.csv", "--observed", "shoulder", "x"
    )
    (finding,) = read_for(load("arm.safetensors"), "hand.csv").examined
    assert (finding.channel, finding.count) == ("shoulder", 2)


def test_row_by_row_too_what_is_there_is_looked_at(arm):
    write_csv("hand.csv", {n: v[:, 2:] for n, v in arm_motions().items()}, channels=CHANNELS[2:])

    told = recognised("hand.csv", "--online", "--window", "8", "--out", "seen.csv")
    assert "looked at x, y; not in the recording: shoulder, elbow" in told


WRONG = {
    "no model": (["nothing", "demos.csv"], "nothing: no such model file"),
    "data as model": (["data.npz", "arm.safetensors"], "data.npz: not a readable model file"),
    "csv as model": (["demos.csv", "demos.csv"], "demos.csv: not a readable model file"),
    "a folder": ([".", "demos.csv"], ".: no such model file"),
    "model as data": (["arm.safetensors", "arm.safetensors"], "not a recording that is read here"),
    "no data": (["arm.safetensors", "nothing.csv"], "nothing.csv: there is no such file"),
    "observed": (["arm.safetensors", "demos.csv", "--observed", "z*"], "unknown channel 'z*'"),
    "missing": (
        ["arm.safetensors", "hand.csv", "--observed", "shoulder"],
        "the model's channel 'shoulder' is missing; the model needs shoulder, here are x, y",
    ),
    "foreign": (["arm.safetensors", "other.csv"], "here are none of them"),
    "excluded": (
        ["arm.safetensors", "demos.csv", "--exclude", "x", "--observed", "x"],
        "channel 'x' is missing",
    ),
    "NaN": (["arm.safetensors", "nan.csv"], "nan.csv: episode 'wave', row 3, channel 'x': values"),
    "one row": (["arm.safetensors", "short.csv"], "episode 'lift' has 1 row; at least 2"),
    "out": (["arm.safetensors", "demos.csv", "--out", "new"], "--out new: its name must end in"),
    "folder": (["arm.safetensors", "demos.csv", "--out", "no/a.csv"], "there is no folder no"),
    "initial": (
        ["arm.safetensors", "demos.csv", "--out", "new.csv", "--initial", "states.npz"],
        "--initial states.npz: its name must end in .json",
    ),
    "both": (
        ["arm.safetensors", "demos.csv", "--initial", "new.json", "--out", "no/new.csv"],
        "--out no/new.csv: there is no folder no",
    ),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    motions = arm_motions()
    write_csv("hand.csv", {n: v[:, 2:] for n, v in motions.items()}, channels=CHANNELS[2:])
    write_csv("other.csv", {n: v[:, :2] for n, v in motions.items()}, channels=["a", "b"])
    write_csv("nan.csv", cell=("wave", 3, 2, "nan"))
    write_csv("short.csv", {"lift": motions["lift"][:1]})

    assert told in refused("recognise", *arguments)
