"""Pictures of the five chapters to be looked at, in the folder that MOTIONESE_PICTURES names.

Those in docs/chapters are made by `MOTIONESE_PICTURES=docs/chapters` with the slow tests.
"""

import io
import os
from pathlib import Path

import pytest
from page.person import Person
from page.serving import served
from page.visitor import obeys
from PIL import Image

WIDTHS = {390: 844, 820: 1180, 1280: 800}
SCHEMES = ("light", "dark")
LAST, MOST_DONE = 5, 60


def photographed(person: Person, folder: Path, chapter: int) -> None:
    """Take the window at every width, light and dark, and leave it as it was."""
    page, was = person.page, person.page.viewport_size
    for width, height in WIDTHS.items():
        page.set_viewport_size({"width": width, "height": height})
        page.evaluate("scrollTo(0, 0)")
        for scheme in SCHEMES:
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            page.wait_for_timeout(400)
            taken = Image.open(io.BytesIO(page.screenshot()))
            taken.save(folder / f"{chapter}-{width}-{scheme}.webp", quality=80, method=6)
        across = page.evaluate("[document.documentElement.scrollWidth, innerWidth]")
        assert across[0] <= across[1], f"chapter {chapter} is wider than {width} px"
    page.set_viewport_size(was)
    page.emulate_media(color_scheme="light", reduced_motion="no-preference")


@pytest.mark.slow
def test_the_five_chapters_fit_windows_of_three_widths(open_page, tmp_path):
    folder = Path(os.environ.get("MOTIONESE_PICTURES", tmp_path))
    folder.mkdir(parents=True, exist_ok=True)
    with served(tmp_path, "babbling") as server:
        server.awake()
        person = open_page(server).arrives()
        done: list[str] = []
        while person.reads("chapter"):
            assert len(done) < MOST_DONE, (done, person.guide())
            chapter = person.reads("chapter")[:1]
            done.append(obeys(person))
            # Every chapter as it ends, with what its act has left on the page.
            if person.reads("chapter")[:1] != chapter:
                photographed(person, folder, int(chapter))
        assert chapter == str(LAST) and done[-1] == "point"
    assert len(list(folder.glob("*.webp"))) == LAST * len(WIDTHS) * len(SCHEMES)
