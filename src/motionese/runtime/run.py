"""One run of a control loop, cycle by cycle."""

from collections.abc import Callable
from dataclasses import dataclass
from threading import Event

import numpy as np
from numpy import ndarray

from motionese.runtime.clock import Clock
from motionese.runtime.limits import Limiter, Limits
from motionese.runtime.model import RuntimeModel
from motionese.runtime.pace import Pace
from motionese.runtime.parts import Scheduled
from motionese.runtime.player import Player, Share
from motionese.runtime.ran import SENTENCES, Ended, Ran
from motionese.runtime.readings import Reading, row_of
from motionese.runtime.watchdog import Watchdog


@dataclass(frozen=True)
class Setup:
    """How a control loop is set up, see `ControlLoop`."""

    model: RuntimeModel
    sense: Callable[[], Reading]
    act: Callable[[dict[str, float]], object]
    rate_hz: float
    share: Share
    limits: Limits
    watchdog_s: float
    clock: Clock
    asked_to_end: Event


class Run:
    """One run: what passes from cycle to cycle."""

    def __init__(self, setup: Setup, watchdog: Watchdog) -> None:
        self._setup, self._watchdog = setup, watchdog
        self._limiter = Limiter(setup.model, setup.limits, setup.rate_hz)
        self._pace = Pace(setup.clock, setup.rate_hz)
        self._heard, self._steps = setup.clock.now(), 0
        self._before = np.empty(0)

    def play(self, schedule: list[Scheduled]) -> Ran:
        """Play the parts and tell how it went."""
        ended = self._parts(schedule)
        return Ran(
            steps=self._steps,
            missed=self._pace.missed,
            skipped=self._pace.skipped,
            worst_lateness_s=self._pace.worst_lateness_s,
            clamped=self._limiter.clamped,
            slowed=self._limiter.slowed,
            ended=ended,
            sentence=SENTENCES[ended].format(steps=self._steps, patience=self._setup.watchdog_s),
        )

    def _parts(self, schedule: list[Scheduled]) -> Ended:
        reading = self._sensed()
        while not np.isfinite(reading).any():
            if ended := self._over():
                return ended
            self._pace.done()
            reading = self._sensed()
        self._limiter.check_start(reading)
        model = self._setup.model
        player = Player(model, model.begin(schedule[0].start, reading), self._setup.share)
        self._before = np.where(np.isfinite(reading), reading, player.row)
        for place, part in enumerate(schedule):
            if place:
                player.blend_to(part.start, part.blend)
            else:
                player.set_out(part.blend)
            for _ in range(part.steps):
                if self._steps:
                    reading = self._sensed()
                if ended := self._over() or self._acted(player, reading):
                    return ended
        return Ended.HUNG if self._watchdog.barked else Ended.DONE

    def _sensed(self) -> ndarray:
        """Begin a cycle: return its reading [D] in the channels' units, NaN where there is none."""
        self._pace.wait()
        self._watchdog.beat()
        reading = row_of(self._setup.sense(), self._setup.model.channels)
        if np.isfinite(reading).any():
            self._heard = self._setup.clock.now()
        return reading

    def _over(self) -> Ended | None:
        """Return why nothing more may be sent, if so."""
        if self._watchdog.barked:
            return Ended.HUNG
        if self._setup.asked_to_end.is_set():
            return Ended.STOPPED
        silent_s = self._setup.clock.now() - self._heard
        return Ended.SENSORS_SILENT if silent_s > self._setup.watchdog_s else None

    def _acted(self, player: Player, reading: ndarray) -> Ended | None:
        """End a cycle: send the next row, unless it is not finite."""
        model = self._setup.model
        row = player.step_unit(model.to_unit(reading))
        if not player.finite:
            return Ended.NOT_FINITE
        self._before = self._limiter.limit(row, self._before)
        self._setup.act(dict(zip(model.channels, self._before.tolist(), strict=True)))
        self._steps += 1
        self._pace.done()
        return None
