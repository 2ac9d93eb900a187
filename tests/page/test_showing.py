"""A person shows motions with a pointer, keys, or a camera, and the robot says what it saw."""

import time

import pytest
from page.conftest import FILMED

PRIMITIVES = ("UR ↓", "LR ↑", "UR ←", "UL ↓", "LL ↑")
COUNTING = """
window.taken = 0;
addEventListener("pointerdown", () => (window.taken += 1), true);
addEventListener("pointermove", (event) => {
  if (event.buttons) window.taken += event.getCoalescedEvents().length || 1;
}, true);
"""
"""Has the page count by itself what its device takes while the pen is down."""
PAIRS = ("UR ↓↑", "LR ↑←", "UR ←↓", "UL ↓↑", "LL ↑↓", "LR ↑↓")


@pytest.mark.slow
def test_every_sample_of_the_pointer_reaches_the_robot(person):
    """However many a busy machine takes; how many that are is what the benchmark measures."""
    person.page.evaluate(COUNTING)
    person.draws("UR ←↓", 1.85)
    person.until(lambda state: state["understandings"])  # while the pen is still down
    person.page.mouse.up()
    person.until(lambda state: state["verdict"])
    taken = person.page.evaluate("window.taken")
    assert taken > 2
    assert person.state()["points"] == taken
    assert person.state()["saw"] == 1, "what it saw is shown before whether it can do it"
    assert person.points_sent() == taken


@pytest.mark.slow
def test_the_arrows_are_what_was_drawn(person):
    read = {}
    for motion in (*PRIMITIVES, *PAIRS):
        person.shows(motion)
        read[motion] = person.page.get_by_test_id("verdict-arrows").text_content()
    wrong = {motion: said for motion, said in read.items() if not said.startswith(motion)}
    assert not set(wrong) & set(PRIMITIVES)
    assert len(set(PAIRS) - set(wrong)) >= 4, wrong


@pytest.mark.slow
def test_something_red_before_the_camera_is_followed(person):
    person.presses("webcam")
    person.presses("webcam-show")
    person.until(lambda state: state["drawing"] and state["points"] > 5)
    seen = -1
    while seen < (now := person.state()["points"]):  # until the film shows nothing any more
        seen = now
        time.sleep(0.5)
    person.presses("webcam-show")
    verdict = person.until(lambda state: state["verdict"])["verdict"]
    assert verdict["motion"] == FILMED
    assert {said.get("source") for said in person.sent if said.get("phase") == "down"} == {"webcam"}
    # The notebook is told anew right after the verdict.
    person.page.get_by_test_id("notebook").get_by_text("webcam").first.wait_for()


@pytest.mark.slow
def test_the_keyboard_is_enough(person):
    keys = person.page.keyboard
    person.goes_to("surface")
    for key in ("ArrowDown", "ArrowUp", "Space", "ArrowDown", "Enter"):
        keys.press(key)
    assert person.until(lambda state: state["step"] == "judged")["verdict"]["motion"] == "UR ↓"
    person.goes_to("imitate")
    keys.press("Enter")
    person.until(lambda state: state["step"] == "performed" and not state["busy"])
    assert person.focused() == "imitate", "a button that may not be pressed keeps the focus"
    person.goes_to("learn")
    keys.press("Enter")
    person.until(lambda state: state["step"] == "learned" and not state["busy"])
    assert person.focused() == "learn"
    person.goes_to("time")
    end = person.state()["at"]
    keys.press("ArrowLeft")
    assert person.state()["at"] < end, "keys move in time"


@pytest.mark.slow
def test_everything_has_a_name_for_who_cannot_see(person):
    person.shows("UR ↓")
    named = person.names()
    assert len([role for role, _ in named if role == "button"]) >= 6
    assert [role for role, name in named if not name] == []


@pytest.mark.slow
def test_the_view_stays_where_it_is_under_the_pen(open_page, taught):
    person = open_page(taught, viewport={"width": 390, "height": 844}).arrives()
    person.shows("UR ↓")
    place = "document.getElementById('surface').getBoundingClientRect().top"
    before = person.page.evaluate(place)
    person.draws("UR ←")
    assert person.page.evaluate(place) == before
    person.page.mouse.up()
    assert person.until(lambda state: state["step"] == "judged")["verdict"]["shown"] == "UR ←"
