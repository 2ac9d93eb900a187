"""A lesson is saved as a film that plays anywhere, however long its pictures took to draw."""

import base64
from itertools import pairwise

import pytest

LOOKED_AT = """
async (encoded) => {
  const bytes = Uint8Array.from(atob(encoded), (one) => one.charCodeAt(0));
  const video = document.createElement("video");
  const happened = (what) =>
    new Promise((done) => video.addEventListener(what, done, { once: true }));
  video.muted = true;
  video.src = URL.createObjectURL(new Blob([bytes], { type: "video/webm" }));
  await happened("loadeddata");
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: 96, height: 54 });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const pictures = [];
  for (const share of [0.02, 0.1, 0.5, 0.97]) {
    video.currentTime = share * video.duration;
    await happened("seeked");
    context.drawImage(video, 0, 0, 96, 54);
    pictures.push([...context.getImageData(0, 0, 96, 54).data]);
  }
  const { duration, videoWidth, videoHeight, error } = video;
  return { duration, size: [videoWidth, videoHeight], error, pictures };
}
"""
"""Has the browser play a film, and returns what it is and four of its pictures."""


@pytest.fixture
def pupil(open_page, taught):
    """A person whose robot has had a lesson of one stroke."""
    person = open_page(taught).arrives()
    assert person.page.get_by_test_id("film").is_hidden(), "there is no lesson yet"
    person.shows("UR ↓")
    person.presses("learn")
    person.until(lambda state: state["tries"])
    person.presses("skip")
    person.until(lambda state: state["step"] == "learned" and not state["busy"])
    return person


def filmed(person):
    """Press the button, and return the film's name and content."""
    with person.page.expect_download(timeout=120_000) as saved:
        person.presses("film")
    return saved.value.suggested_filename, saved.value.path().read_bytes()


@pytest.mark.slow
def test_a_lesson_is_saved_as_a_film_that_plays(pupil):
    name, content = filmed(pupil)
    assert name == "motionese-ur-down-robot-1.webm"
    assert content[:4] == b"\x1a\x45\xdf\xa3" and b"webm" in content[:64]
    film = pupil.page.evaluate(LOOKED_AT, base64.b64encode(content).decode())
    assert film["error"] is None and film["size"] == [960, 540]
    told = pupil.state()["film"]
    assert 5 <= told["seconds"] <= 15
    assert film["duration"] == pytest.approx(told["seconds"], abs=0.1)
    changes = [differing(*pair) for pair in pairwise(film["pictures"])]
    assert min(changes) > 0.01, "it moves"
    assert pupil.complaints == [], "the page's policy lets it be"


LASTING = """
async (motions) => {
  const { timeline } = await import("/static/lesson_film.js");
  const lasts = (parts) => parts.reduce((sum, one) => sum + one.seconds, 0);
  return motions.map((seconds) => lasts(timeline(seconds, 6, 3)));
}
"""
"""How long the films of lessons are whose motions last so many seconds."""


@pytest.mark.slow
def test_a_film_is_short_however_long_the_motion(person):
    lengths = person.page.evaluate(LASTING, [0.3, 1.3, 2.7, 4.1, 20])
    assert lengths == sorted(lengths)
    assert lengths[0] >= 5 and lengths[-1] <= 15


def differing(one, other):
    """The share of values of two pictures that differ clearly."""
    return sum(abs(a - b) > 24 for a, b in zip(one, other, strict=True)) / len(one)


@pytest.mark.slow
def test_a_browser_without_an_encoder_makes_a_gif_and_a_film_can_be_left_off(pupil):
    pupil.page.evaluate("delete window.VideoEncoder")
    pupil.presses("film")
    button = pupil.page.get_by_test_id("film")
    button.get_by_text("Cancel").wait_for()
    pupil.presses("film")
    button.get_by_text("Film").wait_for()
    assert pupil.state()["film"] is None, "nothing was saved"
    name, content = filmed(pupil)
    assert name.endswith(".gif") and content[:6] == b"GIF89a"
    pictures = content.count(b"\x21\xf9\x04")
    delay = int.from_bytes(content[content.index(b"\x21\xf9\x04") + 4 :][:2], "little")
    assert pictures * delay / 100 == pytest.approx(pupil.state()["film"]["seconds"], abs=0.1)
