"""robomimic's HDF5: what is written against its layout, and what others write read."""

import json
from dataclasses import replace

import h5py
import numpy as np
import pytest

from motionese.errors import RecordingError
from motionese.recordings import read, write


@pytest.fixture
def ours(whole, tmp_path):
    """A file that we wrote."""
    write(tmp_path / "ours.hdf5", whole)
    return tmp_path / "ours.hdf5"


@pytest.fixture
def theirs(tmp_path):
    """Eleven demonstrations as robomimic's own tools write them, with a camera."""
    path = tmp_path / "theirs.hdf5"
    with h5py.File(path, "w") as file:
        data = file.create_group("data")
        data.attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 20}, "type": 1})
        for i in range(11):
            demo, rows = data.create_group(f"demo_{i}"), 4 + i
            demo.attrs["num_samples"] = rows
            demo.attrs["model_file"] = "<mujoco/>"
            demo["obs/robot0_eef_pos"] = np.full((rows, 3), float(i))
            demo["obs/gripper"] = np.arange(rows, dtype=np.float32)
            demo["obs/agentview_image"] = np.zeros((rows, 8, 8, 3), np.uint8)
            demo["obs/depth"] = np.zeros((rows, 8, 8), np.float32)
            demo["next_obs/gripper"] = np.zeros(rows)
            demo["actions"] = np.full((rows, 2), -float(i))
            demo["dones"] = np.zeros(rows, np.int64)
        file["mask/train"] = np.array([b"demo_0", b"demo_2"])
    return path


def test_a_file_has_the_layout_of_robomimic(ours, whole):
    with h5py.File(ours) as file:
        data = file["data"]
        assert data.attrs["total"] == 11
        env_args = json.loads(data.attrs["env_args"])
        assert env_args == {
            "env_name": "recording",
            "type": 2,
            "env_kwargs": {"control_freq": 25.0},
        }
        assert list(file) == ["data"]
        assert list(data) == ["demo_0", "demo_1"]
        for demo, episode in zip(data.values(), whole.episodes, strict=True):
            rows = len(episode.values)
            assert demo.attrs["num_samples"] == rows
            assert set(demo) == {"obs", "actions", "rewards", "dones"}
            np.testing.assert_array_equal(demo["obs/state"], episode.values)
            np.testing.assert_array_equal(demo["actions"][:-1], episode.values[1:])
            np.testing.assert_array_equal(demo["actions"][-1], episode.values[-1])
            assert demo["dones"][()].tolist() == [0] * (rows - 1) + [1]
            assert demo["rewards"].shape == (rows,)


def test_what_was_written_reads_the_same(ours, whole):
    found = read(ours)

    assert (found.channels, found.units, found.rate_hz) == (whole.channels, whole.units, 25.0)
    assert found.usual == whole.channels
    for was, now in zip(whole.episodes, found.episodes, strict=True):
        assert (now.name, now.times) == (was.name, None)
        np.testing.assert_array_equal(now.values, was.values)


def test_a_rate_that_nobody_knows_stays_unknown(whole, tmp_path):
    write(tmp_path / "out.h5", replace(whole, rate_hz=None))

    assert read(tmp_path / "out.h5").rate_hz is None


@pytest.mark.parametrize("env_args", ["20 Hz", "[]", '{"env_kwargs": {"control_freq": 1e400}}'])
def test_environments_that_tell_no_rate_leave_it_unknown(theirs, env_args):
    with h5py.File(theirs, "a") as file:
        file["data"].attrs["env_args"] = env_args

    assert read(theirs).rate_hz is None


def test_uneven_times_are_refused(whole, tmp_path):
    timed = replace(whole.episodes[0], times=np.arange(7) / 10)
    with pytest.raises(RecordingError, match="episode 'UR ↓' is not evenly spaced at 25 Hz"):
        write(tmp_path / "out.hdf5", replace(whole, episodes=(timed,)))

    assert not list(tmp_path.iterdir())


def test_files_of_others_are_read(theirs):
    found = read(theirs)

    position = tuple(f"robot0_eef_pos_{i}" for i in range(3))
    assert set(found.channels) == {"gripper", *position, "actions_0", "actions_1"}
    assert found.usual == tuple(n for n in found.channels if not n.startswith("actions"))
    assert found.rate_hz == 20.0
    assert [e.name for e in found.episodes] == [f"demo_{i}" for i in range(11)]
    last = found.episodes[10]
    assert last.values[:, found.channels.index("gripper")].tolist() == list(range(14))
    assert set(last.values[:, found.channels.index("actions_1")]) == {-10.0}


