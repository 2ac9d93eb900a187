"""Three robots on one page, switched by name and compared; and the session as a file."""

import pytest
from page.serving import served


def begins(person, name, grows):
    """Begin with a further robot."""
    before = person.state()["session"]
    person.presses("begin")
    person.page.get_by_test_id("begin-name").fill(name)
    person.page.get_by_label(grows).check()
    person.presses("begin-babbling")
    return person.until(lambda now: now["session"] != before and not now["busy"])["session"]


def switches(person, name):
    """Teach another robot."""
    before = person.state()["session"]
    person.page.get_by_test_id("robots").get_by_role("button", name=name).click()
    return person.until(lambda now: now["session"] != before and not now["busy"])


def column(person, place):
    """What the table says of a robot."""
    rows = person.page.get_by_test_id("comparison").locator("tbody tr")
    return [row.locator("td").nth(place).inner_text() for row in rows.all()]


@pytest.mark.slow
def test_robots_are_compared_by_the_same_lessons_and_shared_as_a_file(
    open_page, chromium, tmp_path
):
    with served(tmp_path, "fresh") as server:
        person = open_page(server.awake()).arrives()
        person.shows("UR ↓")
        person.lets_it_learn()
        begins(person, "Tall", "from the beginning")
        assert person.state()["notebook"] == 0 and person.state()["phase"] == 2
        pressed = person.page.locator("#robots button[aria-pressed='true']")
        assert pressed.inner_text() == "Tall"
        person.page.get_by_role("button", name="Pass on 1 lesson of Robot 1 to Tall").click()
        learned = person.until(lambda now: now["step"] == "learned" and not now["busy"])
        assert learned["notebook"] == 1
        person.presses("compare")
        person.until(lambda _: all(" of 1" in column(person, place)[4] for place in (0, 1)))
        first, tall = (column(person, place) for place in (0, 1))
        assert [first[:3], tall[:3]] == [
            ["when you say", "IO, Cf", "1"],
            ["from the beginning", "IO, Cf, Cs", "1"],
        ]
        assert all("cm" in cell for cell in (*first[5:], *tall[5:])) and len(tall) == 7

        person.page.get_by_label("Name of Robot 1").fill("Late")
        person.page.keyboard.press("Enter")
        person.page.get_by_test_id("robots").get_by_role("button", name="Late").wait_for()
        with person.page.expect_download() as download:
            person.presses("save")
        assert download.value.suggested_filename == "robot-school.motionese"
        file = download.value.path()
        assert switches(person, "Late")["phase"] == 1
        person.shows("UR ←")
        begins(person, "Low", "never")
        person.page.get_by_test_id("begin").click()
        assert person.page.get_by_test_id("begin-away").is_visible(), "three are as many as fit"
        person.page.keyboard.press("Escape")

        (tmp_path / "no session").write_text("mine")
        person.page.set_input_files("#open-file", tmp_path / "no session")
        person.page.get_by_text("This file is no session").wait_for()
        assert person.state()["robots"] == 3
        person.page.set_input_files("#open-file", file)
        opened = person.until(lambda now: now["robots"] == 2 and not now["busy"])
        assert pressed.inner_text() == "Tall" and opened["notebook"] == 1
        assert "put away" in person.page.get_by_test_id("toast").inner_text()
        person.page.reload()
        again = person.until(lambda now: now["ready"] and now["robots"])
        assert (again["robots"], again["session"]) == (2, opened["session"])
        assert [said for said in person.complaints if "422" not in said] == []
