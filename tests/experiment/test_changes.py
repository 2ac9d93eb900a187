"""Changes that answer the learner: read, refused where they can never come, resumed to the bit."""

import pytest
from small_runs import SMALL, left_on_disk, stopped_after

from motionese.errors import SettingError
from motionese.experiment import Run, condition_named, read_settings
from motionese.experiment.checkpoint import read_checkpoints
from motionese.experiment.learned_robot import robot_of
from motionese.experiment.run_folder import open_run_folder

STAGE = """
[[stages]]
lesson = {lesson}
levels = ["io", "cf"]
until = {until}
choosing = {choosing}
"""


def written(tmp_path, *stages, opens="", lesson='"branching"'):
    path = tmp_path / "mine.toml"
    text = '[factors]\nreadiness = ["RF", "RA"]\n'
    for until, choosing in stages:
        text += STAGE.format(lesson=lesson, until=until, choosing=choosing)
    path.write_text(text + f"[opens]\n{opens}")
    return str(path)


def course(preset, name):
    study = read_settings(preset)
    return study.course(condition_named(name, study.factors))


def test_the_adaptive_preset_is_a_two_by_two_beside_fixed_change():
    fixed, adaptive = course("adaptive", "TF/MF"), course("adaptive", "TA/MA")
    assert [s.until.ends(0) for s in fixed.stages] == [15, 30]
    assert fixed.openings[2].ends(0) == 15
    assert fixed.stages[0].until.mastered is None and adaptive.stages[0].until.mastered
    assert fixed.openings[2].emerged is None and adaptive.openings[2].emerged.level == "cf"
    assert course("adaptive", "TF/MA").stages == fixed.stages
    assert course("adaptive", "TA/MF").openings == fixed.openings
    assert read_settings("adaptive").most_loops() == 30
    assert read_settings("adaptive").emerging == ("cf",)
    assert read_settings("order").emerging == ()


def test_a_whole_study_is_read_again_as_it_was_written():
    for preset in ("adaptive", "scaffolding", "four_levels"):
        study = read_settings(preset)
        assert type(study).model_validate(study.model_dump(mode="json")) == study


STAYS = ("{ loops = 5 }", "{}")


@pytest.mark.parametrize(
    ("stage", "opens", "told"),
    [
        (("{ least = 3 }", "{}"), "", "stages.0.until: it needs an end that is sure to come"),
        (("{}", "{}"), "", "stages.0.until: it needs an end that is sure to come"),
        (("{ loops = 2, least = 3 }", "{}"), "", "least = 3 loops are more than it lasts at most"),
        (
            ("{ loops = 2, mastered = { loops = 3 } }", "{}"),
            "",
            "mastered.loops = 3 can never be met, it lasts 2 loops at most",
        ),
        (
            ("{ loops = 9, mastered = { below_cm = -1 } }", "{}"),
            "",
            "stages.0.until.mastered.below_cm = -1: input should be greater than 0",
        ),
        (
            ("{ loops = 9, emerged = { level = 'cf', share = 1.5 } }", "{}"),
            "",
            "stages.0.until.emerged.share = 1.5: input should be less than or equal to 1",
        ),
        (
            ("{ loops = 9, emerged = { level = 'cs' } }", "{}"),
            "",
            "stages.0.until.emerged can never be met in RF: cs is not open then",
        ),
        (
            ("{ loops = 9, emerged = { level = 'cd' } }", "{}"),
            "cs = { in_all = 3 }",
            "unknown level in stages.0.until.emerged 'cd'; did you mean",
        ),
        (("{ RF = { loops = 2 }, RX = { loops = 3 } }", "{}"), "", "did you mean 'RF'?"),
        (("{ RF = { loops = 2 } }", "{}"), "", "a stage says nothing for RA"),
        (("{ RF = { loop = 2 }, RA = { loops = 2 } }", "{}"), "", "stages.0.until.RF.loop"),
        (STAYS, "cs = { in_all = 4, emerged = { level = 'cs' } }", "cs is not open then"),
        (STAYS, "cs = { in_all = 5 }", "opens.cs may never come in RF: it waits for 5 loops"),
        (STAYS, "ct = { in_all = 2 }", "unknown level in opens 'ct'; did you mean 'cs'?"),
        (STAYS, "cf = { in_all = 2 }", "unknown level in opens 'cf'"),
        (("{ loops = 5 }", "{ by = 'easiest' }"), "", "shown says how many motions are chosen"),
        (("{ loops = 5 }", "{ by = 'random', shown = 6 }"), "", "the lesson has 5 motions"),
        (("{ loops = 5 }", "{ by = 'hardest', shown = 2 }"), "", "choosing.by = 'hardest'"),
    ],
)
def test_what_can_never_come_is_refused_in_one_sentence(tmp_path, stage, opens, told):
    with pytest.raises(SettingError) as error:
        read_settings(written(tmp_path, stage, opens=opens))
    assert told in str(error.value)
    assert "\n" not in str(error.value)


