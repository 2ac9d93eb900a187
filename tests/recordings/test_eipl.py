"""Folders of EIPL: padding is turned into lengths."""

import shutil

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from motionese.errors import MotioneseError, RecordingError
from motionese.recordings import read, write


@pytest.fixture
def folder(tmp_path):
    """Write joints of lengths 5, 9, 7, padded in some way, as a folder; and what they were."""
    rng = np.random.default_rng(0)
    real = [rng.normal(size=(n, 2)).astype(np.float32) for n in (5, 9, 7)]

    def wrote(padding, where=""):
        joints = np.zeros((3, 9, 2), np.float32)
        for values, row in zip(real, joints, strict=True):
            row[:] = values[-1] if padding == "last" else padding
            row[: len(values)] = values
        (tmp_path / where).mkdir(exist_ok=True)
        np.save(tmp_path / where / "joints.npy", joints)
        return tmp_path, real

    return wrote


@pytest.mark.parametrize("padding", ["last", 0.0, np.nan])
def test_padding_becomes_lengths(folder, padding):
    path, real = folder(padding)
    found = read(path)

    assert found.channels == ("joint_0", "joint_1")
    assert found.rate_hz is None
    assert [e.name for e in found.episodes] == ["0", "1", "2"]
    for episode, values in zip(found.episodes, real, strict=True):
        np.testing.assert_array_equal(episode.values, values)
        assert episode.observed.all()


def test_a_still_stretch_within_an_episode_is_no_padding(tmp_path):
    joints = np.array([[[1.0], [1.0], [1.0], [2.0]], [[0.0], [0.0], [3.0], [3.0]]])
    np.save(tmp_path / "joints.npy", joints)

    assert [len(e.values) for e in read(tmp_path).episodes] == [4, 3]


PADDINGS = {
    "last": lambda values: values[-1],
    "zeros": lambda values: np.zeros(2),
    "nan": lambda values: np.full(2, np.nan),
}


@pytest.mark.parametrize("padding", PADDINGS)
@given(
    lengths=st.lists(st.integers(2, 9), min_size=1, max_size=6),
    rest=st.integers(0, 5),
    home=st.booleans(),
)
def test_a_rest_that_the_longest_shows_is_kept(tmp_path, padding, lengths, rest, home):
    real = [np.random.default_rng(n).normal(size=(n, 2)) for n in lengths]
    if home and padding == "last":
        real = [np.concatenate([values, np.zeros((1, 2))]) for values in real]
    real = [np.concatenate([values, np.repeat(values[-1:], rest, axis=0)]) for values in real]
    longest = max(map(len, real))
    missing = [longest - len(values) for values in real]
    assume(padding != "zeros" or max(missing) != 1)  # one row of zeros may be the goal
    filled = [np.tile(PADDINGS[padding](v), (longest - len(v), 1)) for v in real]
    padded = [np.concatenate(parts) for parts in zip(real, filled, strict=True)]
    np.save(tmp_path / "joints.npy", np.stack(padded))
    found = read(tmp_path)

    for episode, values in zip(found.episodes, real, strict=True):
        np.testing.assert_array_equal(episode.values, values)
    assert len(found.findings) == (max(missing) > 0)
    for finding in found.findings:
        assert f"{sum(missing)} rows at the ends of {np.count_nonzero(missing)} of" in finding.what


def test_what_is_cut_is_told_once_with_the_way_to_keep_it(folder):
    path, _ = folder("last")
    (finding,) = read(path).findings

    assert finding.sentence == (
        f"{path}: episode '0', row 5: 6 rows at the ends of 2 of 3 episodes only pad them to the "
        f"length of the longest: left out; give {path / 'joints.npy'} itself to keep them"
    )


def test_folders_of_one_length_are_measured_together(folder):
    path, _ = folder("last", "train")
    (path / "test").mkdir()
    np.save(path / "test" / "joints.npy", np.load(path / "train" / "joints.npy")[[0, 2]])

    assert [len(e.values) for e in read(path).episodes] == [5, 9, 7, 5, 7]


