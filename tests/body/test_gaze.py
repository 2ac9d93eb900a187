"""The eye follows a hand, and says in which direction it lies."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.body.actroid import Actroid
from motionese.body.actroid.gaze import EYE_POSITION, FOCAL_PX, bearing
from motionese.task import PUSHING_BUTTONS

CORNERS = {name: PUSHING_BUTTONS.position(name) for name in PUSHING_BUTTONS.places}


def direction(position):
    x, y, z = position - EYE_POSITION
    return np.array([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))])


def demonstrate(body, start, end, shares, rng):
    body.watch(CORNERS[start], rng)
    yield body.sense()
    for share in shares:
        body.move_caregiver(
            body.reachable(CORNERS[start] + share * (CORNERS[end] - CORNERS[start]))
        )
        body.step()
        yield body.sense()


def perform(body, start, end, shares, rng):
    up, down = (body.command_reaching(CORNERS[c]) for c in (start, end))
    body.reset(up, rng)
    yield body.sense()
    for share in shares:
        body.command(up + share * (down - up))
        body.step()
        yield body.sense()


@pytest.mark.parametrize("who", [perform, demonstrate])
def test_keeps_the_marker_near_the_middle(exact_body, who, stroke, minimum_jerk, rng):
    motion = np.array(list(who(exact_body, *stroke, minimum_jerk, rng)))
    off = np.abs(motion[:, 4:])
    assert off[0].max() < 0.1
    assert 3 < off.max() < 7
    assert np.sqrt((off**2).mean(axis=0)).max() < 4


@pytest.mark.slow
@pytest.mark.parametrize("who", [perform, demonstrate])
def test_ranges_hold_what_occurs_and_not_much_more(body, who, minimum_jerk, rng):
    strokes = [(a, b) for a in CORNERS for b in CORNERS if a != b]
    sensed = np.concatenate([list(who(body, *stroke, minimum_jerk, rng)) for stroke in strokes])
    units = (
        Actroid.channels.to_unit(sensed)[:, 2:]
        if who is demonstrate
        else Actroid.channels.to_unit(sensed)
    )
    assert units.min() >= 0.1 and units.max() <= 0.9, units.max(axis=0)
    assert (np.ptp(units, axis=0) > 0.8 * 0.6).all()


@pytest.mark.parametrize("who", [perform, demonstrate])
def test_bearing_points_at_the_marker(exact_body, who, stroke, minimum_jerk, rng):
    where = exact_body.hand_position if who is perform else exact_body.caregiver_position
    for values in who(exact_body, *stroke, minimum_jerk, rng):
        np.testing.assert_allclose(bearing(values), direction(where()), atol=1e-9)


@given(st.floats(-0.7, 0.0), st.floats(0.3, 0.95), st.floats(-30, 30), st.floats(-30, 30))
def test_bearing_composes_the_rotations(pan, tilt, u, v):
    c, s = np.cos(pan), np.sin(pan)
    by_pan = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    c, s = np.cos(tilt), np.sin(tilt)
    by_tilt = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    ray = by_pan @ by_tilt @ [FOCAL_PX, -u, -v]
    values = np.array([0.0, 0.0, pan, tilt, u, v])
    np.testing.assert_allclose(bearing(values), direction(EYE_POSITION + ray), atol=1e-12)
    np.testing.assert_array_equal(bearing(np.stack([values] * 3))[2], bearing(values))
