"""What stages teach and demand: once where all conditions share it, with the stage's own manner."""

from motionese.experiment import read_settings, stage_lessons

STAGE = """
[[stages]]
lesson = {lesson}
levels = ["io", "cf", "cs"]
caregiver = {caregiver}
until = {{ loops = 2 }}
"""


def of_stages(tmp_path, *stages):
    path = tmp_path / "mine.toml"
    told = "".join(STAGE.format(lesson=lesson, caregiver=manner) for lesson, manner in stages)
    path.write_text(f'[factors]\npace = ["slow", "quick"]\n{told}')
    return stage_lessons(read_settings(str(path)))


def test_a_lesson_is_told_once_for_all_conditions_that_share_it():
    lessons = stage_lessons(read_settings())
    assert [(each.stage, each.conditions, each.name) for each in lessons] == [
        (1, "TD/MD, TD/MND", "primitives"),
        (1, "TND/MD, TND/MND", "taught pairs"),
        (2, "all conditions", "taught pairs"),
    ]
    assert lessons[2].sequences == "UR ↓↑, LR ↑←, UR ←↓, UL ↓↑"
    assert all(each.demand.history == 0 for each in lessons)


def test_a_demand_is_told_in_numbers_and_a_list_by_its_sequences(tmp_path):
    branching, listed = of_stages(tmp_path, ('"branching"', "{}"), ('["LR ↑←", "LR ↑↓"]', "{}"))
    numbers = {"D_corner": "0.40", "D_last": "0.40", "D_history": "0.40", "hold": "14"}
    assert branching.numbers == {**numbers, "load": "5.6"}
    assert (listed.stage, listed.name, listed.sequences) == (2, "", "LR ↑←, LR ↑↓")


def test_rows_are_those_of_the_stage_s_caregiver_in_every_condition(tmp_path):
    rests, paces = "{ rest_steps = 8 }", "{ slow = { stroke_steps = 20 }, quick = {} }"
    lessons = of_stages(tmp_path, ('"branching"', rests), ('"pairs and triples"', paces))
    assert [(each.conditions, each.demand.hold) for each in lessons] == [
        ("all conditions", 20),
        ("slow", 44),
        ("quick", 28),
    ]
