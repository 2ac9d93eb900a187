"""`motionese recognise --online`: what a robot that looks on would have known at each row."""

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rerun.chunk import RrdReader
from typed import CHANNELS, NAMES, arm_motions, refused, typed, write_csv

from motionese import Motions, load, recognise_online
from motionese.interfaces.commands.belief_figure import NAMED, write_belief_figure
from motionese.interfaces.commands.online_trace import OnlineTrace
from motionese.runtime.belief import NONE

ONLINE = ("--online", "--window", "10")


def recognised(*arguments):
    status, output, errors = typed("recognise", "arm.safetensors", *arguments)
    assert (status, errors) == (0, ""), errors
    return output


def table(path):
    """Return a table's heading, and its rows by the episode."""
    with Path(path).open(newline="", encoding="utf-8") as file:
        heading, *rows = csv.reader(file)
    return heading, {name: [row for row in rows if row[0] == name] for name in NAMES}


def numbers(cells):
    return np.array([float(cell) if cell else np.nan for cell in cells])


@pytest.mark.parametrize("ahead", [3, None])
def test_what_the_library_knows_at_each_row_is_written(arm, ahead):
    further = () if ahead is None else ("--ahead", str(ahead))
    told = recognised("demos.csv", *ONLINE, *further, "--observed", "x,y", "--out", "new.csv")

    assert told.endswith("What was known: new.csv, new.svg\n")
    heading, rows = table("new.csv")
    coming = [f"{c.split()[0]} in {ahead or 5} rows {c.split()[1]}" for c in CHANNELS]
    assert heading == [
        *("episode", "row", "time [s]", "likeliest", "belief", f"belief in {NONE}"),
        *("window error [share of range]", *coming, *(f"spread of {c}" for c in coming)),
    ]
    settings = {"observed": ["x", "y"], "window": 10, "ahead": ahead or 5}
    for name, values in arm_motions().items():
        twin = recognise_online(load("arm.safetensors"), **settings)
        assert len(rows[name]) == len(values)
        for t, (row, reading) in enumerate(zip(rows[name], values, strict=True)):
            known = twin.observe(reading)
            assert row[:4] == [name, str(t), repr(round(t / 20, 6)), known.likeliest]
            expected = [known.belief[known.likeliest], known.belief[NONE], known.error]
            expected += [*known.ahead[-1], *known.spread[-1]]
            np.testing.assert_allclose(numbers(row[4:]), expected, rtol=1e-4)


def test_every_motion_is_told_at_its_end(arm):
    told = recognised("demos.csv", *ONLINE)

    assert told.startswith("demos.csv: looked at shoulder, elbow, x, y\n")
    assert told.endswith("│\n" + told[told.rindex("└") :])
    cells = [
        [cell.strip() for cell in line.split("│")[1:-1]]
        for line in told.splitlines()
        if line.startswith("│")
    ]
    _, rows = table("demos.online.csv")
    assert [row[:2] for row in cells] == [[name, name] for name in NAMES]
    for name, _, belief, settled, error, milliseconds in cells:
        last = rows[name][-1]
        assert belief == f"{float(last[4]):.1%}"
        assert error == f"{float(last[6]):.1%}"
        assert 0 < float(milliseconds) < 100
        likeliest = [row[3] for row in rows[name]]
        assert set(likeliest[int(settled) :]) == {name}
        assert settled == "0" or likeliest[int(settled) - 1] != name
    assert any(row[3] != "0" for row in cells)


@pytest.mark.parametrize("data", ["hand.csv", "masked.npz"])
def test_gaps_and_missing_channels_are_not_observed(arm, data):
    hand = {n: v[:, 2:] for n, v in arm_motions().items()}
    write_csv("hand.csv", hand, channels=CHANNELS[2:], cell=("lift", 4, 0, ""))
    masks = [np.ones_like(values, dtype=bool) for values in hand.values()]
    masks[0][4, 0] = False  # a value lies there all the same
    values, channels = list(hand.values()), ("x", "y")
    Motions.from_arrays(values, channels, 20.0, observed=masks, names=NAMES).write("masked.npz")
    recognised(data, *ONLINE, "--observed", "x", "y", "--out", "new.csv")

    twin = recognise_online(load("arm.safetensors"), observed=["x", "y"], window=10)
    _, rows = table("new.csv")
    for t, (row, (x, y)) in enumerate(zip(rows["lift"], hand["lift"], strict=True)):
        known = twin.observe({"y": y} if t == 4 else {"x": x, "y": y})
        np.testing.assert_allclose(numbers(row[7:11]), known.ahead[-1], rtol=1e-4)


@pytest.mark.slow
def test_too_short_a_window_is_noted_with_the_rows_that_would_be_needed(arm):
    note = (
        "A window of 10 rows holds 9 observed values after its first, fewer than the network's 13 "
        "context units: what they leave open stays as it was learned; 14 rows would be needed"
    )
    assert note in recognised("demos.csv", *ONLINE, "--observed", "x")
    assert "A window" not in recognised("demos.csv", "--online", "--window", "14", "--observed=x")
    assert "A window of 13" in recognised("demos.csv", "--online", "--window=13", "--observed=x")


def read_rerun(path):
    """Return what was logged by row and name; names as Rerun escapes them."""
    scalars = {}
    for chunk in RrdReader(path).stream():
        if "row" in chunk.timeline_names:
            rows = chunk.to_record_batch().to_pydict()
            for row, (number,) in zip(rows["row"], rows["Scalars:scalars"], strict=True):
                scalars[row, chunk.entity_path.removeprefix("/").replace("\\", "")] = number
    return scalars