def test_a_level_whose_level_below_never_opens_is_refused(tmp_path):
    four = "cs = { size = 2, tau = 70.0 }\nct = { size = 2, tau = 150.0 }\n"
    levels = "[network.levels]\nio = { tau = 2.0 }\ncf = { size = 8, tau = 5.0 }\n" + four
    path = written(tmp_path, STAYS, opens=f"ct = {{ in_all = 2 }}\n{levels}")
    with pytest.raises(SettingError, match=r"opens.ct may never come in RF: the level below it"):
        read_settings(path)


ADAPTIVE = [
    *SMALL,
    "stages.0.until.loops=2",
    "stages.0.until.mastered={ loops = 1, below_cm = 90.0 }",
    "stages.1.until.loops=3",
    "stages.1.choosing={ by = 'random', shown = 2 }",
    "opens.cs.loops=1",
    "opens.cs.emerged={ level = 'cf', loops = 1 }",
]


@pytest.fixture(scope="module")
def adaptive():
    return read_settings("adaptive", ADAPTIVE, quick=True)


@pytest.mark.slow
def test_an_adaptive_run_stopped_after_every_loop_goes_on_to_the_same_bits(tmp_path, adaptive):
    condition = adaptive.conditions[-1]
    undisturbed, run = (Run(condition, 5, tmp_path / name) for name in ("whole", "stopped"))
    stopped_after(undisturbed, adaptive, 3)
    for loop in (1, 2, 3):
        stopped_after(run, adaptive, loop)
    assert left_on_disk(run.folder) == left_on_disk(undisturbed.folder)
    loops = read_checkpoints(run.folder, run.origin(adaptive))
    assert [[row["phase"] for row in each.rows] for each in loops] == [[1] * 5, [2] * 2, [2] * 2]
    assert [each.development["levels"] for each in loops] == [2, 3, 3]
    assert all(0 <= each.development["emerged_cf"] <= 1 for each in loops)


@pytest.mark.slow
def test_change_after_so_many_loops_is_that_of_stages_to_the_bit(tmp_path):
    opens = ["opens.cs.loops=1", "opens.cs.emerged={ level = 'cf', loops = 1, share = 1.0 }"]
    beside = read_settings("adaptive", [*SMALL, *opens], quick=True)
    by_stage = read_settings("order", SMALL, quick=True)
    left = []
    for study, name in ((beside, "TF/MF"), (by_stage, "TD/MD")):
        run = Run(condition_named(name, study.factors), 5, tmp_path / name.replace("/", "-"))
        stopped_after(run, study, 3)
        left.append(left_on_disk(run.folder))
    assert left[0].keys() == left[1].keys()
    for loop in (1, 2, 3):
        (_, one), (_, other) = (each[f"loop-{loop:02d}.safetensors"] for each in left)
        assert one == other


@pytest.mark.slow
def test_a_robot_whose_fourth_level_opened_is_taught_on(tmp_path):
    loops = [f"stages.{n}.until.loops=1" for n in range(3)]
    study = read_settings("four_levels", [*SMALL, *loops], quick=True)
    with open_run_folder(tmp_path / "four", study, "four_levels") as folder:
        run = folder.run(study.conditions[0], 5)
        stopped_after(run, study, 3)
    robot = robot_of(tmp_path / "four")
    assert robot.learner.network.names == ("io", "cf", "cs", "ct")
    assert {e.level for e in robot.learner.elements} == {"cf", "cs"}
