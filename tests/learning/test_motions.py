"""Motions: ragged, masked, and padded by nothing that has a meaning."""

from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import Channel, Channels, Motions, Training, train
from motionese.errors import ChannelError, MotionError, SettingError
from motionese.learning.error import ERRORS
from motionese.learning.objective import predictions

NAMES = ["pan", "tilt"]


def two(**given):
    rng = np.random.default_rng(0)
    return Motions.from_arrays(
        [rng.normal(size=(5, 2)), rng.normal(size=(3, 2))], NAMES, 10, **given
    )


def test_motions_keep_their_values_lengths_and_names():
    motions = two(names=["UR ↓", "UR ←"])

    assert len(motions) == 2
    assert motions.lengths == (5, 3)
    assert motions.names == ("UR ↓", "UR ←")
    assert two().names == ("0", "1")
    assert [one.lengths for one in motions] == [(5,), (3,)]
    assert motions[1].names == ("UR ←",)
    assert all(mask.all() for mask in motions.observed)


def test_values_are_copied_so_that_a_later_change_does_not_reach_them():
    values = np.arange(8.0).reshape(4, 2)
    motions = Motions.from_arrays([values], NAMES, 10.0)

    values[:] = 0.0

    assert motions.values[0][3, 1] == 7.0


def test_ranges_come_from_the_observed_data_with_a_margin_or_as_given():
    values, mask = np.array([[0.0, 1.0], [10.0, 3.0], [99.0, 2.0]]), np.ones((3, 2), bool)
    mask[2, 0] = False

    motions = Motions.from_arrays(
        [values], NAMES, 10.0, observed=[mask], units={"pan": "rad"}, ranges={"tilt": (-9.0, 9.0)}
    )

    assert tuple(motions.channels) == (
        Channel("pan", "rad", -0.5, 10.5),
        Channel("tilt", "", -9.0, 9.0),
    )


def test_a_batch_holds_the_unit_interval_and_what_was_observed():
    channels = Channels([Channel("pan", "rad", 0.0, 2.0), Channel("tilt", "rad", 0.0, 1.0)])
    values = [np.array([[0.0, 1.0], [2.0, np.nan]]), np.array([[1.0, 0.5]] * 3)]
    masks = [np.array([[True, True], [True, False]]), np.ones((3, 2), bool)]

    batch = Motions.from_arrays(values, channels, 10.0, observed=masks).batch()

    np.testing.assert_array_equal(batch.observed[0], [[1, 1], [1, 0], [0, 0]])
    np.testing.assert_array_equal(batch.observed[1], np.ones((3, 2)))
    np.testing.assert_allclose(batch.sensed[0], [[0.1, 0.9], [0.9, 0.5], [0.5, 0.5]], rtol=1e-6)
    np.testing.assert_allclose(batch.sensed[1], np.full((3, 2), 0.5), rtol=1e-6)


def test_a_batch_of_a_capacity_is_filled_up_with_nothing():
    small, large = two().batch(), two().batch(length=8, capacity=4)

    assert large.sensed.shape == large.observed.shape == (4, 8, 2)
    np.testing.assert_array_equal(large.sensed[:2, :5], small.sensed)
    np.testing.assert_array_equal(large.observed[:2, :5], small.observed)
    for part in (large.observed, large.weight):
        assert not np.asarray(part[2:]).any()
        assert not np.asarray(part[:, 5:]).any()


def test_weights_weigh_the_error_and_leave_the_input_as_it_was():
    masks = [np.random.default_rng(i).random((n, 2)) < 0.7 for i, n in enumerate((5, 3))]
    counts = [np.full((5, 2), 2.0), np.zeros((3, 2))]
    plain, weighed = two(observed=masks), two(observed=masks, weights=counts)

    np.testing.assert_array_equal(plain.batch().weight, plain.batch().observed)
    np.testing.assert_array_equal(weighed.batch().observed, plain.batch().observed)
    np.testing.assert_array_equal(weighed.batch().sensed, plain.batch().sensed)
    np.testing.assert_array_equal(weighed.batch().weight[0], 2 * plain.batch().observed[0])
    for part in (weighed[1], weighed.chosen(["1"]), weighed[1].showing(NAMES)):
        assert not np.asarray(part.batch().weight).any()


