"""A visitor who knows nothing, and does what the one line of the page says."""

import re
import time

from page.person import Person

SHOW = re.compile(r"press on (\w+) and draw (.+?)\.$")
TO = re.compile(r"to ([A-Z]+)\b")
BUTTONS = {
    "Imitate": "imitate",
    "Learn this": "learn",
    "Grow": "grow",
    "Explore the map": "map-draw",
}
PRESS = re.compile(rf"Press ({'|'.join(BUTTONS)})\b")
POINT = "Point at the map"
ENDS = {"imitate": "performed", "learn": "learned", "grow": "grown"}


def asked(sentence: str) -> tuple[str, list[str]]:
    """What the line asks for: to draw through places, to point, or a button of that name."""
    if show := SHOW.search(sentence):
        return "draw", [show[1], *TO.findall(show[2])]
    if POINT in sentence:
        return "point", []
    (button,) = PRESS.findall(sentence)
    return BUTTONS[button], []


def obeys(person: Person) -> str:
    """Do what the line says, wait until it is over, and return what it was."""
    what, places = asked(person.guide())
    if what == "draw":
        before = person.state()["notebook"]
        person.draw_through(places)
        person.until(lambda s: s["step"] == "judged" and s["notebook"] > before)
        return what
    if what == "point":
        for at in (60, 120, 180, 240):
            before = person.state()["point"]
            person.page.get_by_test_id("map").hover(position={"x": at, "y": at})
            person.until(lambda state, was=before: state["hovered"] and state["point"] != was)
        person.until(lambda state: not person.reads("chapter"))
        return what
    marked = person.page.locator("button.next:not([aria-disabled='true'])")
    assert marked.get_attribute("id") == what, "the button that is marked is the one that is said"
    person.presses(what)
    if what in ENDS:
        person.until(lambda state: state["busy"])
        person.until(lambda state: state["step"] == ENDS[what] and not state["busy"])
    else:
        person.until(lambda state: POINT in person.guide())
    return what


def rests_at(person: Person) -> tuple[float, ...]:
    """Where the hand is that invites, most of the time."""
    seen = []
    for _ in range(60):
        seen.append(tuple(person.state()["hand"]))
        time.sleep(0.05)
    return max(set(seen), key=seen.count)
