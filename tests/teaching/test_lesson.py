"""Which network a lesson keeps, and how it and growth are told."""

import pytest
from hypothesis import given
from hypothesis import strategies as some

from motionese.teaching.claim import Claim
from motionese.teaching.lesson import Lesson, growth_in_words, kept_practice
from motionese.teaching.notebook import Change
from motionese.teaching.result import Push, Result

errors = some.floats(0, 30)


@given(some.lists(some.tuples(errors, errors, some.integers(0, 2)), min_size=2, max_size=7))
def test_what_is_kept_is_never_worse_and_the_best_of_these(outcomes):
    taught, overall, missed = zip(*outcomes, strict=True)
    kept = kept_practice(taught, lambda n: overall[n], missed)
    no_worse = [
        n
        for n, each in enumerate(outcomes)
        if all(now <= then for now, then in zip(each, outcomes[0], strict=True))
    ]
    assert kept in no_worse and (kept or no_worse == [0])
    assert all((missed[kept], taught[kept]) <= (missed[n], taught[n]) for n in no_worse[1:])


def test_a_push_that_is_made_counts_more_than_nearness_and_is_not_lost_again():
    assert kept_practice([4.0, 1.0, 2.0], lambda n: 1.0, [1, 1, 0]) == 2
    assert kept_practice([4.0, 1.0, 5.0], lambda n: 1.0, [1, 1, 0]) == 1, "but not if it is worse"
    assert kept_practice([4.0, 1.0, 2.0], lambda n: 1.0, [0, 1, 1]) == 0


def test_the_others_are_looked_at_only_where_it_may_be_kept():
    asked = []
    missed = [0] * 4
    assert kept_practice([4.0, 6.0, 2.0, 3.0], lambda n: asked.append(n) or 1.0, missed) == 2
    assert asked == [0, 2]


@pytest.mark.parametrize(
    ("tries", "kept", "said"),
    [
        ((4.8, 2.0, 1.1), 2, "4.8 → 1.1 cm, and it pressed LR: 6.1 mm"),
        ((4.8, 2.0, 1.1), 0, "I kept what I knew before: practising this made others worse."),
        ((4.8, 5.0, 6.1), 0, "I kept what I knew before: practice did not make it better."),
    ],
)
def test_a_lesson_is_told_in_a_sentence(tries, kept, said):
    changes = (Change("UR ↓", tries[0], tries[kept]),)
    result = Result(tries[kept], (Push("right_button", "LR", 6.1, 5.0),))
    claim = Claim(1.0, 1.0, (), "UR ↓", 0.1, result)
    lesson = Lesson(1, tries, kept, changes, result, claim, (0, 0, 0))
    assert lesson.sentence.startswith(said)
    assert "it pressed LR" in lesson.sentence


def test_growth_tells_what_got_worse_and_what_to_do():
    changes = [Change("UR ↓", 1.0, 2.0), Change("UR ←", 2.0, 1.0), Change("LR ↑", 1.0, 3.0)]
    said = growth_in_words(changes)
    assert "2 of 3 got worse (UR ↓, LR ↑); practise them again." in said
    assert "nothing got worse" in growth_in_words(changes[1:2])
