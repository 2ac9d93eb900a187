"""LeRobotDataset: what is written against its schema, and what others write read."""

import json
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyarrow import parquet

from motionese import Motions
from motionese.errors import MotioneseError, RecordingError
from motionese.recordings import read, write
from motionese.recordings.formats.lerobot_features import features_of, read_info

D = 3
STATISTICS = ("min", "max", "mean", "std", "count", "q01", "q10", "q50", "q90", "q99")
VECTOR = pa.list_(pa.float32(), D)
DATA = {
    "observation.state": VECTOR,
    "action": VECTOR,
    "timestamp": pa.float32(),
    "frame_index": pa.int64(),
    "episode_index": pa.int64(),
    "index": pa.int64(),
    "task_index": pa.int64(),
}
# What LeRobotDataset.create of lerobot 0.4.4 wrote for the same features.
INFO = {
    "codebase_version": "v3.0",
    "robot_type": None,
    "total_episodes": 2,
    "total_frames": 11,
    "total_tasks": 1,
    "chunks_size": 1000,
    "data_files_size_in_mb": 100,
    "video_files_size_in_mb": 200,
    "fps": 25,
    "splits": {"train": "0:2"},
    "data_path": "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet",
    "video_path": None,
}
FEATURES = {
    "observation.state": ("float32", [D], ["shoulder", "hand, x", "a[0]"]),
    "action": ("float32", [D], ["shoulder", "hand, x", "a[0]"]),
    "timestamp": ("float32", [1], None),
    "frame_index": ("int64", [1], None),
    "episode_index": ("int64", [1], None),
    "index": ("int64", [1], None),
    "task_index": ("int64", [1], None),
}
EPISODES = {
    "episode_index": pa.int64(),
    "tasks": pa.list_(pa.string()),
    "length": pa.int64(),
    "data/chunk_index": pa.int64(),
    "data/file_index": pa.int64(),
    "dataset_from_index": pa.int64(),
    "dataset_to_index": pa.int64(),
    "meta/episodes/chunk_index": pa.int64(),
    "meta/episodes/file_index": pa.int64(),
}
WHOLE_NUMBERS = ("frame_index", "episode_index", "index", "task_index")


@pytest.fixture
def folder(whole, tmp_path):
    """A dataset that we wrote."""
    write(tmp_path / "data", whole, "lerobot")
    return tmp_path / "data"


def table(folder, part):
    return parquet.read_table(folder / part / "chunk-000" / "file-000.parquet")


def test_a_folder_holds_the_files_of_the_schema_and_no_others(folder):
    found = {str(f.relative_to(folder)) for f in folder.rglob("*") if f.is_file()}

    assert found == {
        "data/chunk-000/file-000.parquet",
        "meta/episodes/chunk-000/file-000.parquet",
        "meta/info.json",
        "meta/stats.json",
        "meta/tasks.parquet",
    }


def test_info_tells_what_lerobot_asks_for(folder):
    info = json.loads((folder / "meta/info.json").read_text())

    assert {key: info[key] for key in INFO} == INFO
    features = {k: (f["dtype"], f["shape"], f["names"]) for k, f in info["features"].items()}
    assert features == FEATURES


def test_data_has_the_columns_of_the_schema(folder, whole):
    data = table(folder, "data")

    assert dict(zip(data.schema.names, data.schema.types, strict=True)) == DATA
    rows = data.to_pandas()
    first, second = (e.values.astype(np.float32) for e in whole.episodes)
    states = np.stack(rows["observation.state"])
    np.testing.assert_array_equal(states, np.concatenate([first, second]))
    followed = np.concatenate([first[1:], first[-1:], second[1:], second[-1:]])
    np.testing.assert_array_equal(np.stack(rows["action"]), followed)
    assert rows["episode_index"].tolist() == [0] * 7 + [1] * 4
    assert rows["frame_index"].tolist() == [*range(7), *range(4)]
    assert rows["index"].tolist() == list(range(11))
    assert set(rows["task_index"]) == {0}
    np.testing.assert_allclose(rows["timestamp"], rows["frame_index"] / 25, rtol=1e-6)


