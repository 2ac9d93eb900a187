"""Recordings that stay where they are: the same motions, read one at a time."""

import json
from dataclasses import replace

import h5py
import numpy as np
import pytest
from pyarrow import parquet

from motionese import Motions
from motionese.errors import ChannelError, MotionError, MotioneseError, RecordingError
from motionese.recordings import Episode, Recording, read_stored, write


@pytest.fixture
def many():
    """Forty motions of unequal lengths."""
    rng = np.random.default_rng(0)
    paths = [np.cumsum(rng.normal(size=(20 + i % 7, 3)), axis=0) for i in range(40)]
    return Motions.from_arrays(paths, ["a", "b", "c"], 10.0, units={"a": "rad"})


@pytest.fixture(params=["npz", "hdf5", "lerobot"])
def path(request, many, tmp_path):
    many.write(tmp_path / f"many.{request.param}", request.param)
    return tmp_path / f"many.{request.param}"


def same(one, other):
    facts = ("names", "lengths", "channels", "rate_hz", "held_out")
    assert all(getattr(one, fact) == getattr(other, fact) for fact in facts)
    for part in ("values", "observed"):
        for left, right in zip(getattr(one, part), getattr(other, part), strict=True):
            np.testing.assert_array_equal(left, right)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"channels": ["c", "a"], "skip": ["3", "5-9"], "ranges": {"a": (-50, 50)}},
        {"resample_hz": 4, "margin": 0.2, "episodes": ["0-20"]},
    ],
    ids=str,
)
def test_stored_motions_are_those_that_are_read_whole(path, given):
    stored = Motions.read(path, stored=True, **given)

    same(stored, Motions.read(path, **given))
    assert stored.stored and not Motions.read(path, **given).stored
    same(stored.chosen([4, 1]), Motions.read(path, **given).chosen([4, 1]))
    for which, batch in stored.batches(100):
        whole = stored.chosen(which).batch(max(stored.lengths), len(batch.sensed))
        np.testing.assert_array_equal(batch.sensed, whole.sensed)


def test_one_episode_is_read_at_a_time(path):
    stored = read_stored(path)
    assert [len(e.values) for e in stored.outline.episodes] == [0] * 40

    assert stored.read(7).name == stored.outline.episodes[7].name
    assert [e.name for e in stored.whole([3, 2]).episodes] == ["3", "2"]


def test_an_episode_is_read_from_the_row_groups_that_hold_it(many, tmp_path):
    many.write(tmp_path / "data", "lerobot")
    (file,) = (tmp_path / "data").glob("data/*/*.parquet")
    parquet.write_table(parquet.read_table(file), file, row_group_size=7)

    stored = Motions.read(tmp_path / "data", stored=True)

    same(stored, Motions.read(tmp_path / "data"))
    table = parquet.read_table(file)
    parquet.write_table(table.take(np.random.default_rng(0).permutation(len(table))), file)
    with pytest.raises(RecordingError, match="the rows of an episode lie apart"):
        Motions.read(tmp_path / "data", stored=True)


def test_gaps_masks_and_short_episodes_are_as_in_a_whole_reading(many, tmp_path):
    path, seen = tmp_path / "gaps.npz", [m.copy() for m in many.observed]
    seen[2][5:9, 1] = False
    replace(many, observed=tuple(seen), held_out=("4", "6")).write(path)

    same(Motions.read(path, stored=True), Motions.read(path))

    with h5py.File(tmp_path / "short.hdf5", "w") as file:
        data = file.create_group("data")
        data.attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 20}})
        for i, rows in enumerate((5, 1, 6)):
            data[f"demo_{i}/obs/x"] = np.arange(2.0 * rows).reshape(rows, 2) ** 2
    stored = Motions.read(tmp_path / "short.hdf5", stored=True)
    same(stored, Motions.read(tmp_path / "short.hdf5"))
    assert "fewer than two rows, and is left out" in stored.examined[-1].sentence


def test_what_was_not_looked_at_is_told(path):
    assert "looked for leaps and clocks in 32 of 40 episodes" in (
        Motions.read(path, stored=True).examined[0].sentence
    )
    Motions.read(path, stored=True, strict=True)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"trim": 0.1}, "trim looks at all episodes together"),
        ({"leaps": "cut"}, "leaps looks at all episodes together"),
        ({"unwrap": ["a"]}, "unwrap looks at all episodes together"),
        ({"columns": ["a", "b", "c"]}, "columns is not for recordings left where they are"),
    ],
    ids=str,
)
def test_what_needs_all_motions_at_once_is_refused(path, given, sentence):
    with pytest.raises(MotioneseError, match=sentence):
        Motions.read(path, stored=True, **given)


def test_a_value_that_is_not_finite_is_refused_wherever_it_stands(many, tmp_path):
    values = [v.copy() for v in many.values]
    values[37][3, 1] = np.nan
    episodes = tuple(Episode.whole(n, v) for n, v in zip(many.names, values, strict=True))
    recording = Recording(
        tmp_path, ("a", "b", "c"), ("", "", ""), {}, 10.0, episodes, ("a", "b", "c")
    )
    write(tmp_path / "nan.npz", recording)

    with pytest.raises(
        MotionError, match="episode '37', row 3, channel 'b': values must be finite"
    ):
        Motions.read(tmp_path / "nan.npz", stored=True)
    assert not Motions.read(tmp_path / "nan.npz", stored=True, nan="gap").observed[37][3, 1]


def test_a_channel_that_never_changes_is_refused(tmp_path):
    still = [np.column_stack([np.arange(9.0), np.ones(9)]) for _ in range(3)]
    Motions.from_arrays(still, ["a", "b"], 5.0, ranges={"b": (0, 2)}).write(tmp_path / "s.hdf5")

    with pytest.raises(ChannelError, match="channel 'b' is always 1"):
        Motions.read(tmp_path / "s.hdf5", stored=True, ranges={"a": (0, 9)})


def test_formats_that_are_read_whole_say_so(many, tmp_path):
    many.write(tmp_path / "many.csv")
    with pytest.raises(
        MotioneseError, match=r"only npz, lerobot, hdf5, robomimic can be left .* this is csv"
    ):
        Motions.read(tmp_path / "many.csv", stored=True)
    np.savez(tmp_path / "bare.npz", observations=np.ones((5, 2)))
    with pytest.raises(MotioneseError, match="those that motionese wrote can be left"):
        Motions.read(tmp_path / "bare.npz", stored=True)
    with h5py.File(tmp_path / "aloha.hdf5", "w") as file:
        file["observations/qpos"] = np.random.default_rng(0).normal(size=(9, 2))
    with pytest.raises(MotioneseError, match="one file of robomimic's layout"):
        Motions.read(tmp_path / "aloha.hdf5", stored=True)


def test_a_file_that_is_damaged_after_it_was_opened_is_refused(many, tmp_path):
    many.write(tmp_path / "many.npz")
    stored = Motions.read(tmp_path / "many.npz", stored=True)
    (tmp_path / "many.npz").write_bytes(b"")
    with pytest.raises(RecordingError, match="not a whole archive of arrays"):
        list(stored.values)
