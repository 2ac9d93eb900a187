"""Chapters end by what is done, stay ended, and say what to do next."""

from dataclasses import replace

import pytest

from motionese.caregiver import Demonstration
from motionese.experiment import read_settings
from motionese.imitation import Scene, newborn
from motionese.teaching.chapters import (
    GROW,
    LESSONS,
    LIGHT,
    MAP,
    PUSH,
    TITLES,
    TRY,
    chapter_of,
    end_chapters,
)
from motionese.teaching.notebook import Change, Entry, Learning
from motionese.teaching.result import Push, Result
from motionese.teaching.session import Teaching
from motionese.teaching.session_folder import SessionFolder


def now(teaching):
    """Number, act and motion of the chapter, once it is noted what has ended."""
    end_chapters(teaching)
    chapter = chapter_of(teaching)
    return chapter and (chapter.name, chapter.act, chapter.motion)


def come_to(teaching, depth_mm, error_cm=1.0):
    """Let the last try of what was shown have pressed LL so deep."""
    entry = teaching.observed.entry
    result = Result(error_cm, (Push("left_button", "LL", depth_mm, 5.0),))
    entry = replace(entry, tried=replace(entry.tried, result=result))
    teaching.standing = replace(
        teaching.standing,
        notebook=teaching.notebook.with_entry(entry),
        results={**teaching.standing.results, entry.motion: result},
    )


def lessons(teaching, motion, count):
    """Note lessons on what was shown."""
    change, number = Change(motion, 3.0, 2.0), teaching.observed.entry.number
    learned = [Learning(number, 1, 1, 5, (change,))] * count
    notebook = replace(teaching.notebook, learned=(*teaching.notebook.learned, *learned))
    teaching.standing = replace(teaching.standing, notebook=notebook)


@pytest.mark.slow
def test_each_is_ended_by_the_act_itself(teaching, draw):
    assert now(teaching) == (PUSH, "show", "UL ↓"), "the push straight before the body"
    teaching.show(draw("UL ↓"), "drawn")
    assert now(teaching) == (TRY, "imitate", "")
    teaching.imitate()
    come_to(teaching, 0.0)
    assert now(teaching) == (LIGHT, "learn", "")
    come_to(teaching, 4.9, error_cm=0.5)
    assert now(teaching) == (LIGHT, "learn", ""), "nearness is no light"
    come_to(teaching, 5.1, error_cm=2.5)
    assert now(teaching) == (GROW, "show", "UL ↓↑"), "a pair that begins with what lit"
    teaching.show(draw("UL ↓↑"), "scripted")
    assert now(teaching) == (GROW, "learn", ""), "there is nothing yet to grow on"
    lessons(teaching, "UL ↓↑", 1)
    assert now(teaching) == (GROW, "grow", "")
    assert end_chapters(teaching, GROW) and not end_chapters(teaching, GROW)
    assert now(teaching) == (MAP, "grow", ""), "there is no slow level to look at"
    end_chapters(teaching, MAP)
    assert now(teaching) is None


def test_a_slow_level_ends_the_pair_and_leads_to_the_map(scene, draw):
    teaching = Teaching(scene, newborn(scene, 3))
    end_chapters(teaching, TRY, LIGHT)
    path = draw("UL ↓↑")
    pair = Entry(1, "UL ↓↑", "drawn", path, Demonstration(path, (0,)))
    notebook = teaching.notebook.with_entry(pair)
    teaching.standing = replace(teaching.standing, notebook=notebook)
    assert now(teaching) == (MAP, "map", ""), "a pair with a push in it is a push"


def test_who_does_something_else_is_led_on_from_there(teaching, draw):
    teaching.show(draw("UR ←"), "drawn")
    assert now(teaching) == (PUSH, "imitate", ""), "what was shown is tried first"
    teaching.imitate()
    assert now(teaching) == (PUSH, "learn", ""), "it missed"
    shown = teaching.observed.entry.motion
    good = {shown: Result(0.5)}
    teaching.standing = replace(teaching.standing, results=good)
    assert now(teaching) == (PUSH, "show", "UL ↓")


def test_after_some_lessons_without_the_light_it_is_another_pushs_turn(teaching, draw):
    for push, other in (("UL ↓", "UR ↓"), ("UR ↓", "UL ↓")):
        teaching.show(draw(push), "drawn")
        teaching.imitate()
        come_to(teaching, 0.0)
        lessons(teaching, push, LESSONS - 1)
        assert now(teaching) == (LIGHT, "learn", "")
        lessons(teaching, push, 1)
        assert now(teaching) == (LIGHT, "show", other)


def test_what_has_ended_stays_ended_also_when_it_is_undone_or_killed(teaching, draw, tmp_path):
    folder = SessionFolder(tmp_path)
    teaching.show(draw("UL ↓"), "drawn")
    teaching.imitate()
    come_to(teaching, 15.0)
    now(teaching)
    folder.save(teaching)
    teaching.forget(1, folder.learner)
    assert now(teaching)[0] == GROW
    folder.save(teaching)
    again = SessionFolder(tmp_path).read()
    assert now(again) == (GROW, "show", "UR ↓↑") and again.notebook.entries == ()


def test_a_task_without_things_to_push_has_chapters_too():
    scene = Scene(read_settings("shapes", quick=True), 0)
    name, act, motion = now(Teaching(scene, newborn(scene, 2)))
    assert (name, act) == (PUSH, "show")
    assert motion in {sequence.name for sequence in scene.task.sequences(1)}


def test_there_are_five_each_with_a_title():
    assert [*TITLES] == [PUSH, TRY, LIGHT, GROW, MAP] and all(TITLES.values())
