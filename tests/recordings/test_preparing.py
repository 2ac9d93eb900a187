"""From what a file holds to what can be learned from."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import ChannelError, MotionError, RecordingError, SettingError
from motionese.recordings import Episode, Recording, choose, prepare, read


def one(values, times=None, observed=None, rate_hz=None, channels=None):
    values = np.asarray(values, float)
    values = values[:, None] if values.ndim == 1 else values
    seen = np.ones(values.shape, bool) if observed is None else np.asarray(observed, bool)
    times = None if times is None else np.asarray(times, float)
    names = tuple(channels or (f"c{i}" for i in range(values.shape[1])))
    episode = Episode("wave", times, values, seen.reshape(values.shape))
    return Recording(Path("f.csv"), names, ("",) * len(names), {}, rate_hz, (episode,), names)


def prepared(recording, **choice):
    ready = prepare(recording, choose(**choice))
    return ready.episodes[0].values, ready.episodes[0].observed, ready


# --- channels ---


def test_channels_are_taken_by_name_and_pattern_in_the_order_given():
    rows = one(np.arange(10).reshape(2, 5), rate_hz=9.0, channels=["LA", "LB", "RA", "a[0]", "t"])

    values, _, ready = prepared(rows, channels=["a[0]", "R*", "?A"], exclude=["t*"])

    assert ready.channels == ready.usual == ("a[0]", "RA", "LA")
    np.testing.assert_array_equal(values, [[3, 2, 0], [8, 7, 5]])


def test_the_usual_channels_are_taken_where_none_are_chosen():
    rows = replace(one(np.eye(3), rate_hz=9.0), usual=("c2", "c0"))

    assert prepared(rows)[2].channels == ("c2", "c0")
    assert prepared(rows, exclude=["c0"])[2].channels == ("c2",)


def test_units_and_ranges_are_given_by_name_or_pattern_before_the_file_s():
    rows = replace(
        one([[0, 5, 7], [1, 5, 9]], rate_hz=9.0),
        ranges={"c0": (-1.0, 2.0), "c2": (0.0, 1.0)},
        units=("rad", "cm", ""),
    )

    ready = prepared(rows, units={"c2": "m"}, ranges={"c[12]": (-8, 9), "c2": (5, 10)})[2]

    assert ready.units == ("rad", "cm", "m")
    assert ready.ranges == {"c0": (-1, 2), "c1": (-8, 9), "c2": (5, 10)}


def test_ranges_come_from_what_is_left_with_a_margin():
    rows = one([0, 10, 99], observed=[1, 1, 0], rate_hz=9.0)

    assert prepared(rows)[2].ranges == {"c0": (-0.5, 10.5)}
    assert prepared(rows, margin=0.0)[2].ranges == {"c0": (0, 10)}


@pytest.mark.parametrize(
    ("choice", "match"),
    [
        ({"channels": ["Z*"]}, r"f\.csv: unknown channel 'Z\*'; there are: still, moving"),
        ({"exclude": ["mooving"]}, "unknown channel 'mooving'; did you mean 'moving'"),
        ({"units": {"arm": "rad"}}, "unknown channel 'arm'"),
        ({"ranges": {"arm": (0, 1)}}, "unknown channel 'arm'"),
        ({"exclude": ["*"]}, "no channel is left; there are: still, moving"),
        (
            {},
            r"f\.csv: channel 'still' is always 3: give its range or leave it out "
            r"\(--range still=LOW:HIGH, --exclude still\)",
        ),
    ],
)
def test_channels_that_cannot_be_taken_are_refused(choice, match):
    rows = one([[3, 0], [3, 1]], rate_hz=9.0, channels=["still", "moving"])

    with pytest.raises(ChannelError, match=match):
        prepared(rows, **choice)


@pytest.mark.parametrize(
    ("choice", "match"),
    [
        ({"ranges": {"c0": (1, 1)}}, r"setting ranges\.c0 = \(1, 1\): a range needs low < high"),
        ({"ranges": {"c0": (2, 1)}}, "a range needs low < high, got 2 to 1"),
        ({"ranges": {"c0": (0, np.inf)}}, r"setting ranges\.c0\.1 = inf: input should be a finite"),
        ({"rate_hz": 0}, "setting rate_hz = 0: input should be greater than 0"),
        ({"resample_hz": np.nan}, "setting resample_hz = nan: "),
        ({"trim": 1.5}, r"setting trim = 1\.5: input should be less than 1"),
        ({"nan": "keep"}, "setting nan = 'keep': input should be 'refuse' or 'gap'"),
        ({"rate": 5}, "unknown setting 'rate'; did you mean 'rate_hz'"),
    ],
)
def test_choices_that_are_none_are_refused(choice, match):
    with pytest.raises(SettingError, match=match):
        choose(**choice)


# --- values ---


def test_nan_is_refused_or_taken_as_a_gap():
    rows = one([[1, 2], [np.nan, 4], [0, 3]], rate_hz=9.0)

    with pytest.raises(
        MotionError, match=r"f\.csv: episode 'wave', row 1, channel 'c0': .* got nan; --nan gap"
    ):
        prepared(rows)
    np.testing.assert_array_equal(
        prepared(rows, nan="gap")[1], [[True, True], [False, True], [True, True]]
    )


@pytest.mark.parametrize("value", [np.inf, -np.inf, 1e300])
def test_infinite_values_are_refused_even_where_nan_is_a_gap(value):
    with pytest.raises(MotionError, match="row 1, channel 'c0': values must be finite"):
        prepared(one([1, value], rate_hz=9.0), nan="gap")


def test_what_was_not_observed_may_be_anything():
    values, observed, _ = prepared(one([1, np.inf, 2], observed=[1, 0, 1], rate_hz=9.0))

    assert observed[:, 0].tolist() == [True, False, True]
    assert len(values) == 3


@pytest.mark.parametrize(("rows", "what"), [(1, "1 row"), (0, "no rows")])
def test_episodes_that_are_too_short_are_refused(rows, what):
    with pytest.raises(MotionError, match=f"f.csv: episode 'wave' has {what}; at least 2 are need"):
        prepared(one(np.zeros((rows, 2)), rate_hz=9.0))


def test_an_episode_of_one_row_is_refused_before_its_rate_is_missed():
    with pytest.raises(MotionError, match="has 1 row"):
        prepared(one([1.0], times=[0.0]))


# --- rate and times ---


def test_the_rate_is_told_by_the_file_the_times_or_the_user():
    values = np.arange(9.0)

    assert prepared(one(values, rate_hz=30.0))[2].rate_hz == 30.0
    assert prepared(one(values), rate_hz=25)[2].rate_hz == 25.0
    assert prepared(one(values, times=np.arange(9) / 30), rate_hz=30)[2].rate_hz == 30.0
    with pytest.raises(RecordingError, match=r"tells neither times nor a rate; .*: --rate"):
        prepared(one(values))


@pytest.mark.parametrize("rate", [25.0, 30.0, 29.97, 1 / 3, 1000.0])
def test_the_rate_of_times_is_the_number_that_was_meant(rate):
    times = 1.7e9 + np.arange(200) / rate

    assert prepared(one(np.arange(200.0), times=np.round(times, 6)))[2].rate_hz == pytest.approx(
        rate, rel=1e-4
    )
    if rate != 1 / 3:
        assert prepared(one(np.arange(200.0), times=times - 1.7e9))[2].rate_hz == rate


def test_stamps_in_whole_milliseconds_and_dropped_rows_tell_the_rate():
    times = np.delete(np.round(np.arange(300) / 30, 3), [50, 51, 52, 53, 54, 55, 120])

    assert prepared(one(np.arange(293.0), times=times))[2].rate_hz == pytest.approx(30, rel=1e-3)


@pytest.mark.parametrize("given", [{"rate_hz": 30.0}, {"times": np.arange(5) / 30}])
def test_a_rate_that_differs_is_refused(given):
    rows = one(np.arange(5.0), **given)

    assert prepared(rows, rate_hz=30.3)[2].rate_hz == 30.0
    with pytest.raises(RecordingError, match=r"recorded at 30 Hz, but .* given as 25 Hz; .*--res"):
        prepared(rows, rate_hz=25)


@pytest.mark.parametrize(
    ("times", "match"),
    [
        ([0, 1, 1], "episode 'wave', row 2: time must be finite and rise"),
        ([0, np.nan, 1], "row 1: time must be finite and rise"),
        ([0, 4e7, 8e7], r"rows are 4e\+07 s apart; are its times in seconds\?"),
        ([0, 1e-4, 1e9], "has 3 rows, but its times span 1e\\+13; check its times"),
    ],
)
def test_times_that_cannot_be_are_refused(times, match):
    with pytest.raises(RecordingError, match=match):
        prepared(one([1, 2, 3], times=times))


def test_rows_that_are_even_are_kept_bit_for_bit():
    rng = np.random.default_rng(0)
    values, seen = rng.normal(size=(40, 3)), rng.random((40, 3)) < 0.8
    times = 5 + (np.arange(40) + rng.uniform(-0.04, 0.04, 40)) / 50

    found, observed, ready = prepared(one(values, times=times, observed=seen))

    assert found.tobytes() == values.tobytes()
    np.testing.assert_array_equal(observed, seen)
    assert ready.rate_hz == pytest.approx(50, rel=0.01)
    assert ready.episodes[0].times is None


def test_uneven_rows_are_put_on_the_line_between_them():
    rng = np.random.default_rng(0)
    times = np.cumsum(rng.uniform(0.5, 1.5, 60)) / 20

    values, observed, ready = prepared(one(3 * (times - times[0]) + 1, times=times))

    assert observed.all()
    np.testing.assert_allclose(values[:, 0], 1 + 3 * np.arange(len(values)) / ready.rate_hz)


def test_a_hole_in_the_times_becomes_a_gap():
    at = np.array([0, 1, 2, 3, 4, 10, 11, 13, 14.0])

    values, observed, _ = prepared(one(at, times=at / 10))

    assert observed[:, 0].tolist() == [i not in (5, 6, 7, 8, 9) for i in range(15)]
    np.testing.assert_allclose(values[observed], np.arange(15)[observed[:, 0]])


def test_channels_with_their_own_stamps_come_onto_one_grid():
    # A topic at 10 Hz and one at 5 Hz, half an interval off.
    fast, slow = np.arange(0, 2, 0.1), np.arange(0.05, 2, 0.2)
    times = np.concatenate([fast, slow])
    order = np.argsort(times)
    values = np.stack([times, -times], axis=1)[order]
    seen = np.array([[True, False]] * len(fast) + [[False, True]] * len(slow))[order]

    found, observed, ready = prepared(one(values, times=times[order], observed=seen, rate_hz=10.0))

    grid = np.arange(20) / 10
    assert ready.rate_hz == 10.0
    assert observed[:, 0].all()
    assert observed[:19, 1].all()
    np.testing.assert_allclose(found[:, 0], grid, atol=1e-12)
    np.testing.assert_allclose(found[1:19, 1], -grid[1:19], atol=1e-12)


# --- another rate ---


def test_the_same_rate_keeps_every_bit():
    values = np.random.default_rng(0).normal(size=(9, 2))

    assert prepared(one(values, rate_hz=25.0), resample_hz=25.0)[0].tobytes() == values.tobytes()


@given(
    was=st.sampled_from([10.0, 25.0, 30.0]),
    now=st.floats(3.0, 90.0),
    rows=st.integers(2, 60),
    slope=st.floats(-5, 5).filter(lambda s: abs(s) > 0.01),
)
def test_a_straight_line_stays_one_at_any_rate(was, now, rows, slope):
    line = 2 + slope * np.arange(rows) / was
    if (rows - 1) / was * now < 1.001:
        return

    values, observed, ready = prepared(one(line, rate_hz=was), resample_hz=now)

    assert observed.all()
    assert ready.rate_hz == now
    np.testing.assert_allclose(values[:, 0], 2 + slope * np.arange(len(values)) / now, atol=1e-9)
    assert (len(values) - 1) / now <= (rows - 1) / was * (1 + 1e-9) < len(values) / now + 1e-6


def test_what_is_faster_than_the_new_rate_does_not_fold_into_it():
    t = np.arange(400) / 100
    slow, fast = np.sin(2 * np.pi * 0.5 * t), np.sin(2 * np.pi * 20 * t)

    values = prepared(one(slow + fast, rate_hz=100.0), resample_hz=20.0)[0]

    np.testing.assert_allclose(values[2:-2, 0], slow[::5][2:-2], atol=0.01)


def test_gaps_stay_gaps_and_nothing_leaks_out_of_them():
    values, seen = np.ones(40), np.ones(40, bool)
    values[10:20], seen[10:20] = 1e6, False
    values[30] = 1.5

    found, observed, _ = prepared(one(values, observed=seen, rate_hz=20.0), resample_hz=10.0)

    assert observed[:, 0].tolist() == [not 10 <= 2 * i < 20 for i in range(20)]
    assert found[observed].max() < 1.5


def test_a_new_row_is_observed_where_both_rows_around_it_were():
    seen = [True, True, False, True, True]

    observed = prepared(one(np.arange(5), observed=seen, rate_hz=10.0), resample_hz=20.0)[1]

    assert observed[:, 0].tolist() == [1, 1, 1, 0, 0, 0, 1, 1, 1]


def test_a_rate_out_of_reach_is_refused():
    with pytest.raises(SettingError, match="recorded at 1 Hz, it cannot be resampled to 500 Hz"):
        prepared(one([1, 2], rate_hz=1.0), resample_hz=500.0)
    with pytest.raises(MotionError, match="episode 'wave' has 1 row; at least 2"):
        prepared(one([1, 2, 3], rate_hz=10.0), resample_hz=0.001)


# --- still ends ---


def test_still_ends_are_cut_but_for_one_row():
    values = np.array([0, 0.001, 0, 0, 0.5, 1.0, 0.5, 0.3, 0.3, 0.301])
    both = np.stack([values, np.r_[np.zeros(5), 1, np.zeros(4)]], axis=1)

    assert prepared(one(both, rate_hz=9.0), trim=0.01)[0][:, 0].tolist() == [0, 0.5, 1, 0.5, 0.3]
    assert len(prepared(one(both, rate_hz=9.0))[0]) == 10


@pytest.mark.parametrize("values", [[5, 5.01, 5], np.linspace(5, 6.05, 50)])
def test_an_episode_that_is_still_throughout_has_no_ends(values):
    rows = replace(one(values, rate_hz=9.0), ranges={"c0": (0.0, 100.0)})

    assert len(prepared(rows, trim=0.01)[0]) == len(values)


def test_trimming_looks_at_what_was_observed():
    values, seen = np.array([9, 0, 0, 1, 0, 0, -9.0]), [0, 1, 1, 1, 1, 1, 0]

    found, _, _ = prepared(one(values, observed=seen, rate_hz=9.0), trim=0.1)

    assert found[:, 0].tolist() == [0, 1, 0]


# --- episodes ---


def several(*lengths, names=None, rates=None):
    """Return a recording of one rising channel in episodes of these lengths."""
    episodes = []
    for i, rows in enumerate(lengths):
        times = None if rates is None else np.arange(rows) / rates[i]
        values = np.linspace(i, i + 1, rows)[:, None]
        episodes.append(Episode.whole(names[i] if names else str(i), values, times))
    rate = None if rates else 10.0
    return Recording(Path("f.csv"), ("c",), ("",), {}, rate, tuple(episodes), ("c",))


def taken(recording, **choice):
    return [e.name for e in prepare(recording, choose(**choice)).episodes]


def test_episodes_are_taken_and_left_out_by_name_pattern_and_number():
    named = several(3, 3, 3, 3, names=["pick_1", "pick_2", "place_1", "7"])

    assert taken(named, episodes=["pick*"]) == ["pick_1", "pick_2"]
    assert taken(named, skip=["place_1", "7"]) == ["pick_1", "pick_2"]
    assert taken(named, episodes=["p*"], skip=["*_1"]) == ["pick_2"]
    assert taken(named, episodes=["7"]) == ["7"]
    letters = several(3, 3, 3, names=["a", "b", "c"])
    assert taken(letters, episodes=["1-2"]) == ["b", "c"]
    numerals = several(3, 3, 3, names=["4", "5", "9"])
    assert taken(numerals, episodes=["5-9"]) == ["5", "9"]


@pytest.mark.parametrize(
    ("choice", "match"),
    [
        ({"episodes": ["x*"]}, r"f\.csv: unknown episode 'x\*'"),
        ({"skip": ["9"]}, "unknown episode '9'"),
        ({"skip": ["*"]}, "no episode is left; there are: 0, 1"),
    ],
)
def test_episodes_that_are_not_there_are_refused(choice, match):
    with pytest.raises(RecordingError, match=match):
        taken(several(3, 3), **choice)


def test_episodes_of_a_row_are_left_out_and_told_where_there_are_others():
    ready = prepare(several(3, 1, 4, 0), choose())

    assert [e.name for e in ready.episodes] == ["0", "2"]
    (told,) = ready.findings
    assert (told.kind, told.episode, told.count) == ("left out", "1", 2)
    assert "--skip 1" in told.remedy
    assert not prepare(several(3, 1, 4), choose(skip=["1"], strict=True)).findings


def test_all_channels_that_never_change_are_told_at_once():
    rows = one([[3, 0, 1, 5], [3, 1, 1, 5]], rate_hz=9.0, channels=["a", "b", "c", "d"])

    with pytest.raises(ChannelError, match=r"--exclude a c d\); the same of c, d"):
        prepared(rows)
    assert prepared(rows, exclude=["a", "c", "d"])[2].channels == ("b",)


# --- rates that differ ---


def test_episodes_of_other_rates_are_refused_unless_they_are_resampled():
    mixed = several(41, 41, 101, rates=[20.0, 20.0, 50.0])

    with pytest.raises(
        RecordingError, match="differ in their rates: '0' at 20 Hz, '2' at 50 Hz; -"
    ):
        prepare(mixed, choose())
    ready = prepare(mixed, choose(resample_hz=10.0))

    assert [len(e.values) for e in ready.episodes] == [21, 21, 21]
    assert [e.name for e in ready.episodes] == ["0", "1", "2"]
    for i, episode in enumerate(ready.episodes):
        np.testing.assert_allclose(episode.values[:, 0], np.linspace(i, i + 1, 21), atol=1e-9)


@given(st.integers(0, 999), st.floats(0, 0.3), st.floats(5, 200))
def test_jitter_is_no_other_rate(seed, jitter, rate):
    rng, episodes = np.random.default_rng(seed), []
    for i in range(4):
        times = (np.arange(30) + jitter * rng.uniform(-0.5, 0.5, 30)) / rate
        episodes.append(Episode.whole(str(i), np.linspace(0, 1, 30)[:, None], times))
    recording = Recording(Path("f.csv"), ("c",), ("",), {}, None, tuple(episodes), ("c",))

    assert prepare(recording, choose()).rate_hz == pytest.approx(rate, rel=0.05)


# --- binary channels ---


def test_binary_channels_keep_their_two_values_at_any_rate():
    gripper = np.repeat([2.0, 5.0, 2.0], 7)
    rows = one(np.stack([gripper, np.linspace(0, 1, 21)], 1), rate_hz=10.0)

    _, _, ready = prepared(rows, binary=["c0"], resample_hz=7.0)

    assert ready.binary == {"c0": (2.0, 5.0)}
    assert set(ready.episodes[0].values[:, 0]) == {2.0, 5.0}


def test_a_channel_of_more_than_two_values_is_not_binary():
    with pytest.raises(
        ChannelError, match="channel 'c0' takes 3 values; --binary names channels o"
    ):
        prepared(one([0, 1, 2], rate_hz=9.0), binary=["c0"])


# --- what is told of channels ---


def test_what_is_told_of_channels_follows_the_choice(tmp_path):
    rows = [f"{i / 20},{np.sin(i / 9)},{np.cos(i / 9)},{99.5 + i / 20}" for i in range(40)]
    path = tmp_path / "log.csv"
    path.write_text("\n".join(["time,a,b,uptime", *rows]))

    def told(**choice):
        ready = prepare(read(path), choose(**choice))
        return ready.channels, [f.channel for f in ready.findings]

    assert told() == (("a", "b"), ["uptime"])
    assert told(exclude=["uptime"]) == (("a", "b"), [])
    assert told(channels=["b"]) == (("b",), [])
    assert told(channels=["b", "uptime"]) == (("b", "uptime"), [])
