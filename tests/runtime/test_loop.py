"""The control loop by a clock of the test's own: what is sent, when, and how it ends."""

from dataclasses import replace

import numpy as np
import pytest
from small_models import Clock

from motionese.errors import ControlError
from motionese.runtime import (
    ControlLoop,
    Ending,
    Limits,
    OnlineRecognition,
    Part,
    Player,
    control_loop,
)
from motionese.runtime.schedule import schedule
from motionese.runtime.timing import Watchdog

HERE = {"lift": 0.4, "turn": -20.0, "grip": 0.5}
WIDE = Limits(ranges={"lift": (-9, 9), "turn": (-999, 999), "grip": (-9, 9)})


class Robot:
    """Records what it is sent and when; `delays` [s] are what some commands take."""

    def __init__(self, clock, delays=None):
        self.clock, self.delays = clock, delays or {}
        self.sent, self.times, self.stops = [], [], 0

    def act(self, commands):
        self.clock.time += self.delays.get(len(self.sent), 0.001)
        self.sent.append(list(commands.values()))
        self.times.append(round(self.clock.time - 100.0, 6))

    def stop(self):
        self.stops += 1


@pytest.fixture
def robot():
    return Robot(Clock())


@pytest.fixture(autouse=True)
def a_machine_that_is_never_too_slow(monkeypatch):
    """The loop's time is pretended here, the watchdog's is not: it waits far longer than is set."""
    monkeypatch.setattr(control_loop, "Watchdog", lambda seconds, stop: Watchdog(600.0, stop))


def loop_of(model, robot, sense=lambda: HERE, **settings):
    settings = {"limits": WIDE, "stop": robot.stop, "clock": robot.clock, **settings}
    return ControlLoop(model, sense, robot.act, **settings)


def test_the_loop_sends_what_the_player_plays_from_where_the_robot_is(model, robot):
    ran = loop_of(model, robot).run("reach")

    player = Player(model, model.begin("reach", HERE))
    player.set_out(schedule(model, ("reach",))[0].blend)
    np.testing.assert_allclose(robot.sent, [player.step() for _ in range(40)], rtol=1e-6)
    assert (ran.ending, ran.steps, ran.missed, ran.skipped) == (Ending.DONE, 40, 0, 0)
    assert ran.sentence == "everything was played to its end, 40 steps"
    assert robot.stops == 0


def test_readings_are_mixed_in_and_missing_ones_predicted(model, robot):
    readings = [HERE, {"lift": -0.5}, None, {"turn": 10.0, "lift": 0.0}, {"grip": np.nan}]
    given = iter(readings)
    loop_of(model, robot, lambda: next(given), share={"lift": 0.5, "grip": 1.0}).run(
        Part("wave", 5, blend=0)
    )

    player = Player(model, model.begin("wave", HERE), {"lift": 0.5, "grip": 1.0})
    np.testing.assert_allclose(robot.sent, [player.step(r) for r in readings], rtol=1e-6)


def test_parts_follow_one_another(model, robot):
    state = model.initial("wave")
    first, second, third = Part("reach", blend=0), Part(state, 25, blend=10), Part("wave", blend=0)
    ran = loop_of(model, robot).run(first, second, third)

    player = Player(model, model.begin("reach", HERE))
    expected = [player.step() for _ in range(40)]
    player.blend_to("wave", 10)
    expected += [player.step() for _ in range(25)]
    player.blend_to("wave", 0)
    expected += [player.step() for _ in range(31)]
    np.testing.assert_allclose(robot.sent, expected, rtol=1e-6)
    assert ran.steps == 96


def test_a_fraction_of_a_step_is_refused_before_the_first_part_is_played(unchecked, model, robot):
    for part, match in (
        (Part("wave", 2.5), r"'wave' must be played for a whole number of steps, .* got 2\.5"),
        (Part("wave", 5, blend=1.5), r"its blend must be 0 to its 5 steps, got 1\.5"),
    ):
        with pytest.raises(ControlError, match=match):
            loop_of(model, robot).run("reach", part)
    assert (robot.sent, robot.stops) == ([], 0)


def test_cycles_keep_to_a_grid_of_time(model, robot):
    robot.delays = {n: 0.001 * (n % 7) for n in range(100)}
    ran = loop_of(model, robot).run(Part("reach", 100))

    np.testing.assert_allclose(robot.times, [0.05 * n + 0.001 * (n % 7) for n in range(100)])
    assert ran.worst_lateness_s == pytest.approx(0.006)
    assert (ran.missed, ran.skipped) == (0, 0)


def test_missed_deadlines_are_counted_and_not_caught_up(model, robot):
    robot.delays = {2: 0.06, 4: 0.17}
    ran = loop_of(model, robot).run(Part("reach", 6))

    begun = [0.0, 0.05, 0.1, 0.2, 0.25, 0.45]
    np.testing.assert_allclose(
        robot.times, np.add(begun, [0.001, 0.001, 0.06, 0.001, 0.17, 0.001]), atol=1e-9
    )
    assert (ran.missed, ran.skipped, ran.steps) == (2, 1 + 3, 6)
    assert ran.worst_lateness_s == pytest.approx(0.17)


