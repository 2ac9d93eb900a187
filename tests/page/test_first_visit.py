"""A first visitor, who knows nothing and does what the one line says, sees the light go on."""

import re
import time

import pytest
from page.serving import served

SHOW = re.compile(r"press on (\w+) and draw (.+?)\.$")
TO = re.compile(r"to ([A-Z]+)\b")
BUTTONS = {"Imitate": "imitate", "Learn this": "learn", "Grow": "grow", "Map": "map-draw"}
MOST_LESSONS = 12


def asked(sentence):
    """What the line asks for: a button of that name, or the places to be drawn through."""
    if show := SHOW.search(sentence):
        return "draw", [show[1], *TO.findall(show[2])]
    (button,) = re.findall(r"Press (Imitate|Learn this|Grow|Map)\b", sentence)
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
    person.until(lambda state: state["busy"] or state["step"] not in ("judged", ""))
    person.until(lambda state: not state["busy"] and not state["plays"])
    return what


@pytest.mark.slow
def test_who_does_what_the_line_says_sees_a_push_fail_and_then_the_light(open_page, tmp_path):
    with served(tmp_path, "babbling") as server:
        began = time.monotonic()
        person = open_page(server.awake()).arrives()
        assert rests_at(person) == pytest.approx(person.place("UL"), abs=0.01)
        chapters, done = [person.reads("chapter")], []
        while not person.reads("chapter").startswith("4"):
            assert done.count("learn") < MOST_LESSONS, done
            done.append(obeys(person))
            if person.reads("chapter") != chapters[-1]:
                chapters.append(person.reads("chapter"))
                print(f"{time.monotonic() - began:.0f} s: {chapters[-1]}")
        assert done[:2] == ["draw", "imitate"]
        assert [chapter[:6] for chapter in chapters] == ["1 of 5", "2 of 5", "3 of 5", "4 of 5"]
        result = person.state()["learned"]["sentence"]
        print(f"{done.count('learn')} lessons, {result}")
        assert "pressed" in result
        person.page.reload()
        person.until(lambda state: state["ready"] and state["notebook"])
        assert person.reads("chapter") == chapters[-1], "kept with the session"
