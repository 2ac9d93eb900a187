"""Random keys depend on seed and purpose alone."""

import numpy as np

from motionese.imitation.keys import generator_for, key_for


def test_keys_differ_by_seed_and_by_purpose_and_by_nothing_else():
    purposes = [(), ("a",), ("b",), ("a", 1), ("a", 2), (1, "a"), ("a", "b"), ("b", "a")]
    draws = {
        (seed, purpose): generator_for(seed, *purpose).random()
        for seed in (0, 1)
        for purpose in purposes
    }
    assert len(set(draws.values())) == len(draws)
    assert key_for(3, "training", 7) == key_for(3, "training", 7)
    assert np.array_equal(generator_for(3, "x").random(5), generator_for(3, "x").random(5))