def test_episodes_and_tasks_have_the_columns_of_the_schema(folder):
    episodes = table(folder, "meta/episodes")

    types = dict(zip(episodes.schema.names, episodes.schema.types, strict=True))
    assert {key: types[key] for key in EPISODES} == EPISODES
    statistics = {f"stats/{key}/{what}" for key in DATA for what in STATISTICS}
    assert set(types) == set(EPISODES) | statistics
    for name in statistics:
        _, key, what = name.split("/")
        whole_number = what == "count" or (what in ("min", "max") and key in WHOLE_NUMBERS)
        assert types[name] == pa.list_(pa.int64() if whole_number else pa.float64())
    assert episodes.column("length").to_pylist() == [7, 4]
    assert episodes.column("dataset_from_index").to_pylist() == [0, 7]
    assert episodes.column("dataset_to_index").to_pylist() == [7, 11]
    tasks = parquet.read_table(folder / "meta/tasks.parquet").to_pandas()
    assert tasks.index.name == "task"
    assert tasks["task_index"].tolist() == [0]
    assert episodes.column("tasks").to_pylist() == [tasks.index.tolist()] * 2


def test_statistics_are_those_of_the_data(folder, whole):
    statistics = json.loads((folder / "meta/stats.json").read_text())

    assert set(statistics) == set(DATA)
    states = np.concatenate([e.values for e in whole.episodes]).astype(np.float32)
    found = statistics["observation.state"]
    assert tuple(found) == STATISTICS
    assert found["count"] == [11]
    np.testing.assert_allclose(found["mean"], states.mean(0), rtol=1e-5)
    np.testing.assert_allclose(found["std"], states.std(0), rtol=1e-5)
    np.testing.assert_array_equal(found["max"], states.max(0))
    np.testing.assert_allclose(found["q50"], np.median(states, axis=0), rtol=1e-6)


def test_one_channel_is_kept_as_plain_numbers_as_lerobot_does(whole, tmp_path):
    single = replace(
        whole,
        channels=("a",),
        units=("rad",),
        episodes=tuple(
            replace(e, values=e.values[:, :1], observed=e.observed[:, :1]) for e in whole.episodes
        ),
    )
    write(tmp_path / "data", single, "lerobot")

    assert table(tmp_path / "data", "data").schema.field("action").type == pa.float32()
    assert read(tmp_path / "data").channels == ("a",)


def test_what_was_written_reads_the_same(folder, whole):
    found = read(folder)

    assert (found.channels, found.units, found.rate_hz) == (whole.channels, whole.units, 25.0)
    assert found.usual == whole.channels
    for was, now in zip(whole.episodes, found.episodes, strict=True):
        assert (now.name, now.times) == (was.name, None)
        np.testing.assert_array_equal(now.values, was.values.astype(np.float32))


@pytest.mark.parametrize("rate", [None, 29.97])
def test_a_rate_that_is_no_whole_number_is_refused(whole, tmp_path, rate):
    with pytest.raises(RecordingError, match=r"whole number of frames per second, .*resample it"):
        write(tmp_path / "data", replace(whole, rate_hz=rate), "lerobot")

    assert not list(tmp_path.iterdir())


def test_gaps_are_refused(recording, tmp_path):
    with pytest.raises(
        RecordingError, match=r"episode 'UR ↓', row \d, .*cannot hold gaps; csv, npz"
    ):
        write(tmp_path / "data", recording, "lerobot")

    assert not list(tmp_path.iterdir())


def test_uneven_times_are_refused(whole, tmp_path):
    uneven = replace(whole.episodes[0], times=np.array([0, 1, 2, 3, 4, 5, 7]) / 25)
    with pytest.raises(RecordingError, match=r"episode 'UR ↓' is not evenly spaced at 25 Hz"):
        write(tmp_path / "data", replace(whole, episodes=(uneven,)), "lerobot")


def others_dataset(folder, version="v2.1", shift=0.0):
    """Write two episodes of what people have on the hub, in files as v2.1 or v3.0 cuts them."""
    names = {
        "observation.state": ["gripper", "elbow", "gripper"],
        "action": {"motors": ["gripper", "elbow", "wrist"]},
        "observation.effort": None,
        "observation.force": {"y": 1, "x": 0},
        "next.reward": None,
    }
    sizes = {"next.reward": 1, "observation.force": 2}
    features = {
        key: {"dtype": "float32", "shape": [sizes.get(key, 3)], "names": told}
        for key, told in names.items()
    }
    features["observation.images.top"] = {"dtype": "video", "shape": [48, 64, 3], "names": None}
    features["next.done"] = {"dtype": "bool", "shape": [1], "names": None}
    features["timestamp"] = {"dtype": "float32", "shape": [1], "names": None}
    info = {"codebase_version": version, "fps": 30, "total_frames": 9, "features": features}
    (folder / "meta").mkdir(parents=True)
    (folder / "meta/info.json").write_text(json.dumps(info))
    for episode, rows in ((0, 5), (1, 4)):
        values = np.arange(rows * 3, dtype=np.float32) + 100 * episode
        frame = np.arange(rows)
        columns = {
            key: pa.FixedSizeListArray.from_arrays(values[: rows * sizes.get(key, 3)], n)
            for key, n in {key: sizes.get(key, 3) for key in names}.items()
        }
        columns["action"] = pa.array(list(values.reshape(rows, 3)))
        columns["next.reward"] = pa.array(np.zeros(rows, np.float32))
        columns["next.done"] = pa.array(frame == rows - 1)
        columns["timestamp"] = pa.array((frame / 30 + shift * frame**2).astype(np.float32))
        columns["frame_index"] = pa.array(frame)
        columns["episode_index"] = pa.array(np.full(rows, episode))
        file = folder / f"data/chunk-000/episode_{episode:06d}.parquet"
        file.parent.mkdir(parents=True, exist_ok=True)
        parquet.write_table(pa.table(columns), file)
    return folder


