"""Playing: beginning where the robot is, mixing, passing to another motion, another duration."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_models import CHANNELS, INITIAL_IO, written

from motionese import generate
from motionese.errors import ControlError, SettingError
from motionese.learning.generation.chain import generate_sequence
from motionese.runtime import Player, load

WIDTHS = CHANNELS.interval_widths


def unit(values):
    return (np.asarray(values) - [-1.0, -90.0, 0.0]) / [3.0, 135.0, 1.0] * 0.8 + 0.1


def test_a_motion_begins_where_the_robot_is(model):
    state = model.begin("reach", {"lift": 0.7, "grip": None, "turn": np.nan})
    learned = model.initial("reach")

    assert Player(model, state).row[0] == pytest.approx(0.7, abs=1e-6)
    assert state.u[0] == pytest.approx(np.log(unit([0.7, 0, 0])[0] / (1 - unit([0.7, 0, 0])[0])))
    np.testing.assert_array_equal(state.u[1:], learned[1:])
    every = model.begin("reach", [0.7, -30.0, 0.2])
    np.testing.assert_allclose(Player(model, every).row, [0.7, -30.0, 0.2], rtol=1e-5)
    np.testing.assert_array_equal(every.u[3:], learned[3:])


def test_a_network_that_begins_at_zero_takes_the_place_as_its_first_input(tmp_path):
    written(tmp_path / "m", initial_io="zero")
    model = load(tmp_path / "m")
    here = [0.7, -30.0, 0.2]

    state = model.begin("reach", here)
    np.testing.assert_array_equal(state.u, model.initial("reach"))
    placed, forced = Player(model, state), Player(model, model.begin("reach"), share=1.0)

    np.testing.assert_allclose(placed.row, here, rtol=1e-5)
    np.testing.assert_allclose(placed.step(), forced.step(here), rtol=1e-5)


def test_what_is_sensed_is_mixed_channel_by_channel(model):
    here = np.array([0.5, -20.0, 0.5])
    partly = Player(model, model.begin("reach"), {"turn": 1.0}).step(here)

    def forced(reading):
        return Player(model, model.begin("reach"), 1.0).step(reading)

    np.testing.assert_allclose(partly, forced({"turn": -20.0}))
    assert not np.allclose(partly, forced(here))
    for nothing in (None, {}, [np.nan] * 3, [np.inf, np.nan, -np.inf], {"lift": None}):
        closed = Player(model, model.begin("reach")).step()
        np.testing.assert_array_equal(forced(nothing), closed)


@pytest.mark.parametrize(
    ("reading", "match"),
    [
        ({"lfit": 0.5}, "reading: unknown channel 'lfit'; did you mean 'lift'"),
        ([0.5, 0.5], r"one value per channel \(lift, turn, grip\), got shape \(2,\)"),
        ({"lift": "up"}, "a reading must hold numbers, got .*'up'"),
    ],
)
def test_readings_that_do_not_fit_are_refused(unchecked, model, reading, match):
    with pytest.raises(ControlError, match=match):
        Player(model, model.begin("reach")).step(reading)


def test_settings_out_of_range_are_refused(unchecked, model):
    for share in (1.1, -0.1, np.nan, {"lift": 2.0}):
        with pytest.raises(ControlError, match="sensed must be 0 to 1, got"):
            Player(model, model.begin("reach"), share)
    with pytest.raises(ControlError, match="share: unknown channel 'left'"):
        Player(model, model.begin("reach"), {"left": 0.5})
    with pytest.raises(ControlError, match="unknown initial state 'rech'; did you mean 'reach'"):
        model.begin("rech")
    with pytest.raises(ControlError, match=r"one value per unit \(12\), got shape \(11,\)"):
        model.begin(np.zeros(11))
    with pytest.raises(ControlError, match="initial states must be finite"):
        model.begin(np.full(12, np.nan))
    with pytest.raises(ControlError, match="a blend takes 0 steps or more, got -1"):
        Player(model, model.begin("reach")).blend_to("wave", -1)


def test_a_blend_goes_from_one_path_to_the_other(model):
    steps, before = 8, 5
    player = Player(model, model.begin("reach"))
    former = Player(model, model.begin("reach"))
    for _ in range(before):
        player.step()
        former.step()

    player.blend_to("wave", steps)

    first = former.step()
    np.testing.assert_array_equal(player.step(), first)
    latter = Player(model, model.begin("wave", first))
    for k in range(1, steps + 4):
        s = min(k / steps, 1.0)
        weight = 10 * s**3 - 15 * s**4 + 6 * s**5
        expected = (1 - weight) * former.step() + weight * latter.step()
        np.testing.assert_allclose(player.step(), expected, rtol=1e-5, atol=1e-5)


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
@pytest.mark.parametrize("blend", [0, 1, 2, 15])
def test_a_sequence_is_the_library_s(model, saved, blend):
    _, network, states = saved
    player = Player(model, model.begin("reach"))
    path = [player.row, *(player.step() for _ in range(39))]
    for name in ("wave", "reach"):
        player.blend_to(name, blend)
        path += [player.step() for _ in range(30)]

    library = generate_sequence(network, list(states[[0, 1, 0]]), [40, 30, 30], blend=blend)
    np.testing.assert_allclose(path / WIDTHS, library / WIDTHS, atol=1e-5)


@given(before=st.integers(1, 40), steps=st.integers(4, 40))
def test_a_blend_never_jumps(model, before, steps):
    """No step is larger than the larger of the two paths' own, and their drawing together."""
    player, former = (Player(model, model.begin("reach")) for _ in range(2))
    for _ in range(before):
        player.step()
        former.step()
    path = [player.row]
    player.blend_to("wave", steps)
    path += [player.step() for _ in range(steps + 5)]
    start = former.row
    first = former.step()
    latter = Player(model, model.begin("wave", first))
    ways = [(start, start), (first, first)]
    ways += [(former.step(), latter.step()) for _ in range(steps + 4)]

    own = np.abs(np.diff(ways, axis=0)).max((0, 1))
    apart = np.abs(np.subtract(*np.swapaxes(ways, 0, 1))).max(0)
    assert (np.abs(np.diff(path, axis=0)).max(0) <= own + 1.9 / steps * apart + 1e-4).all()


