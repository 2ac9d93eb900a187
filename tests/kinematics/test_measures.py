"""The measures of motions of which everything is known, and what must not change them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stroke_motions import LENGTH_M, arc, strokes, through

import motionese as mo
from motionese.errors import MotionError, SettingError
from motionese.kinematics import MEASURES

PER_LENGTH = ("speed", "peak_speed", "acceleration", "peak_acceleration", "range")
NUMBERS = tuple(name for name in MEASURES if name not in PER_LENGTH)


def near(value, rel=0.02):
    return pytest.approx(value, rel=rel)


@pytest.mark.parametrize("rate_hz", [25.0, 30.0, 60.0, 100.0, 200.0])
@pytest.mark.parametrize(("duration", "rest"), [(0.8, 0.6), (1.0, 0.3), (1.0, 0.5), (2.0, 1.0)])
def test_minimum_jerk_strokes_with_known_pauses(duration, rest, rate_hz):
    found = mo.measure(strokes(duration, rest, rate_hz, count=4), rate_hz)

    assert found.speed == near(LENGTH_M / duration)
    assert found.peak_speed == near(1.875 * LENGTH_M / duration)
    assert found.acceleration == near(3.75 * LENGTH_M / duration**2)
    assert found.peak_acceleration == near(5.7735 * LENGTH_M / duration**2)
    assert (found.pause_count, found.pause, found.pausing) == (3, near(rest), near(3 * rest))
    assert found.pace == near(4 * duration / (3 * rest))
    assert found.duration == near(4 * duration + 3 * rest)
    assert (found.range, found.roundness) == (near(LENGTH_M), near(1.0))
    assert found.repetitiveness == near(2.0)
    assert not found.undefined


def test_the_threshold_hardly_matters_where_rests_are_rests():
    found = mo.measure(strokes(1.0, 0.5, 100.0), 100.0)
    assert found.still == near(0.05 * 1.875 * LENGTH_M)
    assert found.pace_at_half == near(found.pace)
    assert found.pace_at_twice == near(found.pace)


def test_slow_steps_are_still_or_not_as_the_threshold_says():
    drift = 0.02 * np.arange(len(strokes(1.0, 0.5, 50.0, 2))) / 50.0
    path = strokes(1.0, 0.5, 50.0, 2) + drift[:, None] * [1.0, 0.0]

    assert mo.measure(path, 50.0, still=0.03).pause_count == 1
    below = mo.measure(path, 50.0, still=0.015)
    assert below.pause_count == 0 and math.isnan(below.pace)
    assert mo.measure(path, 50.0, pause_s=0.6).pause_count == 0


@pytest.mark.parametrize("angle", [0.5, math.pi / 2, math.pi, 1.5 * math.pi])
def test_arcs_of_known_roundness(angle):
    found = mo.measure(arc(angle, 1.5, 60.0), 60.0)
    assert found.roundness == near(angle / 2 / math.sin(angle / 2))


def test_roundness_of_several_ways_is_that_of_all_together():
    half, quarter = arc(math.pi, 1.0, 100.0), arc(math.pi / 2, 1.0, 100.0)
    turn = np.array([[-1.0, 0.0], [0.0, -1.0]])
    found = mo.measure(np.concatenate([half, quarter @ turn]), 100.0)

    assert found.pause_count == 1 and found.pause == near(0.8 + 0.01)
    assert found.roundness == near((math.pi + math.pi / 2) / (2 + math.sqrt(2)))


@pytest.mark.parametrize("rounds", [1, 2, 3])
def test_repetitions_are_counted_with_and_without_pauses(rounds):
    assert mo.measure(arc(2 * math.pi * rounds, 2.0 * rounds, 60.0), 60.0).repetitiveness == near(
        rounds
    )
    to_and_fro = strokes(1.0, 0.5, 60.0, 2 * rounds)
    assert mo.measure(to_and_fro, 60.0).repetitiveness == near(rounds)


@pytest.mark.parametrize(
    "places",
    [
        [(0, 0), (0.3, 0), (0, 0.1), (0.3, 0.1)],
        [(0, 0), (0.3, 0), (0.15, -0.2), (0.15, 0.2)],
    ],
    ids=["beside", "across"],
)
def test_a_way_beside_or_across_another_is_new(places):
    assert mo.measure(through(places, 1.0, 0.4, 60.0), 60.0).repetitiveness == near(1.0)


def test_a_way_near_another_is_a_repetition():
    places = [(0, 0), (0.3, 0), (0, 0.015), (0.3, 0.015)]
    assert mo.measure(through(places, 1.0, 0.4, 60.0), 60.0).repetitiveness == near(1.5)


def test_where_nothing_pauses_pace_and_roundness_are_undefined():
    times = np.arange(300)[:, None] / 50.0
    found = mo.measure(np.hstack([np.cos(2 * times), np.sin(2 * times)]), 50.0)

    assert found.undefined == {
        "pace": "no pause between movements",
        "pause": "no pause between movements",
        "roundness": "no movement from rest to rest",
    }
    assert all(math.isnan(getattr(found, name)) for name in found.undefined)
    assert math.isnan(found.pace_at_half) and math.isnan(found.pace_at_twice)
    assert (found.pause_count, found.pausing) == (0, 0.0)
    assert found.speed == near(2.0) and found.acceleration == near(4.0)


def test_one_motion_has_a_roundness_if_both_its_ends_rest():
    path = arc(math.pi, 1.0, 50.0)
    assert mo.measure(path, 50.0).roundness == near(math.pi / 2)
    cut = mo.measure(path[: len(path) - 40], 50.0)
    assert cut.undefined["roundness"] == "no movement from rest to rest"


def test_a_closed_way_has_no_roundness():
    found = mo.measure(arc(2 * math.pi, 1.5, 60.0), 60.0)
    assert found.undefined["roundness"] == "movements end where they began"


def test_what_does_not_move_has_no_measures():
    rng = np.random.default_rng(0)
    for path in (np.full((100, 2), 0.1), 1e-3 * rng.normal(size=(400, 3))):
        found = mo.measure(path, 50.0)
        assert dict.fromkeys(MEASURES, "nothing moves") == found.undefined
        assert all(map(math.isnan, found.numbers().values()))


def test_what_is_shorter_than_a_window_has_no_measures():
    found = mo.measure(np.zeros((5, 2)), 50.0)
    assert set(found.undefined.values()) == {"fewer than 13 rows in a piece"}


def test_strokes_without_a_rest_are_one_movement():
    assert mo.measure(strokes(1.0, 0.0, 100.0), 100.0).pause_count == 0


def measured_as(found, expected, *, scale=1.0, seconds=1.0, rel=1e-6):
    """Compare measures of a motion and of the same one in other units of length and time."""
    powers = {"speed": 1, "peak_speed": 1, "acceleration": 2, "peak_acceleration": 2}
    powers |= dict.fromkeys(("duration", "pause", "pausing"), -1)
    for name, value in expected.numbers().items():
        factor = (scale if name in PER_LENGTH else 1.0) / seconds ** powers.get(name, 0)
        assert getattr(found, name) == pytest.approx(factor * value, rel=rel), name


@given(
    turn=st.floats(-math.pi, math.pi),
    shift=st.tuples(st.floats(-10, 10), st.floats(-10, 10)),
    scale=st.floats(1e-3, 1e3),
)
def test_turned_shifted_and_scaled_it_is_the_same_motion(turn, shift, scale):
    path = np.concatenate([strokes(1.0, 0.5, 50.0, 3), strokes(0.8, 0.4, 50.0, 3) * [1.0, -2.0]])
    turned = path @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    found = mo.measure(scale * (turned + shift), 50.0)
    measured_as(found, mo.measure(path, 50.0), scale=scale, rel=1e-4)


@given(rate_hz=st.floats(25, 200), lead=st.floats(0.2, 1.0))
def test_at_any_rate_it_is_the_same_motion(rate_hz, lead):
    found = mo.measure(strokes(1.0, 0.6, rate_hz, lead=lead), rate_hz)
    measured_as(found, mo.measure(strokes(1.0, 0.6, 200.0), 200.0), rel=0.02)


@given(seed=st.integers(0, 1000), rate_hz=st.sampled_from([50.0, 100.0, 200.0]))
def test_small_noise_changes_little(seed, rate_hz):
    path = strokes(1.0, 0.6, rate_hz)
    noise = np.random.default_rng(seed).normal(size=path.shape) * LENGTH_M / 5000
    found, clean = mo.measure(path + noise, rate_hz), mo.measure(path, rate_hz)
    assert found.pause_count == clean.pause_count
    for name, value in clean.numbers().items():
        rel = 0.15 if name == "peak_acceleration" else 0.03
        assert getattr(found, name) == pytest.approx(value, rel=rel), name


@given(rate_hz=st.sampled_from([50.0, 100.0]), faster=st.sampled_from([0.5, 2.0]))
def test_in_another_tempo_only_what_has_time_in_it_changes(rate_hz, faster):
    # In time that runs otherwise, the window and the shortest pause do too.
    path = strokes(1.0, 0.6, rate_hz)
    found = mo.measure(path, faster * rate_hz, window_s=0.25 / faster, pause_s=0.15 / faster)
    measured_as(found, mo.measure(path, rate_hz), seconds=1 / faster, rel=0.02)


def test_missing_rows_change_little():
    path = strokes(1.0, 0.6, 100.0)
    rng = np.random.default_rng(3)
    gappy = path.copy()
    gappy[rng.random(len(path)) < 0.2] = np.nan
    gappy[230:236, 0] = np.nan
    measured_as(mo.measure(gappy, 100.0), mo.measure(path, 100.0), rel=0.02)
    seen = ~np.isnan(gappy)
    measured_as(mo.measure(path, 100.0, observed=seen), mo.measure(gappy, 100.0))
    measured_as(mo.measure(path, 100.0, observed=seen.all(axis=1)), mo.measure(gappy, 100.0))


def test_what_lies_beyond_a_long_gap_is_measured_apart():
    path = strokes(1.0, 0.6, 100.0, 4)
    path[int(100 * (0.4 + 1.0 + 0.2)) : int(100 * (0.4 + 1.0 + 0.4))] = np.nan
    found = mo.measure(path, 100.0)

    assert len(found.tracks) == 2 and len(found.movements) == 4
    # The pause that the gap lies in is none: nobody saw that the hand stayed.
    assert found.pause_count == 2 and found.pause == near(0.6)
    assert found.duration == near(1.0 + 3 * 1.0 + 2 * 0.6)


def test_joints_and_three_dimensions_are_measured_alike():
    flat = strokes(1.0, 0.5, 50.0)
    spread = flat @ np.linalg.qr(np.random.default_rng(4).normal(size=(7, 7)))[0][:2]
    measured_as(mo.measure(spread, 50.0), mo.measure(flat, 50.0), rel=1e-4)
    measured_as(mo.measure(np.c_[flat, 0 * flat[:, 0]], 50.0), mo.measure(flat, 50.0))


def test_where_pauses_are_is_told():
    found = mo.measure(strokes(1.0, 0.5, 100.0, 3), 100.0)
    first, second = found.pauses

    assert (first.start_s, first.end_s) == pytest.approx((1.4, 1.9), abs=0.01)
    np.testing.assert_allclose(first.position, [0.24, 0.18], atol=0.002)
    np.testing.assert_allclose(second.position, [0.0, 0.0], atol=0.002)
    assert [m.seconds for m in found.movements] == pytest.approx([1.0] * 3, abs=0.02)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"path": np.zeros(5)}, "a path is an array \\[T, D\\], got shape \\(5,\\)"),
        ({"path": np.zeros((5, 0))}, "got shape \\(5, 0\\)"),
        ({"rate_hz": 0.0}, "rate_hz must be finite and > 0, got 0.0"),
        ({"rate_hz": math.inf}, "rate_hz must be finite"),
        ({"observed": np.ones((3, 2), dtype=bool)}, "observed has shape \\(3, 2\\)"),
        ({"path": np.full((9, 2), math.inf)}, "row 0 of the path is not finite"),
    ],
)
def test_what_is_no_path_is_refused(unchecked, given, told):
    with pytest.raises(MotionError, match=told):
        mo.measure(**{"path": np.zeros((30, 2)), "rate_hz": 50.0} | given)


@pytest.mark.parametrize("name", ["still", "pause_s", "window_s"])
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_settings_are_above_zero(name, value):
    with pytest.raises(SettingError, match=f"{name} = {value}: it must be finite and above 0"):
        mo.measure(np.zeros((30, 2)), 50.0, **{name: value})