@pytest.mark.parametrize("version", ["v2.0", "v2.1", "v3.0"])
def test_datasets_of_others_are_read(tmp_path, version):
    found = read(others_dataset(tmp_path / "data", version))

    assert found.channels == (
        *("gripper_0", "elbow", "gripper_2"),
        *("action.gripper", "action.elbow", "action.wrist"),
        *("observation.effort_0", "observation.effort_1", "observation.effort_2"),
        *("observation.force.x", "observation.force.y"),
        "next.reward",
    )
    assert found.usual == ("gripper_0", "elbow", "gripper_2")
    assert found.rate_hz == 30.0
    assert [e.name for e in found.episodes] == ["episode_000000", "episode_000001"]
    assert [e.times for e in found.episodes] == [None, None]
    assert found.episodes[1].values[1, :8].tolist() == [103, 104, 105, 103, 104, 105, 103, 104]
    assert found.episodes[0].values[:, 9].tolist() == [0, 2, 4, 6, 8]
    assert all(e.observed.all() for e in found.episodes)
    (doubled,) = found.findings
    assert doubled.sentence == (
        f"{tmp_path / 'data'}: channel 'observation.state': 2 of its columns are called "
        "'gripper': told apart by number"
    )


@pytest.mark.parametrize(
    ("told", "channels"),
    [
        ({"observation.state": [2, None]}, ["state_0", "state_1"]),
        ({"observation.state": [1, None], "action": [1, None]}, ["state", "action"]),
        ({"observation.state": [2, {"axes": [["x"], ["y"]]}]}, ["state_0", "state_1"]),
        ({"observation.state": [2, [["x", "y"]]]}, ["x", "y"]),
        ({"observation.state": [2, ["x"]]}, ["state_0", "state_1"]),
        (
            {"observation.state": [1, ["action.x"]], "action": [1, ["x"]]},
            ["action.x", "action.action.x"],
        ),
        ({"observation.state": [10**9, None], "action": [1, ["x"]]}, ["action.x"]),
    ],
)
def test_channels_are_named_after_their_features(tmp_path, told, channels):
    features = {
        key: {"dtype": "float32", "shape": [width], "names": names}
        for key, (width, names) in told.items()
    }
    (tmp_path / "meta").mkdir()
    info = {"codebase_version": "v3.0", "fps": 30, "features": features}
    (tmp_path / "meta/info.json").write_text(json.dumps(info))

    assert [c for f in features_of(read_info(tmp_path)) for c in f.channels] == channels


def test_time_stamps_that_do_not_keep_the_rate_are_kept(tmp_path):
    found = read(others_dataset(tmp_path / "data", shift=0.001))

    expected = np.arange(5) / 30 + 0.001 * np.arange(5) ** 2
    np.testing.assert_allclose(found.episodes[0].times, expected, atol=1e-6)


def retimed(folder, episode, rate_hz):
    """Stamp an episode's rows at another rate."""
    file = folder / f"data/chunk-000/episode_{episode:06d}.parquet"
    rows = parquet.read_table(file)
    at, stamps = rows.schema.get_field_index("timestamp"), np.arange(len(rows)) / rate_hz
    parquet.write_table(rows.set_column(at, "timestamp", pa.array(stamps)), file)


@pytest.mark.parametrize(
    ("episodes", "rate", "told"),
    [
        ([0, 1], 50, "tells 30 Hz, but the times show 50 Hz: the times are taken (2 times)"),
        ([1], 25, "tells 30 Hz, but the times show 25 Hz: rows are put at 30 Hz by the times"),
        ([0, 1], 30.2, None),
    ],
)
def test_time_stamps_that_contradict_the_rate_are_told(tmp_path, episodes, rate, told):
    folder = others_dataset(tmp_path / "data")
    for episode in episodes:
        retimed(folder, episode, rate)
    found = read(folder)

    assert (told or "") in " ".join(finding.sentence for finding in found.findings)
    assert len(found.findings) == 1 + (told is not None)
    motions = Motions.read(folder, channels=["elbow"], ranges={"elbow": (0, 200)})
    assert motions.rate_hz == (50.0 if rate == 50 else 30.0)
    assert motions.lengths == (5, 4)


