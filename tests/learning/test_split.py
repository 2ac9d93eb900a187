"""Motions to learn and motions held out: by share or by name, each in their order."""

from dataclasses import replace

import numpy as np
import pytest

from motionese import Motions, split
from motionese.errors import MotionError

TEN = Motions.from_arrays(
    [np.full((4, 1), i / 10) for i in range(10)], ["x"], 10.0, names=list("abcdefghij")
)
FOUR = TEN.chosen(list("abcd"))


@pytest.mark.parametrize(("share", "count"), [(None, 1), (0.0, 0), (0.01, 1), (0.3, 3), (0.9, 9)])
def test_a_share_is_drawn_and_nothing_is_lost(share, count):
    learned, unseen = split(TEN, share, seed=3)

    held_out = unseen.names if count else ()
    assert len(held_out) == count
    assert set(learned.names) | set(held_out) == set(TEN.names)
    assert list(learned.names) == sorted(learned.names)
    assert list(held_out) == sorted(held_out)


def test_the_draw_follows_from_the_seed():
    drawn = {seed: split(TEN, 0.3, seed=seed)[1].names for seed in range(5)}

    assert drawn[2] == split(TEN, 0.3, seed=2)[1].names
    assert len(set(drawn.values())) > 1


def test_names_are_held_out_in_the_order_of_the_motions():
    learned, unseen = split(FOUR, ["d", "a"])

    assert (learned.names, unseen.names) == (("b", "c"), ("a", "d"))
    assert unseen.values[1][0] == TEN.values[3][0]


def test_fewer_than_five_motions_are_all_learned():
    assert split(FOUR) == (FOUR, None)


def test_what_the_recording_sets_apart_is_held_out_unless_told_otherwise():
    apart = replace(TEN, held_out=("h", "b"))
    learned, unseen = split(apart)

    assert (len(learned), unseen.names) == (8, ("b", "h"))
    assert split(apart, 0.0)[1] is None
    assert split(apart, ["a"])[1].names == ("a",)
    assert split(apart.chosen(list("abc")))[1].names == ("b",)
    assert split(apart.chosen(list("acd")))[1] is None
    with pytest.raises(MotionError, match="held out b: leaves no motion to learn; --held-out 0"):
        split(apart.chosen(["b"]))


def test_what_is_set_apart_stays_so_in_a_file(tmp_path):
    replace(TEN, held_out=("h", "b")).chosen(list("abc")).write(tmp_path / "apart.npz")

    assert Motions.read(tmp_path / "apart.npz").held_out == ("b",)


@pytest.mark.parametrize(
    ("held_out", "said"),
    [
        (1, "held out 1: a share of the motions from 0 to below 1, or their names"),
        (-0.1, "held out -0.1: a share of the motions"),
        (list("abcd"), "held out a, b, c, d: leaves no motion to learn"),
        (["z"], "'z'"),
    ],
)
def test_what_cannot_be_held_out_is_refused(held_out, said):
    with pytest.raises(MotionError, match=said):
        split(FOUR, held_out)
