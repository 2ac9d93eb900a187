"""Training and recognition by plain descent are what equations (3)–(5) say, worked out by hand."""

import jax.numpy as jnp
import numpy as np
import pytest
from by_hand import learning as by_hand
from by_hand.network import rollout, sigmoid
from ragged_motions import drawn, ragged

from motionese import (
    Recognition,
    Training,
    generate,
    train,
)
from motionese.learning import activity, recognise_all
from motionese.learning.optimisers import recognition_rule
from motionese.learning.recognition.descent import descend
from motionese.learning.recognition.search import Search


@pytest.mark.parametrize(
    ("levels", "learned_bias", "initial_io", "clip", "schedule", "shared"),
    [
        (3, True, "sensed", 0.0, "constant", {"cf": "aba"}),
        (2, False, "sensed", 0.3, "cosine", {}),
        (4, True, "zero", 0.3, "constant", {"cs": "baa", "cf": "ccc"}),
    ],
)
def test_training_equals_plain_descent_by_hand(
    float64, levels, learned_bias, initial_io, clip, schedule, shared
):
    net, arrays = drawn(levels, learned_bias=learned_bias, initial_io=initial_io)
    motions, twins = ragged()
    epochs = 25 if schedule == "cosine" else 4  # of which the first is the warm-up
    begin = np.random.default_rng(1).normal(size=(3, net.size))
    settings = Training(
        epochs=epochs,
        schedule=schedule,
        optimiser="descent",
        weight_rate=0.2,
        initial_rate=0.8,
        clip=clip,
        bound=0.3,
        teacher_forcing=0.3,
    )

    fit = train(
        net, motions, settings=settings, initial_states=begin, shared=shared, padded_to=(4, 9)
    )

    of_level = {name: np.arange(net.size)[net.units(name)] for name in shared}
    expected, free, errors = by_hand.descent(
        arrays,
        twins,
        begin,
        epochs=epochs,
        schedule=schedule,
        weight_rate=0.2,
        initial_rate=0.8,
        teacher_forcing=0.3,
        bound=np.where(np.arange(net.size) < 2, np.inf, 0.3),
        clip=clip,
        shared=[
            (of_level[level], [i for i in range(3) if groups[i] == group])
            for level, groups in shared.items()
            for group in set(groups)
        ],
    )
    starts = [
        by_hand.start(f, *motion[:2], initial_io) for f, motion in zip(free, twins, strict=True)
    ]
    assert (np.abs(free[:, 2:]) == 0.3).any(), "the bound should be met"
    exact = 1e-6 if schedule == "cosine" else 1e-10  # optax works out the cosine in float32
    np.testing.assert_allclose(fit.losses, errors, rtol=exact)
    np.testing.assert_allclose(fit.network.weights, expected["weights"], rtol=0, atol=exact)
    np.testing.assert_allclose(fit.network.bias, expected["bias"], rtol=0, atol=exact)
    np.testing.assert_allclose(fit.initial_states, starts, rtol=0, atol=exact)


@pytest.mark.parametrize(("initial_io", "penalty"), [("sensed", 0.0), ("zero", 0.01)])
def test_recognition_equals_plain_descent_by_hand(float64, initial_io, penalty):
    net, arrays = drawn(3, learned_bias=True, initial_io=initial_io)
    motions, twins = ragged()
    starts = np.random.default_rng(2).normal(size=(3, 1, net.size))
    settings = Recognition(
        iterations=10, starts=0, optimiser="descent", rate=2.0, bound={"cf": 1.2}, penalty=penalty
    )

    found = recognise_all(net, motions, starts=starts, settings=settings)

    bound = np.where((np.arange(net.size) >= 2) & (np.arange(net.size) < 6), 1.2, np.inf)
    for each, motion, begin in zip(found, twins, starts[:, 0], strict=True):
        state, loss, _ = by_hand.recognition(
            arrays, motion, begin, iterations=10, rate=2.0, bound=bound, penalty=penalty
        )
        np.testing.assert_allclose(each.initial_state, state, rtol=0, atol=1e-10)
        assert each.loss == pytest.approx(loss, rel=1e-10)