def test_an_end_at_zero_is_no_padding_where_others_repeat_their_last_row(tmp_path):
    joints = np.random.default_rng(0).normal(size=(4, 9, 2))
    for i, length in enumerate((9, 4, 5, 6)):
        joints[i, length:] = joints[i, length - 1]
    joints[3, 5:] = 0.0
    np.save(tmp_path / "joints.npy", joints)

    assert [len(e.values) for e in read(tmp_path).episodes] == [9, 4, 5, 6]


def test_train_and_test_are_told_apart_and_images_left_alone(folder):
    path, _ = folder("last", "train")
    folder("last", "test")
    for part in ("train", "test"):
        np.save(path / part / "images.npy", np.zeros((3, 9, 4, 4, 3), np.uint8))
        np.save(path / part / "force.npy", np.ones((3, 9, 1)))
    np.save(path / "joint_bounds.npy", np.array([[-3.0, 1.0], [3.0, 1.0]]))

    found = read(path)

    assert found.channels == ("joint_0", "joint_1", "force_0")
    assert [e.name for e in found.episodes][::3] == ["train/0", "test/0"]
    assert found.ranges == {"joint_0": (-3.0, 3.0)}
    assert found.held_out == ("test/0", "test/1", "test/2")
    assert read(path / "test").held_out == ()


def test_a_recording_is_written_as_it_reads(whole, tmp_path):
    path = tmp_path / "out"
    write(path, whole, "eipl")
    found = read(path)

    assert np.load(path / "joints.npy").shape == (2, 7, 3)
    assert np.load(path / "joints.npy").dtype == np.float32
    assert found.ranges["joint_0"] == (-4.0, 4.5)
    for was, now in zip(whole.episodes, found.episodes, strict=True):
        np.testing.assert_array_equal(now.values, was.values.astype(np.float32))
    with pytest.raises(RecordingError, match="out: exists already"):
        write(path, whole, "eipl")


def test_gaps_are_refused_and_leave_nothing(recording, tmp_path):
    with pytest.raises(RecordingError, match="an EIPL folder cannot hold gaps; csv, npz and mcap"):
        write(tmp_path / "out", recording, "eipl")

    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("joints", "bounds", "match"),
    [
        (np.zeros((3, 4)), None, r"expected \[episodes, rows, joints\], got shape \(3, 4\)"),
        (np.zeros((0, 4, 2)), None, r"expected \[episodes, rows, joints\]"),
        (np.full((1, 2, 2), "a"), None, "'joint' holds <U1, no numbers"),
        (np.array([[[None]]]), None, "joints.npy: not an array of NumPy: .*object"),
        (np.ones((1, 2, 2)), np.zeros((2, 3)), r"expected shape \(2, 2\).* got .*\(2, 3\)"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(tmp_path, joints, bounds, match):
    np.save(tmp_path / "joints.npy", joints)
    if bounds is not None:
        np.save(tmp_path / "joint_bounds.npy", bounds)

    with pytest.raises(RecordingError, match=match):
        read(tmp_path)


ARRAYS = arrays(
    st.sampled_from(["f8", "f4", "i4", "u1", "?", "U2"]),
    array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=4),
)
PARTS = st.dictionaries(
    st.sampled_from(["joints", "train/joints", "test/joints", "train/force", "joint_bounds"]),
    ARRAYS | arrays("f8", st.tuples(st.just(3), st.integers(1, 5), st.just(2))),
    min_size=1,
)


def made_up(tmp_path_factory, parts):
    """Read a folder of any arrays: a recording or one sentence."""
    folder = tmp_path_factory.mktemp("made_up")
    for name, array in parts.items():
        (folder / name).parent.mkdir(exist_ok=True)
        np.save(folder / f"{name}.npy", array)
    try:
        found = read(folder, "eipl")
        assert all(finding.sentence for finding in found.findings)
    except MotioneseError as error:
        assert "\n" not in str(error)
    shutil.rmtree(folder)


@settings(max_examples=60)
@given(PARTS)
def test_any_arrays_give_a_recording_or_one_sentence(tmp_path_factory, parts):
    made_up(tmp_path_factory, parts)


@pytest.mark.slow
@settings(max_examples=2000)
@given(PARTS)
def test_many_arrays_do_too(tmp_path_factory, parts):
    made_up(tmp_path_factory, parts)
