"""Error regression: the state in which a window of time began, improved by damped steps.

The unknowns c are the potentials of the context units in the window's first row, the residuals r
those of equation (3) over what was observed since, and J = ∂r/∂c runs forward through the window
beside the potentials: with x_t = m_t s_t + k_t y_t (see `Stepper`)

    S_0 = 1,    S_{t+1} = S_t P_t,    P_t = diag(1 − ε) + diag(k_t y_t (1 − y_t)) (ε W)ᵀ,

S_t[k, i] being ∂u_{i,t}/∂c_k. Around what a learned motion would have there, m, lies a prior of
precision p, so that what the window does not tell is as it was learned. A step solves
(Jᵀ J + p + λ) Δc = −(Jᵀ r + p (c − m)) (Levenberg 1944).
"""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from motionese.runtime.model import RuntimeModel
from motionese.unit_interval import logit

EASED, RAISED = 0.2, 5.0
"""λ is multiplied by the first after a step that was taken, by the second after another."""
LEAST, FIRST, LARGEST = 1e-4, 1e-2, 1e2
"""λ at the least, at first and at most, as a share of the largest diagonal element of Jᵀ J + p."""


@dataclass(frozen=True, eq=False)
class Linearised:
    """Rows as a model predicts them from one state, and how they change with it.

    Attributes:
        outputs: y of all units in every row. [T, N]
        potentials: u of all units in every row. [T, N]
        changes: ∂y of the channels in every row by the K unknowns. [T, K, D]
        loss: The summed squared residuals of what was observed.
        cost: The same with what the prior adds.
        curvature: Jᵀ J + p. [K, K]
        slope: Jᵀ r + p (c − m). [K]
    """

    outputs: ndarray
    potentials: ndarray
    changes: ndarray
    loss: float
    cost: float
    curvature: ndarray
    slope: ndarray


class ErrorRegression:
    """Improves the state from which a model predicts a window of rows.

    Attributes:
        damping: λ of the next step, as a share of the largest diagonal element of Jᵀ J + p.
        precision: The prior's p, for every context unit; 0 at first. [K]
    """

    def __init__(self, model: RuntimeModel, bound: float) -> None:
        """Take the model, and the largest |u| that a context unit may begin at."""
        rate = 1 / model.tau.astype(np.float64)
        self._keep = (1 - rate).astype(np.float32)
        self._scaled = np.ascontiguousarray((rate[:, None] * model.weights).T, np.float32)
        self._offset = (rate * model.bias).astype(np.float32)
        self._width, self._senses_first = len(model.channels), model.senses_first
        self._bound, self.damping = bound, FIRST
        self.precision = np.zeros(model.size - self._width, np.float32)
        self._unknown = np.eye(model.size, dtype=np.float32)[self._width :]
        self._step = np.empty_like(self._scaled)
        self._diagonal = self._step.reshape(-1)[:: model.size + 1]

    def begun(self, u: ndarray, first: ndarray) -> ndarray:
        """Return potentials [N] with what was sensed in their row [D] in those of the channels."""
        u = u.astype(np.float32)
        if self._senses_first:
            known = np.flatnonzero(np.isfinite(first))
            u[known] = logit(first[known])
        return u

    def predicted(self, u: ndarray, first: ndarray, rows: int) -> tuple[ndarray, ndarray]:
        """Return outputs and potentials [T, N] of so many rows in closed loop.

        Args:
            u: Potentials in the first row, see `begun`. [N]
            first: What was sensed in it, in the unit interval; NaN where nothing was. [D]
            rows: T.
        """
        outputs, potentials = np.empty((2, rows, len(u)), np.float32)
        with np.errstate(over="ignore"):  # of a potential far below 0, whose y is 0
            for t in range(rows):
                x = self._output(u)
                outputs[t], potentials[t] = x, u
                if t == 0:
                    known = np.flatnonzero(np.isfinite(first))
                    x[known] = first[known]
                u = self._following(u, x)
        return outputs, potentials

    def linearised(self, u: ndarray, sensed: ndarray, mean: ndarray | None = None) -> Linearised:
        """Return what the model predicts of rows from a state, and its sensitivities.

        Args:
            u: Potentials in the first row, see `begun`. [N]
            sensed: The rows in the unit interval; NaN where nothing was observed, and in rows that
                are still to come. [T, D]
            mean: The prior's m, potentials of all units; this state itself if left out. [N]
        """
        width, seen = self._width, np.isfinite(sensed)
        outputs, potentials = np.empty((2, len(sensed), len(u)), np.float32)
        changes = np.zeros((len(sensed), len(self._unknown), width), np.float32)
        change = self._unknown
        with np.errstate(over="ignore"):
            for t in range(len(sensed)):
                x = self._output(u)
                outputs[t], potentials[t] = x, u
                slope = x - x * x
                if t:
                    np.multiply(change[:, :width], slope[:width], out=changes[t])
                else:  # the window begins at what was sensed in it
                    known = np.flatnonzero(seen[0])
                    x[known], slope[known] = sensed[0, known], 0
                np.multiply(self._scaled, slope[:, None], out=self._step)
                np.add(self._diagonal, self._keep, out=self._diagonal)
                change = np.dot(change, self._step)
                u = self._following(u, x)
        told = np.flatnonzero(seen[1:])  # the first row predicts nothing
        residual = outputs[1:, :width].reshape(-1)[told] - sensed[1:].reshape(-1)[told]
        residual = residual.astype(np.float32)
        jacobian = changes[1:].transpose(1, 0, 2).reshape(len(change), -1)[:, told]
        loss, curvature, slope = residual @ residual, jacobian @ jacobian.T, jacobian @ residual
        away = potentials[0, width:] - mean[width:] if mean is not None else 0 * slope
        curvature.reshape(-1)[:: len(away) + 1] += self.precision
        slope += self.precision * away
        cost = loss + self.precision @ away**2
        return Linearised(outputs, potentials, changes, float(loss), float(cost), curvature, slope)

    def stepped(self, u: ndarray, here: Linearised) -> ndarray:
        """Return where a damped step leads [N]; what is pushed beyond its bound stays there."""
        context = u[self._width :]
        free = (np.abs(context) < self._bound) | (context * here.slope > 0)
        damped = here.curvature * (free[:, None] & free)
        diagonal = damped.reshape(-1)[:: len(free) + 1]
        diagonal += self.damping * diagonal.max() + np.finfo(np.float32).tiny
        change = np.linalg.solve(damped, here.slope * free)
        stepped = u.copy()
        stepped[self._width :] = np.clip(context - change, -self._bound, self._bound)
        return stepped

    def better(self, after: Linearised, before: Linearised) -> bool:
        """Return whether a step made the error smaller; λ falls if it did, and rises if not."""
        better = after.cost < before.cost
        self.damping *= EASED if better else RAISED
        self.damping = min(max(self.damping, LEAST), LARGEST)
        return better

    def _following(self, u: ndarray, x: ndarray) -> ndarray:
        following: ndarray = np.dot(x, self._scaled)
        following += self._offset
        following += self._keep * u
        return following

    @staticmethod
    def _output(u: ndarray) -> ndarray:
        y: ndarray = np.exp(-u)
        y += 1
        np.reciprocal(y, out=y)
        return y