def test_what_first_comes_near_enough_is_chosen_and_stays_there(float64):
    net, arrays = drawn(3, learned_bias=True, initial_io="sensed")
    motions, twins = ragged()
    starts = np.random.default_rng(4).normal(0.0, 2.0, (3, 4, net.size))
    given = {"iterations": 10, "rate": 2.0, "bound": np.full(net.size, 9.0), "penalty": 0.0}
    free = [
        [by_hand.recognition(arrays, motion, begin, **given) for begin in of_motion]
        for motion, of_motion in zip(twins, starts, strict=True)
    ]
    losses = np.array([[loss for _, loss, _ in of_motion] for of_motion in free])
    begun = np.array(
        [
            [by_hand.error_and_gradients(arrays, motion, b, 0.0)[0] for b in of_motion]
            for motion, of_motion in zip(twins, starts, strict=True)
        ]
    )
    # Of motion 0 all come near enough on the way, of motion 1 one as it begins and another later,
    # of motion 2 none.
    enough = np.stack([0.5 * (begun[0] + losses[0]), np.zeros(4), 0.9 * losses[2]])
    late, early = np.argsort(losses[1])[:2]
    enough[1, late], enough[1, early] = 1.01 * losses[1, late], 1.01 * begun[1, early]

    rule = recognition_rule("descent", 2.0, 0.0, 10)
    bound, none = jnp.asarray(given["bound"]), jnp.asarray(0.0)
    units, begin, limit = jnp.arange(net.size), jnp.asarray(starts), jnp.asarray(enough)
    search = Search(net, motions.batch(), begin, units, bound, none, limit)
    states, by_start, chosen = descend(search, rule, 10)

    for i, motion in enumerate(twins):
        expected = [
            by_hand.recognition(arrays, motion, begin, **given, enough=limit)
            for begin, limit in zip(starts[i], enough[i], strict=True)
        ]
        arrived = [when for *_, when in expected]
        smallest = [loss for _, loss, _ in expected]
        first = int(np.argmin(arrived if min(arrived) < np.inf else smallest))
        np.testing.assert_allclose(by_start[i], smallest, rtol=1e-10)
        assert chosen[i] == first
        np.testing.assert_allclose(states[i], expected[first][0], rtol=0, atol=1e-10)
    assert chosen[1] == early
    assert by_start[1, late] < by_start[1, early], "the smaller loss came later"


@pytest.mark.parametrize("first", [None, np.array([1.5, 4.0])])
def test_generation_equals_a_closed_loop_by_hand(float64, first):
    net, arrays = drawn(3)
    state = np.random.default_rng(3).normal(size=net.size)
    sensed, share = np.full((9, 2), 0.5), np.zeros((9, 2))
    if first is not None:
        sensed[0], share[0] = (0.1 + 0.8 * 3.5 / 4.0, 0.1 + 0.8 * 4.0 / 5.0), 1.0
    parts = (arrays["weights"], arrays["bias"], arrays["tau"], arrays["sizes"])
    path = rollout(*parts, state, sensed, share)
    y = np.vectorize(sigmoid)(path)
    if first is not None:
        y[0, :2] = sensed[0]

    np.testing.assert_allclose(activity(net, state, 9, first=first), y, rtol=0, atol=1e-12)
    expected = (y[:, :2] - 0.1) / 0.8 * (4.0, 5.0) + (-2.0, 0.0)
    np.testing.assert_allclose(generate(net, state, 9, first=first), expected, rtol=0, atol=1e-12)


@pytest.mark.slow
def test_a_level_that_is_slower_moves_by_so_much_less(float64):
    net, _ = drawn(3, learned_bias=True, initial_io="sensed")
    motions, _ = ragged()
    starts = np.zeros((3, 1, net.size))
    plain = Recognition(iterations=1, starts=0, optimiser="descent", rate=0.1)
    slow = plain.model_copy(update={"slower": {"cf": 0.1}})

    free, held = (recognise_all(net, motions, starts=starts, settings=s) for s in (plain, slow))

    for one, other in zip(free, held, strict=True):
        cf, cs = net.units("cf"), net.units("cs")
        assert np.abs(one.initial_state[cf]).max() > 0
        np.testing.assert_allclose(other.initial_state[cf], 0.1 * one.initial_state[cf])
        np.testing.assert_allclose(other.initial_state[cs], one.initial_state[cs])
