"""What axe-core finds on the page; MOTIONESE_AXE names its file, axe.min.js (npm pack axe-core)."""

import os
from pathlib import Path

import pytest

AXE = os.environ.get("MOTIONESE_AXE", "")
LOOKS = {"light": {}, "dark": {"color_scheme": "dark"}, "forced": {"forced_colors": "active"}}
WIDTHS = {"390": (390, 844), "820": (820, 1180), "1280": (1280, 800), "200 %": (640, 400)}
"""Windows by name; at 200 % a window of 1280 px has room for 640."""
FOUND = """
async () => {
  const { violations } = await axe.run(document);
  return violations.map(({ id, nodes }) => [id, nodes.map(({ target }) => target.join(" "))]);
}
"""


@pytest.mark.slow
@pytest.mark.skipif(not AXE, reason="MOTIONESE_AXE does not name axe.min.js")
@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("look", LOOKS)
def test_axe_finds_nothing(look, width, open_page, taught):
    across, down = WIDTHS[width]
    window = {"viewport": {"width": across, "height": down}, **LOOKS[look]}
    window["reduced_motion"] = "reduce"  # colours on their way to others are not looked at
    if width == "200 %":
        window["device_scale_factor"] = 2
    person = open_page(taught, **window).arrives()
    person.page.evaluate(Path(AXE).read_text())
    found = {"arrived": person.page.evaluate(FOUND)}
    person.presses("demonstrate")
    person.until(lambda state: state["step"] == "judged" and not state["busy"])
    found["judged"] = person.page.evaluate(FOUND)
    if width != "200 %":  # the view is taller than that window
        person.draw_through(["UR", "UL", "LL"], rest_s=0.0)
        person.until(lambda state: "Pause at the corner" in person.guide() and not state["busy"])
        found["wished"] = person.page.evaluate(FOUND)
    person.lets_it_imitate()
    found["performed"] = person.page.evaluate(FOUND)
    person.presses("begin")
    found["asked"] = person.page.evaluate(FOUND)
    assert {moment: what for moment, what in found.items() if what} == {}
