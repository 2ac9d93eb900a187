"""HDF5 of every layout, alone and in folders: what is read, what is told, what is refused."""

import json
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionese import Motions
from motionese.errors import MotioneseError, RecordingError
from motionese.recordings import read
from motionese.recordings.formats import hdf5_walk
from motionese.recordings.formats.flat_episodes import cuts


def robomimic(path, demos=2):
    """Demonstrations of two observed channels and one action."""
    with h5py.File(path, "w") as file:
        for i in range(demos):
            demo = file.create_group(f"data/demo_{i}")
            demo["obs/arm"] = np.random.default_rng(i).normal(size=(6, 2))
            demo["actions"] = np.zeros((6, 1))
            demo.attrs["num_samples"] = 6
    return path


def aloha(path, joints=3, **attributes):
    """An episode as ALOHA's recorder writes it, its pictures compressed."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"sim": False, "compress": True} | attributes)
        for key in ("qpos", "qvel", "effort"):
            file[f"observations/{key}"] = np.random.default_rng(1).normal(size=(9, joints))
        file["observations/images/cam_high"] = np.zeros((9, 400), np.uint8)
        file["action"] = np.random.default_rng(2).normal(size=(9, joints))
        file["base_action"] = np.zeros((9, 2))
        file["compress_len"] = np.zeros((2, 9))
    return path


def maniskill(path, trajectories=11, flat=False):
    """Trajectories with one observation more than actions, and the .json beside them."""
    with h5py.File(path, "w") as file:
        for i in range(trajectories):
            group, rows = file.create_group(f"traj_{i}"), 5 + i
            group["actions"] = np.full((rows, 2), i, np.float32)
            group["success"] = np.arange(rows) == rows - 1
            group["env_states/actors/cube"] = np.zeros((rows + 1, 13), np.float32)
            if flat:
                group["obs"] = np.full((rows + 1, 4), -i, np.float32)
            else:
                group["obs/agent/qpos"] = np.full((rows + 1, 3), -i, np.float32)
                group["obs/extra/is_grasped"] = np.arange(rows + 1) > 3
                group["obs/sensor_data/camera/rgb"] = np.zeros((rows + 1, 4, 4, 3), np.uint8)
    about = {
        "env_info": {"env_id": "Pick", "env_kwargs": {"sim_config": {"control_freq": 20}}},
        "episodes": [{"episode_id": i, "elapsed_steps": 5 + i} for i in range(trajectories)],
    }
    path.with_suffix(".json").write_text(json.dumps(about))
    return path


def d4rl(path, timeouts=(3,), terminals=(7,)):
    """Ten rows, one after another, with what ends episodes."""
    with h5py.File(path, "w") as file:
        file["observations"] = np.arange(20, dtype=np.float32).reshape(10, 2)
        file["actions"] = np.zeros((10, 1), np.float32)
        file["rewards"] = np.zeros(10, np.float32)
        file["infos/qpos"] = np.zeros((10, 2))
        file["metadata/algorithm"] = "SAC"
        for key, rows in (("terminals", terminals), ("timeouts", timeouts)):
            if rows is not None:
                file[key] = np.isin(np.arange(10), rows)
    return path


LAYOUTS = {"robomimic": robomimic, "ManiSkill": maniskill, "ALOHA": aloha, "D4RL": d4rl}


def test_an_episode_of_aloha_is_read(tmp_path):
    found = read(aloha(tmp_path / "episode_3.hdf5"))

    assert found.usual == ("qpos_0", "qpos_1", "qpos_2")
    assert {"qvel_0", "effort_2", "action_1", "base_action_0"} < set(found.channels)
    assert not [name for name in found.channels if "cam" in name or "compress" in name]
    assert [e.name for e in found.episodes] == ["episode_3"]
    assert (found.rate_hz, found.findings) == (None, ())
    assert read(aloha(tmp_path / "told.h5", fps=np.float32(50))).rate_hz == 50.0


def test_a_folder_is_its_files_in_natural_order(tmp_path):
    for i in (10, 2, 1):
        aloha(tmp_path / f"episode_{i}.hdf5", fps=50)
    (tmp_path / "._episode_1.hdf5").write_bytes(b"of another system")
    (tmp_path / "notes.txt").write_text("a good day")
    found = read(tmp_path)

    assert [e.name for e in found.episodes] == ["episode_1", "episode_2", "episode_10"]
    assert found.rate_hz == 50.0
    assert [e.times for e in found.episodes] == [None] * 3
    for name in ("hdf5", "robomimic"):
        assert Motions.read(tmp_path, format=name).names == ("episode_1", "episode_2", "episode_10")


def test_episodes_of_files_that_hold_several_are_told_apart(tmp_path):
    for name in ("lift.hdf5", "stack.hdf5"):
        with h5py.File(robomimic(tmp_path / name), "a") as file:
            file["mask/valid"] = np.array([b"demo_1", b"demo_7"])
    found = read(tmp_path)

    assert [e.name for e in found.episodes][1:3] == ["lift/demo_1", "stack/demo_0"]
    assert found.held_out == ("lift/demo_1", "stack/demo_1")
    (told,) = found.findings
    assert told.sentence.startswith(f"{tmp_path / 'lift.hdf5'}: 'valid' names an episode 'demo_7'")
    assert told.count == 2


def test_where_rates_differ_each_episode_keeps_its_times(tmp_path):
    aloha(tmp_path / "a.hdf5", fps=50)
    aloha(tmp_path / "b.hdf5", fps=20)
    found = read(tmp_path)

    assert found.rate_hz is None
    assert [e.times[1] for e in found.episodes] == [1 / 50, 1 / 20]


def test_a_file_that_does_not_tell_the_rate_that_others_do_is_told(tmp_path):
    for name, told in {"a": {"fps": 50}, "b": {}, "c": {}}.items():
        aloha(tmp_path / f"{name}.hdf5", **told)
    (finding,) = read(tmp_path).findings

    assert finding.sentence == (
        f"{tmp_path / 'b.hdf5'}: tells no rate: taken to be at that of the other files (2 times)"
    )


def test_trajectories_of_maniskill_are_read(tmp_path):
    found = read(maniskill(tmp_path / "trajectory.h5"))

    assert found.usual == (*(f"agent/qpos_{i}" for i in range(3)), "extra/is_grasped")
    assert [e.name for e in found.episodes] == [f"traj_{i}" for i in range(11)]
    assert found.rate_hz == 20.0
    last, at = found.episodes[10], found.channels.index("actions_1")
    assert len(last.values) == 16
    assert last.values[:-1, at].tolist() == [10] * 15
    assert last.observed[:, at].tolist() == [True] * 15 + [False]
    assert last.observed[:, found.channels.index("agent/qpos_2")].all()
    (told,) = found.findings
    assert (told.episode, told.row, told.channel, told.count) == ("traj_0", 5, "actions_0", 11)


def test_what_every_trajectory_of_maniskill_lacks_is_told_and_no_fault(tmp_path):
    path = maniskill(tmp_path / "trajectory.h5")
    given = {"strict": True, "ranges": {"*": (-99.0, 99.0)}}
    assert "nothing was recorded" in Motions.read(path, **given, channels=["*"]).examined[0].what

    about = json.loads(path.with_suffix(".json").read_text())
    about["episodes"][4]["elapsed_steps"] = 200
    path.with_suffix(".json").write_text(json.dumps(about))
    with pytest.raises(RecordingError, match="tells 200 steps; refused as --strict asks for"):
        Motions.read(path, **given)


def test_observations_may_be_one_dataset_and_the_json_may_be_away(tmp_path):
    path = maniskill(tmp_path / "trajectory.h5", flat=True)
    path.with_suffix(".json").write_text("[")
    found = read(path)

    assert found.usual == ("obs_0", "obs_1", "obs_2", "obs_3")
    assert found.rate_hz is None


def test_steps_that_are_not_those_of_the_json_are_told(tmp_path):
    path = maniskill(tmp_path / "trajectory.h5")
    about = json.loads(path.with_suffix(".json").read_text())
    about["episodes"][4]["elapsed_steps"] = 200
    path.with_suffix(".json").write_text(json.dumps(about))

    told = read(path).findings[-1].sentence
    assert told.endswith("episode 'traj_4': has 9 actions; its .json tells 200 steps")


def test_flat_rows_are_cut_where_episodes_end(tmp_path):
    found = read(d4rl(tmp_path / "flat.hdf5"))

    assert found.usual == ("observations_0", "observations_1")
    assert {"actions_0", "rewards", "infos/qpos_1"} < set(found.channels)
    assert [e.name for e in found.episodes] == ["episode_0", "episode_1", "episode_2"]
    column = found.channels.index("observations_0")
    starts = [e.values[:, column].tolist() for e in found.episodes]
    assert starts == [[0, 2, 4, 6], [8, 10, 12, 14], [16, 18]]
    assert not found.findings


def test_flat_rows_in_which_nothing_ends_are_told(tmp_path):
    found = read(d4rl(tmp_path / "flat.hdf5", timeouts=None, terminals=()))

    assert [len(e.values) for e in found.episodes] == [10]
    assert "neither terminals nor timeouts mark an end" in found.findings[0].sentence


@given(st.lists(st.sampled_from([0, 1, 2, 3]), max_size=12))
def test_every_row_is_in_one_episode_that_ends_where_one_is_marked(marks):
    marks = np.array(marks, dtype=int)
    parts = cuts(marks & 1, marks & 2, len(marks))

    rows = [row for part in parts for row in range(part.start, part.stop)]
    assert rows == list(range(len(marks)))
    assert [p.stop - 1 for p in parts if marks[p.stop - 1]] == np.flatnonzero(marks).tolist()


def another_layout(folder):
    robomimic(folder / "b.hdf5")
    return r"b\.hdf5: in the layout of robomimic; others, such as a\.hdf5, in that of ALOHA"


def a_channel_less(folder):
    aloha(folder / "b.hdf5", joints=2)
    return r"b\.hdf5: has no channel 'action_2', which others, such as a\.hdf5, have"


def a_channel_more(folder):
    aloha(folder / "b.hdf5", joints=4)
    return r"b\.hdf5: has a channel 'action_3', which others, such as a\.hdf5, do not have"


def not_hdf5(folder):
    (folder / "b.hdf5").write_text("x,y\n1,2\n")
    return r"b\.hdf5: not an HDF5 file, cut short, or damaged"


@pytest.mark.parametrize("spoil", [another_layout, a_channel_less, a_channel_more, not_hdf5])
def test_the_file_that_does_not_fit_is_named(tmp_path, spoil):
    for name in "abc":
        aloha(tmp_path / f"{name}.hdf5")

    with pytest.raises(RecordingError, match=spoil(tmp_path)):
        read(tmp_path)


def test_what_is_of_no_layout_is_refused_with_what_is_there(tmp_path):
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["joint_action/left"] = np.zeros((3, 2))
    with pytest.raises(RecordingError, match=r"ManiSkill: groups traj_0.*here are: joint_action"):
        read(tmp_path / "other.h5")


@pytest.mark.parametrize("layout", LAYOUTS)
def test_rows_that_do_not_agree_are_refused(tmp_path, layout):
    path = LAYOUTS[layout](tmp_path / "a.hdf5")
    with h5py.File(path, "a") as file:
        names: list[str] = []
        file.visit(names.append)
        name = next(n for n in names if n.rpartition("/")[2] in ("action", "actions"))
        del file[name]
        file[name] = np.zeros((4, 2))
    with pytest.raises(RecordingError, match="they must agree"):
        read(path)


def test_ends_that_are_not_told_of_every_row_are_refused(tmp_path):
    with h5py.File(d4rl(tmp_path / "flat.hdf5"), "a") as file:
        del file["timeouts"]
        file["timeouts"] = np.zeros(9, bool)
    with pytest.raises(RecordingError, match=r"has 10 rows, timeouts the shape \(9,\); they must"):
        read(tmp_path / "flat.hdf5")


def test_a_file_that_is_cut_short_or_foreign_is_refused(tmp_path):
    path = robomimic(tmp_path / "ours.hdf5")
    content = path.read_bytes()
    for damaged in (content[:-500], content[:100], b"", b"episode,time\n"):
        path.write_bytes(damaged)
        with pytest.raises(RecordingError, match=r"ours\.hdf5: not an HDF5 file, cut short"):
            read(path)


@pytest.mark.parametrize(
    ("walk", "sentence"),
    [("__import__('os').abort()", "HDF5 crashes on it"), ("while 1: pass", "not get through it")],
)
def test_a_file_that_takes_hdf5_down_does_not_take_us_down(tmp_path, monkeypatch, walk, sentence):
    for name in "abc":
        aloha(tmp_path / f"{name}.hdf5")
    only_b = f"if path.endswith('b.hdf5'):\n            {walk}"
    script = hdf5_walk._WALK.replace("file.visititems(visit)", only_b)
    monkeypatch.setattr(hdf5_walk, "_WALK", script)
    monkeypatch.setattr(hdf5_walk, "SECONDS", 0.5)

    with pytest.raises(RecordingError, match=rf"b\.hdf5: damaged: .*{sentence}"):
        read(tmp_path)


def damage(tmp_path_factory, layout, data):
    """Read a file of a layout with a few bytes changed: a recording or one sentence."""
    folder = Path(tmp_path_factory.mktemp("damaged"))
    path = LAYOUTS[layout](folder / "a.hdf5")
    damaged = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(damaged)
    try:
        read(path)
    except MotioneseError as error:
        assert "\n" not in str(error)
    shutil.rmtree(folder)


@pytest.mark.parametrize("layout", LAYOUTS)
@settings(max_examples=4)
@given(data=st.data())
def test_damaged_files_give_a_recording_or_one_sentence(tmp_path_factory, layout, data):
    damage(tmp_path_factory, layout, data)


@pytest.mark.slow
@pytest.mark.parametrize("layout", LAYOUTS)
@settings(max_examples=500)
@given(data=st.data())
def test_many_damaged_files_do_too(tmp_path_factory, layout, data):
    damage(tmp_path_factory, layout, data)


TREES = st.dictionaries(
    st.sampled_from(["data", "demo_0", "traj_0", "obs", "observations", "actions", "mask", "qpos"]),
    st.recursive(
        st.tuples(
            st.lists(st.integers(0, 3), max_size=3),
            st.sampled_from(["f4", "f8", "i8", "?", "u1", "S3", "c8"]),
        ),
        lambda inner: st.dictionaries(
            st.sampled_from(["demo_0", "obs", "qpos", "actions", "train", "terminals"]),
            inner,
            max_size=3,
        ),
        max_leaves=6,
    ),
    max_size=4,
)


def plant(group, tree):
    """Write a tree of groups and datasets (shape, type)."""
    for key, part in tree.items():
        if isinstance(part, dict):
            plant(group.create_group(key), part)
        else:
            group[key] = np.ones(part[0], part[1])


@pytest.fixture
def unwalked(monkeypatch):
    """Without the child process, which is slow to start and has nothing to find here."""
    monkeypatch.setattr("motionese.recordings.formats.hdf5.check_walkable", lambda files: None)


def grow(folder, tree):
    """Read a file of any groups and datasets: a recording or one sentence."""
    with h5py.File(folder / "made_up.hdf5", "w") as file:
        plant(file, tree)
    try:
        read(folder / "made_up.hdf5")
    except MotioneseError as error:
        assert "\n" not in str(error)
        assert "damaged" not in str(error)


@settings(max_examples=80)
@given(TREES)
def test_made_up_files_give_a_recording_or_one_sentence(tmp_path, unwalked, tree):
    grow(tmp_path, tree)


@pytest.mark.slow
@settings(max_examples=2000)
@given(TREES)
def test_many_made_up_files_do_too(tmp_path, unwalked, tree):
    grow(tmp_path, tree)
