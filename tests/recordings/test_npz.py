"""The project's own file holds everything, to the last bit."""

import gc
import warnings
from dataclasses import replace

import numpy as np
import pytest

from motionese.errors import RecordingError
from motionese.recordings import read, write


def test_a_recording_reads_as_it_was_written(recording, tmp_path):
    timed = replace(recording.episodes[0], times=np.sort(np.random.default_rng(1).random(7)))
    recording = replace(
        recording, episodes=(timed, *recording.episodes[1:]), usual=("a[0]",), held_out=("UR ↓",)
    )
    path = tmp_path / "out.npz"
    write(path, recording)
    found = read(path)

    for name in ("channels", "units", "ranges", "rate_hz", "usual", "held_out"):
        assert getattr(found, name) == getattr(recording, name)
    for was, now in zip(recording.episodes, found.episodes, strict=True):
        assert now.name == was.name
        for field in ("times", "values", "observed"):
            np.testing.assert_array_equal(getattr(now, field), getattr(was, field))


def test_files_from_before_episodes_were_held_out_are_read(recording, tmp_path):
    path = tmp_path / "out.npz"
    write(path, recording)
    arrays = dict(np.load(path))
    arrays["metadata"] = np.array(str(arrays["metadata"]).replace('"held_out":[],', ""))
    np.savez(path, **arrays)

    assert read(path).held_out == ()


def test_the_same_content_is_the_same_bytes(recording, tmp_path):
    for name in ("a.npz", "b.npz"):
        write(tmp_path / name, recording)

    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()


@pytest.mark.parametrize(
    ("was", "now", "match"),
    [
        ('"version":1', '"version":2', "in format version 2, this motionese reads version 1; a ne"),
        ("motionese-motions", "motionese-emotion", "but not of motions that motionese wrote"),
        ('"rate_hz":25.0', '"rate_hz":"fast"', "its metadata are damaged: rate_hz: "),
        ("[-4.0,4.5]", "[4.5,4.5]", "channel 'shoulder' has no range from 4.5 to 4.5"),
        ('"rate_hz":25.0', '"rate_hz":0.0', "a rate must be finite and > 0, got 0.0"),
        ('"ranges":{"shoulder"', '"ranges":{"elbow"', "there is no channel 'elbow'"),
        ('"rad","cm"', '"cm"', "3 channels need as many units, got"),
    ],
)
def test_metadata_that_are_wrong_are_refused(recording, tmp_path, was, now, match):
    path = tmp_path / "out.npz"
    write(path, recording)
    arrays = dict(np.load(path))
    arrays["metadata"] = np.array(str(arrays["metadata"]).replace(was, now))
    np.savez(path, **arrays)

    with pytest.raises(RecordingError, match=match):
        read(path)


def test_a_file_that_is_cut_short_or_foreign_is_refused(recording, tmp_path):
    path = tmp_path / "out.npz"
    write(path, recording)
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(RecordingError, match=r"out\.npz: not a whole archive of arrays"):
        read(path)
    path.write_bytes(b"PK\x03\x04")
    with warnings.catch_warnings(record=True) as left_open:
        warnings.simplefilter("always")
        with pytest.raises(RecordingError, match=r"out\.npz: not a whole archive of arrays"):
            read(path)
        gc.collect()
    assert not left_open
    np.savez(path, joints=np.zeros((3, 0)))
    with pytest.raises(RecordingError, match=r"no array in it holds rows .* \(joints \(3, 0\)\)"):
        read(path)


@pytest.mark.parametrize(
    ("name", "array", "match"),
    [
        (
            "values_0",
            np.zeros((7, 2)),
            r"values of episode 'UR ↓' should be float64 .* \(7, 3",
        ),
        ("values_1", np.zeros((4, 3), np.float32), "values .* should be float64 .* got float32"),
        ("observed_0", np.ones((6, 3), bool), "the mask of episode 'UR ↓' should be bool of shape"),
        ("times_1", np.zeros((3,)), r"the times of episode .* should be float64 of shape \(4,\)"),
    ],
)
def test_arrays_that_do_not_fit_are_refused(recording, tmp_path, name, array, match):
    path = tmp_path / "out.npz"
    write(path, recording)
    np.savez(path, **{**np.load(path), name: array})

    with pytest.raises(RecordingError, match=match):
        read(path)