def test_each_row_is_logged_and_what_is_predicted_at_the_row_it_is_predicted_for(arm, capfd):
    recognised("demos.csv", *ONLINE, "--ahead", "3", "--observed", "x", "--log", "rerun", "jsonl")

    assert capfd.readouterr() == ("", "")
    logged = read_rerun("demos.online.rrd")
    _, rows = table("demos.online.csv")
    for name, values in arm_motions().items():
        for t, row in enumerate(rows[name]):
            believed = [logged[t, f"{name}/belief/{each}"] for each in (*NAMES, NONE)]
            assert sum(believed) == pytest.approx(1)
            assert max(believed) == pytest.approx(float(row[4]), rel=1e-4)
            assert believed[-1] == pytest.approx(float(row[5]), rel=1e-4)
            error = logged[t, f"{name}/error"]
            assert np.isnan(error) if not row[6] else error == pytest.approx(float(row[6]), 1e-4)
            assert logged[t, f"{name}/observed/x"] == values[t, 2]
            assert (t, f"{name}/observed/y") not in logged
            predicted = logged[t + 3, f"{name}/predicted/shoulder"]
            assert predicted == pytest.approx(float(row[7]), rel=1e-4, abs=1e-6)
    lines = map(json.loads, Path("demos.online.log.jsonl").read_text().splitlines())
    assert {line["row"] for line in lines} == set(range(24 + 3))


def test_the_figure_shows_belief_and_error_with_their_units(arm):
    recognised("demos.csv", *ONLINE)

    drawn = Path("demos.online.svg").read_text()
    for told in (*NAMES, NONE, "belief [share]", "[% of range]", "time [s]"):
        assert f">{told}<" in drawn, told
    assert "#808890" in drawn


def invented(motions, rows=5):
    """Return a trace in which later motions are believed in more."""
    belief = np.tile(np.arange(motions + 1.0), (rows, 1))
    belief /= belief.sum(axis=1, keepdims=True)
    names = (*(f"m{i}" for i in range(motions)), NONE)
    empty, error = np.zeros((rows, 2)), np.full(rows, np.nan)
    return OnlineTrace("shown", 10.0, names, belief, error, empty, empty, np.ones(rows))


def test_the_figure_names_the_motions_that_were_believed_in_most_and_sums_up_the_others(tmp_path):
    write_belief_figure(tmp_path / "new.svg", [invented(11)] * 13, "title")

    drawn = (tmp_path / "new.svg").read_text()
    assert NAMED == 8
    assert [i for i in range(11) if f">m{i}<" in drawn] == list(range(3, 11))
    assert ">3 others<" in drawn
    assert drawn.count(">shown<") == 12
    assert ">title (the first 12 of 13 motions)<" in drawn


def test_belief_has_settled_where_nothing_else_came_after():
    one = invented(2, rows=4)
    for likeliest, settled in (([2, 2, 2, 2], 0), ([0, 1, 0, 1], 3), ([1, 0, 0, 0], 1)):
        assert replace(one, belief=np.eye(3)[likeliest]).settled == settled


LONGER = "demos.csv: motion 'lift' has 20 rows, fewer than the window of 21; "
WRONG = {
    "longer": (["--online", "--window", "21"], f"{LONGER}take a shorter one, --window 20 at most"),
    "huge": (["--online", "--window", "9" * 30], "fewer than the window of 999"),
    "below 2": (["--online", "--window", "1"], "window must be 2 or more, got 1"),
    "window": (["--window", "10"], "--window is for recognition row by row alone; add --online"),
    "ahead": (["--ahead", "5"], "--ahead is for recognition row by row alone; add --online"),
    "log": (["--log", "rerun"], "--log is for recognition row by row alone; add --online"),
    "initial": ([*ONLINE, "--initial", "a.json"], "--initial is not for --online, which finds no"),
    "observed": (
        [*ONLINE, "--observed", "z"],
        "unknown channel 'z'; there are: shoulder",
    ),
    "kind": ([*ONLINE, "--log", "rerum"], "unknown log 'rerum'; did you mean 'rerun'?"),
    "out": ([*ONLINE, "--out", "new.npz"], "--out new.npz: its name must end in .csv"),
    "itself": ([*ONLINE, "--out", "demos.csv"], "demos.csv: this is what is read (demos.csv)"),
    "figure": ([*ONLINE, "--out", "here.csv"], "--out, here.svg: this is a folder"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    Path("here.svg").mkdir()

    assert told in refused("recognise", "arm.safetensors", "demos.csv", *arguments)


def test_a_motion_of_which_nothing_is_seen_is_refused(arm):
    motions = Motions.read("demos.csv")
    masks = [np.ones_like(mask) for mask in motions.observed]
    masks[2][:, 2] = False
    replace(motions, observed=tuple(masks)).write("gap.npz")

    told = refused("recognise", "arm.safetensors", "gap.npz", *ONLINE, "--observed", "x")
    assert told == "gap.npz: of motion 'wave' nothing was observed"


def test_help_tells_of_it():
    status, told, _ = typed("recognise", "--help")

    assert status == 0
    for option in ("--online", "--window", "--ahead", "--log", "NAME.online.csv"):
        assert option in told
