"""Training, recognition and generation in scikit-learn's manner."""

import warnings
from collections.abc import Sequence
from typing import Any

import jax
import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.errors import SettingError, needs
from motionese.interfaces.commands.train import read_levels
from motionese.learning import (
    Fit,
    Motions,
    Recognition,
    RecognitionResult,
    Training,
    recognise_all,
    train,
)
from motionese.network import MTRNN, Level

try:
    from sklearn.base import BaseEstimator
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.metrics import r2_score
    from sklearn.utils import check_random_state
    from sklearn.utils.validation import check_is_fitted, validate_data
except ImportError as error:
    raise needs("scikit-learn", "sklearn", "MTRNNImitator") from error

RULES = {"dtype": np.float64, "ensure_all_finite": "allow-nan", "ensure_min_samples": 2}
"""What one motion is to scikit-learn."""


class MTRNNImitator(BaseEstimator):  # type: ignore[misc]
    """An MTRNN that learns motions and completes what it sees of one.

    X is a list of motions [T_i, D], an array of motions [S, T, D], or one motion [T, D]: a row is
    a moment, and its neighbours are not independent of it. NaN stands for what was not observed.
    There is no y.

    Args:
        levels: Context levels as `"40:5,8:70"` or pairs (size, τ [steps]), the fast one first.
        io_tau: Time constant of the input–output level [steps].
        epochs: Updates in training.
        rate_hz: Rows per second [Hz]; travels with the fit to the robot.
        observed: Columns that are looked at in `recognise`, `predict` and `score`, by number or,
            where X has column names, by name; all where left out.
        training: How the network is trained; its defaults where left out.
        recognition: How motions are recognised; its defaults where left out.
        random_state: Of the initial weights and of the starts of recognition.

    Attributes:
        fit_: What training left.
        channels_: The columns' names and ranges.
        n_features_in_: How many columns X had.
        feature_names_in_: The columns' names, where X had some.
    """

    def __init__(
        self,
        levels: str | Sequence[tuple[int, float]] = "40:5,8:70",
        *,
        io_tau: float = 2.0,
        epochs: int = 3000,
        rate_hz: float = 1.0,
        observed: Sequence[int] | Sequence[str] | None = None,
        training: Training | None = None,
        recognition: Recognition | None = None,
        random_state: int | np.random.RandomState | None = 0,
    ) -> None:
        self.levels = levels
        self.io_tau = io_tau
        self.epochs = epochs
        self.rate_hz = rate_hz
        self.observed = observed
        self.training = training
        self.recognition = recognition
        self.random_state = random_state

    def fit(self, X: Any, y: Any = None) -> "MTRNNImitator":
        """Train a network on motions.

        Raises:
            ValueError: X is not motions of two rows or more and of the same columns.
            MotioneseError: A column that never changes, or a setting out of its range.
        """
        values = self._checked(X, reset=True)
        names = getattr(self, "feature_names_in_", [f"x{i}" for i in range(self.n_features_in_)])
        seen = [~np.isnan(value) for value in values]
        motions = Motions.from_arrays(values, [*map(str, names)], self.rate_hz, observed=seen)
        levels = [Level(len(motions.channels), self.io_tau), *read_levels(self.levels)]
        network = MTRNN.draw(levels, key=self._key())
        self.fit_: Fit = train(
            network, motions, epochs=self.epochs, settings=self.training, key=self._key()
        )
        self.channels_: Channels = motions.channels
        if self.fit_.status.failed:
            warnings.warn(str(self.fit_.status), ConvergenceWarning, stacklevel=2)
        return self

    def recognise(self, X: Any) -> list[RecognitionResult]:
        """Recognise every motion from what is observed in it, and tell how well that went."""
        check_is_fitted(self)
        values, looked_at = self._checked(X, reset=False), self._looked_at()
        seen = [~np.isnan(value) & looked_at for value in values]
        motions = Motions.from_arrays(values, self.channels_, self.rate_hz, observed=seen)
        return recognise_all(self.fit_, motions, settings=self.recognition, key=self._key())

    def predict(self, X: Any) -> Any:
        """Return the motions in closed loop, as they are recognised, all columns at all rows.

        Returns:
            In X's own form, a list of paths [T_i, D], an array [S, T, D], or one path [T, D].
        """
        paths = [found.path for found in self.recognise(X)]
        if _is_list_of_motions(X):
            return paths
        return np.stack(paths) if np.ndim(X) == 3 else paths[0]

    def score(self, X: Any, y: Any = None) -> float:
        """Return R² of the closed-loop paths, the mean over the columns.

        Every value in X counts that is not in its motion's first row, from which the paths start,
        hidden columns as well as those that are looked at. A column of fewer than two such values
        does not count.
        """
        shown = np.concatenate([value[1:] for value in self._checked(X, reset=False)])
        paths = np.concatenate([found.path[1:] for found in self.recognise(X)])
        scores = [
            r2_score(column[seen], path[seen])
            for column, path, seen in zip(shown.T, paths.T, ~np.isnan(shown.T), strict=True)
            if seen.sum() > 1
        ]
        if not scores:
            raise ValueError("no column holds two values after the first row; nothing to score")
        return float(np.mean(scores))

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.allow_nan = True
        tags.input_tags.three_d_array = True
        return tags

    def _checked(self, X: Any, *, reset: bool) -> list[Float[ndarray, "_ D"]]:
        """Return the motions in X, each by scikit-learn's own rules for X."""
        motions = list(X) if _is_list_of_motions(X) or np.ndim(X) == 3 else [X]
        checked = []
        for number, motion in enumerate(motions):
            try:
                new = reset and number == 0
                checked.append(validate_data(self, motion, reset=new, **RULES))
            except ValueError as error:
                if len(motions) == 1:
                    raise
                raise ValueError(f"motion {number}: {error}") from error
        return checked

    def _looked_at(self) -> Bool[ndarray, " D"]:
        if self.observed is None:
            return np.ones(self.n_features_in_, dtype=bool)
        mask, last = np.zeros(self.n_features_in_, dtype=bool), self.n_features_in_ - 1
        places = [
            self.channels_.indices([c])[0] if isinstance(c, str) else c for c in self.observed
        ]
        for place in places:
            if not 0 <= place <= last:
                raise SettingError(f"observed must name columns 0 to {last}, got {place}")
        mask[places] = True
        return mask

    def _key(self) -> jax.Array:
        return jax.random.key(check_random_state(self.random_state).randint(2**31 - 1))


def _is_list_of_motions(X: Any) -> bool:
    return isinstance(X, list | tuple) and len(X) > 0 and np.ndim(X[0]) == 2
