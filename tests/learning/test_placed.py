"""Starting where the robot is: its IO units are there, its context is that of the motion."""

import jax
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese import MTRNN, Level, generate, placed
from motionese.errors import ChannelError


@given(x=st.floats(-1.9, 1.9), z=st.floats(-2.9, 2.9))
def test_generation_begins_where_the_robot_is(fit, x, z):
    state = fit.initial_states[1]

    there = placed(fit.network, state, {"z": z, "x": x})

    np.testing.assert_array_equal(there[[1, *range(3, 17)]], state[[1, *range(3, 17)]])
    unit = 0.1 + 0.8 * np.array([(x + 2.0) / 4.0, (z + 3.0) / 6.0])
    np.testing.assert_allclose(there[[0, 2]], np.log(unit / (1 - unit)), rtol=1e-5, atol=1e-6)
    begun = generate(fit.network, there, 2)[0]
    np.testing.assert_allclose(begun[[0, 2]], [x, z], atol=1e-5)


def test_a_place_beyond_the_range_is_clipped_as_in_training(fit):
    there = placed(fit.network, fit.initial_states[0], {"x": 1e6, "y": -1e6})

    np.testing.assert_allclose(1 / (1 + np.exp(-there[:2])), [0.98, 0.02], rtol=1e-5)


def test_a_batch_is_placed_as_its_members_are_and_left_as_it_was(fit):
    before = fit.initial_states.copy()

    together = placed(fit.network, fit.initial_states, {"y": 0.5})

    for state, there in zip(fit.initial_states, together, strict=True):
        np.testing.assert_array_equal(placed(fit.network, state, {"y": 0.5}), there)
    np.testing.assert_array_equal(fit.initial_states, before)
    assert together.dtype == before.dtype
    np.testing.assert_array_equal(placed(fit.network, before, {}), before)


def test_a_network_whose_io_starts_from_zero_stays_there(motions):
    levels = [Level(3, 2.0), Level(4, 5.0)]
    net = MTRNN.draw(levels, key=jax.random.key(0), initial_io="zero", channels=motions.channels)
    state = np.linspace(-1.0, 1.0, 7)

    np.testing.assert_array_equal(placed(net, state, {"x": 1.0}), state)
    with pytest.raises(ChannelError, match="unknown channel 'w'"):
        placed(net, state, {"w": 1.0})


def test_places_that_cannot_be_are_refused(network, fit):
    state = fit.initial_states[0]
    with pytest.raises(ChannelError, match=r"unknown channel 'X'; did you mean 'x'\?"):
        placed(fit.network, state, {"X": 1.0})
    for value in (np.nan, np.inf):
        with pytest.raises(ChannelError, match=f"channel 'y': .* must be finite, got {value}"):
            placed(fit.network, state, {"x": 1.0, "y": value})
    with pytest.raises(ChannelError, match="carries no channels; train it on motions first"):
        placed(network, state, {"x": 1.0})