def test_weights_that_cannot_be_are_refused():
    good = [np.ones((5, 2)), np.ones((3, 2))]
    with pytest.raises(MotionError, match="2 motions need as many weights, got 1"):
        two(weights=good[:1])
    with pytest.raises(MotionError, match=r"motion '1': its weights have shape \(5, 2\), its"):
        two(weights=[good[0], good[0]])
    for wrong in (-1.0, np.nan):
        with pytest.raises(MotionError, match="motion '1': weights must be finite and ≥ 0"):
            two(weights=[good[0], wrong * good[1]])


@pytest.mark.parametrize(("length", "capacity"), [(4, 2), (5, 1)])
def test_a_batch_that_is_too_small_is_refused(length, capacity):
    with pytest.raises(MotionError, match=f"2 motions of up to 5 rows do not fit into {capacity}"):
        two().batch(length, capacity)


def test_showing_leaves_the_named_channels_observed():
    shown = two().showing(["tilt"])

    assert all((mask == [False, True]).all() for mask in shown.observed)
    with pytest.raises(ChannelError, match=r"unknown channel 'tlt'; did you mean 'tilt'\?"):
        two().showing(["tlt"])


def test_padding_has_no_meaning(network, motions):
    masked = motions.showing(["x", "z"])
    batch = masked.batch(length=35, capacity=4)
    noise = jax.random.normal(jax.random.key(3), batch.sensed.shape)
    other = batch._replace(sensed=jax.numpy.where(batch.observed > 0, batch.sensed, 5 * noise))
    free = jax.random.normal(jax.random.key(4), (4, network.size))

    @jax.jit
    def graded(batch):
        def loss(weights, bias, free):
            net = replace(network, weights=weights, bias=bias)
            return ERRORS["squared"](predictions(net, batch, free, 0.3), batch).sum()

        return jax.value_and_grad(loss, (0, 1, 2))(network.weights, network.bias, free)

    for one, another in zip(
        jax.tree.leaves(graded(batch)), jax.tree.leaves(graded(other)), strict=True
    ):
        np.testing.assert_array_equal(one, another)
        assert np.isfinite(one).all()


def test_what_is_not_observed_changes_no_bit_of_training(network, motions):
    masks = [np.random.default_rng(i).random(v.shape) < 0.7 for i, v in enumerate(motions.values)]
    hidden = [
        [np.where(mask, value, other) for mask, value in zip(masks, motions.values, strict=True)]
        for other in (0.0, 1e3, np.nan)
    ]

    fits = [
        train(
            network,
            Motions.from_arrays(values, motions.channels, 10.0, observed=masks),
            settings=Training(epochs=20),
        )
        for values in hidden
    ]

    for fit in fits[1:]:
        np.testing.assert_array_equal(fit.losses, fits[0].losses)
        np.testing.assert_array_equal(fit.network.weights, fits[0].network.weights)
        np.testing.assert_array_equal(fit.initial_states, fits[0].initial_states)
        np.testing.assert_array_equal(fit.closed_loop_error, fits[0].closed_loop_error)


@pytest.mark.parametrize(
    ("arrays", "match"),
    [
        ([], "no motions given; at least one is needed"),
        (
            [np.zeros((4, 3))],
            r"motion '0': expected an array \[T, 2\] .* pan, tilt, got .*\(4, 3\)",
        ),
        ([np.zeros(4)], r"motion '0': expected an array \[T, 2\]"),
        ([np.eye(2), np.zeros((1, 2))], "motion '1': at least 2 rows are needed, got 1"),
        (
            [[[0, 0], [1, np.nan]]],
            "motion '0', row 1, channel 'tilt': values must be finite, got nan",
        ),
        ([[[0, 0], [-np.inf, 1]]], "motion '0', row 1, channel 'pan': .* finite, got -inf"),
    ],
)
def test_arrays_that_are_no_motions_are_refused(arrays, match):
    with pytest.raises(MotionError, match=match):
        Motions.from_arrays(arrays, NAMES, 10.0)


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, np.nan, np.inf])
def test_a_rate_that_is_none_is_refused(rate_hz):
    with pytest.raises(MotionError, match="rate_hz must be finite and > 0, got"):
        Motions.from_arrays([np.eye(2)], NAMES, float(rate_hz))