def test_limits_hold_from_the_first_command_on(model, robot):
    limits = Limits(ranges={"turn": (-25.0, 30.0)}, speeds={"lift": 0.2})
    ran = loop_of(model, robot, limits=limits).run("reach")

    path = np.array([list(HERE.values()), *robot.sent])
    assert np.abs(np.diff(path[:, 0])).max() <= 0.2 / 20 + 1e-9
    assert path[:, 1].min() >= -25.0
    assert ran.slowed["lift"] > 0
    assert sum(ran.slowed.values()) == ran.slowed["lift"]


def test_the_first_command_is_near_where_the_robot_is(model, robot):
    here = {"lift": 2.6, "turn": 80.0, "grip": 0.5}
    ran = loop_of(
        model, robot, lambda: here, limits=Limits(speeds={"lift": 1.0, "turn": 20.0})
    ).run("reach")

    np.testing.assert_allclose(robot.sent[0][:2], [2.55, 79.0])
    assert (np.abs(np.diff(robot.sent, axis=0)).max(0)[:2] <= [0.0500001, 1.0000001]).all()
    assert ran.clamped["turn"] > 0


@pytest.mark.parametrize("at", [-4.1, 5.1, 65535.0])
def test_a_first_reading_that_cannot_be_is_refused_before_anything_is_sent(model, robot, at):
    match = rf"first reading: channel 'lift' is at {at:g}, far outside its limits -1 to 2: check"
    with pytest.raises(ControlError, match=match):
        loop_of(model, robot, lambda: {"lift": at, "turn": 0.0}, limits=Limits()).run("reach")

    assert (robot.sent, robot.stops) == ([], 1)
    wider = Limits(ranges={"lift": (-6.0, 6.0)}) if abs(at) < 6 else Limits({"lift": (0, 9e4)})
    assert loop_of(model, robot, lambda: {"lift": at}, limits=wider).run("reach").steps == 40


def test_nothing_is_sent_before_the_robot_has_said_where_it_is(model, robot):
    readings = iter([None, {}, {"lift": np.nan}])
    ran = loop_of(model, robot, lambda: next(readings, HERE)).run(Part("reach", 3))

    assert ran.steps == 3
    assert robot.times[0] == pytest.approx(0.151)

    silent = loop_of(model, robot, lambda: None, watchdog_s=0.3).run("reach")
    assert (silent.ending, silent.steps) == (Ending.SENSORS_SILENT, 0)
    assert len(robot.sent) == 3


def test_sensors_that_fall_silent_end_the_loop_and_stop_the_robot(model, robot):
    def sense():
        return HERE if robot.clock.time < 100.52 else None

    ran = loop_of(model, robot, sense, watchdog_s=0.22).run("reach")

    assert ran.ending is Ending.SENSORS_SILENT
    assert ran.sentence == (
        "no reading came for more than 0.22 s; the last command sent is that of step 15"
    )
    assert (len(robot.sent), ran.steps, robot.stops) == (15, 15, 1)


def test_end_ends_the_loop_before_its_next_command(model, robot):
    loop = loop_of(model, robot, lambda: loop.end() if len(robot.sent) == 4 else HERE)
    ran = loop.run("reach")

    assert (ran.ending, ran.steps, len(robot.sent)) == (Ending.STOPPED, 4, 4)
    assert ran.sentence == "the loop was asked to end, after 4 steps"
    assert robot.stops == 0


def test_what_asks_to_end_before_a_run_ends_that_run_alone(model, robot):
    loop = loop_of(model, robot)
    loop.end()

    assert (loop.run("reach").ending, robot.sent) == (Ending.STOPPED, [])
    assert loop.run("reach").ending is Ending.DONE


@pytest.mark.parametrize("where", ["sense", "act"])
@pytest.mark.parametrize("error", [OSError("bus error"), KeyboardInterrupt()])
def test_errors_stop_the_robot_and_are_raised(model, robot, monkeypatch, where, error):
    def fails(*_):
        if len(robot.sent) == 3:
            raise error
        return HERE if where == "sense" else plain(*_)

    plain = robot.act
    sense = fails if where == "sense" else lambda: HERE
    monkeypatch.setattr(robot, "act", fails if where == "act" else plain)
    with pytest.raises(type(error)):
        loop_of(model, robot, sense).run("reach")

    assert (len(robot.sent), robot.stops) == (3, 1)


def test_a_reading_that_does_not_fit_stops_the_robot(model, robot):
    with pytest.raises(ControlError, match="reading: unknown channel 'elbow'"):
        loop_of(model, robot, lambda: {"elbow": 0.1}).run("reach")

    assert (robot.sent, robot.stops) == ([], 1)


