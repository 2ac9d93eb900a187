"""What a caregiver emphasises: how far at which strength, how it fades, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.caregiver import Manner, Motionese, ScriptedCaregiver, check_reach
from motionese.caregiver.motionese import BOW, FURTHEST, exaggerated, rounded
from motionese.errors import SettingError
from motionese.experiment import read_settings
from motionese.imitation.segments import strokes_seen
from motionese.kinematics import measure
from motionese.minimum_jerk import minimum_jerk
from motionese.task import PUSHING_BUTTONS, SHAPES

PAIR, ACROSS = PUSHING_BUTTONS.sequence("UR ↓↑"), PUSHING_BUTTONS.sequence("UR ←↓")
STRENGTHS = ("pauses", "exaggeration", "slowness", "roundness", "repetition")


def manner(**strengths):
    motionese = {name: {"strength": strength} for name, strength in strengths.items()}
    return Manner(
        stroke_steps=12, rest_steps=2, variability_mm=0.0, persistence=0.9, motionese=motionese
    )


@pytest.fixture(scope="module")
def body():
    return open_body(ActroidSettings(), PUSHING_BUTTONS)


def shown(body, sequence, task=PUSHING_BUTTONS, **strengths):
    caregiver = ScriptedCaregiver(task, manner(**strengths), body)
    return caregiver.demonstrate(sequence, np.random.default_rng(0))


@pytest.mark.parametrize("course", ["constant", "loops", "error"])
def test_strengths_of_0_show_what_is_shown_without_motionese_to_the_bit(body, course):
    plain = Manner(stroke_steps=12, rest_steps=2, variability_mm=3.0, persistence=0.9)
    none = Motionese(**{name: {"strength": 0.0, "course": course} for name in STRENGTHS})
    for each in (plain.to_adults(), plain.model_copy(update={"motionese": none}).at(7, 3.0)):
        assert each.motionese.times_shown == 1 and not each.motionese.leaves_the_way
        for sequence in PUSHING_BUTTONS.sequences(2):
            paths = [
                ScriptedCaregiver(PUSHING_BUTTONS, m, body).demonstrate(
                    sequence, np.random.default_rng(3)
                )
                for m in (plain, each)
            ]
            assert paths[0].path.tobytes() == paths[1].path.tobytes()
            assert paths[0].begins == paths[1].begins


def test_a_pause_lies_between_primitives_and_belongs_to_the_one_before(body):
    for sequence in PUSHING_BUTTONS.sequences(3):
        found = shown(body, sequence, pauses=0.5)
        assert found.begins == (0, 18, 36) and len(found.path) == 50
        for place, row in zip(sequence.places[1:-1], found.begins[1:], strict=True):
            still = found.path[row - 6 : row + 1]
            np.testing.assert_allclose(
                still, np.tile(PUSHING_BUTTONS.position(place), (7, 1)), atol=1e-9
            )
    only = PUSHING_BUTTONS.sequences(1)[0]
    assert shown(body, only, pauses=1.0).path.tobytes() == shown(body, only).path.tobytes()


def test_what_must_be_remembered_is_held_for_the_pause_as_well():
    calm = manner(pauses=1.0)
    stroke = PUSHING_BUTTONS.sequence("LR ↑")
    assert (calm.rows(stroke), calm.rows_until_next(stroke)) == (14, 22)
    assert manner().rows_until_next(stroke) == 14


def test_strokes_are_slower(body):
    assert shown(body, PAIR, slowness=0.5).begins == (0, 20)
    slow, usual = (shown(body, PAIR, slowness=s).path for s in (1.0, 0.0))
    np.testing.assert_allclose(slow[2:25:2], usual[1:13], atol=1e-9)


@given(st.floats(0.01, 1.0))
def test_exaggeration_goes_so_far_and_bends_back_to_the_end(further):
    phase = np.linspace(0, 1, 4001)
    share = exaggerated(phase, further)
    assert share[0] == 0 and share[-1] == pytest.approx(1)
    assert share.max() == pytest.approx(1 + further, rel=1e-5)
    turn = int(share.argmax())
    assert (np.diff(share)[:turn] >= -1e-12).all() and (np.diff(share)[turn:] <= 1e-12).all()
    assert np.abs(np.diff(share)[[0, -1]]).max() < 1e-4


def test_weak_exaggeration_is_hardly_any():
    phase = np.linspace(0, 1, 101)
    np.testing.assert_allclose(exaggerated(phase, 1e-6), minimum_jerk(phase), atol=1e-4)


@pytest.mark.parametrize("strengths", [{"exaggeration": 1.0}, {"roundness": 1.0}, {"slowness": 1}])
def test_the_hand_still_comes_to_rest_in_every_place(body, strengths):
    for sequence in PUSHING_BUTTONS.sequences(2):
        found = shown(body, sequence, **strengths)
        ends = [*found.begins[1:], len(found.path) - 1]
        for place, row in zip(sequence.places[1:], ends, strict=True):
            end = PUSHING_BUTTONS.position(place)
            assert np.linalg.norm(found.path[row] - end) < 1e-6


def test_nothing_leads_below_a_button_or_beyond_the_reach(body):
    lowest = min(p.position[2] for p in PUSHING_BUTTONS.places.values())
    for sequence in PUSHING_BUTTONS.sequences(2):
        path = shown(body, sequence, exaggeration=1.0).path
        assert path[:, 2].min() > lowest - 1e-3
        np.testing.assert_allclose(body.reachable(path), path, atol=1e-9)
    highest = max(p.position[2] for p in PUSHING_BUTTONS.places.values())
    wound_up = shown(body, PUSHING_BUTTONS.sequence("UR ↓"), exaggeration=1.0).path
    assert wound_up[:, 2].max() > highest + 0.03, "it swings back first, where it may"


def test_rounder_and_straighter_are_what_they_say():
    share, ends = np.linspace(0, 1, 201), np.array([[0.0, 0, 0], [0.4, 0, 0]])
    outwards, way = np.array([0.0, 1, 0]), share[:, None] * ends[1]
    bowed = rounded(way, share, ends, outwards, 1.0)
    assert bowed[:, 1].max() == pytest.approx(BOW * 0.4)
    np.testing.assert_allclose(bowed[[0, -1]], ends, atol=1e-12)
    np.testing.assert_allclose(rounded(bowed, share, ends, outwards, -1.0), way, atol=1e-12)


def test_shapes_are_rounder_outwards_and_straighter_inwards():
    body = open_body(ActroidSettings(), SHAPES)
    middle = np.mean([p.position for p in SHAPES.places.values()], axis=0)

    def bows(name, roundness):
        path = shown(body, SHAPES.sequence(name), SHAPES, roundness=roundness).path
        return np.linalg.norm(path[6] - middle)

    for name in ("T ↘", "T ◝"):
        assert bows(name, 1.0) > bows(name, 0.0) + 0.02
    assert bows("T ◝", -1.0) == pytest.approx(bows("T ↘", 0.0), abs=2e-3)


def test_a_reader_of_pauses_sees_them_longer_and_the_way_wider(body):
    plain, emphatic = (
        measure(shown(body, ACROSS, **how).path, 10.0) for how in ({}, {"pauses": 1.0})
    )
    assert len(emphatic.pauses) == 1 and emphatic.pause > plain.pausing + 0.5
    slide = PUSHING_BUTTONS.sequence("UR ←")
    wide, usual = (measure(shown(body, slide, exaggeration=e).path, 10.0).range for e in (1, 0))
    assert wide == pytest.approx((1 + FURTHEST) * usual, rel=0.03)


def test_courses_lead_from_full_strength_to_nothing():
    motionese = Motionese(
        pauses={"strength": 1.0, "course": "loops", "steps": 8},
        slowness={"strength": 0.5, "course": "error"},
        roundness={"strength": -0.5, "course": "loops"},
        exaggeration={"strength": 0.7},
        fading_loops=(16, 30),
        fading_cm=(2.0, 6.0),
    )
    told = [motionese.at(loop, None) for loop in (1, 16, 23, 30, 60)]
    assert [m.pauses.rows for m in told] == [8, 8, 4, 0, 0]
    assert [m.roundness.strength for m in told] == [-0.5, -0.5, -0.25, 0, 0]
    assert {m.exaggeration.strength for m in told} == {0.7}
    left = [motionese.at(1, error).slowness.strength for error in (None, 9.0, 4.0, 2.0, 0.5)]
    assert left == [0.5, 0.5, 0.25, 0.0, 0.0]
    once = motionese.at(20, 3.0)
    assert once.at(29, 9.0) == once, "what is left does not fade again"


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("pauses.strength=1.5", r"pauses\.strength = 1\.5: .*less than or equal to 1"),
        ("pauses.strength=-1", r"pauses\.strength = -1: .*greater than or equal to 0"),
        ("pauses.steps=101", r"pauses\.steps = 101: .*less than or equal to 100"),
        ("roundness.strength=-1.1", r"roundness\.strength = -1\.1: .*greater than or equal to -1"),
        ("slowness.course=never", r"slowness\.course = 'never': .*'loops'"),
        ("slow.strength=1", "did you mean 'caregiver.motionese.slowness'"),
        ("fading_loops=[30, 16]", r"from one number ≥ 0 to a larger one, got \[30, 16\]"),
        ("fading_cm=[2.0, 2.0]", r"from one number ≥ 0 to a larger one, got \[2\.0, 2\.0\]"),
        ("fading_cm=[2.0, inf]", r"from one number ≥ 0 to a larger one"),
        ("fading_loops=[16]", r"fading_loops = \[16\]: it has too few entries"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(override, said):
    with pytest.raises(SettingError, match=said) as refused:
        read_settings(overrides=[f"caregiver.motionese.{override}"])
    assert "\n" not in str(refused.value)


def test_exaggeration_out_of_reach_is_refused_with_the_largest_possible():
    near_the_edge = ["task.places.UL=[0.4836, 0.0440, 1.0596]"]
    asked = "caregiver.motionese.exaggeration.strength"
    with pytest.raises(SettingError, match=r"strength = 1 leads .* cm beyond .* is 0\.\d+") as told:
        read_settings(overrides=[*near_the_edge, f"{asked}=1"])
    largest = float(str(told.value).rsplit(" ", 1)[1])
    read_settings(overrides=[*near_the_edge, f"{asked}={largest}"])
    with pytest.raises(SettingError):
        read_settings(overrides=[*near_the_edge, f"{asked}={largest + 0.02}"])


@pytest.mark.parametrize("task", [PUSHING_BUTTONS, SHAPES], ids=lambda task: task.name)
def test_all_strengths_can_be_followed_by_the_standard_robot(task):
    body = open_body(ActroidSettings(), task)
    sequences = task.sequences(2)
    for roundness in (-1.0, 1.0):
        check_reach(task, manner(exaggeration=1.0, roundness=roundness), body, sequences)


@pytest.mark.parametrize("steps", [0, 4, 8])
def test_a_pause_shows_where_a_stroke_begins(body, steps):
    found = shown(body, PAIR, pauses=steps / 8)
    strokes = strokes_seen(found.path[:, 1:], 10.0)
    assert len(strokes) == 2
    assert abs(strokes[1][0] - found.begins[1]) <= 1
