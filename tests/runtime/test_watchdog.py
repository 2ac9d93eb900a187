"""The watchdog, and the machine's own clock: the few tests that wait, for fractions of a second."""

import time

import pytest

from motionese.runtime import ControlLoop, Ending, Part
from motionese.runtime.timing import Clock, Once, Watchdog

HERE = {"lift": 0.4}


@pytest.mark.parametrize("where", ["sense", "act"])
def test_a_cycle_that_hangs_stops_the_robot_once_and_sends_nothing_more(model, where):
    stops, sent = [], []

    def hangs():
        if len(sent) == 2 and not stops:
            began = time.perf_counter()
            while not stops and time.perf_counter() < began + 10:
                time.sleep(0.01)
            time.sleep(0.1)

    def sense():
        if where == "sense":
            hangs()
        return HERE

    def act(commands):
        if where == "act":
            hangs()
        sent.append(commands)

    loop = ControlLoop(model, sense, act, watchdog_s=0.15, stop=lambda: stops.append(len(sent)))
    ran = loop.run("reach")

    assert stops == [2]
    assert ran.ending is Ending.HUNG
    assert len(sent) == ran.steps == (2 if where == "sense" else 3)
    assert "did not return for more than 0.15 s" in ran.sentence


def test_a_hang_in_the_last_cycle_is_told(model):
    stops = []
    loop = ControlLoop(
        model,
        lambda: HERE,
        lambda _: time.sleep(0.3),
        watchdog_s=0.15,
        stop=lambda: stops.append(1),
    )

    assert loop.run(Part("reach", 1)).ending is Ending.HUNG
    assert stops == [1]


def test_a_loop_that_lives_is_left_alone(model):
    stops, began = [], time.perf_counter()
    ran = ControlLoop(
        model, lambda: HERE, lambda _: None, watchdog_s=0.15, stop=lambda: stops.append(1)
    ).run(Part("reach", 8))

    assert ran.ending is Ending.DONE
    assert stops == []
    assert time.perf_counter() - began > 7 / 20


def test_the_watchdog_ends_with_its_block():
    with Watchdog(5.0, lambda: None) as watchdog:
        thread = watchdog._thread
        assert thread.is_alive()
    assert not thread.is_alive()


def test_once_is_once_and_nothing_is_nothing():
    calls = []
    once = Once(lambda: calls.append(1))
    once()
    once()
    Once(None)()
    assert calls == [1]


def test_the_clock_is_never_early_and_does_not_wait_for_the_past():
    clock = Clock()
    moment = clock.now() + 0.02
    clock.sleep_until(moment)
    assert clock.now() >= moment
    clock.sleep_until(moment - 10)
    assert clock.now() < moment + 5
