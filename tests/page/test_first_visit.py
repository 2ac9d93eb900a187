"""A first visitor, who knows nothing and does what the one line says, sees the light go on."""

import re
import time

import pytest
from page.serving import served

SHOW = re.compile(r"press on (\w+) and draw (.+?)\.$")
TO = re.compile(r"to ([A-Z]+)\b")
BUTTONS = {"Imitate": "imitate", "Learn this": "learn"}
ENDS = {"imitate": "performed", "learn": "learned"}
MOST_LESSONS = 20
"""Five turns of four, between the two pushes."""


def asked(sentence):
    """What the line asks for: a button of that name, or the places to be drawn through."""
    if show := SHOW.search(sentence):
        return "draw", [show[1], *TO.findall(show[2])]
    (button,) = re.findall(r"Press (Imitate|Learn this)\b", sentence)
    return BUTTONS[button], None


def rests_at(person):
    """Where the hand is that invites, most of the time."""
    seen = []
    for _ in range(60):
        seen.append(tuple(person.state()["hand"]))
        time.sleep(0.05)
    return max(set(seen), key=seen.count)


def obeys(person):
    """Do what the line says, wait until it is over, and return what it was."""
    what, places = asked(person.guide())
    if what == "draw":
        before = person.state()["notebook"]
        person.draw_through(places)
        person.until(lambda s: s["step"] == "judged" and s["notebook"] > before)
        return what
    marked = person.page.locator("button.next:not([aria-disabled='true'])")
    assert marked.get_attribute("id") == what, "the button that is marked is the one that is said"
    person.presses(what)
    person.until(lambda state: state["busy"])
    person.until(lambda state: state["step"] == ENDS[what] and not state["busy"])
    return what


@pytest.mark.slow
def test_who_does_what_the_line_says_sees_a_push_fail_and_then_the_light(open_page, tmp_path):
    with served(tmp_path, "babbling") as server:
        server.awake()
        began = time.monotonic()
        person = open_page(server).arrives()
        assert rests_at(person) == pytest.approx(person.place("UL"), abs=0.01)
        chapters, done = [person.reads("chapter")], []
        while not person.reads("chapter").startswith("4"):
            assert done.count("learn") < MOST_LESSONS, done
            done.append(obeys(person))
            if person.reads("chapter") != chapters[-1]:
                chapters.append(person.reads("chapter"))
                print(f"{time.monotonic() - began:.0f} s: {chapters[-1]}")
        assert done[:2] == ["draw", "imitate"]
        numbers = [chapter[:6] for chapter in chapters]
        # A newborn may press by chance: then there is nothing to practise.
        assert numbers[:2] == ["1 of 5", "2 of 5"] and numbers[-1] == "4 of 5"
        print(f"{done.count('learn')} lessons: {person.guide()}")
        assert "a pair" in person.guide()
        person.page.reload()
        person.until(lambda state: state["ready"] and state["notebook"])
        assert person.reads("chapter") == chapters[-1], "kept with the session"
