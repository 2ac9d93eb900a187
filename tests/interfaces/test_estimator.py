"""The estimator: scikit-learn's own checks, and that it does what the library does."""

import sys

import numpy as np
import pandas as pd
import pytest
from sklearn.base import clone
from sklearn.metrics import r2_score
from sklearn.model_selection import cross_val_score
from sklearn.utils.estimator_checks import estimator_checks_generator

import motionese
from motionese.errors import ChannelError, MissingPackageError, SettingError
from motionese.interfaces.commands.train import read_levels
from motionese.interfaces.estimator import MTRNNImitator
from motionese.learning import Recognition, generate
from motionese.network import Level

HASTY = Recognition(iterations=5, starts=1)
A_ROW_IS_NOT_A_SAMPLE = "rows are moments of one motion: their order and neighbours matter"
EXPECTED_TO_FAIL = {
    "check_methods_sample_order_invariance": A_ROW_IS_NOT_A_SAMPLE,
    "check_methods_subset_invariance": A_ROW_IS_NOT_A_SAMPLE,
}
LEFT_OUT = {"check_array_api_input": "is skipped unless SciPy was imported in another mode"}
TRAIN_NOTHING = {
    "check_do_not_raise_errors_in_init_or_set_params",
    "check_estimator_cloneable",
    "check_estimator_repr",
    "check_estimator_tags_renamed",
    "check_estimators_empty_data_messages",
    "check_estimators_unfitted",
    "check_fit1d",
    "check_fit2d_1sample",
    "check_get_params_invariance",
    "check_mixin_order",
    "check_no_attributes_set_in_init",
    "check_parameters_default_constructible",
    "check_set_params",
    "check_valid_tag_types",
}
"""The other checks compile for each shape they train on, and are slow together."""


def checks():
    listed = []
    tiny = MTRNNImitator("3:3", epochs=20, recognition=HASTY)
    for estimator, check in estimator_checks_generator(tiny):
        name = check.func.__name__
        if name not in LEFT_OUT:
            marks = () if name in TRAIN_NOTHING else pytest.mark.slow
            listed.append(pytest.param(estimator, check, name, marks=marks, id=name))
    return listed


@pytest.mark.usefixtures("unchecked")
@pytest.mark.parametrize(("estimator", "check", "name"), checks())
def test_scikit_learn_s_own_checks(estimator, check, name):
    if name in EXPECTED_TO_FAIL:
        with pytest.raises((AssertionError, ValueError)):
            check(estimator)
    else:
        check(estimator)


@pytest.fixture(scope="module")
def shown():
    """Three motions of different lengths over three columns that go together.

    Most tests predict three motions of up to 30 rows, so that recognition is compiled once.
    """
    motions = []
    for speed, rows in ((1.0, 30), (1.6, 26), (2.2, 30)):
        t = np.linspace(0, speed, rows)
        motions.append(np.stack([np.sin(3 * t), np.cos(3 * t) * speed, speed - t], axis=1))
    return motions


@pytest.fixture(scope="module")
def fitted(shown):
    return MTRNNImitator("15:4,3:20", epochs=300, rate_hz=25.0).fit(shown)


def test_it_learns_motions_of_different_lengths(fitted, shown):
    paths = fitted.predict(shown)

    assert [path.shape for path in paths] == [motion.shape for motion in shown]
    assert fitted.score(shown) > 0.95


def test_a_hidden_column_is_recalled(fitted, shown):
    seeing = clone(fitted).set_params(observed=[0, 1])
    seeing.__dict__ |= {k: v for k, v in vars(fitted).items() if k.endswith("_")}
    hidden = [motion * [1, 1, np.nan] for motion in shown]

    paths = seeing.predict(shown)
    np.testing.assert_allclose(paths[0], fitted.predict(hidden)[0], atol=1e-6)
    assert r2_score(np.concatenate(shown)[:, 2], np.concatenate(paths)[:, 2]) > 0.9
    assert np.isnan(seeing.recognise(shown)[0].residual[2])


def test_paths_are_those_of_the_library_in_closed_loop(fitted, shown):
    found = fitted.recognise(shown)[0]

    generated = generate(fitted.fit_.network, found.initial_state, len(shown[0]), first=shown[0][0])
    np.testing.assert_allclose(fitted.predict(shown)[0][1:], generated[1:], atol=1e-4)


