"""Bare arrays of NumPy, and archives of arrays."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motionese.errors import MotioneseError, RecordingError, SettingError
from motionese.recordings import read, survey

RNG = np.random.default_rng(0)
ROWS = RNG.normal(size=(90, 3))
NUMBERED = ("column_0", "column_1", "column_2")


@pytest.fixture
def saved(tmp_path):
    def save(name="a.npy", content=None, /, **arrays):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        if content is not None:
            np.save(path, content)
        else:
            np.savez(path, **arrays)
        return path

    return save


def lengths(recording):
    return [(e.name, len(e.values)) for e in recording.episodes]


def test_rows_and_episodes_of_rows(saved):
    stack = ROWS.reshape(3, 30, 3).copy()
    stack[1, 25:] = np.nan
    found, several = read(saved("a.npy", ROWS)), read(saved("b.npy", stack))

    assert (found.channels, lengths(found)) == (NUMBERED, [("a", 90)])
    assert found.findings[0].remedy == "--columns a,b,c names them"
    assert lengths(several) == [("0", 30), ("1", 25), ("2", 30)]
    assert "5 rows at its end are NaN throughout" in several.findings[1].sentence
    assert read(saved("a.npy", ROWS), columns=("x", "y", "z")).channels == ("x", "y", "z")
    with pytest.raises(SettingError, match="has 3 columns, --columns gives 1 names"):
        read(saved("a.npy", ROWS), columns=("x",))


def test_a_folder_of_arrays(saved, tmp_path):
    for i in (2, 10):
        saved(f"folder/take_{i}.npy", ROWS[: 20 + i])
    assert lengths(read(tmp_path / "folder")) == [("take_2", 22), ("take_10", 30)]
    saved("folder/labels.npy", np.zeros((5, 7)))
    with pytest.raises(
        RecordingError, match=r"labels\.npy: has 7 channels, 2 of the 3 files have 3"
    ):
        read(tmp_path / "folder")


@pytest.mark.parametrize(
    ("content", "match"),
    [
        (np.array([1, "a", None], dtype=object), "holds Python objects, which are not loaded"),
        (np.zeros((2, 2, 2, 2)), r"expected numbers, .* got float64 of shape \(2, 2, 2, 2\)"),
        (np.zeros((0, 3)), r"shape \(0, 3\)"),
        (np.array(["a"]), "expected numbers"),
        (np.zeros((2, 9000)), "9000 channels are no motion's"),
    ],
)
def test_what_is_no_motion_is_refused(saved, content, match):
    with pytest.raises(RecordingError, match=match):
        read(saved("a.npy", content))


@pytest.mark.parametrize(
    "cut",
    [
        {"terminals": np.isin(np.arange(90), [29, 49])},
        {"dones": np.isin(np.arange(90), [29]), "timeouts": np.isin(np.arange(90), [49, 89])},
        {"episode_ends": np.array([30, 50, 90])},
        {"episode_starts": np.isin(np.arange(90), [0, 30, 50])},
        {"episode_starts": np.array([0, 30, 50])},
        {"episode_index": np.repeat([4, 5, 9], [30, 20, 40])},
        {"meta/episode_ends": np.array([30, 50, 90])},
        {"episode_lengths": np.array([30, 20, 40])},
    ],
)
def test_rows_of_all_episodes_are_cut(saved, cut):
    found = read(
        saved(
            "a.npz",
            observations=ROWS,
            actions=ROWS[:, :1],
            rewards=ROWS[:, 0],
            images=np.zeros((90, 4, 4, 3), np.uint8),
            seed=np.arange(5.0),
            words=np.array(["a"]),
            **cut,
        )
    )

    assert lengths(found) == [("0", 30), ("1", 20), ("2", 40)]
    assert found.usual == tuple(f"observations_{i}" for i in range(3))
    assert found.channels == (*found.usual, "actions", "rewards")
    assert {f.channel for f in found.findings} == {"images", "seed", "words"}
    np.testing.assert_array_equal(found.episodes[1].values[:, :3], ROWS[30:50])


def test_stacks_times_and_what_names_itself(saved):
    stack = ROWS.reshape(3, 30, 3)
    found = read(saved("a.npz", qpos=stack, action=stack, lengths=np.array([30, 10, 30])))
    assert lengths(found) == [("0", 30), ("1", 10), ("2", 30)]
    assert found.usual == ("qpos_0", "qpos_1", "qpos_2")

    timed = read(saved("b.npz", obs=ROWS, time=np.arange(90) / 20))
    np.testing.assert_allclose(timed.episodes[0].times, np.arange(90) / 20)
    assert read(saved("c.npz", obs=ROWS, fps=np.array(20.0))).rate_hz == 20
    assert read(saved("d.npz", actions=ROWS)).usual == ("actions_0", "actions_1", "actions_2")
    assert read(saved("e.npz", arr_0=ROWS)).channels == NUMBERED
    assert read(saved("f.npz", arr_0=ROWS), columns=("x", "y", "z")).channels == ("x", "y", "z")


def test_archives_without_rows_or_with_cuts_elsewhere_are_refused(saved):
    objects = np.empty(2, dtype=object)
    with pytest.raises(RecordingError, match="obs holds Python objects, which are not loaded"):
        read(saved("a.npz", obs=objects))
    with pytest.raises(RecordingError, match="'episode_starts' cuts at rows that are not there"):
        read(saved("a.npz", obs=ROWS, episode_starts=np.array([0, 300])))


KEYS = ("obs", "actions", "terminals", "episode_ends", "episode_index", "lengths", "time", "fps")
SHAPES = st.lists(st.integers(0, 4), max_size=4).map(tuple)
VALUES = st.sampled_from([0, 1, -1, 2.5, 3, np.nan, np.inf, 1e300])


ARRAYS = st.dictionaries(
    st.sampled_from(KEYS), st.tuples(SHAPES, VALUES, st.sampled_from("fdib?US")), min_size=1
)


def check_anything(folder, arrays):
    with np.errstate(all="ignore"):
        content = {k: np.full(s, v).astype(t) for k, (s, v, t) in arrays.items()}
    np.savez(folder / "a.npz", **content)
    for name, array in content.items():
        np.save(folder / f"{name}.npy", array)
    for path in (folder / "a.npz", *(folder / f"{name}.npy" for name in content)):
        try:
            survey(read(path))
        except MotioneseError as error:
            assert "\n" not in str(error)


@given(ARRAYS)
def test_archives_of_anything(tmp_path, arrays):
    check_anything(tmp_path, arrays)


@pytest.mark.slow
@settings(max_examples=2000)
@given(ARRAYS)
def test_more_archives_of_anything(tmp_path, arrays):
    check_anything(tmp_path, arrays)
