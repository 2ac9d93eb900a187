"""A motion as it is played: readings in, the next row out, all in the channels' units."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import ControlError
from motionese.minimum_jerk import minimum_jerk
from motionese.runtime.model import Reading, RuntimeModel, State, row_of
from motionese.unit_interval import CLIP_HIGH, CLIP_LOW, sigmoid

Share = float | Mapping[str, float]
Blend = int | Callable[[ndarray], int]
"""Steps of a blend, or what tells them from the row [D] at which it begins."""


class Stepper:
    """Steps states of one model; one at a time, since it holds the arrays it computes in."""

    @refusing(ControlError)
    def __init__(self, model: RuntimeModel) -> None:
        rate = 1 / model.tau.astype(np.float64)
        self._keep = (1 - rate).astype(np.float32)
        self._scaled = np.ascontiguousarray(rate[:, None] * model.weights, dtype=np.float32)
        self._offset = (rate * model.bias).astype(np.float32)
        self._width = len(model.channels)
        self._x = np.empty(model.size, np.float32)
        self._summed = np.empty(model.size, np.float32)
        self._correction = np.empty(self._width, np.float32)
        self._given = np.empty(self._width, bool)

    def step(self, state: State, sensed: ndarray, share: ndarray) -> ndarray:
        """Move a state on by one step, in place.

        With ε = 1/τ, x = y + share (sensed − y) for the channels and x = y for all other units:
        u ← (1 − ε) u + ε (W x + b), y ← sigmoid(u).

        Args:
            state: The state; its y is the prediction of the row that is now sensed.
            sensed: What is sensed now, in the unit interval; NaN where nothing is. [D]
            share: How much of the input is sensed, the rest is predicted, 0 to 1. [D]

        Returns:
            The prediction of the next row in the unit interval, a view of the state's y. [D]
        """
        u, y, x, correction = state.u, state.y, self._x, self._correction
        predicted = y[: self._width]
        np.copyto(x, y)
        np.subtract(sensed, predicted, out=correction)
        np.multiply(correction, share, out=correction)
        np.isfinite(correction, out=self._given)
        np.add(predicted, correction, out=x[: self._width], where=self._given)

        np.dot(self._scaled, x, out=self._summed)
        np.multiply(u, self._keep, out=u)
        np.add(u, self._summed, out=u)
        np.add(u, self._offset, out=u)
        sigmoid(u, y)
        return predicted


class Player:
    """Plays a motion step by step, and passes from one motion to another without a jump."""

    @refusing(ControlError)
    def __init__(self, model: RuntimeModel, state: State, share: Share = 0.0) -> None:
        """Take a state to play on from.

        Args:
            model: The model.
            state: Where to begin, see `RuntimeModel.begin`; it is moved on.
            share: How much of what the network takes in is sensed and how much its own
                prediction, from 0 (closed loop) to 1, for all channels or by name (others 0). What
                was not sensed at a step is predicted in any case.
        """
        self._model, self._share = model, shares(model, share)
        self._stepper = Stepper(model)
        self._state = state
        self._former: State | ndarray | None = None
        self._coming: tuple[ndarray, Blend] | None = None
        self._blended = self._blend = 0
        self._row = state.y[: len(model.channels)].astype(np.float64)

    @property
    def row(self) -> ndarray:
        """Where the motion is, in the channels' units, binary channels held. [D]"""
        return self._model.held(self._model.from_unit(self._row))

    @property
    def finite(self) -> bool:
        """Whether the network has not left the numbers."""
        return bool(np.isfinite(self._row).all() and np.isfinite(self._state.u).all())

    def set_out(self, steps: Blend) -> None:
        """Pass from standing still at the present row into the motion, over so many rows."""
        self._blend = steps(self.row) if callable(steps) else steps
        self._former, self._blended = (self._row.copy() if self._blend > 1 else None), 0

    @refusing(ControlError)
    def blend_to(self, start: str | int | ndarray, steps: Blend) -> None:
        """Pass to another motion, whose first row is the next one of the present motion.

        Over so many rows both are played and the row goes from one to the other by the minimum
        jerk's weights 10 s³ − 15 s⁴ + 6 s⁵ (Flash & Hogan 1985); with 0 at once.
        """
        if not callable(steps) and steps < 0:
            raise ControlError(f"a blend takes 0 steps or more, got {steps}")
        if self._former is not None:
            left = self._blend - 1 - self._blended
            raise ControlError(f"the blend before this one has {left} steps to go")
        self._coming = self._model.begin(start).u, steps

    def step(self, reading: Reading = None) -> ndarray:
        """Take in a reading of the present row and return the next one, in the channels' units."""
        values = row_of(reading, self._model.channels)
        return self.step_unit(self._model.to_unit(values))

    def step_unit(self, sensed: ndarray) -> ndarray:
        """Do as `step` with a reading [D] in the unit interval, NaN where nothing was read."""
        row = self._moved(self._state, sensed)
        if self._former is not None:
            self._blended += 1
            weight = minimum_jerk(self._blended / self._blend)
            former = self._former
            if isinstance(former, State):
                former = self._moved(former, sensed)
            row = (1 - weight) * former + weight * row
        if self._coming is not None:
            u, steps = self._coming
            self._blend = steps(self._model.from_unit(row)) if callable(steps) else steps
            self._former, self._coming, self._blended = self._state, None, 0
            self._state = self._model.state_at(u, np.clip(row, CLIP_LOW, CLIP_HIGH))
        if self._blended + 1 >= self._blend:
            self._former = None
        self._row = row
        return self.row

    def _moved(self, state: State, sensed: ndarray) -> ndarray:
        """Move a state on; its row [D] in the unit interval, an array of its own."""
        return self._stepper.step(state, sensed, self._share).astype(np.float64)


def shares(model: RuntimeModel, share: Share) -> ndarray:
    """Return every channel's share of what is sensed [D]; `ControlError` outside 0 to 1."""
    spread = np.array(model.per_channel("share", share, 0.0), dtype=np.float32)
    if not ((spread >= 0) & (spread <= 1)).all():
        raise ControlError(f"the share of what is sensed must be 0 to 1, got {share}")
    return spread
