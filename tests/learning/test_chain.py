"""One motion after another: no jump between them, and each of them reached."""

from dataclasses import replace
from itertools import permutations

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from motionese import MTRNN, Level, generate, generate_sequence
from motionese.errors import ChannelError, SettingError


def of(fit, order):
    return [fit.initial_states[i] for i in order], [fit.lengths[i] for i in order]


@pytest.mark.slow
@pytest.mark.parametrize("order", [*permutations(range(3))])
def test_there_is_no_jump_and_every_motion_is_reached(fit, motions, order):
    states, steps = of(fit, order)
    own = [generate(fit.network, s, n) for s, n in zip(states, steps, strict=True)]
    largest = np.max([np.abs(np.diff(path, axis=0)).max(0) for path in own], axis=0)
    glued = np.abs(np.diff(np.concatenate(own), axis=0)).max(0)
    assert (glued > 2.5 * largest).any(), "the motions do not begin where others end"

    path = generate_sequence(fit.network, states, steps)

    assert path.shape == (sum(steps), 3)
    assert (np.abs(np.diff(path, axis=0)).max(0) < 1.5 * largest).all()
    np.testing.assert_allclose(path[: steps[0]], own[0], atol=1e-5)
    for end, motion in zip(np.cumsum(steps), own, strict=True):
        off = np.abs(path[end - 5 : end] - motion[-5:]) / motions.channels.spans
        assert off.max() < 0.03


@pytest.mark.parametrize("duration", [1.0, 1.5])
def test_a_sequence_of_one_motion_is_that_motion(fit, duration):
    path = generate_sequence(fit.network, [fit.initial_states[0]], [24], duration=duration)

    expected = generate(fit.network, fit.initial_states[0], 24, duration=duration)
    np.testing.assert_allclose(path, expected, atol=1e-6)


def test_a_given_blend_is_kept(fit):
    states, steps = of(fit, (0, 1))
    before = generate(fit.network, states[0], 24 + 24)
    at_once = generate_sequence(fit.network, states, steps, blend=0)

    path = generate_sequence(fit.network, states, steps, blend=8)

    # It parts from the first motion slowly, and is the second alone after so many rows.
    np.testing.assert_allclose(path[:25], before[:25], atol=1e-5)
    s = np.arange(8)[:, None] / 8
    weight = s**3 * (10 - 15 * s + 6 * s**2)
    mixed = (1 - weight) * before[24:32] + weight * at_once[24:32]
    np.testing.assert_allclose(path[24:32], mixed, atol=1e-5)
    np.testing.assert_allclose(path[32:], at_once[32:], atol=1e-5)


def test_a_motion_begins_where_the_one_before_it_has_come_to(fit):
    states, steps = of(fit, (0, 1))
    before = generate(fit.network, states[0], 24 + 24)

    path = generate_sequence(fit.network, states, steps, blend=0)

    np.testing.assert_allclose(path[24], before[24], atol=1e-5)


@pytest.mark.parametrize("bias", [0.0, 1.0])
def test_what_stands_still_needs_no_blend_and_takes_no_harm(motions, bias):
    net = MTRNN.draw(
        [Level(3, 2.0), Level(2, 5.0)], key=jax.random.key(0), channels=motions.channels
    )
    net = replace(net, weights=jnp.zeros((5, 5)), bias=jnp.array([bias, 0.0, 0.0, 0.0, 0.0]))
    still = np.array([bias, 0.0, 0.0, 0.0, 0.0])
    elsewhere = np.array([bias, 0.0, 0.0, 1.0, 0.0])

    path = generate_sequence(net, [still, elsewhere], [6, 6])

    np.testing.assert_allclose(path, np.tile(path[0], (12, 1)), atol=1e-6)


def test_two_that_stand_still_at_different_places_are_blended_as_slowly_as_may_be(motions):
    # A context unit that never changes holds the first channel where it is.
    net = MTRNN.draw(
        [Level(3, 2.0), Level(1, 1e9)], key=jax.random.key(0), channels=motions.channels
    )
    weights = jnp.zeros((4, 4)).at[0, 3].set(2.0)
    net = replace(net, weights=weights, bias=jnp.zeros(4))
    states = [np.array([1.0, 0.0, 0.0, 0.0]), np.array([1.5, 0.0, 0.0, np.log(3.0)])]
    here, there = (generate(net, state, 20)[:, 0] for state in states)
    assert np.ptp(here) == np.ptp(there) == 0.0

    path = generate_sequence(net, states, [20, 20])[:, 0]

    np.testing.assert_allclose(path[:20], here)
    np.testing.assert_allclose(path[30:], there[10:], atol=0.01)
    assert np.abs(np.diff(path)).max() < 0.3 * (there[0] - here[0])


def test_what_cannot_follow_one_another_is_refused(network, fit):
    states = [fit.initial_states[0], fit.initial_states[1]]
    with pytest.raises(SettingError, match="one number of steps for each, got 2 and 1"):
        generate_sequence(fit.network, states, [24])
    with pytest.raises(SettingError, match=r"a sequence needs motions .* got 0 and 0"):
        generate_sequence(fit.network, [], [])
    for blend in (-1, 18):
        with pytest.raises(SettingError, match=rf"every motion \(18 rows\), got {blend}"):
            generate_sequence(fit.network, states, [24, 18], blend=blend)
    for steps in ([24, 1], [1, 24], [24, 0], [24, -3]):
        with pytest.raises(SettingError, match=f"steps must be ≥ 2, got {min(steps)}"):
            generate_sequence(fit.network, states, steps)
    with pytest.raises(SettingError, match=r"between 0\.5 and 2, got 3"):
        generate_sequence(fit.network, states, [24, 18], duration=3.0)
    with pytest.raises(ChannelError, match="carries no channels; train it on motions first"):
        generate_sequence(network, states, [24, 18])


def test_a_motion_sets_out_from_where_the_robot_is_without_rushing(fit, motions):
    length, channels = motions.lengths[0], motions.channels
    away = motions.values[0][0] + 0.3 * channels.spans
    here = dict(zip(channels.names, away, strict=True))

    path = generate_sequence(fit.network, fit.initial_states[:1], [length], here=here)
    rushing = generate_sequence(fit.network, fit.initial_states[:1], [length], here=here, blend=0)

    np.testing.assert_allclose(path[0], away)
    assert np.abs(path[1] - path[0]).max() < 0.2 * np.abs(rushing[1] - rushing[0]).max()
    np.testing.assert_allclose(path[length // 2 :], rushing[length // 2 :])
