"""`motionese measure`: tables, pictures and comparisons of how motions are shown."""

import csv
from pathlib import Path

import numpy as np
import pytest
from stroke_motions import LENGTH_M, arc, strokes, through
from typed import arm_motions, refused, typed, write_csv

XY = ("x [m]", "y [m]")
RATE_HZ = 50.0


def measured(*arguments):
    status, output, errors = typed("measure", *arguments)
    assert (status, errors) == (0, ""), errors
    return output


def rows(output, name):
    """Return the cells of all tables' rows by their first cell."""
    cells = [[c.strip() for c in line.split("│")[1:-1]] for line in output.splitlines()]
    return [each for each in cells if each and each[0] == name]


def table(path):
    with Path(path).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def demos(tmp_path, monkeypatch):
    """A folder with motions of a hand: strokes with pauses, one without, an arc, a still one."""
    monkeypatch.chdir(tmp_path)
    motions = {
        "pausing": strokes(1.0, 0.5, RATE_HZ, 3),
        "one": strokes(1.0, 0.5, RATE_HZ, 1),
        "arc": arc(np.pi, 1.0, RATE_HZ),
        "still": np.full((60, 2), 0.2),
    }
    write_csv("demos.csv", motions, channels=XY, rate_hz=RATE_HZ)
    return tmp_path


def test_episodes_and_all_are_told(demos):
    output = measured("demos.csv")

    assert output.startswith(
        "demos.csv: 4 episodes at 50 Hz, the hand at x, y [m]; smoothed over 0.26 s (13 rows); "
        "still below 5 % of each episode's peak speed, or as noise asks; a pause lasts 0.15 s"
    )
    moving, shape, pauses = (line[1:] for line in rows(output, "pausing"))
    assert moving[:3] == ["4", "0.3", "0.562"] and shape == ["0.3", "1", "1.5"]
    # Pauses, their mean and total length, the pace, and that at half and twice the threshold.
    assert pauses[:6] == ["2", "0.5", "1", "3", "3", "3"]
    assert [line[1:] for line in rows(output, "still")] == [["–"] * 5, ["–"] * 3, [*["–"] * 6, "0"]]
    ((_, mean, interval, of),) = rows(output, "roundness")
    assert float(mean) == pytest.approx((1 + 1 + np.pi / 2) / 3, rel=0.01)
    assert "to" in interval and of == "3"


def test_what_is_undefined_is_said(demos):
    output = measured("demos.csv")

    assert (
        "! undefined (–): pace and mean pause, no pause between movements: 'one', 'arc'" in output
    )
    assert "! undefined (–): everything, nothing moves: 'still'" in output


def test_the_table_holds_every_measure_with_its_unit(demos):
    measured("demos.csv", "--out", "table.csv")
    pausing, one, _, still = table("table.csv")

    assert (pausing["episode"], still["episode"]) == ("pausing", "still")
    assert float(pausing["mean speed [m/s]"]) == pytest.approx(LENGTH_M, rel=0.02)
    assert float(pausing["peak acceleration [m/s²]"]) == pytest.approx(5.7735 * LENGTH_M, rel=0.02)
    assert float(pausing["time in pauses [s]"]) == pytest.approx(1.0, rel=0.02)
    assert float(pausing["pace"]) == pytest.approx(3.0, rel=0.02)
    assert (one["pace"], one["pauses"], one["roundness"] != "") == ("", "0", True)
    assert set(still.values()) == {"still", "", "0"}


def test_motions_are_drawn_with_their_pauses(demos):
    measured("demos.csv", "--plot", "motions.svg")
    drawn = (demos / "motions.svg").read_text()

    for text in ("x [m]", "y [m]", "speed [m/s]", "time [s]", "pausing", "still below"):
        assert f">{text}<" in drawn
    measured("demos.csv", "--plot", "motions.png", "--episodes", "still")
    assert (demos / "motions.png").read_bytes().startswith(b"\x89PNG")


def test_three_dimensions_and_joints_are_drawn_too(arm):
    measured("demos.csv", "--channels", "shoulder", "elbow", "--plot", "joints.svg")
    assert "shoulder [rad]" in (arm / "joints.svg").read_text()
    place = through([(0, 0, 0), (0.1, 0, 0.3), (0.1, 0.05, 0)], 1.0, 0.4, 50.0)
    write_csv("space.csv", {"a": place}, channels=("x [m]", "y [m]", "z [m]"), rate_hz=50.0)
    measured("space.csv", "--plot", "space.svg")
    drawn = (arm / "space.svg").read_text()
    assert ">x [m]<" in drawn and ">z [m]<" in drawn and ">y [m]<" not in drawn


