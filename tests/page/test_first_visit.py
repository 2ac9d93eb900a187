"""A first visitor, who knows nothing and does what the one line says, sees the light go on."""

import time

import pytest
from page.serving import served
from page.visitor import obeys, rests_at

MOST_LESSONS = 20
"""Five turns of four, between the two pushes."""


@pytest.mark.slow
def test_who_does_what_the_line_says_sees_a_push_fail_and_then_the_light(open_page, tmp_path):
    with served(tmp_path, "babbling") as server:
        server.awake()
        began = time.monotonic()
        person = open_page(server).arrives()
        assert rests_at(person) == pytest.approx(person.place("UL"), abs=0.01)
        chapters, done = [person.reads("chapter")], []
        while not person.reads("chapter").startswith("4"):
            assert done.count("learn") < MOST_LESSONS, done
            done.append(obeys(person))
            if person.reads("chapter") != chapters[-1]:
                chapters.append(person.reads("chapter"))
                print(f"{time.monotonic() - began:.0f} s: {chapters[-1]}")
        assert done[:2] == ["draw", "imitate"]
        numbers = [chapter[:6] for chapter in chapters]
        # A newborn may press by chance: then there is nothing to practise.
        assert numbers[:2] == ["1 of 5", "2 of 5"] and numbers[-1] == "4 of 5"
        print(f"{done.count('learn')} lessons: {person.guide()}")
        assert "a pair" in person.guide()
        person.page.reload()
        person.until(lambda state: state["ready"] and state["notebook"])
        assert person.reads("chapter") == chapters[-1], "kept with the session"
