"""Recognition: from any part of a motion to its initial states, with a verdict."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionese import Motions, Recognition, generate, recognise
from motionese.errors import ChannelError, MotionError, SettingError
from motionese.learning import Ending, Training, recognise_all
from motionese.learning.error import ERRORS
from motionese.learning.optimisers import recognition_rule, training_rule
from motionese.learning.parameters import Parameters
from motionese.learning.recognition.descent import descend
from motionese.learning.recognition.search import Search
from motionese.learning.training.updates import Iterate, run_updates

KEY = jax.random.key(2)
QUICK = Recognition()
TOLD = Recognition(iterations=300, starts=0)


def far(found, values, channels):
    """The largest root mean squared distance of a recognised path, as a share of a range."""
    ranges = np.array([c.high - c.low for c in channels])
    return (np.sqrt(((found.path - values) ** 2)[1:].mean(0)) / ranges).max()


@pytest.mark.slow
def test_a_hidden_channel_is_recovered_from_random_starts(fit, motions):
    off = []
    for values in motions.values:
        found = recognise(fit.network, values, observed=["x", "y"], settings=QUICK, key=KEY)
        assert found.status.ending is Ending.RECOGNISED
        off.append(far(found, values, motions.channels))

    assert np.mean(off) < 0.1 and max(off) < 0.15, off


@pytest.mark.slow
@pytest.mark.parametrize("observed", [["y", "z"], ["x", "z"]])
def test_a_learned_motion_is_told_from_the_others_by_two_of_its_channels(fit, motions, observed):
    near = Recognition(iterations=10, starts=0)
    starts = np.repeat(fit.initial_states[None], 3, axis=0)

    found = recognise_all(fit.network, motions.showing(observed), starts=starts, settings=near)

    # Which start was the best is not asked: another motion's may lead to the same path.
    for each, values in zip(found, motions.values, strict=True):
        assert far(each, values, motions.channels) < 0.25


@pytest.mark.slow
@given(
    observed=st.sets(st.sampled_from("xyz"), min_size=1),
    first=st.integers(0, 8),
    rows=st.integers(6, 22),
)
@settings(max_examples=12)
def test_any_part_of_a_motion_is_recognised_near_where_it_was_learned(
    fit, motions, observed, first, rows
):
    looked_at = np.full((24, 3), np.nan)
    columns = [i for i, name in enumerate("xyz") if name in observed]
    looked_at[first : first + rows, columns] = motions.values[0][first : first + rows, columns]

    found = recognise(
        fit.network,
        looked_at,
        observed=sorted(observed),
        rows=slice(first, min(first + rows, 24)),
        starts=fit.initial_states[:1],
        settings=TOLD,
    )

    assert found.status.ending is Ending.RECOGNISED
    np.testing.assert_array_equal(np.isnan(found.residual), [c not in observed for c in "xyz"])
    assert found.error < 0.05


def test_the_found_states_generate_the_recognised_path(fit, motions):
    for io in ("sensed", "free"):
        rows = None if io == "sensed" else slice(1, None)
        found = recognise(fit.network, motions[0], rows=rows, settings=QUICK, key=KEY)
        first = motions.values[0][0] if io == "sensed" else None

        path = generate(fit.network, found.initial_state, 24, first=first)

        np.testing.assert_allclose(path, found.path, atol=1e-4)


def test_residual_and_error_are_those_of_the_path(fit, motions):
    found = recognise(fit.network, motions[2], observed=["x", "z"], settings=QUICK, key=KEY)

    residual = np.sqrt(((found.path - motions.values[2]) ** 2)[1:].mean(0))
    np.testing.assert_allclose(found.residual[[0, 2]], residual[[0, 2]], rtol=1e-3)
    shares = residual[[0, 2]] / (4.0, 6.0)
    assert found.error == pytest.approx(np.sqrt((shares**2).mean()), rel=1e-3)
    assert found.loss == pytest.approx((29 * (0.8 * shares) ** 2).sum(), rel=1e-3)


def test_of_several_starts_the_best_is_kept(fit, motions):
    rng = np.random.default_rng(0)
    starts = rng.normal(0.0, 2.0, (4, 17))
    # So many steps are taken from every start, before only the best goes on.
    short = Recognition(iterations=8, starts=0)
    alone = [recognise(fit.network, motions[0], starts=s[None], settings=short) for s in starts]

    together = recognise(fit.network, motions[0], starts=starts, settings=short)

    losses = [found.loss for found in alone]
    assert together.start == int(np.argmin(losses))
    assert together.loss == pytest.approx(min(losses), rel=1e-3)
    best = alone[together.start].initial_state
    np.testing.assert_allclose(together.initial_state, best, atol=1e-3)


def test_given_starts_are_counted_before_random_ones(fit, motions):
    short = Recognition(iterations=1, starts=2, spread=3.0)

    found = recognise(
        fit.network, motions[1], starts=fit.initial_states[1:2], settings=short, key=KEY
    )

    assert found.start == 0


def test_the_best_on_the_way_is_kept_when_descent_overshoots(fit, motions):
    wild = Recognition(iterations=50, starts=0, optimiser="descent", rate=100.0)

    found = recognise(fit.network, motions[0], starts=fit.initial_states[:1], settings=wild)

    still = Recognition(iterations=1, starts=0, optimiser="descent", rate=0.0)
    begun = recognise(fit.network, motions[0], starts=fit.initial_states[:1], settings=still)
    assert found.loss <= begun.loss
    in_unit_interval = found.residual / motions.channels.interval_widths
    assert found.loss == pytest.approx(23 * (in_unit_interval**2).sum(), rel=1e-3)


def test_bounds_hold_even_for_starts_beyond_them(fit, motions):
    bounded = Recognition(iterations=60, starts=0, bound={"cf": 0.3, "cs": 0.1})

    found = recognise(fit.network, motions[0], starts=np.full((1, 17), 4.0), settings=bounded)

    assert np.abs(found.initial_state[3:15]).max() <= np.float32(0.3)
    assert np.abs(found.initial_state[15:]).max() <= np.float32(0.1)
    assert np.abs(found.initial_state[:3]).max() > 0.3


def test_a_penalty_draws_the_states_towards_zero(fit, motions):
    sizes = []
    for penalty in (0.0, 0.1, 10.0):
        chosen = Recognition(iterations=100, starts=0, penalty=penalty)
        found = recognise(fit.network, motions[0], starts=fit.initial_states[:1], settings=chosen)
        sizes.append(np.linalg.norm(found.initial_state[3:]))

    assert sizes[0] > 1.2 * sizes[1] > 1.2**2 * sizes[2]


def test_verdicts(fit, motions):
    foreign = np.stack(
        [np.linspace(-2, 2, 24), np.tile([-1.5, 1.5], 12), np.linspace(3, -3, 24)], 1
    )

    known = recognise(fit.network, motions[0], settings=QUICK, key=KEY)
    strange = recognise(fit.network, foreign, settings=QUICK, key=KEY)
    unseen = recognise(fit.network, motions[0], rows=slice(0, 1), settings=TOLD)

    assert known.status.ending is Ending.RECOGNISED
    assert "of a channel's range, allowed 10.0%" in known.status.sentence
    assert strange.status.ending is Ending.NOT_RECOGNISED
    assert not strange.status.failed
    assert unseen.status.ending is Ending.NOT_RECOGNISED
    assert "nothing was observed after the first row" in unseen.status.sentence
    assert np.isnan(unseen.residual).all()


def test_a_network_that_computes_nothing_finite_is_a_verdict(fit, motions):
    broken = replace(fit.network, weights=fit.network.weights * np.nan, bias=fit.network.bias)

    found = recognise(broken, motions[0], settings=TOLD)

    assert found.status.ending is Ending.DIVERGED
    assert found.status.failed


@pytest.mark.slow
def test_padding_and_company_change_nothing(fit, motions):
    plain = recognise_all(fit.network, motions, settings=QUICK, key=KEY)
    padded = recognise_all(fit.network, motions, settings=QUICK, key=KEY, padded_to=(6, 40))
    alone = recognise(fit.network, motions[0], settings=QUICK, key=KEY)

    for one, other in [*zip(plain, padded, strict=True), (plain[0], alone)]:
        assert one.start == other.start
        assert one.path.shape == other.path.shape
        np.testing.assert_allclose(one.path, other.path, atol=0.05)


def test_the_same_key_gives_the_same_bits_and_another_key_others(fit, motions):
    first, again, other = (
        recognise(fit.network, motions[0], settings=QUICK, key=jax.random.key(k)) for k in (0, 0, 1)
    )

    np.testing.assert_array_equal(first.initial_state, again.initial_state)
    assert (first.initial_state != other.initial_state).any()


@pytest.mark.slow
def test_the_network_s_scaling_counts(fit, motions):
    elsewhere = Motions.from_arrays([motions.values[1]], motions.channels.names, 10.0)

    found = recognise(fit.network, elsewhere, settings=QUICK, key=KEY)

    expected = recognise(fit.network, motions[1], settings=QUICK, key=KEY)
    np.testing.assert_array_equal(found.initial_state, expected.initial_state)
    np.testing.assert_array_equal(found.path, expected.path)


@pytest.mark.slow
def test_recognition_does_not_pay_for_the_weights_gradient(fit, motions):
    batch = motions.batch()
    net, bound = fit.network, np.full(17, np.inf, np.float32)
    rows, units, starts = 30, 32, 3

    def operations(compiled, *arguments):
        return compiled.lower(*arguments).compile().compiled.cost_analysis()["flops"]

    # Counted once each: loops' bodies, and the product over all steps that is ∂E/∂W alone.
    weights_gradient = 2 * (rows - 1) * len(motions) * units**2
    free = np.zeros((3, starts, 17), np.float32)
    rule, none = recognition_rule("adam", 0.1, 0.9, 10), np.float32(0.0)
    enough = np.full(free.shape[:2], -np.inf, np.float32)
    search = Search(net, batch, free, np.arange(17), bound, none, enough)
    paid = operations(descend, search, rule, 10)
    learner, learned = (
        Parameters(net, jnp.asarray(free[:, 0])),
        ("weights", "bias", "initial_states"),
    )
    trained, start = training_rule(Training(), learned), learner.free(learned)
    state, error = Iterate(start, trained.init(start), jnp.asarray(0)), ERRORS["squared"]
    training = operations(
        run_updates, state, learner, batch, trained, error, none, bound, None, {}, KEY, 10
    )
    assert paid < starts * weights_gradient
    assert training > weights_gradient


@pytest.mark.slow
def test_without_a_key_the_random_starts_are_those_of_key_0(fit, motions):
    found, same = (
        recognise(fit.network, motions[0], settings=Recognition(iterations=10), **key)
        for key in ({}, {"key": jax.random.key(0)})
    )
    assert np.array_equal(found.initial_state, same.initial_state)


def test_what_does_not_fit_is_refused(network, fit, motions):
    with pytest.raises(SettingError, match="takes one motion, got 3; see recognise_all"):
        recognise(fit.network, motions, key=KEY)
    with pytest.raises(ChannelError, match=r"unknown channel 'X'; did you mean 'x'\?"):
        recognise(fit.network, motions[0], observed=["X"], key=KEY)
    with pytest.raises(ChannelError, match="the network carries no channels"):
        recognise(network, motions.values[0], key=KEY)
    with pytest.raises(MotionError, match="row 3, channel 'y': values must be finite, got nan"):
        broken = motions.values[0].copy()
        broken[3, 1] = np.nan
        recognise(fit.network, broken, observed=["x", "y"], key=KEY)
    with pytest.raises(MotionError, match=r"expected an array \[T, 3\]"):
        recognise(fit.network, motions.values[0][:, :2], observed=["x"], key=KEY)
    with pytest.raises(
        SettingError, match=r"starts must have shape \[3 motions, .* got \(2, 1, 17"
    ):
        recognise_all(fit.network, motions, starts=np.zeros((2, 1, 17)), key=KEY)
    with pytest.raises(SettingError, match="the motions' x, y, w"):
        other = Motions.from_arrays(motions.values, ["x", "y", "w"], 10.0)
        recognise_all(fit.network, other, key=KEY)