@pytest.mark.parametrize(
    ("channels", "options", "told"),
    [
        (("a [m]", "b [m]"), [], "the hand at a, b [m]"),
        (("a [m]", "b [cm]"), [], "the hand at a, b [m]"),
        (("u [px]", "v [px]"), [], "the hand at u, v [px]"),
        (("hand_y", "hand_x"), [], "the hand at hand_x, hand_y [no unit told]"),
        (("handX", "handY"), [], "the hand at handX, handY [no unit told]"),
        (("/hand.position[x]", "/hand.position[y]"), [], "the hand at /hand.position[x], /hand."),
        (("a", "b"), ["--hand", "b", "a"], "the hand at b, a [no unit told]"),
        (("a", "b"), ["--hand", "a", "b", "--unit", "a=cm"], "the hand at a, b [cm]"),
        (("max", "ymax"), [], "joints max, ymax [rad] (taken to be, where no unit is told);"),
        (("a [deg]", "b [rad]"), [], "joints a, b [rad];"),
        (("a [rad]", "force [N]"), [], "joints a [rad]"),
    ],
)
def test_the_hand_or_the_joints_are_found(demos, channels, options, told):
    write_csv("other.csv", {"a": strokes(1.0, 0.5, RATE_HZ)}, channels=channels, rate_hz=RATE_HZ)
    assert told in measured("other.csv", *options)


def test_units_of_one_quantity_are_brought_together(demos):
    path = strokes(1.0, 0.5, RATE_HZ, 3)
    write_csv(
        "mixed.csv", {"a": path * [100.0, 1.0]}, channels=("x [cm]", "y [m]"), rate_hz=RATE_HZ
    )
    measured("mixed.csv", "--out", "mixed_table.csv")
    measured("demos.csv", "--out", "table.csv")
    mixed, one = table("mixed_table.csv")[0], table("table.csv")[0]

    assert float(mixed["range [cm]"]) == pytest.approx(100 * float(one["range [m]"]))
    write_csv("deg.csv", {"a": np.rad2deg(path)}, channels=("a [deg]", "b [deg]"), rate_hz=RATE_HZ)
    measured("deg.csv", "--out", "deg_table.csv")
    speeds = float(table("deg_table.csv")[0]["mean speed [rad/s]"]), float(one["mean speed [m/s]"])
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-6)


def test_the_threshold_and_the_pauses_are_as_they_are_set(demos):
    output = measured("demos.csv", "--still", "0.02", "--shortest-pause", "0.7", "--window", "0.5")

    assert "smoothed over 0.5 s (25 rows); still below 0.02 m/s; a pause lasts 0.7 s" in output
    assert rows(output, "pausing")[2][1:] == ["0", "–", "0", "–", "–", "–", "0.02"]


def test_gaps_and_noise_are_told(demos):
    path = strokes(1.0, 0.5, RATE_HZ, 3)
    noisy = path + 0.002 * np.random.default_rng(0).normal(size=path.shape)
    times = np.delete(np.arange(len(path)), range(60, 80))
    lines = ["episode,time [s],x [m],y [m]"]
    lines += [f"gap,{i / RATE_HZ},{path[i, 0]},{path[i, 1]}" for i in times]
    lines += [f"noisy,{i / RATE_HZ},{x},{y}" for i, (x, y) in enumerate(noisy)]
    Path("bad.csv").write_text("\n".join(lines))
    output = measured("bad.csv")

    assert "! parted by gaps, on either side of which is measured apart: 'gap'" in output
    assert "% of the mean acceleration; a longer --window smooths more: 'noisy'" in output


def test_findings_are_told_and_refused_if_asked(demos):
    path = strokes(1.0, 0.5, RATE_HZ)
    path[100] += 1.0
    write_csv("spike.csv", {"a": path}, channels=XY, rate_hz=RATE_HZ)

    assert "a spike" in measured("spike.csv")
    assert "a spike" in refused("measure", "spike.csv", "--strict")


@pytest.fixture
def groups(demos):
    """Two files of motions: slow with long pauses, and quick with short ones."""
    rng = np.random.default_rng(0)
    for name, duration, rest in (("slow.csv", 1.3, 0.8), ("quick.csv", 0.8, 0.3)):
        motions = {
            f"{i}": strokes(duration + 0.1 * rng.random(), rest + 0.1 * rng.random(), RATE_HZ)
            for i in range(6 if name == "slow.csv" else 7)
        }
        write_csv(name, motions, channels=XY, rate_hz=RATE_HZ)
    return demos


