"""Generation: shapes, units, batches, what is refused."""

import numpy as np
import pytest

from motionese import generate
from motionese.errors import ChannelError, SettingError
from motionese.learning import activity


def test_a_batch_generates_what_its_members_generate(fit, motions):
    together = generate(fit.network, fit.initial_states, 20)

    assert together.shape == (3, 20, 3)
    for state, path in zip(fit.initial_states, together, strict=True):
        np.testing.assert_allclose(generate(fit.network, state, 20), path, atol=1e-5)
    grid = generate(fit.network, fit.initial_states.reshape(1, 3, 17), 20)
    np.testing.assert_array_equal(grid, together[None])


def test_a_fit_generates_its_motions(fit, motions):
    for state, values in zip(fit.initial_states, motions.values, strict=True):
        path = generate(fit.network, state, len(values), first=values[0])

        np.testing.assert_allclose(path[0], values[0], atol=1e-6)
        assert (np.sqrt(((path - values) ** 2).mean(0)) < (0.4, 0.3, 0.6)).all()


def test_a_channel_that_is_not_sensed_at_first_is_predicted(fit, motions):
    state, values = fit.initial_states[0], motions.values[0][0] + 0.2
    own = generate(fit.network, state, 20)
    given, partly = np.array([values[0], np.nan, np.nan]), own[0].copy()
    partly[0] = values[0]

    path = generate(fit.network, state, 20, first=given)

    np.testing.assert_allclose(path, generate(fit.network, state, 20, first=partly), atol=1e-5)
    assert np.abs(path - own)[1:].max() > 1e-3


def test_activity_holds_the_path_in_the_unit_interval(fit, motions):
    outputs = activity(fit.network, fit.initial_states[0], 20)

    assert outputs.shape == (20, 17)
    assert ((outputs > 0) & (outputs < 1)).all()
    path = motions.channels.from_unit(outputs[:, :3])
    np.testing.assert_array_equal(path, generate(fit.network, fit.initial_states[0], 20))


def test_what_cannot_be_generated_is_refused(network, fit):
    with pytest.raises(ChannelError, match="carries no channels; train it on motions first"):
        generate(network, fit.initial_states[0], 20)
    with pytest.raises(SettingError, match=r"one value per unit \(17\), got 16"):
        generate(fit.network, fit.initial_states[0, :16], 20)
    with pytest.raises(SettingError, match="steps must be ≥ 2, got 1"):
        generate(fit.network, fit.initial_states[0], 1)
