"""Held-out motions: told all the way, the best network kept for them, and what a fit says."""

from dataclasses import replace

import numpy as np
import pytest

from motionese import Motions, Training, recognise, train
from motionese.errors import SettingError
from motionese.learning import Ending

# Without a tolerance, training ends only where the best network lies before the last one.
EARLY = Training(epochs=4000, schedule="constant", patience=200, tolerance=0.0)


@pytest.fixture(scope="module")
def unlike(motions):
    """A motion that fits the others less well the better they are learned."""
    return Motions.from_arrays([motions.values[0] * (1, 1, -1)], motions.channels, 10.0)


@pytest.fixture(scope="module")
def told():
    return []


@pytest.fixture(scope="module")
def early(network, motions, unlike, told):
    return train(
        network,
        motions.chosen(["a", "b"]),
        settings=EARLY,
        validation=unlike,
        progress=told.append,
    )


def test_the_network_that_was_best_for_them_is_kept(early, told):
    best = told[int(early.validation_losses.argmin())]
    assert early.status.ending is Ending.CONVERGED
    assert "the loss of the held-out motions fell by less than 0 of" in str(early.status)
    assert best.epoch < told[-1].epoch == len(early.losses) < EARLY.epochs

    kept = early.share(early.closed_loop_error)

    assert kept == pytest.approx(best.closed_loop_error, rel=1e-5)
    assert kept != pytest.approx(told[-1].closed_loop_error, rel=1e-3)


def test_progress_tells_both_errors_and_both_losses(early, told):
    losses = early.validation_losses
    assert [now.epoch for now in told] == [100 * (i + 1) for i in range(len(losses))]
    assert [now.loss for now in told] == list(early.losses[99::100])
    assert [now.validation_loss for now in told] == list(losses)
    for now in told:
        # Of 23 rows of 3 channels, a whole range being 0.8 of the unit interval.
        assert now.validation_loss == pytest.approx(
            69 * (0.8 * now.validation_error) ** 2, rel=1e-3
        )


def test_without_held_out_motions_nothing_is_said_of_them(network, motions):
    told = []

    fit = train(network, motions, epochs=100, progress=told.append)

    assert (told[0].validation_loss, told[0].validation_error) == (None, None)
    assert fit.validation_names == ()
    assert fit.validation_error.shape == (0, 3)
    assert fit.validation_losses.shape == (0,)


def test_a_fit_says_what_it_was_made_of(early):
    assert early.names == ("a", "b")
    assert early.lengths == (24, 18)
    assert early.rate_hz == 10.0
    assert early.validation_names == ("0",)
    assert early.index("b") == 1
    with pytest.raises(SettingError, match="unknown motion 'c'"):
        early.index("c")


def test_the_error_of_held_out_motions_is_that_of_their_recognition(early, unlike):
    found = recognise(early, unlike)

    assert early.validation_error.shape == (1, 3)
    np.testing.assert_allclose(early.validation_error[0], found.residual, rtol=1e-5)
    assert found.error == pytest.approx(early.share(early.validation_error), rel=1e-5)


def test_held_out_motions_must_fit_the_others(network, motions):
    slower = replace(motions, rate_hz=5.0)
    with pytest.raises(SettingError, match="have 5 rows a second, the others 10"):
        train(network, motions, epochs=1, validation=slower)
    other = Motions.from_arrays(motions.values, ["x", "y", "w"], 10.0)
    with pytest.raises(SettingError, match="channels are x, y, z, the motions' x, y, w"):
        train(network, motions, epochs=1, validation=other)
