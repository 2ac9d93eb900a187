"""Levels: sizes, time constants, names; what is refused, and in which words."""

import math
from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese.channels import Channel, Channels
from motionese.errors import SettingError
from motionese.network import MTRNN, Level

IO, CF, CS = Level(3, tau=2.0), Level(5, tau=5.0), Level(2, tau=70.0)


def network(*levels, **settings):
    return MTRNN.draw(levels, key=jax.random.key(0), **settings)


def test_levels_are_named_by_their_place_unless_they_have_a_name():
    net = network(IO, Level(5, 5.0, "fast"), CS, Level(1, 200.0), Level(1, 500.0))

    assert [level.name for level in net.levels] == ["io", "fast", "cs", "c4", "c5"]
    assert net.sizes == (3, 5, 2, 1, 1)
    assert net.size == 12
    assert net.io_size == 3
    assert net.units("cs") == slice(8, 10)


def test_every_unit_has_the_time_constant_of_its_level_or_its_own():
    net = network(IO, Level(2, tau=(4.0, 6.0)), CS)

    np.testing.assert_array_equal(net.tau, [2, 2, 2, 4, 6, 70, 70])


def test_levels_tell_the_time_constants_that_the_network_has():
    net = network(IO, Level(2, tau=(4.0, 6.0)), CS)

    assert [level.tau for level in net.levels] == [2.0, (4.0, 6.0), 70.0]
    assert [level.tau for level in net.lasting(1.5).levels] == [3.0, (6.0, 9.0), 105.0]


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"bias": np.zeros(9)}, r"bias must have shape \(10,\), got \(9,\)"),
        ({"sizes": (3, 5)}, r"weights must have shape \(8, 8\), got \(10, 10\)"),
        ({"names": ("io", "cf", "io")}, "level names must be unique"),
    ],
)
def test_fields_that_do_not_fit_each_other_are_refused(unchecked, fields, match):
    with pytest.raises(SettingError, match=match):
        replace(network(IO, CF, CS), **fields)


@pytest.mark.parametrize("tau", [0.99, 0.0, -2.0, math.inf, math.nan, (2.0, 0.5)])
def test_a_time_constant_below_one_step_is_refused(tau):
    with pytest.raises(SettingError, match=r"tau must be finite and ≥ 1 step, at most 1e\+30, got"):
        Level(2, tau=tau)


@pytest.mark.parametrize("size", [0, -1, 2.0, True])
def test_a_size_that_is_no_positive_whole_number_is_refused(unchecked, size):
    with pytest.raises(SettingError, match=f"size must be a whole number.*, got {size}"):
        Level(size, tau=2.0)


def test_a_wrong_number_of_time_constants_is_refused():
    with pytest.raises(SettingError, match=r"level 'cf': .* one per unit \(3\), got 2 values"):
        Level(3, tau=(2.0, 3.0), name="cf")


def test_doubled_names_are_refused():
    with pytest.raises(SettingError, match="level names must be unique, got io, cs, cs"):
        network(IO, Level(5, 5.0, "cs"), CS)


def test_io_alone_is_no_network():
    with pytest.raises(SettingError, match="at least one context, got 1"):
        network(IO)


def test_an_unknown_level_is_refused_with_the_nearest_that_exists():
    with pytest.raises(
        SettingError, match=r"unknown level 'csx'; did you mean 'cs'\? .*io, cf, cs"
    ):
        network(IO, CF, CS).units("csx")


@pytest.mark.parametrize("gain", [-1.0, math.nan, math.inf])
def test_a_gain_below_zero_is_refused(gain):
    with pytest.raises(SettingError, match="gain of the initial weights must be ≥ 0, got"):
        network(IO, CF, gain=gain)


def test_channels_must_be_as_many_as_io_units():
    two = Channels([Channel("pan", "rad", -1.0, 1.0), Channel("tilt", "rad", -1.0, 1.0)])

    with pytest.raises(SettingError, match=r"'io' needs one unit per channel \(2\), got 3"):
        network(IO, CF, channels=two)


def test_values_by_level_are_spread_over_the_units():
    net = network(IO, CF, CS)

    np.testing.assert_array_equal(
        net.per_unit({"cs": 3.0, "io": 2.0}, 1.0), [2] * 3 + [1] * 5 + [3] * 2
    )
    np.testing.assert_array_equal(net.per_unit(4.0, 1.0), [1] * 3 + [4] * 7)
    with pytest.raises(SettingError, match="unknown level 'c4'"):
        net.per_unit({"c4": 1.0}, 0.0)


def test_a_word_that_is_no_choice_is_refused_with_the_nearest_that_is(unchecked):
    with pytest.raises(SettingError, match=r"unknown initial_io 'zer'; did you mean 'zero'\?"):
        network(IO, CF, initial_io="zer")
    with pytest.raises(SettingError, match=r"unknown scale .* 'fanin'; did you mean 'fan_in'\?"):
        network(IO, CF, scale="fanin")
