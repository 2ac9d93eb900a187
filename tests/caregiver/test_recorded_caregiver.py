"""What a person has shown goes into files and from there into the experiment."""

import numpy as np
import pytest

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.caregiver import (
    DEMONSTRATIONS,
    Manner,
    RecordedCaregiver,
    ScriptedCaregiver,
    lasting,
    read_recorded,
    recording_of,
)
from motionese.errors import MotioneseError, TaskError
from motionese.recordings import Choice, Episode, Recording, prepare, read, write
from motionese.task import PUSHING_BUTTONS, SHAPES

MANNER = Manner(stroke_steps=12, rest_steps=2, variability_mm=3.0, persistence=0.9)
CHANNELS = ("hand_x", "hand_y", "hand_z")
DIAGONAL = lasting(np.stack([PUSHING_BUTTONS.position(name) for name in ("UR", "LL")]), 20)


class Shown:
    """A task at a robot, and hands that show it, faster or slower than the caregiver."""

    def __init__(self, task):
        self.task, self.body = task, open_body(ActroidSettings(), task)
        self.scripted = ScriptedCaregiver(task, MANNER, self.body)

    def path(self, name, slower=1.0, seed=0):
        sequence, rng = self.task.sequence(name), np.random.default_rng(seed)
        path = self.scripted.demonstrate(sequence, rng).path
        return lasting(path, round(slower * len(path)))

    def read(self, path):
        return read_recorded(path, self.task, MANNER, self.body)


@pytest.fixture(scope="module")
def buttons():
    return Shown(PUSHING_BUTTONS)


@pytest.fixture(scope="module")
def shapes():
    return Shown(SHAPES)


@pytest.fixture(scope="module")
def shown(buttons):
    return [
        ("UR ↓", buttons.path("UR ↓", slower=2.0)),
        ("UR ↓", buttons.path("UR ↓", slower=0.7, seed=1)),
        ("LR ↑←", buttons.path("LR ↑←", slower=1.5)),
        ("UR ?", buttons.path("UR ↓↑", seed=2)),
    ]


def written(path, episodes, channels=CHANNELS):
    made = tuple(Episode(n, None, v, np.ones(v.shape, dtype=bool)) for n, v in episodes)
    write(path, Recording(path, channels, ("m",) * len(channels), {}, 10.0, made, channels))
    return path


def test_every_path_is_an_episode_in_its_own_time(shown, tmp_path):
    write(tmp_path / "d.npz", recording_of(shown, 10.0))
    found = prepare(read(tmp_path / "d.npz"), Choice())
    assert [e.name for e in found.episodes] == ["UR ↓", "UR ↓ (2)", "LR ↑←", "UR ?"]
    assert found.channels == CHANNELS and found.units == ("m",) * 3
    np.testing.assert_array_equal(found.episodes[0].values, shown[0][1])
    assert recording_of([], 10.0) is None


def test_they_are_shown_at_the_caregiver_s_tempo_and_the_rest_is_scripted(buttons, shown, tmp_path):
    write(tmp_path / DEMONSTRATIONS, recording_of(shown, 10.0))
    recordings = buttons.read(tmp_path).recordings
    assert {name: len(each) for name, each in recordings.items()} == {"UR ↓": 2, "LR ↑←": 1}
    caregiver = RecordedCaregiver(recordings, buttons.scripted)
    for name in ("UR ↓", "LR ↑←", "UL ↓↑↓"):
        sequence = PUSHING_BUTTONS.sequence(name)
        each = caregiver.demonstrate(sequence, np.random.default_rng(0))
        assert each.path.shape == (MANNER.rows(sequence), 3)
        end = PUSHING_BUTTONS.position(sequence.places[-1])
        assert np.linalg.norm(each.path[-1] - end) < 0.03
        assert each.begins == pytest.approx(MANNER.begins(sequence)[:-1], abs=3)
    with pytest.raises(TaskError, match="UL ↓↑↓"):
        RecordedCaregiver(recordings).demonstrate(sequence, np.random.default_rng(0))


def test_a_shape_of_arcs_is_divided_where_its_strokes_begin(shapes, tmp_path):
    paths = [(name, shapes.path(name, slower=1.3)) for name in ("T ◝◡◜", "T ↘←↗")]
    write(tmp_path / DEMONSTRATIONS, recording_of(paths, 10.0))
    recordings = shapes.read(tmp_path).recordings
    for name, (each,) in recordings.items():
        expected = MANNER.begins(SHAPES.sequence(name))[:-1]
        assert each.begins == pytest.approx(expected, abs=3)
    assert set(recordings) == {"T ◝◡◜", "T ↘←↗"}


def test_the_digest_tells_demonstrations_apart(buttons, shown, tmp_path):
    one = written(tmp_path / "one.npz", shown[:1])
    same = written(tmp_path / "same.npz", [*shown[:1], shown[3]])
    other = written(tmp_path / "other.npz", shown[1:])
    assert buttons.read(one).digest == buttons.read(same).digest != buttons.read(other).digest


@pytest.mark.parametrize(
    ("name", "aside", "said"),
    [
        ("UR ←", 0.0, "'UR ←' shows UR ↓"),
        ("UR ↓→", 0.0, "'UR ↓→' is named by no sequence of pushing_buttons"),
        ("UR ↓←", 0.0, "'UR ↓←' is named by no sequence"),
        ("your motion 1 (2)", 0.0, "'your motion 1 (2)' is named by no sequence"),
        ("UR ↓", 0.2, "cm from what the robot's hand reaches"),
        ("UR ↓", None, "'UR ↓' shows no sequence of pushing_buttons"),
    ],
)
def test_what_is_no_motion_of_the_task_is_skipped_and_told(
    buttons, shown, tmp_path, name, aside, said
):
    path = shown[0][1] + aside if aside is not None else buttons.body.reachable(DIAGONAL)
    alone = written(tmp_path / "alone.npz", [(name, path)])
    with pytest.raises(MotioneseError, match="no episode shows a sequence") as refused:
        buttons.read(alone)
    assert said in str(refused.value)
    among = buttons.read(written(tmp_path / "among.npz", [(name, path), shown[2]]))
    assert list(among.recordings) == ["LR ↑←"]
    assert len(among.skipped) == 1 and said in among.skipped[0]
    bare = buttons.read(written(tmp_path / "bare.npz", [shown[2]]))
    assert bare.digest == among.digest and not bare.skipped


def test_what_is_no_number_is_refused(buttons, tmp_path):
    with pytest.raises(MotioneseError, match=r"finite|NaN"):
        buttons.read(written(tmp_path / "d.npz", [("UR ↓", np.full((5, 3), np.nan))]))


def test_other_channels_are_refused(buttons, shown, tmp_path):
    file = written(tmp_path / "d.npz", shown[:1], channels=("x", "y", "z"))
    with pytest.raises(MotioneseError, match="hand_x"):
        buttons.read(file)
