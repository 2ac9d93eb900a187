"""How a person shows a motion, beside the scripted caregiver, and the wish for a pause."""

import json

import numpy as np
import pytest
from drawn import view

from motionese.imitation import Scene
from motionese.interfaces.page.descriptions import session_message, verdict_message
from motionese.kinematics import MEASURES, measure
from motionese.teaching.drawing import at_tempo
from motionese.teaching.session import Teaching
from motionese.teaching.session_folder import SessionFolder
from motionese.teaching.shown_manner import ADULT, MOTIONESE, YOU

PAIR = "UR ←↓"
PAUSED, HURRIED = (0.6, 0.61), (0.0, 0.01)


@pytest.fixture
def show(draw_in_time, scene):
    """Show a motion to a robot with rests of so many seconds, as it goes in time."""

    def shown(teaching, name, rests, source="drawn"):
        drawn = draw_in_time(name, rests=rests)
        return teaching.show(at_tempo(drawn, scene.task, scene.settings.caregiver), source, drawn)

    return shown


def told_of(teaching):
    """What the page is told, as it goes through the wire: no number that JSON does not know."""
    message = session_message(teaching, view(), "id", "fresh", "")
    return json.loads(json.dumps(message, allow_nan=False))["manner"]


def test_a_drawing_is_measured_as_it_went_in_time(teaching, show, scene):
    observed = show(teaching, PAIR, PAUSED)
    own = observed.manner.measures[YOU]
    assert own.numbers() == measure(observed.entry.drawn, scene.body.rate_hz).numbers()
    assert own.pause_count == 1 and own.pause == pytest.approx(0.6, abs=0.1)
    told = told_of(teaching)
    assert told["motion"] == PAIR and list(told["measures"]) == [YOU, ADULT, MOTIONESE]
    assert told["measures"][YOU]["pace"] == pytest.approx(own.pace, abs=0.01)


def test_the_caregiver_shows_as_to_an_adult_and_with_motionese(teaching, show, scene):
    theirs = show(teaching, PAIR, PAUSED).manner.measures
    adult, motionese = theirs[ADULT], theirs[MOTIONESE]
    manner, rate_hz = scene.settings.caregiver, scene.body.rate_hz
    assert not manner.motionese.emphasises, "so that all of it stands for it"
    assert adult.pause_count == motionese.pause_count == 1
    assert adult.pause == pytest.approx(manner.rest_steps / rate_hz, rel=0.1)
    assert adult.roundness == pytest.approx(1.0, abs=0.02)
    assert motionese.pause > 3 * adult.pause and motionese.roundness > 1.3
    assert motionese.duration > 1.5 * adult.duration


def test_a_session_s_own_motionese_is_what_is_shown(scene, fresh, show):
    wanted = {"pauses": {"strength": 0.5, "steps": 8, "course": "error"}}
    caregiver = scene.settings.caregiver
    emphatic = caregiver.model_validate({**caregiver.model_dump(), "motionese": wanted})
    other = Scene(scene.settings.model_copy(update={"caregiver": emphatic}), 0)
    theirs = show(Teaching(other, fresh), PAIR, PAUSED).manner.measures
    assert theirs[MOTIONESE].pause == pytest.approx(0.2 + 0.4, rel=0.05)
    assert theirs[MOTIONESE].roundness == pytest.approx(theirs[ADULT].roundness, abs=0.02)


def test_what_is_undefined_is_said_to_be_and_not_zero(teaching, show):
    observed = show(teaching, PAIR, HURRIED)
    assert np.isnan(observed.manner.measures[YOU].pace)
    own = told_of(teaching)["measures"][YOU]
    assert own["pace"] is None and own["pause"] is None and own["pause_count"] == 0
    assert own["undefined"]["pace"] == "no pause between movements"
    teaching.standing = Teaching(teaching.scene, teaching.learner).standing
    assert told_of(teaching) is None, "nothing was shown"


def test_who_shows_decides_what_stands_beside_what(teaching, scene, show):
    by_itself = show(teaching, PAIR, HURRIED, "scripted")
    assert list(by_itself.manner.measures) == [ADULT, MOTIONESE]
    assert by_itself.manner.corners == () and not by_itself.verdict.wish
    ends = np.array([scene.task.position(place) for place in ("UR", "LL")])
    share = np.linspace(0, 1, 20)[:, None]
    own = teaching.show(scene.body.reachable(ends[0] + share * (ends[1] - ends[0])), "webcam")
    assert own.verdict.sequence is None and list(own.manner.measures) == [YOU]
    assert own.manner.corners == () and not own.verdict.wish


@pytest.mark.parametrize("source", ["drawn", "webcam"])
def test_the_robot_wishes_for_a_pause_until_it_has_seen_one(teaching, show, source):
    wished = show(teaching, PAIR, HURRIED, source).verdict
    assert wished.wish.startswith("Pause at the corner UL, please")
    assert wished.line == f"{wished.saw} {wished.wish}"
    assert wished.sentence == f"{wished.line} {wished.claim.sentence}", "all of it is spoken"
    heard = show(teaching, PAIR, PAUSED, source).verdict
    assert not heard.wish and heard.saw.endswith("I saw you pause at UL.")
    assert heard.line == heard.sentence == f"{heard.saw} {heard.claim.sentence}"
    single = show(teaching, "UR ↓", HURRIED, source).verdict
    assert not single.wish and "pause" not in single.sentence
    assert teaching.look_back(1).verdict.wish == wished.wish


def test_the_page_is_told_the_line(teaching, show):
    observed = show(teaching, PAIR, HURRIED)
    told = verdict_message(observed, view(), 0.0)
    assert (told["line"], told["sentence"]) == (observed.verdict.line, observed.verdict.sentence)


def test_a_session_that_is_opened_again_shows_the_same(tmp_path, scene, show):
    folder = SessionFolder(tmp_path / "session")
    teaching = folder.begin("fresh", scene)
    before = show(teaching, PAIR, PAUSED).manner
    folder.save(teaching)
    after = SessionFolder(folder.path).read(scene=scene).look_back(1).manner
    assert after.corners == before.corners
    for who, measures in before.measures.items():
        for name in MEASURES:
            was, now = getattr(measures, name), getattr(after.measures[who], name)
            assert now == pytest.approx(was, nan_ok=True)
