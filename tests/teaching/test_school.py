"""Up to three robots in one session: begun, named, compared, put away, found again after a kill."""

import numpy as np
import pytest

from motionese.errors import MotioneseError, StorageError
from motionese.imitation import newborn
from motionese.teaching.school import NoPlaceError, School, lessons_left, read_school
from motionese.teaching.session_folder import SessionFolder


def nothing(*progress):
    """Be told, and do nothing."""


@pytest.fixture
def school(scene, tmp_path):
    """A session with one robot that knows nothing."""
    folder = SessionFolder(tmp_path / "session")
    return School(folder, folder.begin("fresh", scene))


def names_of(school):
    return [pupil.folder.name for pupil in school.pupils]


def test_three_robots_develop_as_they_were_begun(school):
    late, (early, never) = (
        school.pupils[0],
        (school.begin("fresh", grows) for grows in ("beginning", "never")),
    )
    assert names_of(school) == ["Robot 1", "Robot 2", "Robot 3"]
    levels = [len(p.teaching.learner.network.levels) for p in (late, early, never)]
    assert levels == [2, 3, 2]
    assert [p.teaching.can_grow for p in (late, early, never)] == [True, False, False]
    same = [np.asarray(p.teaching.learner.network.weights) for p in (late, never)]
    np.testing.assert_array_equal(*same)
    assert school.taught is never, "who has just begun is taught"
    with pytest.raises(NoPlaceError, match="3 robots are as many"):
        school.begin("fresh", "told")


@pytest.mark.slow
def test_every_robot_is_found_again_as_it_was(school, draw, kept):
    second = school.begin("fresh", "never", "  Lazy\tBones ")
    second.teaching.show(draw("UR ↓"), "drawn")
    second.teaching.learn(nothing)
    second.folder.save(second.teaching)
    school.teach(school.pupils[0])
    school.teach(second)
    again = read_school(school.home)
    assert names_of(again) == ["Robot 1", "Lazy Bones"]
    found = again.taught
    assert found.folder.id == second.folder.id and found.folder.grows == "never"
    assert not found.teaching.can_grow
    assert found.teaching.notebook.learned == second.teaching.notebook.learned
    assert found.teaching.scene is again.pupils[0].teaching.scene, "what is compiled is shared"
    assert again.pupils[0].teaching.notebook.entries == ()
    again.call(found, "Robot 7")
    again.call(found, " \n")
    assert names_of(read_school(school.home)) == ["Robot 1", "Robot 7"]


def test_one_is_put_away_for_another_and_can_be_opened_there(school, draw):
    first = school.pupils[0]
    first.teaching.show(draw("UR ↓"), "drawn")
    first.folder.save(first.teaching)
    other = school.begin("fresh", "never", "Never")
    other.teaching.show(draw("UR ←"), "drawn")
    other.folder.save(other.teaching)
    for away in (first, other):
        school.begin("fresh", "beginning", away=away)
    assert names_of(school) == ["Robot 1", "Robot 2"]
    assert {p.folder.grows for p in read_school(school.home).pupils} == {"beginning"}
    assert all(p.teaching.notebook.entries == () for p in read_school(school.home).pupils)
    earlier = [read_school(school.home / f"earlier-0{n}") for n in (1, 2)]
    assert [names_of(each) for each in earlier] == [["Robot 1"], ["Never"]], "each alone"
    assert [e.taught.teaching.notebook.entries[0].motion for e in earlier] == ["UR ↓", "UR ←"]
    assert not earlier[1].taught.teaching.can_grow


def test_the_command_that_began_a_session_goes_on_when_its_robot_was_put_away(scene, tmp_path):
    folder = SessionFolder(tmp_path)
    school = School(folder, folder.begin("runs/mine", scene, newborn(scene, 2)))
    school.begin("fresh", "told", away=school.pupils[0])
    assert SessionFolder(tmp_path).read("runs/mine").notebook.entries == ()
    with pytest.raises(StorageError, match="began from fresh, not from runs/other"):
        SessionFolder(tmp_path).read("runs/other")


