"""Which strokes are clear, in one chart; and the map beside the eye view, played with."""

import pytest


def before_the_map(person):
    """A person before the map of the robot."""
    person.presses("map-draw")
    person.page.locator("#map-ways li").first.wait_for()
    return person


def chart(person):
    """What the chart says of every stroke, when it is there."""
    strokes = person.page.locator(".clear-strokes li")
    strokes.first.wait_for()
    return strokes.all_text_contents()


@pytest.mark.slow
def test_the_chart_says_of_every_stroke_how_clear_it_is_beside_the_newborn(person):
    told = chart(person)
    assert len(told) == 5
    assert all("of the map goes that way" in each for each in told)
    assert all("As a newborn:" in each for each in told)
    clear = sum("clear:" in each for each in told)
    assert person.reads("emergence-note").startswith(f"{clear} of 5 strokes are clear")
    assert "swap their Cs₀, how one begins follows" in person.reads("emergence")
    person.page.reload()
    person.until(lambda state: state["ready"])
    assert len(chart(person)) == 5, "it is kept"


@pytest.mark.slow
def test_a_newborn_has_nothing_clear_and_is_told_what_cannot_be_measured(parent):
    told = chart(parent)
    assert len(told) == 5 and not any("clear:" in each for each in told)
    if parent.state()["phase"] == 1:
        assert "not measurable yet" in parent.reads("emergence")
        parent.presses("map-draw")
        parent.page.locator("#map-ways li").first.wait_for()
        assert "no slow level yet" in parent.reads("map-note")
        assert "Another Cf" in parent.page.inner_text("#map-title")


@pytest.mark.slow
def test_pointing_at_the_map_shows_the_motion_at_once_and_moves_nothing(person):
    explorer = before_the_map(person)
    view, map_ = (explorer.page.get_by_test_id(name) for name in ("view", "map"))
    explorer.until(lambda state: state["hovered"])
    before, place = explorer.state(), view.bounding_box()
    assert map_.bounding_box()["width"] > 380
    map_.hover(position={"x": 60, "y": 60})
    after = explorer.until(lambda s: s["point"] != before["point"] and s["hovered"])
    explorer.until(lambda state: state["hovered"] != before["hovered"])
    assert len(after["hovered"]) == 28
    assert view.bounding_box() == place, "the eye view stays where it is"
    assert place["y"] >= 0 and place["y"] + place["height"] <= 800, "and is seen"
    assert explorer.reads("map-told").startswith("Cs₀ = (")
    explorer.page.mouse.move(5, 5)
    assert explorer.state()["hovered"], "it stays until another is pointed at"
    explorer.presses("map-close")
    assert explorer.state()["hovered"] is None
    assert explorer.page.locator("#robot").is_visible()
    assert explorer.complaints == []


def test_the_map_is_walked_with_the_keys_and_tells_what_is_there(parent):
    explorer = before_the_map(parent)
    assert explorer.focused() == "map"
    begun = explorer.until(lambda state: state["hovered"])["point"]
    told = explorer.reads("map-told")
    explorer.page.keyboard.press("ArrowUp")
    explorer.page.keyboard.press("ArrowLeft")
    assert explorer.state()["point"] == [begun[0] - 1, begun[1] + 1]
    assert explorer.reads("map-told") != told
    for _ in range(20):
        explorer.page.keyboard.press("ArrowRight")
    rim = explorer.state()["point"]
    explorer.page.keyboard.press("ArrowRight")
    assert explorer.state()["point"] == rim != begun, "it ends at the rim"
    shares = explorer.page.locator("#map-ways b").all_text_contents()
    assert sum(int(share.strip(" %")) for share in shares) == pytest.approx(100, abs=2)


@pytest.mark.slow
def test_a_finger_chooses_on_the_map_and_the_robot_comes_back_when_it_tries(open_page, taught):
    window = {"viewport": {"width": 390, "height": 844}, "has_touch": True}
    person = open_page(taught, **window).arrives()
    person.shows("UR ↓")
    person.page.get_by_test_id("map-draw").tap()
    person.page.locator("#map-ways li").first.wait_for()
    begun = person.until(lambda state: state["hovered"])["point"]
    person.page.get_by_test_id("map").tap(position={"x": 70, "y": 70})
    person.until(lambda state: state["point"] != begun)
    person.page.get_by_test_id("imitate").tap()
    person.until(lambda state: state["step"] == "performed" and not state["busy"])
    assert person.page.locator("#explore").is_hidden()