def test_splits_for_testing_are_held_out(folder):
    assert read(folder).held_out == ()
    rewrite(folder, lambda i: i.update(splits={"train": "0:1", "val": "1:9", "all": [0, 1]}))
    found = read(folder)

    assert found.held_out == (found.episodes[1].name,)
    (told,) = found.findings
    assert told.what == "'val' names an episode 'episode_000002', which is not there"
    rewrite(folder, lambda i: i.update(splits={"train": "1:2"}))
    assert read(folder).held_out == (found.episodes[0].name,)


def test_numbers_of_every_kind_are_taken_where_they_are_observed(tmp_path):
    folder = others_dataset(tmp_path / "data")
    more = {
        "observation.closed": ("bool", [1], pa.array([True, False, True, False])),
        "observation.ticks": ("int64", [1], pa.array([3, 4, 5, 6])),
        "subtask": ("int64", [1], pa.array([0, 0, 1, 1])),
        "observation.pose": ("float32", [4, 4], pa.array([[0.0] * 16] * 4)),
        "observation.points": ("float32", [2, 4, 4], pa.array([[0.0] * 32] * 4)),
    }
    (folder / "data/chunk-000/episode_000000.parquet").unlink()
    file = folder / "data/chunk-000/episode_000001.parquet"
    rows = parquet.read_table(file)
    for key, (_, _, column) in more.items():
        rows = rows.append_column(key, column)
    parquet.write_table(rows, file)
    features = {k: {"dtype": d, "shape": s, "names": None} for k, (d, s, _) in more.items()}
    rewrite(folder, lambda i: i["features"].update(features) or i.pop("total_frames"))
    found = read(folder)

    assert found.channels[-2:] == ("observation.closed", "observation.ticks")
    assert found.episodes[0].values[:, -2:].tolist() == [[1, 3], [0, 4], [1, 5], [0, 6]]
    told = [f.sentence for f in found.findings if f.kind == "left out"]
    assert len(told) == 1
    assert "channel 'observation.pose': a feature of shape [4, 4] is left out" in told[0]


def rewrite(folder, change):
    """Change info.json."""
    file = folder / "meta/info.json"
    info = json.loads(file.read_text())
    change(info)
    file.write_text(json.dumps(info))


BAD_INFO = {
    "an older version": (
        lambda i: i.update(codebase_version="v1.6"),
        "'v1.6' is not read; LeRobotDataset v3.0, v2.1, v2.0 are",
    ),
    "no version": (lambda i: i.pop("codebase_version"), "codebase_version: Field required"),
    "no features": (
        lambda i: i.update(features={}),
        r"no feature of numbers of shape \[n\]; there are: none",
    ),
    "no rate": (lambda i: i.update(fps=0), "fps: Input should be greater than 0"),
    "rows that are away": (lambda i: i.update(total_frames=12), "tells 12 total_frames.*hold 11"),
    "episodes away": (lambda i: i.update(total_episodes=3), "tells 3 total_episodes.*hold 2"),
    "another width": (
        lambda i: i["features"]["observation.state"].update(shape=[4]),
        r"'observation.state' has \[3\] numbers in a row; info.json says 4",
    ),
    "a column that is away": (
        lambda i: i["features"].update(force={"dtype": "float32", "shape": [2], "names": None}),
        "has no column 'force'",
    ),
}


@pytest.mark.parametrize("case", BAD_INFO)
def test_what_does_not_add_up_is_refused(folder, case):
    change, sentence = BAD_INFO[case]
    rewrite(folder, change)
    with pytest.raises(RecordingError, match=sentence):
        read(folder)


def test_frames_that_are_missing_are_told(tmp_path):
    folder = others_dataset(tmp_path / "data")
    file = folder / "data/chunk-000/episode_000001.parquet"
    rows = parquet.read_table(file)
    parquet.write_table(pa.concat_tables([rows.slice(0, 2), rows.slice(3)]), file)
    rewrite(folder, lambda info: info.pop("total_frames"))
    with pytest.raises(RecordingError, match="episode 1: frame 2 is missing; found frame_index 3"):
        read(folder)