@pytest.mark.slow
def test_all_try_the_same_motions_and_learning_makes_that_old(school, draw, kept):
    first, second = school.pupils[0], school.begin("fresh", "beginning")
    first.teaching.show(draw("UR ↓"), "drawn")
    second.teaching.show(draw("UR ←"), "drawn")
    assert first.results is None
    assert [*school.compare()] == [(done, 4) for done in (1, 2, 3, 4)]
    assert list(first.results) == list(second.results) == ["UR ↓", "UR ←"]
    assert first.results["UR ↓"].error_cm == first.teaching.imitate().error_cm
    assert first.results["UR ↓"].pushes and not first.results["UR ←"].pushes
    second.teaching.learn(nothing)
    assert first.results and second.results is None


@pytest.mark.slow
def test_lessons_of_another_robot_are_told_apart_by_what_was_shown(school, draw, kept):
    first, second = school.pupils[0].teaching, school.begin("fresh", "told").teaching
    for name in ("UR ↓", "UR ←"):
        first.show(draw(name), "drawn")
        first.learn(nothing)
    first.learn(nothing)
    first.show(draw("LR ↑"), "drawn")
    left = lessons_left(second.notebook, first.notebook)
    assert [entry.motion for entry in left] == ["UR ↓", "UR ←", "UR ←"]
    shown = left[1]
    second.show(shown.demonstration.path, shown.source, shown.drawn)
    second.learn(nothing)
    left = lessons_left(second.notebook, first.notebook)
    assert [entry.motion for entry in left] == ["UR ↓", "UR ←"]
    assert lessons_left(first.notebook, second.notebook) == []


def test_a_robot_that_was_half_begun_when_its_process_was_killed_leaves_nothing(school):
    for name in ("learner-00001.safetensors", "shown-0001.npz"):
        (school.home / "robot-2").mkdir(exist_ok=True)
        (school.home / "robot-2" / name).write_bytes(b"of a robot that was not finished")
    assert len(read_school(school.home).pupils) == 1
    begun = school.begin("fresh", "told")
    assert [p.folder.path.name for p in read_school(school.home).pupils] == ["session", "robot-2"]
    files = {file.name for file in begun.folder.path.iterdir()}
    assert files == {"session.json", "learner-00001.safetensors"}


def test_a_kill_while_one_is_put_away_leaves_it_as_it_was(school, draw, kept, monkeypatch):
    first = school.pupils[0]
    for _ in range(2):
        first.teaching.show(draw("UR ↓"), "drawn")
        first.teaching.learn(nothing)
        first.folder.save(first.teaching)

    def killed(*written):
        raise KeyboardInterrupt

    monkeypatch.setattr("motionese.teaching.session_folder.write_whole", killed)
    with pytest.raises(KeyboardInterrupt):
        school.begin("fresh", "beginning", away=first)
    monkeypatch.undo()
    again = read_school(school.home).taught
    assert again.teaching.notebook.learned == first.teaching.notebook.learned
    weights = np.asarray(first.teaching.learner.network.weights)
    np.testing.assert_array_equal(again.teaching.learner.network.weights, weights)
    before = [again.folder.learner(each.before) for each in first.teaching.notebook.learned]
    assert [len(learner.network.levels) for learner in before] == [2, 2], "undo finds its own"


def test_a_robot_that_is_not_there_or_not_whole_is_told(school):
    with pytest.raises(MotioneseError, match="not in the session"):
        school.pupil("nobody")
    second = school.begin("fresh", "told")
    (second.folder.path / "session.json").write_text('{"format": "motionese-teaching"}')
    with pytest.raises(StorageError, match="robot-2"):
        read_school(school.home)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ('{"format": "motionese-school", "version": 2, "taught": ""}', "format 2.*reads 1"),
        ("[]", "was not written by motionese"),
    ],
)
def test_what_says_who_is_taught_is_refused_where_it_is_of_another_kind(school, content, said):
    (school.home / "school.json").write_text(content)
    with pytest.raises(StorageError, match=said):
        read_school(school.home)
