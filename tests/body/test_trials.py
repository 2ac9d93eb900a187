"""A trial depends on its own calls and its generator, and on nothing before it."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from motionese.body import CHANNELS, CORNERS, Actroid, Body, BodySettings
from motionese.errors import MotionError


def trial(body: Body, seed=5):
    body.reset(np.array([0.62, -0.2]), np.random.default_rng(seed))
    sensed = [body.sense()]
    for share in np.linspace(0, 1, 14):
        body.command(np.array([0.62 - 0.5 * share, -0.2 + 0.3 * share]))
        body.step()
        sensed.append(body.sense())
    return np.array(sensed)


def demonstration(body, seed=6):
    body.watch(CORNERS["UL"], np.random.default_rng(seed))
    sensed = [body.sense()]
    for share in np.linspace(0, 1, 10):
        body.move_caregiver(CORNERS["UL"] + share * (CORNERS["LL"] - CORNERS["UL"]))
        body.step()
        sensed.append(body.sense())
    return np.array(sensed)


def test_trials_are_the_same_bits_whatever_came_before():
    fresh, seen = trial(Actroid()), demonstration(Actroid())
    used = Actroid()
    for _ in range(2):
        np.testing.assert_array_equal(demonstration(used), seen)
        used.command(np.array([0.7, 0.3]))
        used.step()
        np.testing.assert_array_equal(trial(used), fresh)
        used.command(np.array([0.9, 0.0]))
        used.move_caregiver(CORNERS["LR"])
        used.step()


def test_trials_are_the_same_bits_in_another_process():
    code = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
        "import test_trials as t\n"
        "from motionese.body import Actroid\n"
        "b = Actroid(); t.demonstration(b); sys.stdout.buffer.write(t.trial(b).tobytes())"
    )
    other = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout
    assert other == trial(Actroid()).tobytes()


def test_noise_follows_the_generator(body):
    one, same, other = trial(body, 1), trial(body, 1), trial(body, 2)
    np.testing.assert_array_equal(one, same)
    assert (one[:, 4:] != other[:, 4:]).all()


def test_sensing_twice_is_sensing_once(body):
    trial(body)
    np.testing.assert_array_equal(body.sense(), body.sense())


def test_what_is_returned_can_be_kept(body, rng):
    body.reset(np.zeros(2), rng)
    kept = [body.sense(), body.hand_position(), body.caregiver_position(), body.pose()]
    copies = [np.copy(k) for k in kept]
    goal = CORNERS["UR"].copy()
    body.move_caregiver(goal)
    goal += 9.0
    body.command(np.array([0.5, 0.2]))
    body.step()
    for now, then in zip(kept, copies, strict=True):
        np.testing.assert_array_equal(now, then)
    np.testing.assert_allclose(body.caregiver_position(), CORNERS["UR"])


def test_the_protocol_is_filled(body):
    filled: Body = body
    assert filled.channels == CHANNELS and filled.rate_hz == 10.0
    assert filled.channels.names == ("shoulder", "armpit", "pan", "tilt", "u", "v")


@pytest.mark.parametrize("angle", [np.nan, np.inf])
def test_command_that_is_not_finite_is_refused(body, angle):
    with pytest.raises(MotionError, match="must be finite, got"):
        body.command(np.array([0.1, angle]))


def test_settings_are_kept():
    settings = BodySettings(rate_hz=5.0, stiffness=20.0)
    body = Actroid(settings)
    assert body.settings == settings and body.rate_hz == 5.0
