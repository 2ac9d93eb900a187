"""Decoders against their twin, cases whose answer is known, and the networks written by hand."""

import numpy as np
import pytest
from by_hand.decoders import r_squared, share_right
from hypothesis import given
from hypothesis import strategies as st

from motionese.imitation.roles.decoders import PENALTY, class_score, decoded, ridge, value_score

seeds = st.integers(0, 2**32 - 1)


def demonstrations(seed, motions=3, rounds=3, units=4):
    """Activity of random length, what it tells in part as values and as classes, and rounds."""
    rng = np.random.default_rng(seed)
    numbers = np.repeat(np.arange(rounds), motions).tolist()
    activity = [rng.uniform(size=(rng.integers(2, 6), units)) for _ in numbers]
    code = rng.normal(size=(units, 2))
    values = [y @ code + 0.3 * rng.normal(size=(len(y), 2)) for y in activity]
    thirds = np.quantile(np.concatenate(values)[:, 0], [1 / 3, 2 / 3])
    labels = [["ABC"[i] for i in np.digitize(value[:, 0], thirds)] for value in values]
    return activity, labels, values, numbers


@given(seeds)
def test_scores_equal_the_twin(seed):
    activity, labels, values, rounds = demonstrations(seed)
    found = class_score(activity, labels, rounds)
    assert found.score == pytest.approx(share_right(activity, labels, rounds))
    every = [name for own in labels for name in own]
    assert found.chance == pytest.approx(max(every.count(name) for name in every) / len(every))
    expected = r_squared(activity, values, rounds)
    assert value_score(activity, values, rounds) == pytest.approx((expected, 0.0))


@given(seeds, st.floats(1e-3, 1e3))
def test_the_scale_of_the_activity_does_not_matter(seed, scale):
    activity, labels, values, rounds = demonstrations(seed)
    scaled = [scale * y for y in activity]
    assert class_score(scaled, labels, rounds) == class_score(activity, labels, rounds)
    assert value_score(scaled, values, rounds) == pytest.approx(
        value_score(activity, values, rounds)
    )


def test_of_one_unit_a_ridge_is_a_slope_that_the_penalty_shrinks():
    x = np.array([[0.0], [1.0], [2.0]])
    told = ridge(x, 3 * x + 5)
    np.testing.assert_allclose(told(np.array([[4.0]])), 8 + 3 * 3 / (1 + PENALTY))
    shrunk = 1 - (PENALTY / (1 + PENALTY)) ** 2
    assert value_score([x, x], [3 * x, 3 * x], [1, 2]) == pytest.approx((shrunk, 0.0))


def test_a_demonstration_is_never_decoded_by_its_own_rows():
    """Units that tell one demonstration each tell nothing of another one's motion."""
    motions, rounds = ["A", "B", "C"] * 2, [1] * 3 + [2] * 3
    labels = [[name] * 5 for name in motions]
    by_itself = [np.tile(np.eye(6)[i], (5, 1)) for i in range(6)]
    assert class_score(by_itself, labels, rounds) == pytest.approx((1 / 3, 1 / 3))
    by_motion = [np.tile(np.eye(3)["ABC".index(name)], (5, 1)) for name in motions]
    assert class_score(by_motion, labels, rounds) == pytest.approx((1.0, 1 / 3))


def test_where_nothing_can_be_decoded_there_is_no_score():
    activity, labels, values, rounds = demonstrations(0)
    same = [np.full_like(y, 0.5) for y in activity]
    assert class_score(same, labels, rounds) is None
    assert value_score(same, values, rounds) is None
    assert class_score(activity, [["A"] * len(y) for y in activity], rounds) is None
    assert class_score(activity, labels, [1] * len(rounds)) is None
    assert value_score(activity, values, [1] * len(rounds)) is None
    once = [["D"] * len(y) for y in activity[:1]] + labels[1:]
    assert class_score(activity, once, rounds) is None


def scores(lesson, **columns):
    rows = decoded(lesson)
    return [
        r["score"] for r in rows if all(r.get(name) == value for name, value in columns.items())
    ]


def test_where_cs_decides_the_order_it_tells_it_first(lesson_of):
    """Cf hears it from Cs: in the first row there is nothing of it there, soon there is."""
    lesson = lesson_of("separate", demonstrations=6)
    assert set(scores(lesson, level="cs", what="order")) == {1.0}
    assert np.mean(scores(lesson, level="cf", what="order", row=-14)) < 0.7
    assert set(scores(lesson, level="cf", what="order", row=-10)) == {1.0}


def test_where_cf_decides_all_cs_tells_nothing(lesson_of):
    lesson = lesson_of("all_in_cf", demonstrations=6)
    assert set(scores(lesson, level="cf", what="order")) == {1.0}
    assert np.mean(scores(lesson, level="cs", what="order")) < 0.7
    (cf,), (cs,) = (scores(lesson, level=level, what="direction") for level in ("cf", "cs"))
    assert cf > 0.9 and cs < 0.4
    (cf,), (cs,) = (scores(lesson, level=level, what="position") for level in ("cf", "cs"))
    assert cf > 0.8 and cs < 0.1


def test_where_cs_decides_all_it_tells_direction_and_order(lesson_of):
    lesson = lesson_of("all_in_cs", demonstrations=6)
    assert set(scores(lesson, level="cs", what="order")) == {1.0}
    assert np.mean(scores(lesson, level="cf", what="order", row=-14)) < 0.7
    (direction,) = scores(lesson, level="cs", what="direction")
    assert direction > 0.5


def test_every_row_of_every_beginning_is_decoded_by_itself(lesson_of):
    rows = decoded(lesson_of("separate"))
    orders = [row for row in rows if row["what"] == "order" and row["level"] == "cs"]
    assert [(row["beginning"], row["row"]) for row in orders] == [
        (beginning, row) for beginning in ("middle →", "middle ←") for row in range(-14, 14)
    ]
    assert orders[0] == {
        "level": "cs",
        "what": "order",
        "beginning": "middle →",
        "row": -14,
        "score": 1.0,
        "chance": 0.5,
    }
    assert [(r["level"], r["what"], r["chance"]) for r in rows if r["what"] != "order"] == [
        (level, what, chance)
        for level in ("cf", "cs")
        for what, chance in (("direction", 0.25), ("position", 0.0))
    ]


def test_what_does_not_branch_has_no_order(lesson_of):
    lesson = lesson_of("separate", motions=[("right", "up"), ("left", "down")])
    assert {row["what"] for row in decoded(lesson)} == {"direction", "position"}


def test_one_demonstration_is_not_decoded_and_neither_is_a_level_at_rest(lesson_of):
    assert decoded(lesson_of("separate", motions=())) == []
    assert decoded(lesson_of("separate", demonstrations=1)) == []
    assert {row["level"] for row in decoded(lesson_of("all_in_cf", scatter=0.0))} == {"cf"}