def test_rows_are_put_in_the_order_of_their_frames(tmp_path):
    folder = others_dataset(tmp_path / "data")
    file = folder / "data/chunk-000/episode_000000.parquet"
    rows = parquet.read_table(file)
    parquet.write_table(rows.take([4, 0, 2, 3, 1]), file)

    assert read(folder).episodes[0].values[:, 0].tolist() == [0, 3, 6, 9, 12]


def test_row_numbers_that_are_none_are_refused(tmp_path):
    folder = others_dataset(tmp_path / "data")
    file = folder / "data/chunk-000/episode_000000.parquet"
    rows = parquet.read_table(file)
    at = rows.schema.get_field_index("frame_index")
    parquet.write_table(rows.set_column(at, "frame_index", pa.array([0, 1, 2, np.nan, 4])), file)
    with pytest.raises(RecordingError, match="column 'frame_index' holds nan, no row number"):
        read(folder)


def test_cells_without_a_value_are_refused(tmp_path):
    folder = others_dataset(tmp_path / "data")
    file = folder / "data/chunk-000/episode_000000.parquet"
    rows = parquet.read_table(file)
    at = rows.schema.get_field_index("next.reward")
    holed = rows.set_column(at, "next.reward", pa.array([None, 1, 2, 3, None], pa.float32()))
    parquet.write_table(holed, file)
    with pytest.raises(RecordingError, match=r"'next.reward' has 2 cells without a value \(null\)"):
        read(folder)


def test_a_dataset_without_data_is_refused(tmp_path):
    folder = others_dataset(tmp_path / "data")
    for file in folder.glob("data/*/*"):
        file.unlink()
    with pytest.raises(RecordingError, match="is the download complete"):
        read(folder)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda part: (
        st.lists(part, max_size=3) | st.dictionaries(st.text(max_size=5), part, max_size=3)
    ),
    max_leaves=8,
)
FEATURE = st.fixed_dictionaries(
    {
        "dtype": st.sampled_from(["float32", "float64", "int64", "video"]) | JSON,
        "shape": st.lists(st.integers(-2, 10**12), max_size=2) | JSON,
        "names": st.lists(st.text(max_size=2), max_size=3) | JSON,
    }
)
INFOS = {
    "features": st.dictionaries(st.text(max_size=4), FEATURE, max_size=3),
    "fps": JSON,
    "rest": JSON,
}


def described(tmp_path, features, fps, rest):
    """Read an info.json of anything: features with unique names, or one sentence."""
    info = {"codebase_version": "v3.0", "fps": fps, "features": features, "total_frames": rest}
    (tmp_path / "meta").mkdir(exist_ok=True)
    for told in (rest, info, {**info, "fps": 30, "total_frames": 1}):
        (tmp_path / "meta/info.json").write_text(json.dumps(told))
        try:
            names = [c for f in features_of(read_info(tmp_path)) for c in f.channels]
        except MotioneseError as error:
            assert "\n" not in str(error)
        else:
            assert len(set(names)) == len(names)


@settings(max_examples=100)
@given(**INFOS)
def test_any_info_gives_features_or_one_sentence(tmp_path, features, fps, rest):
    described(tmp_path, features, fps, rest)


@pytest.mark.slow
@settings(max_examples=2000)
@given(**INFOS)
def test_many_infos_do_too(tmp_path, features, fps, rest):
    described(tmp_path, features, fps, rest)


def damage(folder, data):
    """Read a dataset with a few bytes of its data changed: a recording or one sentence."""
    file = folder / "data/chunk-000/file-000.parquet"
    content = file.read_bytes()
    damaged = bytearray(content)
    for _ in range(data.draw(st.integers(1, 4))):
        damaged[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    file.write_bytes(damaged[: data.draw(st.sampled_from([len(content), 100, 4, 0]))])
    try:
        read(folder)
    except MotioneseError as error:
        assert "\n" not in str(error)
    finally:
        file.write_bytes(content)


@settings(max_examples=60)
@given(st.data())
def test_damaged_data_gives_a_recording_or_one_sentence(folder, data):
    damage(folder, data)


@pytest.mark.slow
@settings(max_examples=2000)
@given(st.data())
def test_much_damaged_data_does_too(folder, data):
    damage(folder, data)


SPLITS = st.dictionaries(
    st.sampled_from(["train", "val", "test", "other"]),
    JSON | st.builds("{}:{}".format, st.integers(-2, 10**19), st.integers(-2, 10**19)),
)


@given(SPLITS | JSON)
def test_any_splits_give_a_recording(folder, splits):
    rewrite(folder, lambda i: i.update(splits=splits))
    found = read(folder)

    assert set(found.held_out) <= {e.name for e in found.episodes}
