"""The robot's control loop: sense, predict, act, at a fixed rate and within limits."""

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from threading import Event

import numpy as np
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import ControlError
from motionese.runtime.belief import NONE
from motionese.runtime.limits import Limiter, Limits
from motionese.runtime.loop_report import SENTENCES, Ending, LoopReport
from motionese.runtime.model import Reading, RuntimeModel, row_of
from motionese.runtime.online_recognition import OnlineRecognition
from motionese.runtime.player import Player, Share, shares
from motionese.runtime.schedule import Part, ScheduledPart, schedule
from motionese.runtime.timing import Clock, Once, Pace, Watchdog

SAME_RATE = 1e-3
"""Rates that differ by no more than this share are the same."""


@refusing(ControlError)
@dataclass(frozen=True, eq=False)
class ControlLoop:
    """Plays motions on a robot.

    A cycle takes a reading, has the network predict the next row, holds it within the limits and
    hands it to the robot, which is to be there when the next cycle begins. Cycles begin on a grid
    of the monotonic clock; one that takes longer than its period is counted, and the periods that
    it ran over are skipped.

    On a computer that does other work beside, a process needs real-time priority to be on time
    (on Linux `chrt -f 50 python robot.py`).

    Attributes:
        model: The model.
        sense: Returns a reading in the channels' units, or None if there is no new one. It must
            not wait for one.
        act: Sends commands, in the channels' units by name.
        rate_hz: Cycles per second [Hz], which must be the model's; needed only where the model
            does not tell its rate.
        share: How much of the network's input is sensed, see `Player`.
        limits: Limits of the commands; the model's ranges where left out.
        watchdog_s: How long [s] sensors may be silent, and how long a cycle may hang.
        stop: Brings the robot to a halt. It is called once, from another thread if need be: when a
            cycle hangs, sensors fall silent, `sense` or `act` raises, a prediction is not finite,
            or Ctrl-C is pressed.
        clock: The machine's monotonic clock where left out.

    Raises:
        ControlError: Another rate than the model's, a share, limit or watchdog out of range, a
            channel that does not exist.
    """

    model: RuntimeModel
    sense: Callable[[], Reading]
    act: Callable[[dict[str, float]], object]
    _: KW_ONLY
    rate_hz: float | None = None
    share: Share = 0.0
    limits: Limits = field(default_factory=Limits)
    watchdog_s: float = 0.5
    stop: Callable[[], None] | None = None
    clock: Clock = field(default_factory=Clock)
    _asked_to_end: Event = field(default_factory=Event, init=False, repr=False)

    def __post_init__(self) -> None:
        # What is out of range is told here, before the robot is sent anything.
        rate = _agreed_rate(self.model, self.rate_hz)
        if not 2 / rate < self.watchdog_s < np.inf:
            raise ControlError(
                f"watchdog_s must be finite and more than two periods ({2 / rate:g} s at "
                f"{rate:g} Hz), got {self.watchdog_s:g} s"
            )
        shares(self.model, self.share)
        Limiter(self.model, self.limits, rate)

    def end(self) -> None:
        """Ask the loop to end before its next command: from `sense`, `act` or another thread.

        Asked between two runs, the next one ends at once.
        """
        self._asked_to_end.set()

    @refusing(ControlError)
    def run(self, *parts: Part | str | int) -> LoopReport:
        """Play motions one after another, from where the robot is.

        The first reading places the robot; until it has come nothing is sent. A channel that it
        leaves out is taken to be where the motion was recorded. Where the robot is elsewhere, it
        passes into the first motion as from one motion to another, see `Part.blend`.

        Raises:
            ControlError: A motion that the model does not know, a reading that does not fit its
                channels, or a first one far outside the limits. `stop` is called before any error
                of a running loop is raised.
        """
        scheduled = schedule(self.model, parts)
        return self._ran(lambda run: run.play(scheduled))

    @refusing(ControlError)
    def follow(self, recognition: OnlineRecognition, steps: int, *, lag: int = 2) -> LoopReport:
        """Follow a motion while it is shown, so many rows behind it.

        What `sense` returns are readings of the demonstration, beside those of the robot's own
        joints. A cycle recognises it by the reading and sends the row that was, or will be, due.
        While what is shown is most likely none of the learned motions, the robot holds still.

        Args:
            recognition: With the same model; it has observed nothing yet.
            steps: Cycles until it ends.
            lag: Rows that the robot is behind; with 0 it sends what is predicted.

        Raises:
            ControlError: Another model, a lag below 0, no row ahead for a lag of 0, or as of `run`.
        """
        if recognition.model is not self.model:
            raise ControlError("the loop and its recognition must have the same model")
        if lag < 0 or steps < 0:
            raise ControlError(f"lag and steps must be 0 or more, got {lag} and {steps}")
        if lag == 0 and recognition.ahead == 0:
            raise ControlError("a lag of 0 sends what is predicted: recognise with ahead ≥ 1")
        return self._ran(lambda run: run.follow(recognition, steps, lag))

    def _ran(self, how: Callable[["_Run"], LoopReport]) -> LoopReport:
        stop = Once(self.stop)
        with Watchdog(self.watchdog_s, stop) as watchdog:
            try:
                report = how(_Run(self, watchdog, self._asked_to_end))
            except BaseException:
                stop()
                raise
            finally:
                self._asked_to_end.clear()
            if report.ending not in {Ending.DONE, Ending.STOPPED}:
                stop()
        return report


