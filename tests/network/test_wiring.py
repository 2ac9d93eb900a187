"""What is wired, and how large initial weights are."""

import jax
import numpy as np
import pytest

from motionese.network import MTRNN, Level, wiring
from motionese.network.wiring import draw_weights

SIZES = (30, 40, 25, 35)


def blocks(sizes):
    """Rows and columns of every block, and its pair of levels (receiving, sending)."""
    ends = np.cumsum((0, *sizes))
    for i in range(len(sizes)):
        for j in range(len(sizes)):
            yield (i, j), (slice(ends[i], ends[i + 1]), slice(ends[j], ends[j + 1]))


@pytest.mark.parametrize("sizes", [(2, 3), (2, 3, 1), (1, 1, 1, 1), SIZES])
def test_a_level_is_wired_to_itself_and_its_neighbours_only(sizes):
    mask = wiring(sizes)

    for (i, j), block in blocks(sizes):
        assert (mask[block] == (abs(i - j) <= 1)).all(), (i, j)


@pytest.mark.parametrize(
    ("scale", "senders"), [("fan_in", SIZES), ("one", (max(SIZES),) * len(SIZES))]
)
def test_initial_weights_have_the_scale_of_their_block(scale, senders):
    levels = [Level(size, 2.0) for size in SIZES]
    weights = np.asarray(MTRNN.draw(levels, key=jax.random.key(1), gain=3.0, scale=scale).weights)

    for (i, j), block in blocks(SIZES):
        if abs(i - j) > 1:
            assert not weights[block].any(), (i, j)
            continue
        deviation = 3.0 / np.sqrt(senders[j])
        count = weights[block].size
        # Five standard errors of a standard deviation, and of a mean.
        assert weights[block].std() == pytest.approx(deviation, rel=5 / np.sqrt(2 * count)), (i, j)
        assert abs(weights[block].mean()) < 5 * deviation / np.sqrt(count), (i, j)


def test_the_same_key_draws_the_same_weights_and_another_key_others():
    levels = [Level(3, 2.0), Level(5, 5.0)]
    first, again, other = (MTRNN.draw(levels, key=jax.random.key(k)).weights for k in (0, 0, 1))

    np.testing.assert_array_equal(first, again)
    assert (np.asarray(first) != np.asarray(other)).all()


def test_networks_of_one_key_share_the_weights_of_the_blocks_they_share():
    small, large = (
        draw_weights(sizes, 4.0, "fan_in", jax.random.key(3)) for sizes in ((3, 9), (3, 9, 2))
    )
    np.testing.assert_array_equal(large[:12, :12], small)
    firsts = [large[0, 0], large[0, 3], large[3, 0], large[3, 3], large[3, 12], large[12, 3]]
    assert len({float(first) for first in firsts}) == len(firsts)
