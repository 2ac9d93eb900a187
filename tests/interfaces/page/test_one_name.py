"""A place has one name, whatever the page is told of it, and whatever stands on the page."""

import re
from pathlib import Path

import pytest

import motionese

OTHERS = re.compile(
    r"\b(upper|lower|top|bottom)[ _-](right|left)\b|\b(right|left|blue|green)[ _](button|light)\b",
    re.IGNORECASE,
)
"""What the corners and buttons could be called beside UR, UL, LR and LL."""
WEB = Path(motionese.__file__).parent / "interfaces" / "page" / "web"


def sentences(told, where=""):
    """All texts of a message that are shown: without shapes, and names that things go by."""
    if isinstance(told, dict):
        shown = {key: each for key, each in told.items() if key not in ("robot", "film")}
        for key, each in shown.items():
            yield from sentences(each, f"{where}.{key}")
    elif isinstance(told, list):
        for each in told:
            yield from sentences(each, where)
    elif isinstance(told, str):
        yield where, told


@pytest.mark.slow
def test_nothing_that_is_told_has_another_name_for_a_place(robot, told, does, draw_with):
    draw_with(robot, "LR ↑←")
    draw_with(robot, "UL ↓")
    for kind in ("imitate", "learn", "map"):
        does(kind)
    for kind in ("replay", "forget"):
        does(kind, entry=2)
    texts = {(where, text) for each in told for where, text in sentences(each)}
    explained = {(w, t) for w, t in texts if re.fullmatch(r"\.task\.places\.\w\w\.title", w)}
    assert len(explained) == 4, "what a name stands for is told where it is explained"
    ids = {(w, t) for w, t in texts if w.endswith((".task.effects.name", ".effect"))}
    wrong = {(w, t) for w, t in texts - explained - ids if OTHERS.search(t)}
    assert wrong == set()
    assert any("LL" in text for where, text in texts if where == ".sentence")
    kinds = {each["type"] for each in told}
    assert kinds >= {"scene", "session", "verdict", "performed", "learned", "map", "told"}


def test_nothing_on_the_page_has_another_name_for_a_place():
    for file in (*WEB.glob("*.js"), WEB / "index.html"):
        found = OTHERS.search(file.read_text(encoding="utf-8"))
        assert not found, f"{file.name}: {found}"
