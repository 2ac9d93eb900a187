"""Rows in which the seen hand rests, or moves, weigh more in equation (3)."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand import attention as by_hand
from by_hand.learning import error_and_gradients

from motionese.caregiver import Demonstration
from motionese.errors import SettingError
from motionese.experiment import read_settings
from motionese.imitation import Scene, newborn
from motionese.imitation.attention import attention, noise_speed, seen_speed
from motionese.imitation.performance import watch
from motionese.learning.error import ERRORS
from motionese.learning.objective import predictions

SMALL = ["network.levels.cf.size=5"]
BODIES = {"actroid": "default", "desk_arm": "desk_arm"}


def scene_of(*overrides, preset="default"):
    return Scene(read_settings(preset, [*SMALL, *overrides]), seed=3)


def paying(to, strength):
    return f"training.attention.to={to}", f"training.attention.strength={strength}"


@pytest.fixture(scope="module")
def watched():
    scene = scene_of()
    return scene, scene.show(scene.task.sequence("UR ↓↑"), "attention").sensed


@pytest.mark.parametrize("preset", BODIES.values(), ids=BODIES)
def test_v0_is_the_speed_that_noise_alone_gives_a_hand_at_rest(preset):
    scene = scene_of(preset=preset)
    for place in ("UR", "LL"):
        still = Demonstration(np.tile(scene.task.position(place), (300, 1)), (0,))
        seen = scene.body.bearing(watch(scene.body, still, np.random.default_rng(1)).sensed)
        measured = np.sqrt((seen_speed(seen)[1:-1] ** 2).mean())
        assert noise_speed(scene.body, 0.3) == pytest.approx(measured, rel=0.2)
    assert noise_speed(scene.body, 0.6) == pytest.approx(2 * noise_speed(scene.body, 0.3))


@pytest.mark.parametrize("to", ["rests", "movement"])
def test_rows_weigh_as_they_do_by_hand(watched, to):
    scene, values = watched
    chosen = read_settings(overrides=[*SMALL, *paying(to, 3.0)])
    weigh = attention(scene.body, chosen)
    seen = scene.body.bearing(values)
    expected = by_hand.weights(seen, to, 3.0, noise_speed(scene.body, 0.3))
    np.testing.assert_allclose(weigh(values), expected, rtol=1e-12)
    at_rest, moving = weigh(values)[13:15].mean(), weigh(values)[6]
    assert (at_rest > moving) == (to == "rests")
    assert moving == pytest.approx(1 if to == "rests" else 4)


def test_where_no_hand_was_seen_a_row_weighs_as_ever(watched):
    scene, values = watched
    unseen = values.copy()
    unseen[5] = np.nan
    weigh = attention(scene.body, read_settings(overrides=[*SMALL, *paying("rests", 3.0)]))
    assert (weigh(unseen)[4:7] == 1).all() and np.isfinite(weigh(unseen)).all()


def test_with_strength_0_nothing_is_weighed(watched):
    scene, values = watched
    for to in ("rests", "movement"):
        assert attention(scene.body, read_settings(overrides=[*SMALL, *paying(to, 0.0)])) is None
    learner = newborn(scene, 2).experiencing(1, "UR ↓↑", values, np.zeros(11))
    assert learner.motions(10.0, None).weights is None


def test_the_loss_and_its_gradient_are_those_of_the_weighed_equation(watched, float64):
    """Against sums written out, and against finite differences."""
    scene, values = watched
    weigh = attention(scene.body, read_settings(overrides=[*SMALL, *paying("rests", 3.0)]))
    learner = newborn(scene, 2)
    learner = learner.experiencing(1, "UR ↓↑", values, np.zeros(learner.network.size))
    batch = learner.motions(10.0, weigh).batch()
    free = jax.random.normal(jax.random.key(2), (1, learner.network.size))

    def loss(free):
        predicted = predictions(learner.network, batch, free, 0.3)
        return ERRORS["squared"](predicted, batch).sum()

    arrays = {name: np.asarray(value) for name, value in learner.network.arrays.items()}
    net = {**arrays, "sizes": learner.network.sizes, "initial_io": "sensed"}
    unit = scene.body.channels.to_unit(values)
    counts = by_hand.weights(scene.body.bearing(values), "rests", 3.0, noise_speed(scene.body, 0.3))
    twin = unit, np.ones_like(unit), np.repeat(np.array(counts)[:, None], unit.shape[1], axis=1)
    error, slope = error_and_gradients(net, twin, np.asarray(free[0]), 0.3)

    gradient = jax.grad(loss)(free)[0]
    assert float(loss(free)) == pytest.approx(error, rel=1e-6)
    np.testing.assert_allclose(gradient, slope["initial"], rtol=1e-4, atol=1e-6)
    step = 1e-5
    for unit_number in range(len(scene.body.channels), learner.network.size):
        aside = jnp.zeros_like(free).at[0, unit_number].set(step)
        difference = (loss(free + aside) - loss(free - aside)) / (2 * step)
        assert float(gradient[unit_number]) == pytest.approx(float(difference), rel=1e-3, abs=1e-6)


def test_without_noise_nothing_tells_what_rests():
    with pytest.raises(SettingError, match=r"strength above 0 needs body\.pixel_noise above 0"):
        read_settings(overrides=[*paying("rests", 1.0), "body.pixel_noise=0"])
    with pytest.raises(SettingError, match=r"attention\.strength = -1.*greater than or equal to 0"):
        read_settings(overrides=[*paying("rests", -1)])
