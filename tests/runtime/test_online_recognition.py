"""Recognition while it happens: what is known after every reading."""

import warnings

import numpy as np
import pytest

from motionese.errors import ControlError
from motionese.runtime import NONE, OnlineRecognition, Stepper
from motionese.runtime import online_recognition as module


def generated(model, name, rows=None):
    """A learned motion as the network generates it, in the channels' units."""
    state, stepper = model.begin(name), Stepper(model)
    nothing, path = np.full(3, np.nan), []
    for _ in range(rows or model.lengths[name]):
        path.append(state.y[:3].astype(float).copy())
        stepper.step(state, nothing, np.zeros(3))
    return model.from_unit(np.array(path))


def observed(online, path):
    return [online.observe(row) for row in path]


@pytest.mark.parametrize("saved", ["sensed", "zero"], indirect=True)
def test_a_learned_motion_is_recognised_and_predicted(model):
    path = generated(model, "wave")
    online = OnlineRecognition(model, window=8, ahead=3)

    results = observed(online, path)

    for row in (12, 20, 27):
        known = results[row]
        assert known.row == row and known.likeliest == known.learned[0] == "wave"
        np.testing.assert_allclose(known.path[-1], path[row], atol=0.02 * 135)
        np.testing.assert_allclose(known.ahead, path[row + 1 : row + 4], atol=0.03 * 135)
        assert known.path.shape == (8, 3) and known.ahead.shape == known.spread.shape == (3, 3)
        assert known.error < 0.02 and known.values == 7 * 3
        assert sum(known.belief.values()) == pytest.approx(1)
        np.testing.assert_array_equal(known.expected(row), known.path[-1])
        np.testing.assert_array_equal(known.expected(row + 2), known.ahead[1])
        np.testing.assert_array_equal(known.expected(0), known.path[0])
        np.testing.assert_array_equal(known.expected(row + 9), known.ahead[-1])


def test_without_rows_ahead_the_rest_is_known_alike(model):
    path = generated(model, "wave", 12)
    none, some = (observed(OnlineRecognition(model, ahead=n), path)[-1] for n in (0, 3))
    assert none.ahead.shape == none.spread.shape == (0, 3)
    assert none.learned == some.learned
    np.testing.assert_array_equal(none.path, some.path)


def test_hidden_channels_follow_from_the_others(model):
    path = generated(model, "reach")
    online = OnlineRecognition(model, observed=["lift", "grip"], window=10)
    known = observed(online, path)[25]
    assert known.values == 9 * 2
    assert abs(known.path[-1, 1] - path[25, 1]) < 0.05 * 135


def test_steps_make_the_windows_error_smaller(model):
    rng = np.random.default_rng(1)
    path = generated(model, "reach")
    path = path + rng.normal(0.0, 0.06, 3) * (3.0, 135.0, 1.0)  # shown somewhere else
    still, moving = (
        observed(OnlineRecognition(model, window=10, steps=steps, accuracy=0.08), path)
        for steps in (0, 2)
    )
    assert [r.steps for r in still] == [0] * len(path)
    later = slice(5, None)
    assert np.mean([r.error for r in moving[later]]) < 0.9 * np.mean(
        [r.error for r in still[later]]
    )


def test_a_change_of_motion_begins_the_window_anew(model):
    first, second = generated(model, "reach"), generated(model, "wave")
    results = observed(OnlineRecognition(model, window=12), [*first[:15], *second[2:17]])
    assert results[14].likeliest == "reach"
    assert results[-1].likeliest == "wave"
    assert results[-1].error < 0.05
    changed = next(r.row for r in results[15:] if r.likeliest == "wave")
    assert changed - 15 <= 5


def test_the_spread_is_smaller_where_more_was_observed(model):
    path = generated(model, "reach")
    rich = observed(OnlineRecognition(model, window=15), path)[20]
    poor = observed(OnlineRecognition(model, window=15, observed=["grip"]), path)[20]
    assert (rich.spread <= poor.spread + 1e-9).all() and (rich.spread < poor.spread).any()
    assert (rich.spread > 0).all()


def test_gaps_late_readings_and_their_order(model):
    path = generated(model, "reach")
    whole = OnlineRecognition(model, window=10)
    expected = observed(whole, path[:14])[-1]

    mixed = OnlineRecognition(model, window=10)
    for row in (0, 1, 2, 3, 5, 4, 8, 6, 7, 9, 10, 11, 13, 12):
        known = mixed.observe(path[row], row=row)
    assert known.row == 13 and known.values == expected.values
    np.testing.assert_allclose(known.path[-1], expected.path[-1], atol=0.02 * 135)
    assert mixed.late == 0
    mixed.observe(path[2], row=2)
    assert mixed.late == 1
    known = mixed.observe(None)
    assert known.row == 14 and known.values == expected.values - 3


def test_what_does_not_fit_into_the_budget_is_postponed(model, monkeypatch):
    moment = iter(np.arange(0, 1000, 0.004))
    monkeypatch.setattr(module.time, "perf_counter", lambda: next(moment))
    online = OnlineRecognition(model, budget_ms=9.0)
    path = generated(model, "reach")
    results = observed(online, path)
    assert [r.steps for r in results] == [1] * len(path)
    assert online.postponed == len(path)


def test_a_step_longer_than_the_budget_is_told_with_its_figure(model, monkeypatch):
    moment = iter(np.arange(0, 1000, 0.008))
    monkeypatch.setattr(module.time, "perf_counter", lambda: next(moment))
    online = OnlineRecognition(model, budget_ms=8.5)
    online.observe(generated(model, "reach")[0])
    online._step_s = 0.02
    with pytest.warns(UserWarning, match=r"takes 20\.00 ms, more than the budget of 8\.5 ms"):
        online.observe(None)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert online.observe(None).steps == 0


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"window": 1}, "window must be 2 or more, got 1"),
        ({"steps": -1}, "steps must be 0 or more, got -1"),
        ({"ahead": -1}, "ahead must be 0 or more, got -1"),
        ({"budget_ms": 0.0}, r"budget_ms must be finite and > 0, got 0\.0"),
        ({"accuracy": float("nan")}, "accuracy must be finite and > 0, got nan"),
        ({"observed": ["lift", "nose"]}, "unknown channel 'nose'"),
    ],
)
def test_what_is_out_of_range_is_told(model, settings, said):
    with pytest.raises(ControlError, match=said):
        OnlineRecognition(model, **settings)


def test_nothing_is_believed_of_what_was_never_shown(model):
    rng = np.random.default_rng(5)
    strange = rng.uniform((-1.0, -90.0, 0.0), (2.0, 45.0, 1.0), (12, 3))
    assert observed(OnlineRecognition(model), strange)[-1].likeliest == NONE


def test_what_is_not_observed_is_as_it_was_learned(model):
    path = generated(model, "reach")
    rng = np.random.default_rng(2)
    noisy = path + rng.normal(0.0, 0.01, path.shape) * (3.0, 135.0, 1.0)
    results = observed(OnlineRecognition(model, observed=["grip"], window=10), noisy)
    hidden = np.array([r.path[-1, :2] - path[r.row, :2] for r in results[15:]]) / (3.0, 135.0)
    assert np.abs(hidden).mean() < 0.02


def test_a_row_below_0_is_told(model):
    online = OnlineRecognition(model)
    with pytest.raises(ControlError, match="row must be 0 or more, got -1"):
        online.observe([0.0, 0.0, 0.0], row=-1)
    assert online.observe([0.0, 0.0, 0.0]).row == 0
