"""`motionese inspect`: what is in recordings, whatever is wrong with them."""

import numpy as np
import pytest
from typed import CHANNELS, arm_motions, refused, typed, write_csv


def inspected(*arguments):
    status, output, errors = typed("inspect", *arguments)
    assert (status, errors) == (0, ""), errors
    return output


def row(output, name):
    """Return the cells of a table's row by its first cell."""
    rows = [[c.strip() for c in line.split("│")[1:-1]] for line in output.splitlines()]
    return next(cells for cells in rows if cells and cells[0] == name)


def test_channels_and_episodes_are_shown_and_drawn(arm):
    output = inspected("demos.csv")

    assert "demos.csv: 5 episodes, 110 rows, 4 channels, 20 Hz" in output
    assert row(output, "shoulder")[1:4] == ["rad", "0", "1.2"]
    assert row(output, "pull")[:3] == ["pull", "24", "1.15"]
    assert output.endswith("Plot: demos.svg\n")
    drawn = (arm / "demos.svg").read_text()
    assert "shoulder [rad]" in drawn
    assert "time [s]" in drawn


def test_the_plot_may_be_a_picture_elsewhere(arm):
    (arm / "plots").mkdir()
    inspected("data.npz", "--plot", "plots/all.PNG", "--channels", "x", "y")

    assert (arm / "plots/all.PNG").read_bytes().startswith(b"\x89PNG")


def test_what_is_wrong_is_shown_and_not_refused(arm):
    motions = arm_motions() | {"one row": arm_motions()["lift"][:1]}
    motions["wave"][2, 1] = float("nan")
    motions["wave"][4, 2] = float("-inf")
    motions["push"][:, 3] = 1e308
    write_csv("demos.csv", motions, cell=("wave", 3, 1, ""))
    output = inspected("demos.csv")

    assert row(output, "elbow")[-3:] == ["1%", "1", "–"]
    assert row(output, "x")[-3:] == ["0%", "–", "1"]
    assert row(output, "one row")[1:3] == ["1", "0.00"]
    assert row(output, "wave")[-2:] == ["1", "1"]


def test_rows_are_counted_where_no_rate_is_told(arm):
    write_csv("demos.csv", rate_hz=None)

    output = inspected("demos.csv")
    assert "no rate told (give it with --rate when it is learned from)" in output
    assert ">row<" in (arm / "demos.svg").read_text()
    assert row(inspected("demos.csv", "--rate", "10"), "lift")[2] == "1.90"


@pytest.mark.filterwarnings("error")
def test_names_are_shown_as_they_are(arm):
    names = ("$x_1$", "a$b", "[red]c", "関節")
    write_csv("demos.csv", channels=[f"{n} [%]" for n in names])
    output = inspected("demos.csv")

    drawn = (arm / "demos.svg").read_text()
    for name in names:
        assert row(output, name)[1] == "%"
        assert f">{name} [%]<" in drawn


def test_many_episodes_are_summed_up(arm):
    motions = {f"{i}": arm_motions()["lift"] for i in range(45)}
    write_csv("demos.csv", motions)

    assert row(inspected("demos.csv"), "5 more")[1] == "100"


def test_tables_fit_a_terminal_of_80_columns(arm, monkeypatch):
    write_csv("demos.csv", channels=[f"a_rather_long_name_{c}" for c in CHANNELS])
    monkeypatch.setattr("typed.COLUMNS", "80")
    output = inspected("demos.csv")

    assert "a_rather_long_name_x" in output
    assert max(map(len, output.splitlines())) <= 80


def test_no_digit_is_left_out_at_80_columns(arm, monkeypatch):
    names = [f"a_rather_long_name_{c}" for c in CHANNELS]
    write_csv("demos.csv", {n: m / 300 for n, m in arm_motions().items()}, channels=names)
    monkeypatch.setattr("typed.COLUMNS", "80")
    output = inspected("demos.csv")

    assert "…" not in output
    assert output.splitlines()[0].endswith("20 Hz, intervals within 0.0%")


def test_a_plot_says_which_channels_it_leaves_out(arm):
    motions = {n: np.hstack([m] * 8) for n, m in arm_motions().items()}
    write_csv("demos.csv", motions, channels=[f"c{i}" for i in range(32)])
    inspected("demos.csv")

    assert "(the first 30 of 32 channels)" in (arm / "demos.svg").read_text()


WRONG = {
    "nothing": (["nothing"], "nothing: there is no such file or folder"),
    "model": (["arm.safetensors"], "arm.safetensors: not a recording that is read here"),
    "rate": (["demos.csv", "--rate", "0"], "setting rate_hz = 0"),
    "channel": (["demos.csv", "--channels", "z"], "demos.csv: unknown channel 'z'"),
    "plot": (["demos.csv", "--plot", "plot.pdf"], "--plot plot.pdf: its name must end in .svg"),
    "folder": (["demos.csv", "--plot", "no/plot.svg"], "--plot no/plot.svg: there is no folder no"),
    "a folder": (["demos.csv", "--plot", "a.svg"], "--plot a.svg: this is a folder"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(arm, arguments, told):
    (arm / "a.svg").mkdir()
    assert told in refused("inspect", *arguments)