def test_two_groups_are_compared(groups):
    output = measured(
        "slow.csv", "--against", "quick.csv", "--out", "both.csv", "--plot", "both.png"
    )

    *_, speed, tested = rows(output, "mean speed [m/s]")
    assert float(speed[3]) == pytest.approx(float(speed[1]) - float(speed[2]), abs=0.01)
    assert tested[1:] == ["-1.00", ".001", ".014"]
    *_, count, tested = rows(output, "pauses")
    assert count[1:] == ["3", "3", "0", "0 to 0"] and tested[1:] == ["+0.00", "1.000", "1.000"]
    assert "A is slow.csv (6), B is quick.csv (7)." in output
    both = table("both.csv")
    assert [row["group"] for row in both] == ["slow.csv"] * 6 + ["quick.csv"] * 7
    assert (groups / "both.png").read_bytes().startswith(b"\x89PNG")


def test_groups_are_told_apart_by_their_folders_and_brought_to_one_unit(groups):
    for folder in ("a", "b"):
        (groups / folder).mkdir()
    motions = {f"{i}": 100 * strokes(1.0, 0.5, RATE_HZ, 2 + i) for i in range(3)}
    write_csv("a/demos.csv", {n: m / 100 for n, m in motions.items()}, channels=XY, rate_hz=RATE_HZ)
    write_csv("b/demos.csv", motions, channels=("x [cm]", "y [cm]"), rate_hz=RATE_HZ)
    output = measured("a/demos.csv", "--against", "b/demos.csv", "--plot", "both.svg")

    assert "A is a/demos.csv (3), B is b/demos.csv (3)." in output
    *_, extent, _ = rows(output, "range [m]")
    assert extent[1] == extent[2]
    assert ">A: a/demos.csv<" in (groups / "both.svg").read_text()


@pytest.mark.parametrize("columns", ["80", "100", "200"])
def test_tables_fit_the_terminal_without_a_digit_left_out(groups, monkeypatch, columns):
    monkeypatch.setattr("typed.COLUMNS", columns)
    output = measured("slow.csv", "--against", "quick.csv")
    framed = [line for line in output.splitlines() if line[:1] in "┏┃┡│└"]

    assert framed and max(map(len, framed)) <= int(columns)
    assert "…" not in output


WRONG = {
    "one axis": (["demos.csv", "--hand", "x"], "--hand names the 2 or 3 channels of a position"),
    "no channel": (["demos.csv", "--hand", "x", "z"], "demos.csv: unknown channel 'z'"),
    "twice": (["demos.csv", "--hand", "x", "y", "--channels", "x"], "leave out --channels"),
    "two hands": (["hands.csv"], "positions are: left_x, left_y; right_x, right_y"),
    "force": (["force.csv"], "channel 'a' is in [N], neither a position nor an angle"),
    "units": (["demos.csv", "--hand", "x", "y", "--unit", "y=px"], "is in [px], which is no [m]"),
    "still": (["demos.csv", "--still", "0"], "still = 0.0: it must be finite and above 0"),
    "pause": (
        ["demos.csv", "--shortest-pause", "-1"],
        "pause_s = -1.0: it must be finite and above 0",
    ),
    "window": (["demos.csv", "--window", "nan"], "window_s = nan: it must be finite and above 0"),
    "no rate": (["rateless.csv"], "tells neither times nor a rate"),
    "table": (["demos.csv", "--out", "table.txt"], "--out table.txt: its name must end in .csv"),
    "picture": (["demos.csv", "--plot", "a.pdf"], "--plot a.pdf: its name must end in .svg, .png"),
    "joints": (
        ["demos.csv", "--against", "joints.csv"],
        "cannot be compared with the hand at x, y",
    ),
    "nothing": (["demos.csv", "--against", "no.csv"], "no.csv: there is no such file or folder"),
    "one episode": (["demos.csv", "--against", "single.csv"], "single.csv: holds 1 episode"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence(demos, arguments, told):
    two = {name: strokes(1.0, 0.5, RATE_HZ) for name in ("a", "b")}
    hands = ("left_x", "left_y", "right_x", "right_y")
    write_csv("hands.csv", {n: np.hstack([m, m]) for n, m in two.items()}, channels=hands)
    write_csv("force.csv", two, channels=("a [N]", "b [N]"))
    write_csv("joints.csv", two, channels=("a [rad]", "b [rad]"))
    write_csv("rateless.csv", two, channels=XY, rate_hz=None)
    write_csv("single.csv", {"a": two["a"]}, channels=XY)
    assert told in refused("measure", *arguments)


def test_the_arm_s_hand_is_measured_and_not_its_joints(arm):
    write_csv("demos.csv", {n: m for n, m in arm_motions().items() if n != "pull"})
    assert "4 episodes at 20 Hz, the hand at x, y [m]" in measured("demos.csv")