def test_a_prediction_that_is_not_finite_is_never_sent(model, robot):
    bias = np.where(np.arange(12) == 8, np.float32(3e38), model.bias)
    weights = np.where(np.arange(12)[:, None] == 3, 0, model.weights)
    weights[0, 8] = weights[0, 9] = 3e38
    broken = replace(model, bias=bias, weights=weights, tau=np.ones(12, np.float32))

    with np.errstate(over="ignore", invalid="ignore"):
        ran = loop_of(broken, robot).run("reach")

    assert ran.ending is Ending.NOT_FINITE
    assert (len(robot.sent), robot.stops) == (ran.steps, 1)
    assert np.isfinite(robot.sent).all()
    assert "not finite; it was not sent" in ran.sentence


@pytest.mark.parametrize(
    ("settings", "match"),
    [
        ({"rate_hz": 40.0}, r"at 40 Hz, but the model learned .* 20 Hz: .*model.with_rate\(40\)"),
        ({"rate_hz": 0.0}, "rate_hz must be finite and > 0, got 0"),
        ({"watchdog_s": 0.1}, r"two periods \(0\.1 s at 20 Hz\), got 0\.1 s"),
        ({"watchdog_s": np.inf}, "must be finite and more than two periods"),
        ({"share": 2.0}, "must be 0 to 1, got 2"),
        ({"limits": Limits(speeds={"left": 1.0})}, "unknown channel 'left'"),
    ],
)
def test_settings_that_cannot_be_are_refused_at_once(model, robot, settings, match):
    with pytest.raises(ControlError, match=match):
        loop_of(model, robot, **settings)


def test_a_model_without_a_rate_is_given_one(model, robot):
    untold = replace(model, rate_hz=None)
    with pytest.raises(ControlError, match="does not tell its rate: give rate_hz"):
        loop_of(untold, robot)
    assert loop_of(untold, robot, rate_hz=10.0).run(Part("reach", 3)).steps == 3
    np.testing.assert_allclose(robot.times, [0.001, 0.101, 0.201])
    assert loop_of(model.with_rate(40.0), robot, rate_hz=40.0).run("reach").steps == 80


@pytest.mark.parametrize(
    ("parts", "match"),
    [
        ((), "nothing to play"),
        (("rech",), "unknown initial state 'rech'; did you mean 'reach'"),
        ((Part("reach", 0),), "motion 'reach' must be played for .*, 1 or more, got 0"),
        ((Part(np.zeros(12)),), "a motion: the model does not tell how long it is; give its steps"),
        (("reach", Part("wave", 5, blend=6)), "its blend must be 0 to its 5 steps, got 6"),
        (("reach", Part(np.zeros(3), 5)), r"one value per unit \(12\), got shape \(3,\)"),
    ],
)
def test_parts_that_cannot_be_played_are_refused_before_anything_is_sent(
    model, robot, parts, match
):
    with pytest.raises(ControlError, match=match):
        loop_of(model, robot).run(*parts)
    assert (robot.sent, robot.stops) == ([], 0)


def shown(model, name):
    """Readings of a learned motion while somebody shows it."""
    player = Player(model, model.begin(name))
    rows = [player.row, *(player.step() for _ in range(39))]
    return [dict(zip(model.channels, row.tolist(), strict=True)) for row in rows]


@pytest.mark.parametrize("lag", [0, 1, 3])
def test_it_follows_what_is_shown_so_many_rows_behind(model, robot, lag):
    rows = shown(model, "reach")
    given = iter(rows)
    recognition = OnlineRecognition(model, window=12)

    ran = loop_of(model, robot, lambda: next(given)).follow(recognition, 30, lag=lag)

    assert (ran.ending, ran.steps) == (Ending.DONE, 30)
    due = np.array([list(row.values()) for row in rows])[10 + 1 - lag : 31 - lag]
    np.testing.assert_allclose(robot.sent[10:], due, atol=0.05 * 135)
    first = list(rows[0].values())
    for sent in robot.sent[: max(lag, 1) - 1]:
        np.testing.assert_allclose(sent, first, rtol=1e-6)


def test_it_holds_still_while_nothing_it_knows_is_shown(model, robot):
    rng = np.random.default_rng(0)
    strange = rng.uniform((-1.0, -90.0, 0.0), (2.0, 45.0, 1.0), (20, 3))
    given = iter(strange)
    loop_of(model, robot, lambda: next(given)).follow(OnlineRecognition(model), 20)
    assert np.ptp(robot.sent[8:], axis=0).max() == 0


def test_it_follows_until_sensors_fall_silent(model, robot):
    given = iter([*shown(model, "reach")[:5], *[None] * 100])
    ran = loop_of(model, robot, lambda: next(given)).follow(OnlineRecognition(model), 90)
    assert ran.ending == Ending.SENSORS_SILENT
    assert robot.stops == 1


def test_what_cannot_be_followed_is_told(model, robot):
    loop = loop_of(model, robot)
    with pytest.raises(ControlError, match="must have the same model"):
        loop.follow(OnlineRecognition(replace(model)), 5)
    with pytest.raises(ControlError, match="lag and steps must be 0 or more, got -1 and 5"):
        loop.follow(OnlineRecognition(model), 5, lag=-1)
    with pytest.raises(ControlError, match="a lag of 0 sends what is predicted"):
        loop.follow(OnlineRecognition(model, ahead=0), 5, lag=0)
    assert not robot.sent
