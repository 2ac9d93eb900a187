"""The networks whose weights are written by hand make the motions that they are said to make."""

import numpy as np
import pytest
from by_hand.network import rollout, sigmoid
from by_hand.role_networks import (
    BEGINS,
    CHANNELS,
    CROSSING,
    DIRECTIONS,
    FIRST,
    MOTIONS,
    ROWS,
    TOLD_BY_CS,
    bearing,
    role_network,
    sequence_of,
)

from motionese.learning import generate
from motionese.network import wiring

CORNER = {"right": (0, 1), "left": (0, -1), "up": (1, 1), "down": (1, -1)}


@pytest.mark.parametrize("name", TOLD_BY_CS)
@pytest.mark.parametrize("motion", MOTIONS)
def test_every_motion_goes_to_its_side_and_on_in_its_order(name, motion):
    made = role_network(name)
    network = made.network
    path = generate(network, made.states[motion], ROWS, first=FIRST)

    at_rest, end = path[BEGINS[1] - 2 : BEGINS[1]], path[-1]
    for stroke in motion:
        axis, sign = CORNER[stroke]
        assert sign * end[axis] > 0.15
    axis, sign = CORNER[motion[0]]
    assert (sign * at_rest[:, axis] > 0.15).all()
    assert (np.abs(at_rest[:, 1 - axis]) < 0.01).all()

    parts = (np.asarray(part, dtype=float) for part in (network.weights, network.bias, network.tau))
    first = np.zeros((ROWS, 2))
    first[0] = CHANNELS.to_unit(FIRST)
    share = np.zeros((ROWS, 2))
    share[0] = 1.0
    by_hand = rollout(*parts, network.sizes, made.states[motion], first, share)
    unit = [[sigmoid(u) for u in row[:2]] for row in by_hand[1:]]
    np.testing.assert_allclose(path[1:], CHANNELS.from_unit(np.array(unit)), atol=1e-4)


@pytest.mark.parametrize("name", TOLD_BY_CS)
def test_nothing_is_wired_that_may_not_be(name):
    network = role_network(name).network
    assert np.array_equal(network.wired_weights(), network.weights)
    assert not np.asarray(network.weights)[~wiring(network.sizes)].any()


def test_the_levels_hold_what_they_decide():
    def values(name, level):
        made = role_network(name)
        return len({tuple(state[made.network.units(level)]) for state in made.states.values()})

    assert {name: (values(name, "cf"), values(name, "cs")) for name in TOLD_BY_CS} == {
        "separate": (2, 2),
        "all_in_cf": (4, 1),
        "all_in_cs": (1, 4),
    }


def test_the_motions_are_sequences_of_a_task():
    assert [s.name for s in CROSSING.sequences(2)] == [sequence_of(m).name for m in MOTIONS]
    azimuth, elevation = bearing(np.array([0.1, 0.2]))
    assert (azimuth, elevation) == (-0.1, 0.2)
    assert set(DIRECTIONS) == {stroke for motion in MOTIONS for stroke in motion}
