"""The robot moves, learns and grows while a person looks on, and the page remembers."""

import pytest
from page.person import changed


def test_the_robot_moves_on_the_canvas(person):
    before = person.sees("robot")
    person.shows("UR ↓")
    frames = person.state()["frames"]
    person.presses("imitate")
    person.until(lambda state: state["frames"] > frames + 15)
    assert changed(before, person.sees("robot")) > 0.004
    done = person.until(lambda state: state["step"] == "performed" and not state["busy"])
    assert done["performed"]["error_cm"] < 5
    assert done["frames"] - frames >= 20, "poses a second"
    assert changed(before, person.sees("robot")) > 0.004


def test_the_arm_follows_the_pen_and_the_page_shows_what_is_believed(person):
    belief = person.page.get_by_test_id("belief")
    before, frames = person.sees("robot"), person.state()["frames"]
    person.page.get_by_test_id("follow").check()
    person.draws("UR ↓")
    assert person.until(lambda state: state["frames"] > frames + 10)["drawing"]
    assert "none of these" in belief.text_content() and belief.locator("li").count() > 1
    assert changed(before, person.sees("robot")) > 0.004
    person.page.mouse.up()
    person.until(lambda state: state["step"] == "judged")
    assert belief.is_hidden()


@pytest.mark.slow
def test_a_newborn_learns_and_grows_and_is_found_again(parent):
    parent.shows("UL ↓")
    learned = parent.lets_it_learn()["learned"]
    before = learned["before_cm"]
    for _ in range(2):  # on a busy machine the pointer draws a ragged line, which takes longer
        if learned["after_cm"] >= 0.7 * before:
            learned = parent.lets_it_learn()["learned"]
    assert learned["after_cm"] < 0.7 * before
    attempts = parent.page.get_by_test_id("entry").inner_text()
    assert f"{learned['after_cm']:.1f} cm" in attempts, "what it is left with comes last"
    levels = parent.page.locator("#network svg > g:not(.waiting)")
    assert levels.count() == 2
    parent.presses("grow")
    parent.until(lambda state: state["phase"] == 2 and not state["busy"])
    assert levels.count() == 3
    shown = parent.state()["notebook"]
    parent.page.reload()
    again = parent.until(lambda state: state["ready"] and state["notebook"])
    assert (again["notebook"], again["phase"]) == (shown, 2)
    assert "UL ↓" in parent.page.get_by_test_id("notebook").text_content()
