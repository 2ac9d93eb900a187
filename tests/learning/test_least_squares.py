"""Recognition by damped steps: equal to the twin by hand, within bounds, never worse."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand import least_squares as by_hand
from ragged_motions import drawn, ragged

from motionese import MTRNN, Level, Motions, Recognition
from motionese.errors import SettingError
from motionese.learning import recognise_all
from motionese.learning.recognition.least_squares import BROAD, damped_steps, normal_equations
from motionese.learning.recognition.search import Search

LEAST_SQUARES = Recognition(optimiser="least_squares", iterations=7, starts=0, bound=100.0)


@pytest.mark.parametrize(
    ("initial_io", "penalty", "levels", "bound", "slower"),
    [
        ("sensed", 0.0, None, {"cf": 1.2}, {}),
        ("zero", 0.01, None, {"cf": 1.2, "cs": 9.0}, {"cf": 0.3}),
        ("sensed", 0.0, ("cs",), {"cs": 9.0}, {}),
        ("sensed", 0.02, ("cf",), {"cf": 0.7}, {}),
    ],
)
def test_recognition_equals_damped_steps_by_hand(
    float64, initial_io, penalty, levels, bound, slower
):
    net, arrays = drawn(3, learned_bias=True, initial_io=initial_io)
    motions, twins = ragged()
    starts = np.random.default_rng(2).normal(size=(3, 1, net.size))
    settings = LEAST_SQUARES.model_copy(
        update={"penalty": penalty, "levels": levels, "bound": bound, "slower": slower}
        | {"iterations": BROAD + 4}
    )

    found = recognise_all(net, motions, starts=starts, settings=settings, padded_to=(4, 9))

    # IO units that began at something sensed in all motions are not among those that are sought.
    io = [d for d in (0, 1) if initial_io == "sensed" and not all(m[0][d] for _, m, _ in twins)]
    context = {None: range(2, 8), ("cs",): range(6, 8), ("cf",): range(2, 6)}[levels]
    widest = np.full(8, np.inf)
    widest[2:6], widest[6:] = bound.get("cf", np.inf), bound.get("cs", np.inf)
    paces = np.where((np.arange(8) >= 2) & (np.arange(8) < 6), slower.get("cf", 1.0), 1.0)
    for each, motion, begin in zip(found, twins, starts[:, 0], strict=True):
        state, loss, _ = by_hand.recognition(
            arrays, motion, begin, [*io, *context],
            iterations=BROAD + 4, bound=widest, penalty=penalty, paces=paces,
        )  # fmt: skip
        np.testing.assert_allclose(each.initial_state, state, rtol=0, atol=1e-8)
        assert each.loss == pytest.approx(loss, rel=1e-9)
    kept = np.setdiff1d(np.arange(2, 8), context)
    for each, begin in zip(found, starts[:, 0], strict=True):
        np.testing.assert_array_equal(each.initial_state[kept], begin[kept])


def search_of(net, motions, free, enough=-np.inf):
    return Search(
        net,
        motions.batch(),
        jnp.asarray(free),
        jnp.arange(2, net.size),
        jnp.full(net.size, 100.0),
        jnp.asarray(0.0),
        jnp.full(free.shape[:2], enough),
    )


@pytest.mark.slow
def test_what_first_comes_near_enough_is_kept_and_stays_there(float64):
    net, arrays = drawn(3, learned_bias=True, initial_io="sensed")
    motions, twins = ragged()
    free = np.random.default_rng(4).normal(0.0, 2.0, (3, 4, net.size))
    begun = np.asarray(damped_steps(search_of(net, motions, free), 0).losses)
    losses = np.asarray(damped_steps(search_of(net, motions, free), 12).losses)
    # Of motion 0 all come near enough on the way; of motion 1 one is so as it begins; of 2 none.
    enough = np.stack([0.5 * (begun[0] + losses[0]), np.zeros(4), 0.9 * losses[2]])
    early = int(np.argmax(losses[1]))
    enough[1, early] = 1.01 * begun[1, early]
    limited = search_of(net, motions, free)._replace(enough=jnp.asarray(enough))

    found = damped_steps(limited, 12)

    tried = [
        by_hand.recognition(
            arrays, twins[0], begin, range(2, 8), iterations=12, bound=np.full(8, 100.0),
            penalty=0.0, enough=limit,
        )
        for begin, limit in zip(free[0], enough[0], strict=True)
    ]  # fmt: skip
    first = min(taken for _, loss, taken in tried)
    assert tried[int(found.chosen[0])][2] == first
    assert found.losses[0, found.chosen[0]] <= enough[0, found.chosen[0]]
    assert found.chosen[1] == early and found.losses[1, early] == begun[1, early]
    assert found.chosen[2] == np.argmin(found.losses[2])


@pytest.mark.slow
@pytest.mark.parametrize("variance", [False, True])
def test_a_step_follows_the_gradient_and_no_search_ends_worse(float64, variance):
    net = MTRNN.draw(
        [Level(2, 2.0), Level(4, 5.0), Level(2, 30.0)], key=jax.random.key(1), variance=variance
    )
    if variance:  # a variance that does not depend on what is sought, as a step takes it to be
        net = replace(net, variance_bias=jnp.array([-3.0, -6.0]))
    motions, _ = ragged()
    free = np.random.default_rng(4).normal(0.0, 1.0, (3, 2, net.size))
    search = search_of(net, motions, free)

    def total(sought):
        return normal_equations(search, sought)[0].sum()

    loss, curvature, slope = normal_equations(search, search.begin)
    np.testing.assert_allclose(slope, jax.grad(total)(search.begin) / 2, rtol=0, atol=1e-10)
    assert np.linalg.eigvalsh(curvature).min() > -1e-12
    assert (damped_steps(search, 9).losses <= loss.reshape(3, 2)).all()


def test_a_level_that_is_not_sought_keeps_the_state_of_the_first_start():
    net, _ = drawn(3)
    motions, _ = ragged()
    starts = np.random.default_rng(2).normal(size=(3, 1, net.size)).astype(np.float32)
    settings = LEAST_SQUARES.model_copy(update={"levels": ("cs",), "starts": 3, "spread": 2.0})

    found = recognise_all(net, motions, starts=starts, settings=settings)

    for each, begin in zip(found, starts[:, 0], strict=True):
        np.testing.assert_array_equal(each.initial_state[2:6], begin[2:6])


def test_a_level_that_does_not_exist_is_told():
    net, _ = drawn(2)
    motions, _ = ragged()
    with pytest.raises(SettingError, match=r"unknown level 'cs'"):
        recognise_all(net, motions, settings=LEAST_SQUARES.model_copy(update={"levels": ("cs",)}))


def test_nothing_observed_after_the_first_row_ends_at_once():
    net, _ = drawn(3)
    values = np.zeros((5, 2))
    masks = [np.arange(5)[:, None] + np.zeros((5, 2)) < 1]
    motions = Motions.from_arrays([values], net.channels, 10.0, observed=masks)
    found = recognise_all(net, motions, settings=LEAST_SQUARES)[0]
    assert found.status.ending.value == "not recognised"
    assert np.isfinite(found.initial_state).all()
