"""Memory: what was learned is recognised from a part of its channels, the nearest first."""

from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import MTRNN, Level, Motions, Recognition, Training, recognise, train
from motionese.errors import SettingError
from motionese.learning import Ending, recognise_all
from motionese.learning.memory import RECALLED, SLACK, Memory


def far(found, values, channels):
    """The largest root mean squared distance of a recognised path, as a share of a range."""
    return (np.sqrt(((found.path - values) ** 2)[1:].mean(0)) / channels.spans).max()


@pytest.mark.slow
@pytest.mark.parametrize("observed", ["x", "y", "z"])
def test_hidden_channels_are_recovered_from_a_third_of_them(fit, motions, observed):
    for values in motions.values:
        found = recognise(fit, values, observed=[observed])

        assert found.status.ending is Ending.RECOGNISED
        assert far(found, values, motions.channels) < 0.05


@pytest.mark.slow
@pytest.mark.parametrize("observed", ["x", "z"])
def test_a_network_without_its_memory_recovers_less(fit, motions, observed):
    shown = motions.showing([observed])

    with_memory, without = (
        max(
            far(each, values, motions.channels)
            for each, values in zip(found, motions.values, strict=True)
        )
        for found in (
            recognise_all(fit, shown),
            recognise_all(fit.network, shown, settings=Recognition(iterations=100)),
        )
    )

    assert without > 5 * with_memory


@pytest.mark.slow
def test_what_is_given_and_drawn_counts_after_what_is_recalled(fit, motions):
    given = fit.initial_states[1:2] + 0.1
    settings = Recognition(iterations=200, starts=2)
    unlike = Motions.from_arrays([motions.values[1] * (1, -1, 1)], motions.channels, 10.0)

    recall = fit.memory.nearest(fit.network, unlike.batch())
    starts = [
        recognise(fit, unlike, settings=settings, starts=given).start,
        recognise(fit.network, unlike, settings=settings, starts=given).start,
    ]

    assert recall.starts.shape == (1, 3, 17)
    assert starts[0] < 6
    assert starts[1] < 3


def test_the_nearest_learned_motions_come_first(fit, motions):
    shown = motions.showing(["x", "z"])
    as_it_is = Recognition(iterations=1, starts=0, optimiser="descent", rate=0.0)

    recall = fit.memory.nearest(fit.network, shown.batch(40, 4))

    assert recall.starts.shape == (4, 3, 17)
    for i, motion in enumerate(shown):
        losses = [
            recognise(fit.network, motion, starts=state[None], settings=as_it_is).loss
            for state in fit.initial_states
        ]
        np.testing.assert_array_equal(recall.starts[i], fit.initial_states[np.argsort(losses)])
        np.testing.assert_array_equal(recall.starts[i, 0], fit.initial_states[i])


def test_enough_is_as_near_as_each_was_learned(fit, motions):
    seen = [np.zeros(values.shape, bool) for values in motions.values]
    seen[0][1:11, 0], seen[0][1:6, 2] = True, True
    batch = replace(motions, observed=tuple(seen)).batch()

    recall = fit.memory.nearest(fit.network, batch)

    # In the unit interval, where a range is 0.8: 10 rows of x and 5 of z, and not row 0.
    unit = 0.8 * fit.closed_loop_error / motions.channels.spans
    each = SLACK**2 * (10 * unit[:, 0] ** 2 + 5 * unit[:, 2] ** 2)
    order = [int(np.flatnonzero((fit.initial_states == s).all(1))[0]) for s in recall.starts[0]]
    np.testing.assert_allclose(recall.enough[0], each[order], rtol=1e-5)
    assert recall.typical[0] == pytest.approx(np.median(each), rel=1e-5)
    np.testing.assert_array_equal(recall.enough[1:], 0.0)


def test_an_error_that_is_not_known_counts_as_a_typical_one(fit, motions):
    unknown = fit.closed_loop_error.copy()
    unknown[1, 0], unknown[:, 1] = np.nan, np.nan
    batch = motions.showing(["x"]).batch()
    squared = (0.8 * unknown[:, 0] / 4.0) ** 2

    memory = replace(fit.memory, errors=unknown)
    recall = memory.nearest(fit.network, batch)

    squared[1] = np.median(squared[[0, 2]])
    for i, rows in enumerate((23, 17, 29)):
        np.testing.assert_allclose(
            sorted(recall.enough[i]), np.sort(rows * SLACK**2 * squared), rtol=1e-5
        )
    unseen = memory.nearest(fit.network, motions.showing(["y"]).batch())
    np.testing.assert_array_equal(unseen.enough, 0.0)


@pytest.mark.slow
def test_no_more_than_some_are_recalled_of_many():
    rng = np.random.default_rng(0)
    many = Motions.from_arrays([*rng.uniform(size=(6, 5, 1))], ["x"], 10.0)
    net = MTRNN.draw([Level(1, 2.0), Level(2, 5.0)], key=jax.random.key(0))
    fit = train(net, many, settings=Training(epochs=1))

    assert fit.memory.nearest(fit.network, many.batch()).starts.shape == (6, RECALLED, 3)


@pytest.mark.slow
def test_what_is_recalled_does_not_depend_on_company_or_padding(fit, motions):
    together = recognise_all(fit, motions.showing(["y"]))
    padded = recognise_all(fit, motions.showing(["y"]), padded_to=(5, 40))

    for i, (one, other) in enumerate(zip(together, padded, strict=True)):
        alone = recognise(fit, motions[i], observed=["y"])
        for each in (one, other):
            assert each.start == alone.start
            np.testing.assert_allclose(each.path, alone.path, atol=1e-4)


def test_a_network_and_its_memory_recognise_as_their_fit_does(fit, motions):
    shown = motions.showing(["x"])

    for one, other in zip(
        recognise_all(fit, shown), recognise_all((fit.network, fit.memory), shown), strict=True
    ):
        np.testing.assert_array_equal(one.initial_state, other.initial_state)
        assert (one.start, one.loss) == (other.start, other.loss)


@pytest.mark.slow
def test_a_memory_of_unknown_errors_is_searched_to_the_end(fit, motions):
    memory = replace(fit.memory, errors=np.full((3, 3), np.nan))
    settings = Recognition(iterations=60, starts=0)
    starts = fit.memory.nearest(fit.network, motions[1].batch()).starts

    found = recognise((fit.network, memory), motions[1], settings=settings)

    expected = recognise(fit.network, motions[1], settings=settings, starts=starts[0])
    np.testing.assert_array_equal(found.initial_state, expected.initial_state)
    assert found.start == expected.start


def test_an_empty_memory_recalls_nothing(fit, motions):
    empty = Memory((), np.zeros((0, 17)), np.zeros((0, 3)))

    found = recognise((fit.network, empty), motions[0])

    expected = recognise(fit.network, motions[0])
    np.testing.assert_array_equal(found.initial_state, expected.initial_state)


def test_motions_of_another_rate_are_refused(fit, motions):
    faster = Motions.from_arrays(motions.values, motions.channels, 2 * motions.rate_hz)

    with pytest.raises(SettingError, match="20 rows a second, the model was trained at 10"):
        recognise_all(fit, faster)
