"""What a person has shown goes into files and from there into the experiment."""

import numpy as np
import pytest

from motionese.caregiver import PUSHING_BUTTONS
from motionese.errors import MotioneseError
from motionese.experiment.keys import generator_for
from motionese.recordings import Choice, Episode, Recording, prepare, read, write
from motionese.teaching.demonstrations import CHANNELS, recorded, recording_of
from motionese.teaching.notebook import Entry


@pytest.fixture
def entries(draw):
    def entry(number, name, **how):
        demonstration = draw(name, seed=number, **how)
        return Entry(number, name, "drawn", demonstration.drawn, demonstration.path)

    scribble = draw("UR ↓")
    return [
        entry(1, "UR ↓", seconds=2.0),
        entry(2, "UR ↓"),
        entry(3, "LR ↑←"),
        Entry(4, "UR ?", "webcam", scribble.drawn, scribble.path),
    ]


def written(path, episodes, channels=CHANNELS, rate_hz=10.0):
    made = tuple(Episode(n, None, v, np.ones(v.shape, dtype=bool)) for n, v in episodes)
    write(path, Recording(path, channels, ("m",) * len(channels), {}, rate_hz, made, channels))


def test_every_entry_is_an_episode_in_its_own_time(entries, tmp_path):
    write(tmp_path / "d.npz", recording_of(entries, 10.0))
    found = prepare(read(tmp_path / "d.npz"), Choice())
    assert [e.name for e in found.episodes] == ["UR ↓", "UR ↓ (2)", "LR ↑←", "UR ?"]
    assert found.channels == CHANNELS and found.units == ("m",) * 3
    np.testing.assert_array_equal(found.episodes[0].values, entries[0].drawn)
    assert recording_of([], 10.0) is None


def test_the_recorded_caregiver_shows_them_at_its_tempo(entries, scene, tmp_path):
    write(tmp_path / "demonstrations.npz", recording_of(entries, 10.0))
    manner = scene.settings.caregiver
    found = recorded(tmp_path, manner, 10.0)
    assert found.motions == ("UR ↓", "LR ↑←")
    for name in ("UR ↓", "LR ↑←", "UL ↓↑↓"):
        motion = PUSHING_BUTTONS.motion(name)
        shown = found.caregiver.demonstrate(motion, generator_for(0, name))
        assert shown.shape == (manner.rows(motion), 3)
        assert np.linalg.norm(shown[-1] - manner.corner(motion.corners[-1])) < 0.03
    assert len(found.caregiver.recordings["UR ↓"]) == 2
    again = recorded(tmp_path / "demonstrations.npz", manner, 10.0)
    assert again.digest == found.digest
    write(tmp_path / "demonstrations.npz", recording_of(entries[1:], 10.0))
    assert recorded(tmp_path, manner, 10.0).digest != found.digest


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda e: [("UR ←", e[0].drawn)], "'UR ←' shows UR ↓"),
        (lambda e: [("wave", e[0].drawn)], "no episode is named by a motion"),
        (lambda e: [("UR ↓", e[0].drawn + 0.2)], "cm from what the robot's hand reaches"),
        (lambda e: [("UR ↓", np.full((5, 3), np.nan))], "finite|NaN"),
    ],
)
def test_what_cannot_be_shown_is_refused(entries, scene, tmp_path, change, said):
    written(tmp_path / "d.npz", change(entries))
    with pytest.raises(MotioneseError, match=said):
        recorded(tmp_path / "d.npz", scene.settings.caregiver, 10.0)


def test_other_channels_are_refused(entries, scene, tmp_path):
    written(tmp_path / "d.npz", [("UR ↓", entries[0].drawn)], channels=("x", "y", "z"))
    with pytest.raises(MotioneseError, match="hand_x"):
        recorded(tmp_path / "d.npz", scene.settings.caregiver, 10.0)