def test_actions_are_usual_where_nothing_was_observed(theirs):
    with h5py.File(theirs, "a") as file:
        for demo in file["data"].values():
            del demo["obs"]
            demo["states"] = np.zeros((len(demo["actions"]), 40))
    found = read(theirs)

    assert len(found.channels) == 42
    assert found.usual == ("actions_0", "actions_1")


def cut_actions(file):
    del file["data/demo_3/actions"]
    file["data/demo_3/actions"] = np.zeros((6, 2))


def cut_all(file):
    file["data/demo_4"].attrs["num_samples"] = 9


def lose_a_key(file):
    del file["data/demo_5/obs/gripper"]


def widen(file):
    del file["data/demo_6/obs/robot0_eef_pos"]
    file["data/demo_6/obs/robot0_eef_pos"] = np.zeros((10, 4))


def lose_data(file):
    file.move("data", "trajectories")


def lose_numbers(file):
    del file["data/demo_0/obs"]
    del file["data/demo_0/actions"]


BAD = {
    cut_actions: r"theirs.hdf5: 'demo_3': obs/gripper has 7 rows, actions 6; they must agree",
    cut_all: "'demo_4': obs/gripper has 8 rows, its attribute num_samples 9",
    lose_a_key: "'demo_5' has no dataset obs/gripper of 1 columns, which the first",
    widen: "'demo_6' has no dataset obs/robot0_eef_pos of 3 columns",
    lose_data: r"robomimic: groups data/demo_0, data/demo_1, ….*; here are: mask, trajectories",
    lose_numbers: r"'demo_0' has no datasets of numbers \[T\] or \[T, n\]",
}


@pytest.mark.parametrize("change", BAD)
def test_what_does_not_fit_together_is_refused(theirs, change):
    with h5py.File(theirs, "a") as file:
        change(file)
    with pytest.raises(RecordingError, match=BAD[change]):
        read(theirs)


def masked(path, **masks):
    """The same file with these masks and no others."""
    with h5py.File(path, "a") as file:
        del file["mask"]
        for name, numbers in masks.items():
            file[f"mask/{name}"] = np.array([f"demo_{i}".encode() for i in numbers])
    return read(path)


@pytest.mark.parametrize(
    ("masks", "held_out"),
    [
        ({"train": range(9), "valid": [10, 9]}, ["demo_9", "demo_10"]),
        ({"train": range(8), "20_percent": [0, 1]}, ["demo_8", "demo_9", "demo_10"]),
        ({"train": range(11)}, []),
        ({"20_percent": [0, 1]}, []),
    ],
)
def test_what_masks_set_apart_is_held_out(theirs, masks, held_out):
    found = masked(theirs, **masks)

    assert list(found.held_out) == held_out
    assert not found.findings


def test_masks_that_are_wrong_are_told(theirs):
    found = masked(theirs, train=range(9), valid=[8, 10, 30, 31])

    assert found.held_out == ("demo_8", "demo_10")
    missing, both = (finding.sentence for finding in found.findings)
    assert missing.endswith("'valid' names an episode 'demo_30', which is not there (2 times)")
    assert both.endswith(
        "episode 'demo_8': is both in 'train' and in a part for testing; it is held out"
    )


def test_what_is_held_out_is_written_as_masks(whole, tmp_path):
    apart = replace(whole, held_out=(whole.episodes[1].name,))
    write(tmp_path / "out.hdf5", apart, "robomimic")

    assert read(tmp_path / "out.hdf5").held_out == apart.held_out
    with h5py.File(tmp_path / "out.hdf5") as file:
        assert {k: v[()].tolist() for k, v in file["mask"].items()} == {
            "train": [b"demo_0"],
            "valid": [b"demo_1"],
        }


def test_whole_numbers_are_taken_where_they_are_observed(theirs):
    with h5py.File(theirs, "a") as file:
        for demo in file["data"].values():
            rows = len(demo["actions"])
            demo["obs/contact"] = np.ones(rows, bool)
            demo["obs/jpeg"] = np.zeros((rows, 300), np.uint8)
            demo["obs/embedding"] = np.zeros((rows, 768), np.float32)
            demo["obs/timestamp"] = np.arange(rows, dtype=float)
    found = read(theirs)

    assert "contact" in found.usual
    assert "timestamp" in found.channels and "timestamp" not in found.usual
    assert not {name for name in found.channels if name.startswith(("jpeg", "embedding", "dones"))}
    (told,) = found.findings
    assert "obs/embedding has 768 columns, more than the 512 that are read" in told.sentence
