"""Units of one quantity are brought to each other, others are refused."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import ChannelError
from motionese.recordings import Episode, Recording, in_units
from motionese.recordings.units import QUANTITIES, factor

PAIRS = [(a, b) for units in QUANTITIES for a in units for b in units]


def recording(unit):
    episode = Episode.whole("0", np.array([[180.0], [90.0]]))
    return Recording(Path("f.csv"), ("c",), (unit,), {"c": (0.0, 360.0)}, 9.0, (episode,), ("c",))


@pytest.mark.parametrize(
    ("unit", "to", "size"),
    [
        ("deg", "rad", np.pi / 180),
        ("°", "rad", np.pi / 180),
        ("rad", "Degrees", 180 / np.pi),
        ("mm", "m", 1e-3),
        ("m", "cm", 100.0),
        ("deg/s", "rad/s", np.pi / 180),
        ("rpm", "rad/s", 2 * np.pi / 60),
        ("mA", "A", 1e-3),
    ],
)
def test_one_quantity_in_another_unit(unit, to, size):
    assert factor(unit, to) == pytest.approx(size)


@given(st.sampled_from(PAIRS))
def test_there_and_back_is_where_one_was(pair):
    there, back = factor(*pair), factor(*reversed(pair))

    assert there is not None
    assert there * back == pytest.approx(1.0)


def test_a_conversion_is_told_and_done_to_values_and_ranges():
    changed = in_units(recording("deg"), {"c": "rad"})

    np.testing.assert_allclose(changed.episodes[0].values[:, 0], [np.pi, np.pi / 2])
    assert changed.ranges["c"] == pytest.approx((0.0, 2 * np.pi))
    assert changed.units == ("rad",)
    assert "converted from deg to the model's rad" in changed.findings[0].sentence


@pytest.mark.parametrize(("unit", "to"), [("deg", ""), ("", "rad"), ("deg", "deg"), ("deg", "°")])
def test_nothing_is_told_where_units_are_unknown_or_the_same(unit, to):
    changed = in_units(recording(unit), {"c": to})

    assert not changed.findings
    np.testing.assert_array_equal(changed.episodes[0].values, recording(unit).episodes[0].values)


def test_what_measures_something_else_is_refused_with_both():
    with pytest.raises(ChannelError, match=r"is in \[deg\], the model's in \[m\], .* --unit c=m"):
        in_units(recording("deg"), {"c": "m"})
