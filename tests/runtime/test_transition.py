"""From one motion to another: as many rows as the library takes, told before the robot moves."""

from itertools import product

import numpy as np
import pytest
from small_models import CHANNELS, INITIAL_IO, Clock

from motionese import generate_sequence
from motionese.runtime import ControlLoop, Limits, Part, Player
from motionese.runtime.schedule import Course, course, rows_between, schedule

WIDTHS = CHANNELS.interval_widths
WIDE = Limits(ranges={"lift": (-9, 9), "turn": (-999, 999), "grip": (-9, 9)})


def sent(model, *parts, sense):
    """What a robot is sent that senses this."""
    rows = []
    act = lambda commands: rows.append([*commands.values()])  # noqa: E731
    ControlLoop(model, sense, act, limits=WIDE, clock=Clock()).run(*parts)
    return np.array(rows)


def recorded(model, start):
    """A robot that is where a motion was recorded, and does not move from there."""
    return Player(model, model.begin(start)).row


def apart(path, library):
    return np.abs((path - library) / WIDTHS).max()


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
@pytest.mark.parametrize(("first", "steps"), [*product(("reach", "wave"), (21, 40, 100))])
def test_a_sequence_is_the_library_s(model, saved, first, steps):
    _, network, states = saved
    other, lengths = {"reach": "wave", "wave": "reach"}[first], {"reach": 41, "wave": 31}
    order = [0, 1] if first == "reach" else [1, 0]

    here = dict(zip(CHANNELS.names, recorded(model, first), strict=True))
    library = generate_sequence(network, states[order], [lengths[first], steps], here=here)
    path = sent(model, first, Part(other, steps), sense=lambda: recorded(model, first))

    assert apart(path, library[1:]) < 1e-5
    at_once = sent(model, first, Part(other, steps, blend=0), sense=lambda: recorded(model, first))
    assert apart(at_once, library[1:]) > 0.05


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
@pytest.mark.parametrize("scale", [1.0, 1.5])
def test_initial_states_follow_one_another_as_named_motions_do(model, saved, scale):
    _, network, states = saved
    slower = model.with_duration(scale)

    here = dict(zip(CHANNELS.names, recorded(model, "reach"), strict=True))
    library = generate_sequence(network, states, [50, 60], duration=scale, here=here)
    parts = [Part(states[0], 49), Part(states[1], 60)]
    path = sent(slower, *parts, sense=lambda: recorded(model, "reach"))

    assert apart(path, library[1:]) < 1e-5


def test_the_way_from_where_the_robot_is_adds_no_speed(model):
    """A robot that is elsewhere rushes to the first motion; what follows is no faster for it."""
    first = Part("reach", blend=0)
    path = sent(model, first, Part("wave", 200), sense=lambda: [1.9, 40.0, 0.05])
    former, latter = course(model, "reach", 41), course(model, "wave", 200)
    rows = rows_between(former, latter, path[40])

    given = sent(model, first, Part("wave", 200, blend=rows), sense=lambda: [1.9, 40.0, 0.05])

    rushed = np.abs(np.diff(path[:40], axis=0)).max(0) > former.speed
    assert rushed.any()
    np.testing.assert_array_equal(path, given)


def test_every_part_is_played_beforehand_as_long_as_it_will_be(model, monkeypatch):
    played = []

    def course(_, start, rows):
        played.append((start, rows))
        return Course(np.zeros(3), np.full(3, {"reach": 0.1, "wave": 0.01}[start]), rows)

    monkeypatch.setattr("motionese.runtime.schedule.course", course)
    first, last = Part("reach", blend=0), Part("wave", blend=3)
    parts = schedule(model, (first, Part("wave", 200), Part("wave", 900), last))

    assert played == [("reach", 41), ("wave", 200), ("wave", 900), ("wave", 31)]
    assert [part.steps for part in parts] == [40, 200, 900, 31]
    here = np.array([2.0, 0.0, 0.0])
    assert [part.blend(here) for part in parts[1:3]] == [38, 375]  # 1.875 · 2 / 0.1, / 0.01
    assert (parts[0].blend, parts[3].blend) == (0, 3)


def test_what_has_its_blends_is_not_played_beforehand(model, monkeypatch):
    monkeypatch.setattr("motionese.runtime.schedule.course", lambda *_: pytest.fail("played"))

    first = Part("reach", blend=0)
    schedule(model, (first,))
    schedule(model, (first, Part("wave", blend=0), Part("reach", blend=20)))


@pytest.mark.parametrize(
    ("here", "speed", "rows", "expected"),
    [
        ([0.0, 0.0], [0.1, 0.1], 100, 10),  # already there
        ([3.0, 0.0], [0.1, 0.1], 200, 57),  # 1.875 · 3 / 0.1, rounded up
        ([0.0, -3.0], [0.1, 0.2], 200, 29),
        ([3.0, 0.0], [0.1, 0.1], 40, 20),  # no more than half
        ([3.0, 0.0], [0.0, 0.1], 40, 20),  # it never moves there by itself
        ([0.0, 0.0], [0.0, 0.0], 40, 10),
        ([np.nan, 0.0], [0.1, 0.1], 40, 20),
        ([0.0, 0.0], [0.1, 0.1], 5, 2),
        ([3.0, 0.0], [0.1, 0.1], 1, 0),
    ],
)
def test_rows_of_a_transition(here, speed, rows, expected):
    faster = Course(np.zeros(2), np.array(speed), 50)
    slower = Course(np.zeros(2), 0.9 * np.array(speed), rows)

    assert rows_between(faster, slower, np.array(here)) == expected
    if rows > 50:
        faster = Course(np.zeros(2), np.array(speed), rows)
        assert rows_between(slower, faster, np.array(here)) == expected


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
@pytest.mark.parametrize("here", [[1.9, 40.0, 0.05], [-1.0, -60.0, 0.02]])
def test_the_first_part_sets_out_from_standing_still_as_in_the_library(model, saved, here):
    _, network, states = saved
    told = dict(zip(CHANNELS.names, here, strict=True))

    library = generate_sequence(network, states[:1], [200], here=told)
    path = sent(model, Part("reach", 199), sense=lambda: here)

    assert apart(path, library[1:]) < 1e-5
    rushing = sent(model, Part("reach", 199, blend=0), sense=lambda: here)
    first_step = np.abs(np.stack([path[0], rushing[0]]) - here) / WIDTHS
    assert first_step[0].max() < 0.1 * first_step[1].max()
