"""Which format it is, and what holds for all of them."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.errors import RecordingError, SettingError
from motionese.recordings import FORMATS, read, write


@pytest.mark.parametrize("name", [name for name, known in FORMATS.items() if known.written])
def test_every_format_holds_values_units_and_names_that_it_has_a_place_for(whole, tmp_path, name):
    path = tmp_path / ("out" if name == "mcap" else f"out{next(iter(FORMATS[name].suffixes), '')}")
    write(path, whole, name)
    found = read(path)

    single = name in ("eipl", "lerobot")
    assert len(found.episodes) == 2
    if name not in ("eipl", "npy"):
        assert set(found.channels) >= set(whole.channels)
        assert found.rate_hz == 25.0 or found.episodes[0].times is not None
    for was, now in zip(whole.episodes, found.episodes, strict=True):
        columns = [found.channels.index(c) for c in found.usual]
        expected = was.values.astype(np.float32) if single else was.values
        np.testing.assert_array_equal(now.values[:, columns], expected)
        assert now.observed[:, columns].all()


@pytest.mark.parametrize("name", ["csv", "npz", "mcap"])
def test_gaps_are_held(recording, tmp_path, name):
    path = tmp_path / "out"
    write(path, recording, name)
    found = read(path, name)

    columns = [found.channels.index(c) for c in recording.channels]
    for was, now in zip(recording.episodes, found.episodes, strict=True):
        np.testing.assert_array_equal(now.observed[:, columns], was.observed)
        np.testing.assert_array_equal(
            now.values[:, columns][was.observed], was.values[was.observed]
        )


@pytest.mark.parametrize("name", ["eipl", "lerobot", "robomimic", "npy"])
def test_where_gaps_cannot_be_held_nothing_is_written(recording, tmp_path, name):
    with pytest.raises(RecordingError, match="cannot hold gaps; csv, npz and mcap can"):
        write(tmp_path / "out", recording, name)

    assert not list(tmp_path.iterdir())


def test_what_is_not_there_or_of_no_format_is_refused(tmp_path):
    with pytest.raises(RecordingError, match=r"away\.csv: there is no such file or folder"):
        read(tmp_path / "away.csv")
    (tmp_path / "notes.doc").write_text("hello")
    with pytest.raises(RecordingError, match=r"notes\.doc: not a recording .*: motionese's own .n"):
        read(tmp_path / "notes.doc")
    with pytest.raises(RecordingError, match=r"not a recording that is read here"):
        read(tmp_path)
    with pytest.raises(RecordingError, match="cannot be read: File name too long"):
        read(tmp_path / ("x" * 300 + ".csv"))


def test_a_format_that_is_unknown_or_not_told_is_refused(whole, tmp_path):
    with pytest.raises(SettingError, match=r"unknown format 'lerobt'; did you mean 'lerobot'\?"):
        write(tmp_path / "out", whole, "lerobt")
    with pytest.raises(SettingError, match=r"out: its name does not tell the format; end it in"):
        write(tmp_path / "out", whole)
    write(tmp_path / "out.npz", whole)
    with pytest.raises(SettingError, match="episode is the column that names the episode, of csv"):
        read(tmp_path / "out.npz", episode="id")


def test_names_that_are_doubled_or_no_text_are_refused(whole, tmp_path):
    a, b = whole.episodes
    with pytest.raises(RecordingError, match="episode names must be unique; doubled: UR ↓"):
        write(tmp_path / "out.npz", replace(whole, episodes=(a, a, b)))
    with pytest.raises(RecordingError, match=r"a channel is called 'x\\udcff'; names are text"):
        write(tmp_path / "out.csv", replace(whole, channels=("x\udcff", "y", "z")))


def test_a_folder_that_cannot_be_written_is_refused(whole, tmp_path):
    with pytest.raises(RecordingError, match="cannot be written: No such file or directory"):
        write(tmp_path / "away" / "out.csv", whole)
