"""Pictures of the page to be looked at, in the folder that MOTIONESE_PICTURES names."""

import os
from pathlib import Path

import pytest

LOOKS = {
    "light": {},
    "dark": {"color_scheme": "dark"},
    "touch": {"viewport": {"width": 1024, "height": 768}, "has_touch": True},
}


@pytest.mark.slow
@pytest.mark.parametrize("look", LOOKS)
def test_pictures(look, open_page, taught, tmp_path):
    folder = Path(os.environ.get("MOTIONESE_PICTURES", tmp_path))
    folder.mkdir(parents=True, exist_ok=True)
    person = open_page(taught, **LOOKS[look])

    def photographed(moment: str, **how) -> None:
        person.page.screenshot(path=folder / f"{look}-{moment}.png", **how)
        across = person.page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
        assert across[0] <= across[1], f"{moment}: the page is wider than the window"

    person.arrives()
    photographed("1-arrived")
    person.draws("UR ←↓")
    photographed("2-drawing")
    person.page.mouse.up()
    person.until(lambda state: state["step"] == "judged")
    photographed("3-judged")
    frames = person.state()["frames"]
    person.presses("imitate")
    person.until(lambda state: state["frames"] > frames + 20)
    photographed("4-imitating")
    person.until(lambda state: state["step"] == "performed" and not state["busy"])
    photographed("5-performed")
    person.presses("learn")
    person.until(lambda state: state["busy"])
    photographed("6-learning")
    person.until(lambda state: state["step"] == "learned" and not state["busy"])
    person.presses("map-draw")
    person.page.get_by_test_id("map").hover()
    person.until(lambda state: state["hovered"])
    person.page.evaluate("scrollTo(0, 0)")
    photographed("7-whole", full_page=True)
