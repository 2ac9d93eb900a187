"""Channels: the mapping to the unit interval and back, and what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese import Channel, Channels
from motionese.errors import ChannelError

EYE = Channels([Channel("pan", "rad", -1.0, 1.0), Channel("tilt", "rad", 0.0, 4.0)])


@given(
    low=st.floats(-1e3, 1e3),
    span=st.floats(1e-2, 1e3),
    share=st.floats(-0.1, 1.1, exclude_min=True, exclude_max=True),
)
def test_to_the_unit_interval_and_back(low, span, share):
    channels = Channels([Channel("x", "cm", low, low + span)])
    value = np.array([[low + share * span]])

    unit = channels.to_unit(value)

    assert unit[0, 0] == pytest.approx(min(max(0.1 + 0.8 * share, 0.02), 0.98), abs=1e-9)
    if 0.02 < unit[0, 0] < 0.98:
        assert channels.from_unit(unit)[0, 0] == pytest.approx(
            value[0, 0], abs=1e-9 * (1 + abs(low))
        )


def test_the_range_is_mapped_to_the_inner_part_and_the_rest_is_clipped():
    values = np.array([[-1.0, 4.0], [-1e9, 1e9], [0.0, 2.0]])

    np.testing.assert_allclose(EYE.to_unit(values), [[0.1, 0.9], [0.02, 0.98], [0.5, 0.5]])
    np.testing.assert_allclose(EYE.from_unit(np.array([0.1, 0.9])), [-1.0, 4.0])
    np.testing.assert_allclose(EYE.interval_widths, [2.5, 5.0])


@given(st.integers(0, 3))
def test_any_leading_shape_is_mapped(axes):
    values = np.full((2,) * axes + (2,), 0.5)

    assert EYE.to_unit(values).shape == EYE.from_unit(values).shape == values.shape


def test_columns_are_found_by_name_in_the_order_asked_for():
    np.testing.assert_array_equal(EYE.indices(["tilt", "pan"]), [1, 0])
    with pytest.raises(ChannelError, match=r"unknown channel 'Tild'; did you mean 'tilt'\? .* pan"):
        EYE.indices(["Tild"])


@pytest.mark.parametrize(
    ("low", "high"), [(1.0, 1.0), (2.0, 1.0), (math.nan, 1.0), (0.0, math.inf)]
)
def test_a_range_that_is_none_is_refused(low, high):
    with pytest.raises(ChannelError, match="channel 'x': its range must be finite with low < high"):
        Channel("x", "cm", low, high)


def test_no_channels_and_doubled_channels_are_refused():
    with pytest.raises(ChannelError, match="at least one is needed"):
        Channels([])
    with pytest.raises(ChannelError, match="must be unique; doubled: pan"):
        Channels([EYE[0], EYE[1], EYE[0]])


@pytest.mark.parametrize("shape", [(), (3,), (2, 1)])
def test_values_of_another_width_are_refused(shape):
    with pytest.raises(ChannelError, match="the 2 channels pan, tilt; got an array of shape"):
        EYE.to_unit(np.zeros(shape))
