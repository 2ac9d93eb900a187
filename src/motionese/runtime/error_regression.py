"""Error regression: the state in which a window of time began, improved by damped steps.

The unknowns c are the potentials of the context units in the window's first row, the residuals r
those of equation (3) over what was observed since, and J = ∂r/∂c runs forward through the window
beside the potentials: with x_t = m_t s_t + k_t y_t (see `Stepper`)

    S_0 = 1,    S_{t+1} = S_t P_t,    P_t = diag(1 − ε) + diag(k_t y_t (1 − y_t)) (ε W)ᵀ,

S_t[k, i] being ∂u_{i,t}/∂c_k. Around what a learned motion would have there, m, lies a prior of
precision p, so that what the window does not tell is as it was learned. A step solves
(Jᵀ J + p + λ) Δc = −(Jᵀ r + p (c − m)) (Levenberg 1944).
"""

from dataclasses import dataclass, replace

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
        potentials: u of all units in every row, and in the one that follows. [T + 1, N]
        changes: ∂y of the channels in every row by the K unknowns. [T, K, D]
        change: ∂u of all units in the row that follows by the unknowns. [K, N]
        loss: The summed squared residuals of what was observed.
        cost: The same with what the prior adds.
        curvature: Jᵀ J + p. [K, K]
        slope: Jᵀ r + p (c − m). [K]
    """

    outputs: ndarray
    potentials: ndarray
    changes: ndarray
    change: ndarray
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
        self._nothing = np.full(self._width, np.nan)
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
        """Return outputs [T, N] of rows in closed loop, and potentials [T + 1, N] with the next.

        Args:
            u: Potentials in the first row, see `begun`. [N]
            first: What was sensed in it, in the unit interval; NaN where nothing was. [D]
            rows: T.
        """
        outputs = np.empty((rows, len(u)), np.float32)
        potentials = np.empty((rows + 1, len(u)), np.float32)
        with np.errstate(over="ignore"):  # of a potential far below 0, whose y is 0
            for t in range(rows):
                x = self._output(u)
                outputs[t], potentials[t] = x, u
                if t == 0:
                    known = np.flatnonzero(np.isfinite(first))
                    x[known] = first[known]
                u = self._following(u, x)
        potentials[rows] = u
        return outputs, potentials

    def linearised(self, u: ndarray, sensed: ndarray, mean: ndarray | None = None) -> Linearised:
        """Return what the model predicts of rows from a state, and its sensitivities.

        Args:
            u: Potentials in the first row, see `begun`. [N]
            sensed: The rows in the unit interval; NaN where nothing was observed. [T, D]
            mean: The prior's m, potentials of all units; this state itself if left out. [N]
        """
        outputs, potentials = self.predicted(u, sensed[0], len(sensed))
        slopes = outputs - outputs * outputs
        slopes[0, np.flatnonzero(np.isfinite(sensed[0]))] = 0  # begins at what was sensed in it
        changes, change = self._changed(self._unknown, slopes)
        changes[0] = 0  # and predicts nothing there
        told, residual = self._residual(outputs, sensed)
        jacobian = changes[1:].transpose(1, 0, 2).reshape(len(change), -1)[:, told]
        loss, curvature, slope = residual @ residual, jacobian @ jacobian.T, jacobian @ residual
        away = self._away(u, mean)
        curvature.reshape(-1)[:: len(away) + 1] += self.precision
        slope += self.precision * away
        cost = float(loss + self.precision @ away**2)
        return Linearised(outputs, potentials, changes, change, float(loss), cost, curvature, slope)

    def moved(
        self, here: Linearised, u: ndarray, sensed: ndarray, mean: ndarray | None = None
    ) -> Linearised:
        """Return what is predicted from another state near by, with the sensitivities as here."""
        outputs, potentials = self.predicted(u, sensed[0], len(sensed))
        _, residual = self._residual(outputs, sensed)
        loss = float(residual @ residual)
        cost = loss + float(self.precision @ self._away(u, mean) ** 2)
        return replace(here, outputs=outputs, potentials=potentials, loss=loss, cost=cost)

    def continued(self, here: Linearised, rows: int) -> tuple[ndarray, ndarray]:
        """Return outputs [A, N] of rows that follow, and their `changes` [A, K, D]."""
        outputs, _ = self.predicted(here.potentials[-1], self._nothing, rows)
        return outputs, self._changed(here.change, outputs - outputs * outputs)[0]

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

    def _changed(self, change: ndarray, slopes: ndarray) -> tuple[ndarray, ndarray]:
        """Return `changes` over rows of slopes y(1 − y) [T, N], and `change` after them."""
        changes = np.empty((len(slopes), len(change), self._width), np.float32)
        for t, slope in enumerate(slopes):
            np.multiply(change[:, : self._width], slope[: self._width], out=changes[t])
            np.multiply(self._scaled, slope[:, None], out=self._step)
            np.add(self._diagonal, self._keep, out=self._diagonal)
            change = np.dot(change, self._step)
        return changes, change

    def _residual(self, outputs: ndarray, sensed: ndarray) -> tuple[ndarray, ndarray]:
        """Return which values after the first row were observed, and what is wrong with them."""
        told = np.flatnonzero(np.isfinite(sensed[1:]))
        residual = outputs[1:, : self._width].reshape(-1)[told] - sensed[1:].reshape(-1)[told]
        return told, residual.astype(np.float32)

    def _away(self, u: ndarray, mean: ndarray | None) -> ndarray:
        """Return c − m. [K]"""
        away: ndarray = u[self._width :] - (u if mean is None else mean)[self._width :]
        return away

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