def test_the_score_is_the_columns_mean_share_of_variance_after_the_first_row(fitted, shown):
    with_gaps = [motion.copy() for motion in shown]
    with_gaps[0][:12, 1] = np.nan
    paths = fitted.predict(with_gaps)

    told = np.concatenate([motion[1:] for motion in with_gaps])
    predicted = np.concatenate([path[1:] for path in paths])
    residual = np.nansum((told - predicted) ** 2, axis=0)
    spread = np.nansum((told - np.nanmean(told, axis=0)) ** 2, axis=0)
    assert fitted.score(with_gaps) == pytest.approx((1 - residual / spread).mean(), rel=1e-6)


def test_nothing_to_score_is_told(fitted, shown):
    hidden = np.full_like(shown[0], np.nan)
    hidden[0] = shown[0][0]

    with pytest.raises(ValueError, match="nothing to score"):
        fitted.score([hidden] * 3)


def test_an_array_of_motions_gives_one_back(fitted, shown):
    motions = np.stack([shown[0], shown[2], shown[0]])

    paths = fitted.predict(motions)
    assert paths.shape == motions.shape
    np.testing.assert_allclose(paths, np.stack(fitted.predict(list(motions))), atol=1e-6)


@pytest.mark.slow
def test_one_motion_gives_one_path_and_a_table_its_names(shown):
    frame = pd.DataFrame(shown[0], columns=["a", "b", "c"])
    named = MTRNNImitator("4:4", epochs=5, observed=["a", "c"], recognition=HASTY).fit(frame)

    assert named.predict(frame).shape == frame.shape
    assert named.channels_.names == ("a", "b", "c")
    assert named.fit_.network.channels == named.channels_
    assert np.isnan(named.recognise(frame)[0].residual).tolist() == [False, True, False]
    with pytest.raises(ChannelError, match=r"unknown channel 'd'.* a, b, c"):
        named.set_params(observed=["d"]).predict(frame)


def test_the_same_random_state_gives_the_same_weights(shown):
    def weights(state):
        return MTRNNImitator("4:4", epochs=5, random_state=state).fit(shown).fit_.network.weights

    np.testing.assert_array_equal(weights(3), weights(3))
    assert not np.array_equal(weights(3), weights(4))


@pytest.mark.slow
def test_it_is_cross_validated_over_motions(shown):
    small = MTRNNImitator("4:4", epochs=5, recognition=HASTY)

    scores = cross_val_score(small, [shown[0], shown[2], shown[0]], cv=3)
    assert np.isfinite(scores).all()


@pytest.mark.parametrize("column", [-1, 3])
def test_a_column_that_is_not_there_is_told(fitted, shown, column):
    seeing = clone(fitted).set_params(observed=[column])
    seeing.__dict__ |= {k: v for k, v in vars(fitted).items() if k.endswith("_")}

    with pytest.raises(SettingError, match=f"columns 0 to 2, got {column}"):
        seeing.predict(shown)


def test_what_is_wrong_with_a_motion_is_told(shown):
    endless = shown[1].copy()
    endless[3, 1] = np.inf
    for wrong, sentence in (
        (shown[1][:, :2], "motion 1: X has 2 features, but MTRNNImitator is expecting 3"),
        (shown[1][:1], "motion 1: Found array with 1 sample"),
        (endless, "motion 1: Input X contains infinity"),
    ):
        with pytest.raises(ValueError, match=sentence):
            MTRNNImitator().fit([shown[0], wrong])
    with pytest.raises(ChannelError, match="channel 'x1' is always 1"):
        MTRNNImitator().fit([np.stack([np.arange(5.0), np.ones(5)], axis=1)])


def test_without_scikit_learn_the_extra_is_told(monkeypatch):
    monkeypatch.delitem(sys.modules, "motionese.interfaces.estimator")
    monkeypatch.setitem(sys.modules, "sklearn.base", None)

    assert motionese.Motions
    with pytest.raises(MissingPackageError, match=r"MTRNNImitator.*motionese\[sklearn\]"):
        _ = motionese.MTRNNImitator


def test_it_is_a_public_name():
    assert motionese.MTRNNImitator is MTRNNImitator
    assert "MTRNNImitator" in dir(motionese)


def test_levels_are_read_from_text_and_from_pairs():
    assert read_levels("40:5,8:70") == [Level(40, 5.0), Level(8, 70.0)]
    assert read_levels([(40, 5)]) == [Level(40, 5.0)]


@pytest.mark.usefixtures("unchecked")
@pytest.mark.parametrize(
    "levels",
    ["", "40", "40:5;8:70", "40:5,", "4.5:3", "0:5", "4:0.5", "4:nan", 40, [40, 8], [(40, "fast")]],
)
def test_levels_that_are_none_are_told(levels):
    with pytest.raises(SettingError):
        read_levels(levels)
