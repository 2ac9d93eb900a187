"""`motionese teach --session FILE`: a session that comes as one file."""

import pytest

from motionese.errors import SettingError, StorageError
from motionese.imitation import Scene
from motionese.interfaces.commands.shared_session import session_folder
from motionese.teaching.packed_session import pack
from motionese.teaching.school import read_school
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture
def file(tmp_path, small_settings):
    """A packed session."""
    folder = SessionFolder(tmp_path / "of another")
    folder.begin("fresh", Scene(small_settings, 0))
    file = tmp_path / "robot-school.motionese"
    file.write_bytes(pack(folder.path))
    return file


def test_a_file_is_unpacked_beside_itself_or_where_it_is_said(file, tmp_path):
    assert session_folder(file, None) == tmp_path / "robot-school"
    assert session_folder(file, tmp_path / "new" / "place") == tmp_path / "new" / "place"
    for folder in (tmp_path / "robot-school", tmp_path / "new" / "place"):
        assert read_school(folder).taught.folder.began == "fresh"
    assert not list(tmp_path.rglob(".*"))
    with pytest.raises(StorageError, match="is there already: go on with --session"):
        session_folder(file, None)


def test_a_folder_is_taken_as_it_is(tmp_path):
    for folder in (tmp_path, tmp_path / "new"):
        assert session_folder(folder, None) == folder
        with pytest.raises(SettingError, match="--into"):
            session_folder(folder, tmp_path / "other")


def test_a_file_that_is_no_session_leaves_nothing(file, tmp_path):
    with pytest.raises(StorageError, match="no such file"):
        session_folder(tmp_path / "nowhere.motionese", None)
    (tmp_path / "text").write_text("mine")
    with pytest.raises(StorageError, match="is no session"):
        session_folder(tmp_path / "text", None)
    (tmp_path / "of another" / "session.json").write_text('{"format": "motionese-teaching"}')
    file.write_bytes(pack(tmp_path / "of another"))
    with pytest.raises(StorageError, match=r"robot-school\.motionese cannot be opened: session"):
        session_folder(file, None)
    assert {path.name for path in tmp_path.iterdir()} == {"of another", file.name, "text"}


def test_the_command_says_it_in_one_line(begin, tmp_path):
    (tmp_path / "text").write_text("mine")
    process = begin("teach", "--no-browser", "--session", str(tmp_path / "text"))
    assert process.wait(30) == 2
    errors = process.stderr.read()
    assert "is no session" in errors and errors.count("\n") == 1
