"""Recognition while it happens: what is being shown, from one reading to the next."""

import time
import warnings
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from motionese.arguments import place_of, refusing, several
from motionese.errors import ControlError
from motionese.runtime.belief import Belief
from motionese.runtime.error_regression import FIRST, ErrorRegression, Linearised
from motionese.runtime.model import Reading, RuntimeModel, row_of
from motionese.unit_interval import INNER_HIGH, INNER_LOW

ACCURACY = 0.05
"""Standard deviation of what is shown from what was learned, in the unit interval."""
HALF = 0.5
"""Belief in none of the motions from which on none of them is a prior."""
BACK = 5
"""A motion that is taken up anew is looked back on for so many rows."""
KNOWN = 4
"""The known accuracy counts as so many observed values, when the present one is judged."""
LEAST_VARIANCE = 1e-3
"""Of a context unit that is the same in all that was learned."""
BOUND = 100.0
"""Largest |u| of a context unit in the window's first row."""
FORGETS = 0.9
"""How long a step took is remembered as this share of it, each time that no step fits: one that
the machine held up is not taken for what steps take."""


@dataclass(frozen=True, eq=False)
class OnlineResult:
    """What is known after a reading.

    Attributes:
        row: The row it belongs to, from 0.
        potentials: The network's present potentials u. [N]
        path: The rows that are looked at, as the network generates them, in the channels' units;
            the last is the present one. [T, D]
        ahead: The rows that come next, in the channels' units. [A, D]
        spread: Their standard deviation, by what the window leaves open. [A, D]
        belief: How likely every learned motion is being shown, and `NONE`; the sum is 1.
        learned: The learned motion that is believed in most, and the row it has come to; what is
            shown may still rather be none of these, see `likeliest`.
        error: Root mean squared error of what was observed in these rows, as a share of the
            channels' ranges; NaN where nothing was after the first.
        values: Observed values after the first row. Where they are fewer than the network's
            context units, what they leave open stays as it was learned.
        steps: Damped steps that were tried.
    """

    row: int
    potentials: ndarray
    path: ndarray
    ahead: ndarray
    spread: ndarray
    belief: Mapping[str, float]
    learned: tuple[str, int]
    error: float
    values: int
    steps: int

    @property
    def likeliest(self) -> str:
        """The motion that is believed in most, or `NONE`."""
        return max(self.belief, key=self.belief.__getitem__)

    def expected(self, row: int) -> ndarray:
        """Return a row as the network generates it, in the channels' units: seen, or to come. [D]

        One beyond what is looked at, or predicted, is the first or the last of these.
        """
        place = len(self.path) - 1 + row - self.row
        rows = [*self.path, *self.ahead]
        return np.asarray(rows[min(max(place, 0), len(rows) - 1)])


