"""How far a way extends: against all pairs."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.kinematics.shape import extent


@given(seed=st.integers(0, 1000), count=st.integers(1, 700), width=st.integers(1, 5))
def test_the_extent_is_the_largest_of_all_distances(seed, count, width):
    points = np.random.default_rng(seed).normal(size=(count, width)) ** 3
    apart = np.linalg.norm(points[:, None] - points[None], axis=-1)
    assert extent(points) == pytest.approx(apart.max())


def test_of_a_circle_it_is_the_diameter():
    angles = np.linspace(0, 2 * np.pi, 3001)
    assert extent(np.stack([np.cos(angles), np.sin(angles)], axis=1)) == pytest.approx(2.0)
