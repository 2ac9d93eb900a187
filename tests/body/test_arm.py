"""The pneumatic arm: how fast it answers, how far it overshoots, how it gives way."""

import mujoco
import numpy as np
import pytest

from motionese.body.actroid import Actroid, ActroidSettings
from motionese.task import PUSHING_BUTTONS

NECK, AWAY = np.array([-0.3, 0.5]), np.array([1.3, 1.1, 0.95])
START, END = np.radians([8.0, 0.0]), np.radians([24.0, 0.0])


def simulation_of(stiffness):
    return Actroid(ActroidSettings(stiffness=stiffness), PUSHING_BUTTONS)._simulate()


def settled(simulation, command, steps=60):
    simulation.place(command, NECK, AWAY)
    for _ in range(steps):
        simulation.advance(command, NECK)
    return simulation.angles[:2]


def step_response(stiffness):
    """Share of a 16° shoulder step done after every physics step of 5 ms."""
    simulation = simulation_of(stiffness)
    settled(simulation, START)
    way = []
    # One physics step between two pictures, to look at every one of them.
    simulation.substeps = 1
    for _ in range(300):
        simulation.advance(END, NECK)
        way.append(simulation.angles[0])
    return (np.array(way) - START[0]) / (END - START)[0]


@pytest.mark.parametrize(
    ("stiffness", "fastest", "slowest", "overshoot"),
    [(15, 330, 410, 0.01), (30, 240, 300, 0.03), (80, 150, 210, 0.06)],
)
def test_step_response(stiffness, fastest, slowest, overshoot):
    way = step_response(stiffness)
    t63 = 5 * (np.argmax(way > 0.632) + 1)
    assert fastest <= t63 <= slowest
    assert way.max() < 1 + overshoot
    assert way[-1] == pytest.approx(1, abs=1e-3)


def test_dead_time_of_50_ms():
    way = step_response(30)
    assert np.abs(way[:10]).max() < 1e-9
    assert way[12] > 1e-5


@pytest.mark.parametrize("stiffness", [15.0, 30.0, 80.0])
def test_settles_on_the_command_where_nothing_is_touched(stiffness):
    simulation = simulation_of(stiffness)
    for command in np.random.default_rng(0).uniform(*np.radians([[-10, -30], [28, 30]]), (8, 2)):
        np.testing.assert_allclose(settled(simulation, command), command, atol=np.radians(0.01))


def test_gives_way_to_a_push_by_its_stiffness():
    deflections = []
    for stiffness in (15.0, 30.0, 60.0):
        simulation = simulation_of(stiffness)
        settled(simulation, START)
        before = simulation.marker("own")
        arm = simulation.model.body("arm").id
        mujoco.mj_applyFT(
            simulation.model,
            simulation.data,
            np.array([0, 0, 5.0]),
            np.zeros(3),
            before,
            arm,
            simulation.data.qfrc_applied,
        )
        for _ in range(60):
            simulation.advance(START, NECK)
        deflections.append(100 * np.linalg.norm(simulation.marker("own") - before))
    assert 3.5 < deflections[1] < 5.0
    np.testing.assert_allclose(np.divide(deflections, deflections[1]), [2, 1, 0.5], rtol=0.1)


def test_table_stops_the_fist(exact_body, rng):
    exact_body.reset(np.radians([50.0, 0.0]), rng)
    fist = exact_body.hand_position()[2] - 0.057 * np.cos(exact_body.sense()[0])
    assert 0.75 < fist < 0.76
