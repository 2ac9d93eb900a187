"""Equations (1) and (2), one step, without a new array."""

import numpy as np
from numpy import ndarray

from motionese.runtime.model import RuntimeModel
from motionese.runtime.state import State
from motionese.unit_interval import sigmoid


class Stepper:
    """Steps states of one model; one at a time, since it holds the arrays it computes in."""

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