def test_masks_and_names_must_fit_the_motions():
    with pytest.raises(MotionError, match="2 motions need as many masks and names, got 2 and 1"):
        two(names=["a"])
    with pytest.raises(
        MotionError, match=r"motion '0': its mask has shape \(5,\), its values \(5, 2\)"
    ):
        two(observed=[np.ones(5, bool), np.ones((3, 2), bool)])


def test_a_channel_without_a_range_is_refused():
    still = np.stack([np.arange(4.0), np.full(4, 2.5)], axis=1)
    with pytest.raises(ChannelError, match=r"channel 'tilt' is always 2\.5: give its range or"):
        Motions.from_arrays([still], NAMES, 10.0)
    with pytest.raises(ChannelError, match="channel 'tilt' is never observed: give its range or"):
        Motions.from_arrays([still], NAMES, 10.0, observed=[np.array([[True, False]] * 4)])
    with pytest.raises(ChannelError, match=r"unknown channel 'tlit'; did you mean 'tilt'\?"):
        Motions.from_arrays([still], NAMES, 10.0, ranges={"tlit": (0.0, 5.0)})


def test_motions_are_chosen_by_name_and_index_in_the_order_given():
    motions = two(names=["a", "b"])

    assert motions.chosen(["b", "a"]).names == ("b", "a")
    assert motions.chosen([1]).lengths == (3,)
    np.testing.assert_array_equal(motions.chosen(["b", 0]).values[1], motions.values[0])
    assert motions.chosen(["b"]).channels == motions.channels
    with pytest.raises(MotionError, match="unknown motion 'c'; there are: a, b"):
        motions.chosen(["c"])
    with pytest.raises(MotionError, match="unknown motion 2; there are 2, counted from 0"):
        motions.chosen([2])
    with pytest.raises(MotionError, match="no motions chosen"):
        motions.chosen([])


def test_a_table_is_read_in_one_line(tmp_path):
    path = tmp_path / "demos.csv"
    path.write_text("episode,shoulder [rad],led\na,0,1\na,1,1\nb,0.5,1\nb,,1\n")

    motions = Motions.read(path, rate_hz=25, exclude=["led"], margin=0.0)

    assert motions.names == ("a", "b")
    assert tuple(motions.channels) == (Channel("shoulder", "rad", 0.0, 1.0),)
    assert motions.rate_hz == 25.0
    assert motions.observed[1].tolist() == [[True], [False]]
    with pytest.raises(ChannelError, match=r"demos\.csv: channel 'led' is always 1: give its ran"):
        Motions.read(path, rate_hz=25)
    with pytest.raises(SettingError, match="unknown setting 'channel'; did you mean 'channels'"):
        Motions.read(path, rate_hz=25, channel=["shoulder"])


@pytest.mark.parametrize("name", ["out.npz", "out.csv"])
def test_motions_read_as_they_were_written(motions, tmp_path, name):
    masked = motions.showing(motions.channels.names[:2])
    masked.write(tmp_path / name)
    ranges = {c.name: (c.low, c.high) for c in motions.channels}
    found = Motions.read(tmp_path / name, ranges=ranges)

    assert (found.names, found.channels) == (masked.names, masked.channels)
    assert found.rate_hz == masked.rate_hz
    for was, now in zip(masked.observed, found.observed, strict=True):
        np.testing.assert_array_equal(was, now)
    for was, now, seen in zip(masked.values, found.values, masked.observed, strict=True):
        np.testing.assert_array_equal(was[seen], now[seen])
