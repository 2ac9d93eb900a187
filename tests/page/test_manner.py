"""How a person shows a motion stands beside the caregiver's, and the robot wishes for pauses."""

import pytest

WISH, SEEN = "Pause at the corner UL, please", "I saw you pause at UL."
PLACES = ["UR", "UL", "LL"]


def shows(person, rest_s):
    """Draw a pair with rests in its places; returns what is measured of it, by row."""
    shown = person.state()["notebook"]
    person.draw_through(PLACES, rest_s)
    person.until(lambda s: s["step"] == "judged" and s["notebook"] > shown and not s["busy"])
    return measured(person)


def measured(person):
    rows = person.page.get_by_test_id("manner").locator("tr").all()
    cells = [row.locator("th, td").all_text_contents() for row in rows]
    return {first.strip(): [told.replace("\xa0", " ") for told in rest] for first, *rest in cells}


@pytest.mark.slow
def test_the_wish_for_a_pause_goes_when_it_is_heard(person):
    hurried = shows(person, 0.0)
    assert WISH in person.guide() and WISH in person.page.text_content("#verdict-spoken")
    assert hurried["pauses"][0] == "none"
    assert hurried["pace"][0] == "undefined: no pause between movements"
    paused = shows(person, 2.0)  # so long that a busy machine does not blur it
    assert SEEN in person.guide() and "please" not in person.guide()
    assert paused["UR ←↓UR"] == ["you", "as to an adult", "with motionese"]
    assert paused["pauses"][0].startswith("1, ") and 0 < float(paused["pace"][0]) < 9
    assert paused["pauses"][1] == "1, 0.2 s" and float(paused["pace"][1]) > 9
    assert paused["roundness"][1] == "1.01" and float(paused["roundness"][2]) > 1.3
    assert person.complaints == []
    person.page.reload()
    person.until(lambda state: state["ready"] and state["notebook"])
    assert measured(person) == paused, "it is told whoever comes"


@pytest.mark.slow
def test_the_hand_of_the_keyboard_pauses_at_corners(person):
    person.goes_to("surface")
    for key in ("ArrowDown", "ArrowUp", "Space", "ArrowLeft", "ArrowDown", "Enter"):
        person.page.keyboard.press(key)
    person.until(lambda state: state["step"] == "judged" and not state["busy"])
    assert SEEN in person.guide()


FITS = """
() => {
  const cells = [...document.querySelectorAll("#manner th, #manner td")];
  const [line, place] = ["#guide span", "#guide"].map((one) => document.querySelector(one));
  return {
    cells: cells.length > 0 && cells.every((cell) => cell.scrollWidth <= cell.clientWidth + 1),
    line: line.offsetHeight <= place.offsetHeight,
    page: document.documentElement.scrollWidth <= innerWidth,
  };
}
"""


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 820, 1280])
def test_what_is_measured_and_wished_fits_the_window(open_page, taught, width):
    person = open_page(taught, viewport={"width": width, "height": 900}).arrives()
    shows(person, 0.0)
    assert WISH in person.guide()
    assert person.page.evaluate(FITS) == {"cells": True, "line": True, "page": True}
