"""A step of the runtime against the equations by hand, and against the library."""

import numpy as np
import pytest
from by_hand import network as by_hand
from hypothesis import given
from hypothesis import strategies as st
from small_models import INITIAL_IO, SIZES

from motionese import generate
from motionese.runtime import Player, Stepper


def by_hand_path(model, u, sensed, share):
    """y of the channels, row by row, where NaN in `sensed` is not sensed."""
    seen = np.isfinite(sensed)
    potentials = by_hand.rollout(
        model.weights.tolist(),
        model.bias.tolist(),
        model.tau.tolist(),
        SIZES,
        u.tolist(),
        np.where(seen, sensed, 0.0),
        share * seen,
    )
    return 1 / (1 + np.exp(-potentials[:, :3]))


@given(seed=st.integers(0, 2**32 - 1))
def test_steps_are_those_of_the_equations(model, seed):
    rng = np.random.default_rng(seed)
    u = rng.normal(0.0, 2.0, 12)
    sensed = rng.uniform(0.02, 0.98, (30, 3))
    sensed[rng.uniform(size=sensed.shape) < 0.3] = np.nan
    share = rng.uniform(size=3)
    state, stepper = model.begin(u), Stepper(model)

    path = [state.y[:3].copy()]
    for row in sensed[:-1]:
        path.append(stepper.step(state, row, share).copy())

    np.testing.assert_allclose(path, by_hand_path(model, u, sensed, share), atol=2e-6)


@pytest.mark.parametrize("saved", INITIAL_IO, indirect=True)
def test_closed_loop_is_what_the_library_generates(model, saved):
    _, network, states = saved
    for name, u in zip(("reach", "wave"), states, strict=True):
        player = Player(model, model.begin(name))
        path = [player.row, *(player.step() for _ in range(99))]

        widths = network.channels.interval_widths
        np.testing.assert_allclose(path / widths, generate(network, u, 100) / widths, atol=1e-5)


def test_states_share_a_model_and_a_stepper(model):
    nothing, share = np.full(3, np.nan), np.zeros(3)
    stepper = Stepper(model)

    def alone(name):
        state = model.begin(name)
        return [stepper.step(state, nothing, share).copy() for _ in range(5)]

    one, other = model.begin("reach"), model.begin("wave")
    together = [
        (stepper.step(one, nothing, share).copy(), stepper.step(other, nothing, share).copy())
        for _ in range(5)
    ]

    np.testing.assert_array_equal(
        list(zip(*together, strict=True)), [alone("reach"), alone("wave")]
    )


def test_a_copied_state_goes_its_own_way(model):
    stepper, state = Stepper(model), model.begin("reach")
    kept = state.copy()

    stepper.step(state, np.full(3, np.nan), np.zeros(3))

    assert not np.array_equal(kept.u, state.u)
    np.testing.assert_array_equal(kept.u, model.initial("reach"))


def test_the_model_is_never_changed(model):
    before = model.initial("reach")
    model.begin("reach", [0.0, 0.0, 0.5])

    np.testing.assert_array_equal(model.initial("reach"), before)
    with pytest.raises(ValueError, match="read-only"):
        model.weights[0, 0] = 1.0


def test_potentials_far_out_saturate_without_a_warning(model):
    state = model.begin(np.full(12, -1e4))
    Stepper(model).step(state, np.full(3, np.nan), np.zeros(3))

    assert np.isfinite(state.y).all()
