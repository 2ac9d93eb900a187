"""A session in one file: packed, opened again, and refused where it is not what it should be."""

import io
import json
import zipfile

import numpy as np
import pytest

from motionese.errors import StorageError
from motionese.teaching import packed_session
from motionese.teaching.packed_session import MANIFEST, pack, unpack
from motionese.teaching.school import School, exchange, read_school
from motionese.teaching.session_contents import contents, settle
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture
def school(scene, tmp_path, draw):
    """A session with two robots, the second of which was shown something and is taught."""
    folder = SessionFolder(tmp_path / "session")
    school = School(folder, folder.begin("fresh", scene))
    second = school.begin("fresh", "never", "Robot Two")
    second.teaching.show(draw("UR ↓"), "drawn")
    second.teaching.imitate()
    second.folder.save(second.teaching)
    return school


@pytest.fixture
def packed(school, tmp_path):
    """The file of a session."""
    file = tmp_path / "shared.motionese"
    file.write_bytes(pack(school.home))
    return file


def test_a_session_is_the_same_after_a_journey(school, packed, tmp_path):
    unpack(packed, tmp_path / "elsewhere")
    assert contents(tmp_path / "elsewhere") == contents(school.home)
    for name in contents(school.home):
        assert (tmp_path / "elsewhere" / name).read_bytes() == (school.home / name).read_bytes()
    again = read_school(tmp_path / "elsewhere")
    assert [p.folder.name for p in again.pupils] == ["Robot 1", "Robot Two"]
    assert again.taught.folder.name == "Robot Two" and not again.taught.teaching.can_grow
    (entry,) = again.taught.teaching.notebook.entries
    assert entry.motion == "UR ↓" and entry.tried is not None


def test_what_was_put_away_and_what_is_hidden_stays_at_home(school):
    school.begin("fresh", "told", away=school.pupils[1])
    (school.home / ".lock").touch()
    (school.home / "notes.txt").write_text("mine")
    names = zipfile.ZipFile(io.BytesIO(pack(school.home))).namelist()
    assert sorted(names) == sorted(contents(school.home))
    assert not [name for name in names if "earlier" in name or name.endswith(("lock", "txt"))]


def test_a_session_of_one_robot_needs_no_manifest_of_its_own(scene, tmp_path):
    folder = SessionFolder(tmp_path / "session")
    folder.begin("fresh", scene)
    file = tmp_path / "one.motionese"
    file.write_bytes(pack(folder.path))
    unpack(file, tmp_path / "two")
    assert len(read_school(tmp_path / "two").pupils) == 1
    with pytest.raises(StorageError, match="no session to be packed"):
        pack(tmp_path / "nowhere")


def test_a_session_that_is_written_to_is_packed_as_it_was_at_one_moment(school, monkeypatch):
    own, moments = packed_session.contents, []

    def written_meanwhile(folder):
        if len(moments) < 2:
            moments.append(own(folder))
            learner = next((folder / "robot-2").glob("learner-*"))
            learner.rename(learner.with_name(f"learner-0000{len(moments) + 1}.safetensors"))
            return moments[-1]
        return own(folder)

    monkeypatch.setattr(packed_session, "contents", written_meanwhile)
    names = zipfile.ZipFile(io.BytesIO(pack(school.home))).namelist()
    assert len(moments) == 2 and "robot-2/learner-00003.safetensors" in names


def rezipped(packed, change):
    """Pack a session's files again, changed."""
    with zipfile.ZipFile(packed) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    change(files)
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)


@pytest.mark.parametrize(
    "name",
    [
        *("../evil.npz", "/tmp/evil.npz", "robot-2/../../evil.npz", "earlier-01/session.json"),
        *("robot-4/session.json", "robot-2/", "a\\..\\..\\evil.npz", ".lock", "page.html"),
    ],
)
def test_a_name_that_no_session_has_is_refused_and_nothing_written(packed, tmp_path, name):
    rezipped(packed, lambda files: files.update({name: b""}))
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(StorageError, match="is no file of a session"):
        unpack(packed, tmp_path / "elsewhere")
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda files: files.pop("session.json"), "no session that motionese has packed"),
        (lambda files: files.pop(MANIFEST), "no session that motionese has packed"),
        (lambda files: files.update({MANIFEST: b"{"}), "not written by motionese"),
        (
            lambda files: files.update(
                {MANIFEST: json.dumps({"format": "motionese-school", "version": 9, "taught": ""})}
            ),
            "format 9, this version of motionese reads 1",
        ),
    ],
)
def test_what_is_no_session_or_of_a_newer_kind_is_told(packed, tmp_path, change, said):
    rezipped(packed, change)
    with pytest.raises(StorageError, match=said):
        unpack(packed, tmp_path / "elsewhere")
    assert not (tmp_path / "elsewhere").exists()


