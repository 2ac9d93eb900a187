"""The robot's control loop: sense, predict, act, at a fixed rate and within limits."""

from collections.abc import Callable
from threading import Event

import numpy as np

from motionese.errors import ControlError
from motionese.runtime.clock import Clock, MonotonicClock
from motionese.runtime.limits import Limiter, Limits
from motionese.runtime.model import RuntimeModel
from motionese.runtime.parts import Part, scheduled
from motionese.runtime.player import Share, shares
from motionese.runtime.ran import Ended, Ran
from motionese.runtime.readings import Reading
from motionese.runtime.run import Run, Setup
from motionese.runtime.watchdog import Once, Watchdog

SAME_RATE = 1e-3
"""Rates that differ by no more than this share are the same."""


class ControlLoop:
    """Plays motions on a robot.

    A cycle takes a reading, has the network predict the next row, holds it within the limits and
    hands it to the robot, which is to be there when the next cycle begins. Cycles begin on a grid
    of the monotonic clock; one that takes longer than its period is counted, and the periods that
    it ran over are skipped.

    On a computer that does other work beside, a process needs real-time priority to be on time
    (on Linux `chrt -f 50 python robot.py`).
    """

    def __init__(
        self,
        model: RuntimeModel,
        sense: Callable[[], Reading],
        act: Callable[[dict[str, float]], object],
        *,
        rate_hz: float | None = None,
        share: Share = 0.0,
        limits: Limits | None = None,
        watchdog_s: float = 0.5,
        stop: Callable[[], None] | None = None,
        clock: Clock | None = None,
    ) -> None:
        """Set a loop up.

        Args:
            model: The model.
            sense: Returns a reading in the channels' units, or None if there is no new one. It
                must not wait for one.
            act: Sends commands, in the channels' units by name.
            rate_hz: Cycles per second [Hz], which must be the model's; needed only where the model
                does not tell its rate.
            share: How much of the network's input is sensed, see `Player`.
            limits: Limits of the commands; the model's ranges where left out.
            watchdog_s: How long [s] sensors may be silent, and how long a cycle may hang.
            stop: Brings the robot to a halt. It is called once, from another thread if need be:
                when a cycle hangs, sensors fall silent, `sense` or `act` raises, a prediction is
                not finite, or Ctrl-C is pressed.
            clock: The machine's monotonic clock where left out.

        Raises:
            ControlError: Another rate than the model's, a share, limit or watchdog out of range,
                a channel that does not exist.
        """
        rate = _agreed_rate(model, rate_hz)
        if not 2 / rate < watchdog_s < np.inf:
            raise ControlError(
                f"watchdog_s must be finite and more than two periods ({2 / rate:g} s at "
                f"{rate:g} Hz), got {watchdog_s:g} s"
            )
        self._setup = Setup(
            model=model,
            sense=sense,
            act=act,
            rate_hz=rate,
            share=share,
            limits=limits or Limits(),
            watchdog_s=watchdog_s,
            clock=clock or MonotonicClock(),
            asked_to_end=Event(),
        )
        self._stop = stop
        # What is out of range is told here, before the robot is sent anything.
        shares(model, share)
        Limiter(model, self._setup.limits, rate)

    def end(self) -> None:
        """Ask the loop to end before its next command: from `sense`, `act` or another thread.

        Asked between two runs, the next one ends at once.
        """
        self._setup.asked_to_end.set()

    def run(self, *parts: Part | str) -> Ran:
        """Play motions one after another, from where the robot is.

        The first reading places the robot; until it has come nothing is sent. A channel that it
        leaves out is taken to be where the motion was recorded. Where the robot is elsewhere, it
        passes into the first motion as from one motion to another, see `Part.blend`.

        Raises:
            ControlError: A motion that the model does not know, a reading that does not fit its
                channels, or a first one far outside the limits. `stop` is called before any error
                of a running loop is raised.
        """
        schedule = scheduled(self._setup.model, parts)
        stop = Once(self._stop)
        with Watchdog(self._setup.watchdog_s, stop) as watchdog:
            try:
                ran = Run(self._setup, watchdog).play(schedule)
            except BaseException:
                stop()
                raise
            finally:
                self._setup.asked_to_end.clear()
            if ran.ended not in {Ended.DONE, Ended.STOPPED}:
                stop()
        return ran


def _agreed_rate(model: RuntimeModel, rate_hz: float | None) -> float:
    """Return the rate [Hz] that a loop runs at."""
    rate = model.rate_hz if rate_hz is None else rate_hz
    if rate is None:
        raise ControlError(
            "the model's file does not tell its rate: give rate_hz, that of the recordings"
        )
    if not 0 < rate < np.inf:
        raise ControlError(f"rate_hz must be finite and > 0, got {rate}")
    if model.rate_hz is not None and abs(rate / model.rate_hz - 1) > SAME_RATE:
        raise ControlError(
            f"the loop is to run at {rate:g} Hz, but the model learned motions of "
            f"{model.rate_hz:g} Hz: change the model's rate by model.with_rate({rate:g}), "
            f"or train it on recordings of {rate:g} Hz"
        )
    return rate