def test_a_blend_is_not_begun_during_another(model):
    player = Player(model, model.begin("reach"))
    player.blend_to("wave", 3)
    player.step()
    with pytest.raises(ControlError, match="the blend before this one has 2 steps to go"):
        player.blend_to("reach", 3)
    player.step()
    player.step()
    player.blend_to("reach", 3)


def test_without_a_blend_the_next_motion_sets_out_from_the_same_place(model):
    player, former = (Player(model, model.begin("reach")) for _ in range(2))
    player.blend_to("wave", 0)

    first = former.step()
    np.testing.assert_array_equal(player.step(), first)
    np.testing.assert_allclose(player.step(), Player(model, model.begin("wave", first)).step())


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
def test_another_duration_is_the_library_s(model, saved):
    _, network, states = saved
    slower = model.with_duration(1.5)
    player = Player(slower, slower.begin("wave"))
    path = [player.row, *(player.step() for _ in range(49))]

    library = generate(network.lasting(1.5), states[1], 50)
    np.testing.assert_allclose(path / WIDTHS, library / WIDTHS, atol=1e-5)


def test_another_duration_scales_the_time_constants(model):
    slower = model.with_duration(2.0)
    faster = slower.with_duration(0.5).with_duration(0.8)

    np.testing.assert_allclose(slower.tau, 2 * model.tau)
    np.testing.assert_allclose(faster.tau, 0.8 * model.tau, rtol=1e-6)
    assert dict(slower.lengths) == {"reach": 81, "wave": 61}
    assert dict(faster.lengths) == {"reach": 33, "wave": 25}
    assert slower.rate_hz == model.rate_hz
    for scale in (0.49, 2.01, np.nan):
        with pytest.raises(SettingError, match=r"must lie between 0\.5 and 2, got"):
            model.with_duration(scale)


def test_another_rate_keeps_the_seconds(model, tmp_path):
    quicker = model.with_rate(40.0)

    assert quicker.rate_hz == 40.0
    np.testing.assert_allclose(quicker.tau, 2 * model.tau)
    assert dict(quicker.lengths) == {"reach": 81, "wave": 61}
    with pytest.raises(ControlError, match="a model of 20 Hz can be run at 10 to 40 Hz, got 50 Hz"):
        model.with_rate(50.0)
    written(tmp_path / "m")
    with pytest.raises(ControlError, match="does not tell its rate"):
        load(tmp_path / "m").with_rate(20.0)
