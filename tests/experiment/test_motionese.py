"""Motionese and attention in a run: nothing at strength 0, and the same bits after any stop."""

import numpy as np
import pytest
from small_runs import SMALL, left_on_disk, stopped_after

from motionese.errors import SettingError
from motionese.experiment import Run, condition_named, go_through, read_settings, run
from motionese.experiment.run import _as_shown
from motionese.imitation import LoopDone, Scene

LOOPS_ALONE = (*SMALL, "stages.1.lesson=branching", "training.epochs=3")
NOTHING = (
    "caregiver.motionese.pauses.steps=12",
    "caregiver.motionese.pauses.course=loops",
    "caregiver.motionese.exaggeration.course=error",
    "caregiver.motionese.fading_loops=[1, 2]",
    "training.attention.to=movement",
)
FADING = (
    "caregiver.motionese.pauses.strength=1",
    "caregiver.motionese.pauses.steps=4",
    "caregiver.motionese.pauses.course=loops",
    "caregiver.motionese.exaggeration.strength=1",
    "caregiver.motionese.exaggeration.course=error",
    "caregiver.motionese.repetition.strength=0.3",
    "caregiver.motionese.fading_loops=[2, 4]",
    "caregiver.motionese.fading_cm=[0.0, 100.0]",
    "training.attention.strength=2",
    "training.grouping=pauses",
)
TD_MD = condition_named("TD/MD", read_settings().factors)


@pytest.fixture
def loops_of(tmp_path, monkeypatch):
    """What the loops of a run leave on disk; nothing is evaluated after them."""
    monkeypatch.setattr(run, "_evaluated", lambda *_: {})

    def gone_through(*overrides, stops=()):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        settings = read_settings(overrides=[*LOOPS_ALONE, *overrides], quick=True)
        for loop in stops:
            stopped_after(Run(TD_MD, 5, folder), settings, loop)
        go_through(Run(TD_MD, 5, folder), settings, lambda loop: None)
        return left_on_disk(folder)

    return gone_through


def without_origin(left):
    """Everything but the digest of the settings, which tells them apart as it should."""

    def untold(what):
        whole = isinstance(what, dict)
        return {n: untold(w) for n, w in what.items() if n != "origin"} if whole else what

    return {
        name: tuple(map(untold, what)) if isinstance(what, tuple) else what
        for name, what in left.items()
    }


@pytest.mark.slow
def test_at_strength_0_a_run_leaves_the_same_bits_as_without_motionese(loops_of):
    assert without_origin(loops_of(*NOTHING)) == without_origin(loops_of())


@pytest.mark.slow
def test_fading_goes_on_with_the_same_bits_after_every_stop(loops_of):
    whole, stopped = loops_of(*FADING), loops_of(*FADING, stops=(1, 2, 3))
    assert stopped == whole
    assert without_origin(whole) != without_origin(loops_of())


def test_what_is_shown_follows_from_the_loops_before_alone():
    study = read_settings(overrides=FADING)
    stages = study.development(TD_MD)

    def shown(loop, stage, before_stage, error):
        errors = {"UR ↓": error - 1, "LR ↑": error + 1}
        before = [LoopDone(before_stage, errors, levels=2)] * (loop - 1)
        return _as_shown(stages, stage, before).manner.motionese

    assert [shown(loop, 0, 0, 9.0).pauses.rows for loop in (1, 2, 3, 4)] == [4, 4, 2, 0]
    left = [
        shown(*at).exaggeration.strength for at in ((1, 0, 0, 0), (5, 0, 0, 25.0), (9, 1, 0, 25.0))
    ]
    assert left == pytest.approx([1.0, 0.25, 1.0]), "a new lesson begins at full strength"


def test_motions_are_evaluated_as_shown_to_an_adult_unless_told_otherwise():
    study = read_settings(overrides=["caregiver.motionese.pauses.strength=1"])
    scene = Scene(study, seed=3)
    pair = scene.task.sequence("UR ↓↑")
    assert scene.show(pair, "new").begins == (0, 14)
    assert scene.shown_with(study.caregiver.motionese).show(pair, "new").begins == (0, 22)
    assert scene.show(pair, "new", manner=study.caregiver).begins == (0, 22)


def test_what_is_shown_again_is_seen_as_the_mean():
    study = read_settings(overrides=["caregiver.motionese.repetition.strength=1"])
    scene = Scene(study, seed=3)
    pair = scene.task.sequence("UR ↓↑")
    intended = scene.caregiver().intended(pair)
    once, again = (
        [scene.show(pair, number, manner=manner).path - intended for number in range(12)]
        for manner in (None, study.caregiver)
    )
    assert np.std(again) == pytest.approx(np.std(once) / 2, rel=0.25)


def test_a_stage_s_caregiver_changes_only_what_it_names(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(
        "[caregiver.motionese]\npauses = { strength = 1.0 }\n"
        '[[stages]]\nlesson = "primitives"\nlevels = ["io", "cf"]\nuntil = { loops = 1 }\n'
        "caregiver = { motionese = { slowness = { strength = 0.5 } } }\n"
    )
    (stage,) = read_settings(str(file)).development(TD_MD)
    assert stage.manner.motionese.pauses.rows == 8
    assert stage.manner.motionese.slower == 1.5


@pytest.mark.parametrize(
    ("pauses", "said"),
    [
        (
            "pauses = { strength = 2 }",
            r"stages\.0\.caregiver: setting motionese\.pauses\.strength = 2",
        ),
        ("pauzes = { strength = 1 }", r"did you mean 'motionese\.pauses'"),
    ],
)
def test_a_stage_s_motionese_is_checked_when_it_is_read(tmp_path, pauses, said):
    file = tmp_path / "mine.toml"
    file.write_text(
        '[[stages]]\nlesson = "primitives"\nlevels = ["io", "cf"]\nuntil = { loops = 1 }\n'
        f"caregiver = {{ motionese = {{ {pauses} }} }}\n"
    )
    with pytest.raises(SettingError, match=said):
        read_settings(str(file))


@pytest.mark.parametrize("emphasis", ["pauses", "exaggeration", "slowness", "roundness"])
def test_an_arm_that_follows_what_is_shown_presses_the_button(emphasis):
    """The joints are told where the hand was shown, and to hold the places against the button."""
    study = read_settings(overrides=[f"caregiver.motionese.{emphasis}.strength=1"])
    scene, manner = Scene(study, seed=3), study.caregiver
    pair = scene.task.sequence("UR ←↓")
    path = scene.caregiver(manner).intended(pair)
    body, begins = scene.body, manner.begins(pair)
    gaps = {
        place: scene.postures[place] - body.angles_nearest(scene.task.position(place))
        for place in pair.places
    }
    body.reset(scene.postures[pair.start], np.random.default_rng(0))
    depth = 0.0
    for row in range(1, len(path)):
        stroke = int(np.searchsorted(begins, row, side="right")) - 1
        rows = manner.stroke_rows(pair.primitives[stroke])
        share = min((row - begins[stroke]) / rows, 1.0)
        start, end = (gaps[place] for place in pair.places[stroke : stroke + 2])
        body.command(body.angles_nearest(path[row]) + (1 - share) * start + share * end)
        body.step()
        depth = max(depth, body.effects()["left_button"])
    assert depth > 2 * scene.task.needed_mm
