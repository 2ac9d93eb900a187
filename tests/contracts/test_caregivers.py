"""What every caregiver promises: scripted, recorded, and recorded where there is a recording."""

import numpy as np
import pytest

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.caregiver import Caregiver, Manner, RecordedCaregiver, ScriptedCaregiver
from motionese.errors import TaskError
from motionese.task import PUSHING_BUTTONS

MANNER = Manner(stroke_steps=12, rest_steps=2, variability_mm=3.0, persistence=0.9)
SEQUENCES = [s for length in (1, 2) for s in PUSHING_BUTTONS.sequences(length)]


def scripted():
    body = open_body(ActroidSettings(), PUSHING_BUTTONS)
    return ScriptedCaregiver(PUSHING_BUTTONS, MANNER, body)


def recorded():
    rng = np.random.default_rng(9)
    shows = scripted()
    return RecordedCaregiver({s.name: [shows.demonstrate(s, rng)] * 2 for s in SEQUENCES})


def recorded_or_scripted():
    first = SEQUENCES[0].name
    return RecordedCaregiver({first: recorded().recordings[first]}, scripted())


CAREGIVERS = {each.__name__: each for each in (scripted, recorded, recorded_or_scripted)}


@pytest.fixture(scope="module", params=CAREGIVERS.values(), ids=CAREGIVERS)
def caregiver(request):
    return request.param()


def test_it_fills_the_protocol(caregiver):
    assert isinstance(caregiver, Caregiver)


@pytest.mark.parametrize("sequence", SEQUENCES, ids=lambda s: s.name)
def test_a_demonstration_goes_from_place_to_place(caregiver, sequence):
    shown = caregiver.demonstrate(sequence, np.random.default_rng(0))
    assert len(shown.begins) == len(sequence.primitives) and shown.begins[0] == 0
    rows = [*shown.begins, len(shown.path) - 1]
    for row, place in zip(rows, sequence.places, strict=True):
        assert np.linalg.norm(shown.path[row] - PUSHING_BUTTONS.position(place)) < 0.03


def test_the_same_generator_gives_the_same_demonstration(caregiver):
    one, same = (caregiver.demonstrate(SEQUENCES[0], np.random.default_rng(1)) for _ in range(2))
    assert np.array_equal(one.path, same.path) and one.begins == same.begins


def test_recordings_are_drawn_from_and_a_missing_one_is_told():
    shown = recorded().recordings["UR ↓↑"][0]
    others = [type(shown)(np.full((20, 3), float(i)), (0, 10)) for i in range(3)]
    caregiver = RecordedCaregiver({"UR ↓↑": others})
    rng, pair = np.random.default_rng(0), PUSHING_BUTTONS.sequence("UR ↓↑")
    assert {float(caregiver.demonstrate(pair, rng).path[0, 0]) for _ in range(50)} == {0, 1, 2}
    with pytest.raises(TaskError, match="unknown recorded sequence 'UR ↓'"):
        caregiver.demonstrate(PUSHING_BUTTONS.sequence("UR ↓"), rng)
