"""Words are explained where they stand, motions get names, and what was undone is not claimed."""

from page.person import Person

WORDS = {"caregiver", "primitive", "places", "tau", "io", "cf", "cs", "start", "loop"}
WORDS |= {"motionese", "pauses", "pace", "roundness"}


def note(person: Person):
    return person.page.get_by_test_id("word")


def test_every_word_is_explained_in_a_sentence_and_closed_by_escape(parent):
    there = parent.page.evaluate(
        "[...document.querySelectorAll('[data-word]')].map(w => w.dataset.word)"
    )
    assert set(there) == WORDS
    for word in sorted(WORDS):
        button = parent.page.locator(f"[data-word={word}]").first
        button.click()
        assert note(parent).is_visible() and button.get_attribute("popovertarget") == "word"
        assert note(parent).locator("p").first.inner_text().count(". ") == 0
        parent.page.keyboard.press("Escape")
        assert note(parent).is_hidden()
        focused = parent.page.evaluate("document.activeElement.dataset.word")
        assert focused == word, "who has read it is where they were"


def test_another_word_can_be_asked_for_while_one_is_explained(parent):
    tau, cf = (parent.page.locator(f"#terms [data-word={word}]") for word in ("tau", "cf"))
    tau.focus()
    parent.page.keyboard.press("Enter")
    assert "Yamashita & Tani 2008" in note(parent).inner_text()
    cf.focus()
    parent.page.keyboard.press("Enter")
    assert "fast context" in note(parent).inner_text()
    assert note(parent).is_visible()


def test_a_motion_of_ones_own_is_called_by_its_name_from_then_on(parent):
    shown = parent.state()["notebook"]
    parent.draw_through(["UR", "LL"])
    parent.until(lambda s: s["step"] == "judged" and s["notebook"] > shown)
    arrows = parent.page.get_by_test_id("verdict-arrows")
    called(parent, "UR wave")
    parent.page.get_by_text("choose another name").wait_for()
    called(parent, "big wave")
    arrows.get_by_text("big wave").wait_for()
    parent.until(lambda s: "I saw big wave" in parent.guide())
    assert "big wave" in parent.page.get_by_test_id("entry").first.inner_text()
    parent.page.reload()
    parent.until(lambda state: state["ready"] and state["notebook"])
    assert "big wave" in parent.page.get_by_test_id("notebook").inner_text()
    assert "big wave" in parent.reads("verdict-arrows"), "that is what would be imitated"
    parent.draw_through(["UR", "LL"])
    verdict = parent.until(lambda state: state["step"] == "judged")["verdict"]
    assert verdict["motion"] == "big wave", "it is recognised"


def called(person: Person, name: str) -> None:
    person.page.get_by_test_id("verdict-arrows").get_by_test_id("name").click()
    person.page.get_by_test_id("name-typed").fill(name)
    person.page.keyboard.press("Enter")


def test_what_was_undone_is_no_longer_claimed(parent):
    for motion in ("UR ←", "UR ↓"):
        parent.shows(motion)
    undo = parent.page.get_by_test_id("forget")
    undo.nth(1).click()
    parent.until(lambda state: not state["step"])
    assert parent.reads("claim") == "–", "it was said by a network that may be no more"
    assert parent.page.get_by_test_id("verdict-arrows").text_content().startswith("UR ↓")
    undo.first.click()
    parent.page.get_by_test_id("verdict-arrows").get_by_text("nothing yet").wait_for()
    assert parent.page.locator("#legend .drawn").is_hidden()
    assert parent.page.get_by_test_id("imitate").get_attribute("aria-disabled") == "true"