class _Run:
    """One run of a loop: what passes from cycle to cycle."""

    def __init__(self, loop: ControlLoop, watchdog: Watchdog, asked_to_end: Event) -> None:
        self._loop, self._watchdog, self._asked_to_end = loop, watchdog, asked_to_end
        rate = _agreed_rate(loop.model, loop.rate_hz)
        self._limiter = Limiter(loop.model, loop.limits, rate)
        self._pace = Pace(loop.clock, rate)
        self._heard, self._steps = loop.clock.now(), 0
        self._before = np.empty(0)

    def play(self, parts: list[ScheduledPart]) -> LoopReport:
        """Play the parts and tell how it went."""
        return self._report(self._play(parts))

    @refusing(ControlError)
    def follow(self, recognition: OnlineRecognition, steps: int, lag: int) -> LoopReport:
        """Follow what is shown and tell how it went."""
        return self._report(self._follow(recognition, steps, lag))

    def _report(self, ending: Ending) -> LoopReport:
        patience = self._loop.watchdog_s
        return LoopReport(
            steps=self._steps,
            missed=self._pace.missed,
            skipped=self._pace.skipped,
            worst_lateness_s=self._pace.worst_lateness_s,
            clamped=self._limiter.clamped,
            slowed=self._limiter.slowed,
            ending=ending,
            sentence=SENTENCES[ending].format(steps=self._steps, patience=patience),
        )

    def _placed(self) -> ndarray | Ending:
        """Return the first reading, or why none came; nothing is sent until then."""
        reading = self._sensed()
        while not np.isfinite(reading).any():
            if ending := self._over():
                return ending
            self._pace.done()
            reading = self._sensed()
        self._limiter.check_start(reading)
        return reading

    def _follow(self, recognition: OnlineRecognition, steps: int, lag: int) -> Ending:
        reading = self._placed()
        if isinstance(reading, Ending):
            return reading
        for _ in range(steps):
            if self._steps:
                reading = self._sensed()
            if ending := self._over():
                return ending
            known = recognition.observe(reading)
            row = known.expected(known.row + 1 - lag)
            if not np.isfinite(row).all():
                return Ending.NOT_FINITE
            if self._steps == 0:
                self._before = np.where(np.isfinite(reading), reading, row)
            holds = known.likeliest == NONE or known.row + 1 <= lag
            self._send(self._before if holds else row)
        return Ending.HUNG if self._watchdog.barked else Ending.DONE

    def _play(self, parts: list[ScheduledPart]) -> Ending:
        reading = self._placed()
        if isinstance(reading, Ending):
            return reading
        model = self._loop.model
        player = Player(model, model.begin(parts[0].start, reading), self._loop.share)
        self._before = np.where(np.isfinite(reading), reading, player.row)
        for place, part in enumerate(parts):
            if place:
                player.blend_to(part.start, part.blend)
            else:
                player.set_out(part.blend)
            for _ in range(part.steps):
                if self._steps:
                    reading = self._sensed()
                if ending := self._over() or self._acted(player, reading):
                    return ending
        return Ending.HUNG if self._watchdog.barked else Ending.DONE

    def _sensed(self) -> ndarray:
        """Begin a cycle: return its reading [D] in the channels' units, NaN where there is none."""
        self._pace.wait()
        self._watchdog.beat()
        reading = row_of(self._loop.sense(), self._loop.model.channels)
        if np.isfinite(reading).any():
            self._heard = self._loop.clock.now()
        return reading

    def _over(self) -> Ending | None:
        """Return why nothing more may be sent, if so."""
        if self._watchdog.barked:
            return Ending.HUNG
        if self._asked_to_end.is_set():
            return Ending.STOPPED
        silent_s = self._loop.clock.now() - self._heard
        return Ending.SENSORS_SILENT if silent_s > self._loop.watchdog_s else None

    def _acted(self, player: Player, reading: ndarray) -> Ending | None:
        """End a cycle: send the next row, unless it is not finite."""
        row = player.step_unit(self._loop.model.to_unit(reading))
        if not player.finite:
            return Ending.NOT_FINITE
        self._send(row)
        return None

    def _send(self, row: ndarray) -> None:
        """Send a row [D], held within the limits, and end the cycle."""
        self._before = self._limiter.limit(row, self._before)
        self._loop.act(dict(zip(self._loop.model.channels, self._before.tolist(), strict=True)))
        self._steps += 1
        self._pace.done()


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