def test_what_would_unpack_to_more_than_a_session_is_refused(packed, tmp_path, monkeypatch):
    with zipfile.ZipFile(packed, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("shown-0009.npz", bytes(2**20))
    assert packed.stat().st_size < 2**20
    monkeypatch.setattr(packed_session, "MOST_UNPACKED", 2**20)
    with pytest.raises(StorageError, match="more than a session can be"):
        unpack(packed, tmp_path / "elsewhere")
    monkeypatch.setattr(packed_session, "MOST_PACKED", 2**10)
    with pytest.raises(StorageError, match="larger than"):
        unpack(packed, tmp_path / "elsewhere")
    with pytest.raises(StorageError, match="larger than"):
        pack(tmp_path / "session")
    assert not (tmp_path / "elsewhere").exists()


@pytest.mark.parametrize("damage", ["cut", "flipped", "text", "empty", "twice"])
def test_a_damaged_file_is_told_in_a_sentence(packed, tmp_path, damage):
    content = packed.read_bytes()
    middle = len(content) // 2
    damaged = {
        "cut": content[:middle],
        "flipped": content[:middle]
        + bytes(b ^ 255 for b in content[middle : middle + 64])
        + content[middle + 64 :],
        "text": b"not a session",
        "empty": b"",
        "twice": content,
    }[damage]
    packed.write_bytes(damaged)
    if damage == "twice":
        with (
            pytest.warns(UserWarning, match="Duplicate"),
            zipfile.ZipFile(packed, "a") as archive,
        ):
            archive.writestr("session.json", "{}")
    with pytest.raises(StorageError, match=r"shared\.motionese"):
        unpack(packed, tmp_path / "elsewhere")


def test_what_was_opened_takes_the_place_of_what_was_there_and_that_is_put_away(
    scene, school, packed, draw, tmp_path
):
    folder = SessionFolder(tmp_path / "mine")
    mine = School(folder, folder.begin("fresh", scene))
    mine.taught.teaching.show(draw("LR ↑"), "drawn")
    folder.save(mine.taught.teaching)
    unpack(packed, tmp_path / "mine" / ".opened-1")
    now = exchange(mine, tmp_path / "mine" / ".opened-1")
    assert [p.folder.name for p in now.pupils] == ["Robot 1", "Robot Two"]
    assert contents(tmp_path / "mine") == contents(school.home)
    before = read_school(tmp_path / "mine" / "earlier-01")
    assert before.taught.teaching.notebook.entries[0].motion == "LR ↑"
    left = {path.name for path in (tmp_path / "mine").iterdir() if path.name.startswith(".")}
    assert left == set()


def test_what_cannot_be_read_changes_nothing(school, packed, tmp_path):
    rezipped(packed, lambda files: files.pop("robot-2/shown-0001.npz"))
    before = {name: (school.home / name).read_bytes() for name in contents(school.home)}
    unpack(packed, school.home / ".opened-1")
    with pytest.raises(
        StorageError, match=r"session cannot be opened: robot-2/shown-0001\.npz cannot be read"
    ):
        exchange(school, school.home / ".opened-1")
    after = {name: (school.home / name).read_bytes() for name in contents(school.home)}
    assert after == before and not list(school.home.glob("earlier-*"))


@pytest.mark.parametrize("killed_after", [0, 1, 3, 6])
def test_a_kill_while_one_takes_the_place_of_the_other_is_made_good(
    scene, packed, tmp_path, monkeypatch, killed_after
):
    folder = SessionFolder(tmp_path / "mine")
    mine = School(folder, folder.begin("fresh", scene))
    unpack(packed, tmp_path / "mine" / ".opened-1")
    copied, copy = [], packed_session.shutil.copyfile

    def killed(source, target):
        if ".replacing" in str(source):
            if len(copied) == killed_after:
                raise KeyboardInterrupt
            copied.append(target)
        return copy(source, target)

    monkeypatch.setattr("motionese.teaching.session_contents.shutil.copyfile", killed)
    with pytest.raises(KeyboardInterrupt):
        exchange(mine, tmp_path / "mine" / ".opened-1")
    monkeypatch.undo()
    settle(tmp_path / "mine")
    again = read_school(tmp_path / "mine")
    assert [p.folder.name for p in again.pupils] == ["Robot 1", "Robot Two"]
    np.testing.assert_array_equal(
        again.pupils[0].teaching.learner.network.weights,
        mine.pupils[0].teaching.learner.network.weights,
    )
    assert {path.name for path in (tmp_path / "mine").glob(".*")} == set()
