"""The page asks nobody else, two of them do not disturb each other, a dead worker comes back."""

from urllib.parse import urlsplit
from urllib.request import urlopen

import pytest
from page.serving import served


@pytest.mark.slow
def test_nothing_is_asked_of_others_and_nothing_complains(person):
    person.shows("UR ↓")
    person.lets_it_imitate()
    home = urlsplit(person.address).netloc
    assert len(person.requests) > 10
    assert {urlsplit(url).netloc for url in person.requests} == {home}
    assert person.complaints == []


@pytest.mark.slow
def test_the_policy_lets_nothing_else_in(taught):
    policy = urlopen(taught.address).headers["content-security-policy"]
    rules = {name: set(sources) for name, *sources in map(str.split, policy.split(";"))}
    assert rules["default-src"] == {"'none'"}
    assert rules["script-src"] == rules["style-src"] == rules["connect-src"] == {"'self'"}
    assert all(
        source in ("'self'", "'none'", "data:", "blob:") for of in rules.values() for source in of
    )


@pytest.mark.slow
def test_a_second_page_is_told_and_may_take_over(open_page, taught):
    first, second = open_page(taught).arrives(), open_page(taught)
    second.page.goto(second.address)
    second.page.get_by_test_id("take-over").wait_for()
    assert not second.state()["ready"]
    assert first.state()["ready"], "the first is disturbed"
    first.shows("UR ↓")
    second.presses("take-over")
    second.until(lambda state: state["ready"])
    first.until(lambda state: not state["ready"])
    assert "taken over" in first.reads("notice")
    second.shows("UR ↓")
    assert [*first.complaints, *second.complaints] == []


@pytest.mark.slow
def test_a_killed_worker_comes_back_with_the_session(person, taught):
    before = person.state()["notebook"]
    person.shows("LR ↑")
    shown = person.until(lambda state: state["notebook"] > before)["notebook"]
    robot = taught.worker()
    robot.kill()
    person.until(lambda state: not state["ready"], patience=5)
    assert "starting again" in person.guide()
    again = person.until(lambda state: state["ready"])
    assert again["notebook"] == shown
    assert taught.worker().pid != robot.pid
    assert person.shows("UR ↓")["motion"] == "UR ↓"


@pytest.mark.slow
def test_what_is_drawn_while_the_robot_wakes_up_is_understood(open_page, trained, tmp_path):
    with served(tmp_path, trained) as server:
        person = open_page(server)
        person.page.goto(server.address)
        person.until(lambda state: state.get("watching"))
        person.draw("UR ↓")
        verdict = person.until(lambda state: state["verdict"])["verdict"]
    assert verdict["motion"] == "UR ↓"
