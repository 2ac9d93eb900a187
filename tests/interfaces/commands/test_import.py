"""`motionese import`: recordings in, one file of motions out, chosen and prepared."""

from pathlib import Path

import numpy as np
import pytest
from typed import CHANNELS, NAMES, arm_motions, refused, typed, write_csv

from motionese import Motions


def imported(*arguments):
    """Import the demonstrations; return the motions in the file, and what was told."""
    status, output, errors = typed("import", "demos.csv", "--out", "new.npz", *arguments)
    assert (status, errors) == (0, ""), errors
    return Motions.read("new.npz"), output


def test_what_was_recorded_is_what_is_in_the_file(arm):
    motions, told = imported()

    assert told == "new.npz: 5 motions of 20 to 24 rows at 20 Hz, 4 channels\n"
    assert motions.names == NAMES
    assert [f"{c.name} [{c.unit}]" for c in motions.channels] == list(CHANNELS)
    for values, expected in zip(motions.values, arm_motions().values(), strict=True):
        np.testing.assert_array_equal(values, expected)


def test_empty_cells_are_gaps(arm):
    write_csv("demos.csv", cell=("wave", 3, 1, ""))
    motions, told = imported()

    assert "0.2% not observed" in told
    missing = [np.argwhere(~mask).tolist() for mask in motions.observed]
    assert missing == [[], [], [[3, 1]], [], []]


def test_what_a_narrow_range_clips_is_told(arm):
    assert "beyond" not in imported("--range", "shoulder=0:1.2")[1]

    _, told = imported("--range", "shoulder=0:0.5", "x=0:1e9")
    shoulder = np.concatenate([m[:, 0] for m in arm_motions().values()])
    share = (shoulder > 0.55).sum() / (4 * len(shoulder))
    assert told.endswith(f", 4 channels, {share:.1%} beyond their ranges and clipped\n")


def test_channels_ranges_and_units_are_chosen(arm):
    motions, _ = imported(
        *("--channels", "y", "sh*", "elbow", "--exclude", "elbow"),
        *("--range", "shoulder=-2:3", "--unit", "shoulder=°", "--margin", "0.5"),
    )

    (y, shoulder) = motions.channels
    assert (shoulder.name, shoulder.unit, shoulder.low, shoulder.high) == ("shoulder", "°", -2, 3)
    seen = np.concatenate([m[:, 3] for m in arm_motions().values()])
    assert (y.low, y.high) == pytest.approx(
        (seen.min() - np.ptp(seen) / 2, seen.max() + np.ptp(seen) / 2)
    )


def test_still_ends_are_cut_and_the_rate_is_changed(arm):
    motions, told = imported("--resample", "10", "--trim", "0.2")

    assert "at 10 Hz" in told
    assert motions.rate_hz == 10
    whole, _ = imported("--resample", "10")
    assert sum(motions.lengths) < sum(whole.lengths)


def test_a_nan_is_a_gap_where_that_is_said(arm):
    write_csv("demos.csv", cell=("lift", 0, 2, "nan"))
    motions, _ = imported("--nan", "gap")

    assert not motions.observed[0][0, 2]


def test_columns_may_be_called_otherwise(arm):
    text = (arm / "demos.csv").read_text().replace("episode", "which").replace("time [s]", "at")
    (arm / "demos.csv").write_text(text)
    motions, _ = imported("--episode", "which", "--time", "at")

    assert motions.names == NAMES
    assert motions.rate_hz == 20


def test_a_rate_is_given_where_none_is_told(arm):
    write_csv("demos.csv", rate_hz=None)
    assert "give the rate [Hz] it was recorded at: --rate" in refused(
        "import", "demos.csv", "--out", "new.npz"
    )

    motions, _ = imported("--rate", "12.5")
    assert motions.rate_hz == 12.5


def test_what_was_found_before_a_refusal_is_told(arm):
    Path("words.csv").write_text("x,grip\n" + "0.1,open\n0.2,closed\n" * 5)
    status, output, errors = typed("import", "words.csv", "--out", "new.npz")

    assert (status, output) == (2, "")
    found, refusal = errors.splitlines()
    assert found == "! words.csv: channel 'grip': 'closed' is read as 0, 'open' as 1"
    assert refusal.startswith("motionese: words.csv: tells neither times nor a rate")


WRONG = {
    "no such file": (["nothing.csv"], "nothing.csv: there is no such file or folder"),
    "a model": (["arm.safetensors"], "arm.safetensors: not a recording that is read here: "),
    "format": (["demos.csv", "--format", "cvs"], "unknown format 'cvs'; did you mean 'csv'?"),
    "other format": (["demos.csv", "--format", "npz"], "demos.csv: "),
    "channel": (["demos.csv", "--channels", "sholder"], "did you mean 'shoulder'?"),
    "pattern": (["demos.csv", "--exclude", "z*"], "demos.csv: unknown channel 'z*'"),
    "all excluded": (["demos.csv", "--exclude", "*"], "demos.csv: no channel is left"),
    "rate": (["demos.csv", "--rate", "30"], "recorded at 20 Hz, but its rate is given as 30 Hz"),
    "no rate": (["demos.csv", "--rate", "nan"], "setting rate_hz = nan: "),
    "resample": (["demos.csv", "--resample", "0"], "setting resample_hz = 0"),
    "trim": (["demos.csv", "--trim", "1"], "setting trim = 1"),
    "nan": (["demos.csv", "--nan", "maybe"], "setting nan = 'maybe': "),
    "unit": (["demos.csv", "--unit", "shoulder"], "--unit shoulder: write NAME=rad"),
    "range": (["demos.csv", "--range", "x=1"], "--range x=1: a range is two numbers"),
    "three": (["demos.csv", "--range", "x=1:2:3"], "--range x=1:2:3: a range is two numbers"),
    "zero width": (["demos.csv", "--range", "x=1:1"], "a range needs low < high, got 1 to 1"),
    "infinite": (["demos.csv", "--range", "x=0:inf"], "setting ranges"),
    "of none": (["demos.csv", "--range", "z=0:1"], "demos.csv: unknown channel 'z'"),
    "margin": (["demos.csv", "--margin", "-1"], "setting margin = -1"),
    "episode": (["demos.csv", "--episode", "no"], "demos.csv: unknown column 'no'"),
    "of no table": (["data.npz", "--time", "t"], "time is the column that holds the time"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    assert told in refused("import", *arguments, "--out", "new.npz")


@pytest.mark.parametrize(
    ("out", "told"),
    [
        ("nowhere/new.npz", "nowhere/new.npz: cannot be written"),
        ("demos.csv/new.npz", "demos.csv/new.npz: cannot be written"),
        ("new", "new: its name does not tell the format; end it in .npz, "),
        ("folder.npz", "folder.npz: cannot be written"),
    ],
)
def test_a_file_that_cannot_be_written_is_told(arm, out, told):
    (arm / "folder.npz").mkdir()
    assert told in refused("import", "demos.csv", "--out", out)