class OnlineRecognition:
    """Recognises a motion while it happens, in a window that slides (error regression).

    With every reading the state in which the window begins is improved by damped steps, from where
    the reading before left it; as the window slides, the improved state is carried on into its next
    row. Where that explains the last rows badly, the learned motion that is believed in most is
    tried in its place, and if it explains them better, the window begins anew with it.

    Attributes:
        model: The model.
        ahead: Rows that are predicted.
        postponed: Steps that did not fit into the budget and were left for the next reading.
        late: Readings that were left out, since their row was no longer looked at.
    """

    @refusing(ControlError)
    def __init__(
        self,
        model: RuntimeModel,
        *,
        observed: Sequence[str | int] | str | int | None = None,
        window: int = 20,
        steps: int = 2,
        ahead: int = 5,
        budget_ms: float | None = None,
        accuracy: float = ACCURACY,
    ) -> None:
        """Recognise with a model; every motion that it learned is a hypothesis.

        Args:
            model: The model.
            observed: Names or numbers of the channels that are looked at; all if left out.
            window: Rows that are looked back on.
            steps: Damped steps a reading.
            ahead: Rows that are predicted.
            budget_ms: How long a reading may take [ms]; steps that do not fit are postponed.
            accuracy: Standard deviation of what is shown from what was learned, in the unit
                interval. What is farther away than about two of them is none of these.

        Raises:
            ControlError: A channel or length of a motion that is not there, a number out of range.
        """
        for name, value, least in (("window", window, 2), ("steps", steps, 0), ("ahead", ahead, 0)):
            if value < least:
                raise ControlError(f"{name} must be {least} or more, got {value}")
        for name, number in (("budget_ms", budget_ms), ("accuracy", accuracy)):
            if number is not None and not 0 < number < np.inf:
                raise ControlError(f"{name} must be finite and > 0, got {number}")
        if not model.lengths:
            raise ControlError("the model's file does not tell how long its motions are")
        looked_at = range(len(model.channels)) if observed is None else several(observed)
        seen = [place_of("channel", one, model.channels, ControlError) for one in looked_at]
        self.model, self.postponed, self.late = model, 0, 0
        self._seen = np.isin(np.arange(len(model.channels)), seen)
        self._steps, self.ahead, self._accuracy = steps, ahead, accuracy
        self._budget_s = np.inf if budget_ms is None else budget_ms / 1000
        self._step_s, self._told = 0.0, False
        self._regression = ErrorRegression(model, BOUND)
        self._learned = {name: self._generated(name) for name in model.initial_states}
        self._belief = Belief({n: y for n, (y, _) in self._learned.items()}, accuracy)
        learned = np.concatenate([u for _, u in self._learned.values()])
        apart = np.maximum(learned[:, len(model.channels) :].var(axis=0), LEAST_VARIANCE)
        self._regression.precision = (accuracy**2 / apart).astype(np.float32)
        self._window = deque[ndarray](maxlen=window)
        self._row, self._u = -1, np.zeros(model.size, np.float32)

    @refusing(ControlError)
    def observe(self, reading: Reading, row: int | None = None) -> OnlineResult:
        """Take in a reading and return what is known now.

        Args:
            reading: Values by channel name, or one per channel, in the channels' units; what was
                not read is left out or NaN. None where nothing was.
            row: Which row it belongs to; the next one if left out. One that is passed over counts
                as not read; one that came before fills its place in the window.

        Raises:
            ControlError: A channel that does not exist, another width, a row below 0.
        """
        if row is not None and row < 0:
            raise ControlError(f"row must be 0 or more, got {row}")
        began = time.perf_counter()
        sensed = self.model.to_unit(row_of(reading, self.model.channels))
        sensed[~self._seen] = np.nan
        place = self._row + 1 if row is None else row
        if place > self._row:
            for _ in range(self._row + 1, place):
                self._append(np.full(len(sensed), np.nan))
            self._append(sensed)
        else:
            self._fill(place, sensed)
        here = self._tried(self._linearised(self._u))
        steps = 0
        while steps < self._steps and self._fits(began, self._steps - steps):
            steps += 1
            here = self._improved(here, last=steps == self._steps)
        return self._result(here, steps)

    def _generated(self, name: str) -> tuple[ndarray, ndarray]:
        """Return a learned motion's channels [L, D] in the unit interval, and its potentials."""
        nothing, u = np.full(len(self.model.channels), np.nan), self.model.begin(name).u
        y, potentials = self._regression.predicted(u, nothing, self.model.lengths[name])
        return y[:, : len(nothing)], potentials[:-1]

    def _append(self, sensed: ndarray) -> None:
        """Take in the next row; the state is carried on where the window slides."""
        if len(self._window) == self._window.maxlen:
            u = self._regression.begun(self._u, self._window[0])
            self._u = self._regression.predicted(u, self._window[0], 1)[1][1]
        self._window.append(sensed)
        self._belief.observe(sensed)
        self._row += 1
        if self._row == 0:
            name, place = self._belief.likeliest
            self._u = self._learned[name][1][place]

    def _fill(self, row: int, sensed: ndarray) -> None:
        place = len(self._window) - 1 - (self._row - row)
        if place < 0:
            self.late += 1
        else:
            np.copyto(self._window[place], sensed, where=np.isfinite(sensed))

    def _linearised(self, u: ndarray) -> Linearised:
        rows = np.array(self._window)
        u = self._regression.begun(u, rows[0])
        return self._regression.linearised(u, rows, self._expected_begin())

    def _expected_begin(self) -> ndarray | None:
        """Return the learned motion's state in the window's first row, where it reaches so far."""
        name, place = self._belief.likeliest
        first = place - len(self._window) + 1
        known = first >= 0 and self._belief.none < HALF
        return self._learned[name][1][first] if known else None

    def _tried(self, here: Linearised) -> Linearised:
        """Begin anew with the motion believed in most, where it explains the last rows better."""
        rows = np.array(self._window)
        recent = self._squared(here.outputs, rows)[-BACK:]
        if not np.nanmean(recent) > self._accuracy**2 if np.isfinite(recent).any() else True:
            return here
        name, place = self._belief.likeliest
        back = min(place, BACK, len(rows) - 1)
        if not back:
            return here
        u = self._learned[name][1][place - back]
        begun = self._regression.begun(u, rows[-1 - back])
        y, _ = self._regression.predicted(begun, rows[-1 - back], back + 1)
        anew = self._squared(y, rows[-1 - back :])[1:]
        if not np.nansum(anew) < np.nansum(recent[-back:]):
            return here
        for _ in range(len(rows) - 1 - back):
            self._window.popleft()
        self._u, self._regression.damping = u, FIRST
        return self._linearised(u)

    def _squared(self, outputs: ndarray, rows: ndarray) -> ndarray:
        return np.asarray((outputs[:, : rows.shape[1]] - rows) ** 2)

    def _fits(self, began: float, left: int) -> bool:
        """Return whether a step fits into the budget; count what does not."""
        spent = time.perf_counter() - began
        if spent + self._step_s <= self._budget_s:
            return True
        self.postponed += left
        if self._step_s > self._budget_s and not self._told:
            self._told = True
            warnings.warn(
                f"a step of recognition takes {1000 * self._step_s:.2f} ms, more than the budget "
                f"of {1000 * self._budget_s:g} ms: take a shorter window, or fewer rows ahead",
                stacklevel=3,
            )
        self._step_s *= FORGETS
        return False

    def _improved(self, here: Linearised, last: bool) -> Linearised:
        """Take a step where it makes the error smaller; after the last, J stays as it was."""
        began = time.perf_counter()
        u = self._regression.stepped(here.potentials[0], here)
        if last:
            rows = np.array(self._window)
            u = self._regression.begun(u, rows[0])
            there = self._regression.moved(here, u, rows, self._expected_begin())
        else:
            there = self._linearised(u)
        self._step_s = time.perf_counter() - began
        if self._regression.better(there, here):
            self._u = u
            return there
        return here

    def _result(self, here: Linearised, steps: int) -> OnlineResult:
        width, rows = len(self._seen), np.array(self._window)
        ahead, changes = self._regression.continued(here, self.ahead)
        shown = np.concatenate([here.outputs, ahead])[:, :width].astype(np.float64)
        np.copyto(shown[0], rows[0], where=np.isfinite(rows[0]))
        values = int(np.isfinite(rows[1:]).sum())
        error = np.sqrt(here.loss / values) / (INNER_HIGH - INNER_LOW) if values else np.nan
        path = self.model.from_unit(shown)
        return OnlineResult(
            row=self._row,
            potentials=here.potentials[-2],
            path=path[: len(rows)],
            ahead=path[len(rows) :],
            spread=self._spread(here, changes, values),
            belief=self._belief.shares,
            learned=self._belief.likeliest,
            error=float(error),
            values=values,
            steps=steps,
        )

    def _spread(self, here: Linearised, changes: ndarray, values: int) -> ndarray:
        """Return the standard deviation of the rows ahead [A, D], in the channels' units.

        What is observed lies around the rows as it has so far, the unknowns lie around those of
        learned motions: the covariance of what the window leaves open follows by Bayes' rule, and
        that of the rows ahead by their sensitivities.
        """
        variance = (here.loss + KNOWN * self._accuracy**2) / (values + KNOWN)
        change = changes.transpose(1, 0, 2).reshape(len(here.slope), -1)
        left = np.linalg.solve(here.curvature, change)
        unit = np.sqrt(variance * (1 + (change * left).sum(0))).reshape(changes.shape[::2])
        return np.asarray(unit * (self.model.high - self.model.low) / (INNER_HIGH - INNER_LOW))
