"""Studies: stages by condition, and what stands in the way of going through them."""

import pytest

from motionese.errors import SettingError
from motionese.experiment import condition_named, read_settings
from motionese.task import PUSHING_BUTTONS

TAUGHT = PUSHING_BUTTONS.lesson("taught pairs")


def names(study, condition):
    stages = study.development(condition_named(condition, study.factors))
    return [(stage.lesson, stage.levels) for stage in stages]


def test_the_default_study_is_the_paper_s_two_by_two():
    study = read_settings()
    primitives = PUSHING_BUTTONS.sequences(1)
    assert names(study, "TD/MD") == [(primitives, 2), (TAUGHT, 3)]
    assert names(study, "TD/MND") == [(primitives, 3), (TAUGHT, 3)]
    assert names(study, "TND/MD") == [(TAUGHT, 2), (TAUGHT, 3)]
    assert names(study, "TND/MND") == [(TAUGHT, 3), (TAUGHT, 3)]
    assert study.most_loops() == 30


def test_a_further_stage_is_lines_of_a_preset():
    stages = read_settings("three_stages")
    first, second, third = names(stages, "TD/MD")
    assert (first[1], second[1], third[1]) == (2, 3, 3)
    assert {s.name for s in third[0]} == {"UR ↓↑←", "LR ↑←↓", "UR ←↓↑"}


def test_any_list_of_sequences_is_a_lesson():
    listed = ["UR ↓", "LR ↑←", "UR ←↓↑", "RAISE(R) + PUSH(R)", "UR ↓"]
    stages = "0.lesson.TND", "1.lesson"
    study = read_settings(overrides=[f"stages.{stage}={listed}" for stage in stages])
    for lesson, _ in names(study, "TND/MD"):
        assert [s.name for s in lesson] == ["UR ↓", "LR ↑←", "UR ←↓↑", "LR ↑↓"]


def written(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(text)
    return str(path)


STAGE = "[[stages]]\nlesson = {lesson}\nlevels = {levels}\nuntil = {{ loops = 2 }}\n"


def stage(lesson='"primitives"', levels='["io", "cf"]'):
    return STAGE.format(lesson=lesson, levels=levels)


def test_the_caregiver_s_manner_may_differ_by_stage_and_by_choice(tmp_path):
    text = (
        '[factors]\npace = ["slow", "quick"]\n'
        + stage()
        + "caregiver = { slow = { stroke_steps = 20 }, quick = {} }\n"
        + stage()
        + "caregiver = { rest_steps = 5 }\n"
    )
    study = read_settings(written(tmp_path, text))
    slow, quick = (study.development(c) for c in study.conditions)
    assert [s.manner.stroke_steps for s in slow] == [20, 12]
    assert [s.manner.stroke_steps for s in quick] == [12, 12]
    assert [s.manner.rest_steps for s in slow] == [2, 5]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (stage(levels='["io", "cs"]'), "must be the network's, from io upwards without a gap"),
        (stage(levels='["io", "cf", "sc"]'), "did you mean 'cs'?"),
        (
            stage(levels='["io", "cf", "cs"]') + stage(),
            "stages.1.levels closes a level that stage 0 has opened in TD/MD",
        ),
        (
            stage(levels='{ MD = ["io", "cf"] }'),
            "a stage says nothing for MND; it does for MD",
        ),
        (stage(lesson='{ TX = "primitives", TY = "primitives" }'), "did you mean 'TD'?"),
        (stage(lesson='"primitive"'), "is no lesson or sequence of pushing_buttons"),
        (stage(lesson='["UR ↓←"]'), "impossible sequence 'UR ↓←'"),
        (stage() + "caregiver = { stroke_step = 3 }", "did you mean 'stroke_steps'?"),
        ("stages = []", "stages = []"),
        ('[[stages]]\nlesson = "primitives"\n', "setting stages.0.levels is missing"),
        (
            stage().replace("loops = 2", "loops = 0"),
            "setting stages.0.until.loops = 0: input should be greater than or equal to 1",
        ),
        (
            stage().replace("loops = 2", "loops = 2, settled = { loop = 2 }"),
            "did you mean 'stages.0.until.settled.loops'?",
        ),
        ('[factors]\nteaching = ["TD", "TD"]', "each of a name of its own; got TD, TD"),
        ("[factors]\nteaching = []", "every factor needs choices"),
        ('[factors]\nteaching = ["T/D"]', "factors.teaching.0 = 'T/D'"),
    ],
)
def test_what_cannot_be_gone_through_is_one_sentence(tmp_path, text, told):
    with pytest.raises(SettingError) as error:
        read_settings(written(tmp_path, text))
    assert told in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[phases]\nloops = 30", "setting phases is of the form before; it is now [[stages]]"),
        ('[teaching.TD]\nphase_1 = "primitives"', "setting teaching is of the form before"),
        ("[caregiver.corners]\nUR = [1, 2, 3]", "it is now [task] places = { UR"),
    ],
)
def test_settings_of_the_form_before_are_shown_the_new_form(tmp_path, text, told):
    with pytest.raises(SettingError) as error:
        read_settings(written(tmp_path, text))
    assert told in str(error.value)
