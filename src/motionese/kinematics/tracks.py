"""Sampled, noisy, gappy positions smoothed and differentiated: local polynomials of degree 4.

At every row t a polynomial x(s) = Σ_k c_k (s − t)^k, k = 0 … 4, is fitted by least squares to the
n observed rows nearest in time; position, velocity and acceleration are c_0, c_1 and 2 c_2. Where
no row is missing this is the filter of A. Savitzky and M. J. E. Golay (Analytical Chemistry 36,
1964), at the ends the polynomial of the last whole window; across missing rows the window reaches
further. A movement of minimum jerk is itself a polynomial of degree 5 in time: what lies within it
is met to some thousandths. Between rows the nearest row's polynomial is read.
"""

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

DEGREE = 4
WINDOW_S = 0.25
"""Width of the window [s], unless that is fewer than `FEWEST` rows."""
FEWEST = 7
"""Rows of the narrowest window: with fewer the polynomial would follow the noise."""
MOST_ROWS = 1e9
"""Rows of a window that are as good as infinitely many."""
FINE_HZ, MOST_PARTS = 100.0, 25
"""Quantities are told at least so often [Hz], that peaks and crossings do not hang on the rate; at
most so many times a row."""
NORMAL = 1.4826
"""Standard deviations in the median of absolute normal deviates."""
SLOWEST = 0.25
"""Share of the rows, the slowest ones, that tell the noise."""
CHUNK = 4096


@dataclass(frozen=True, eq=False)
class Track:
    """A stretch of a motion without long gaps, smoothed, at even times.

    Attributes:
        times: From the motion's first row [s]. [G]
        positions: In the path's unit. [G, D]
        speeds: Norm of the velocity [unit/s]. [G]
        accelerations: Norm of the acceleration [unit/s²]. [G]
        noise: Standard deviation of the samples [unit], all D together, from how they lie about
            the polynomials where the hand is slowest.
        noise_speed: What this noise makes of the speed of a hand at rest [unit/s], root mean
            square.
        noise_acceleration: The same of its acceleration [unit/s²].
    """

    times: Float[ndarray, " G"]
    positions: Float[ndarray, "G D"]
    speeds: Float[ndarray, " G"]
    accelerations: Float[ndarray, " G"]
    noise: float
    noise_speed: float
    noise_acceleration: float

    @property
    def step_s(self) -> float:
        """Time between two rows [s]."""
        return float(self.times[1] - self.times[0])


def window_rows(rate_hz: float, window_s: float) -> int:
    """Return the rows of the window: an odd number, at least `FEWEST`."""
    return max(2 * round(min(window_s * rate_hz, MOST_ROWS) / 2) + 1, FEWEST)


def tracks_of(
    path: Float[ndarray, "T D"], known: Bool[ndarray, " T"], rate_hz: float, window_s: float
) -> tuple[Track, ...]:
    """Return the stretches of a path that no gap longer than half a window interrupts.

    A stretch with fewer observed rows than a window is left out.

    Args:
        path: Positions, or joint angles; anything where not known.
        known: Rows at which all of them were observed.
        rate_hz: Rows per second [Hz].
        window_s: Width of the window [s].
    """
    rows = np.flatnonzero(known)
    window = window_rows(rate_hz, window_s)
    ends = np.flatnonzero(np.diff(rows) > window // 2 + 1) + 1
    stretches = (part for part in np.split(rows, ends) if len(part) >= window)
    return tuple(_track(rows, path[rows], rate_hz, window) for rows in stretches)


def _track(rows: ndarray, values: Float[ndarray, "N D"], rate_hz: float, window: int) -> Track:
    """Return the track of the observed rows of a stretch."""
    # What stays where it is moves by exactly 0, wherever that is.
    times, origin = rows / rate_hz, values[0]
    at = np.arange(rows[0], rows[-1] + 1) / rate_hz
    fit = polynomials(times, values - origin, at, window)
    parts = ceil(min(FINE_HZ / rate_hz, MOST_PARTS) - 1e-9) // 2 * 2 + 1
    off = (np.arange(parts) - parts // 2) / (parts * rate_hz)
    order, inside = np.arange(DEGREE + 1), slice(parts // 2, parts * len(at) - parts // 2)

    def read(derivative: int) -> Float[ndarray, "G D"]:
        factors = np.prod([order - k for k in range(derivative)], axis=0, initial=1.0)
        powers = off[:, None] ** np.maximum(order - derivative, 0) * factors
        fine = np.einsum("pk,rkd->rpd", powers, fit).reshape(-1, values.shape[1])
        return np.asarray(fine[inside])

    position, speed, acceleration = gains(rate_hz, window)
    deviation = _deviation(fit[rows - rows[0]], values - origin, window)
    noise = deviation / sqrt(1 - position)
    return Track(
        (at[:, None] + off).ravel()[inside],
        read(0) + origin,
        np.linalg.norm(read(1), axis=1),
        np.linalg.norm(read(2), axis=1),
        noise,
        noise * speed,
        noise * acceleration,
    )


def _deviation(fit: Float[ndarray, "N K D"], values: Float[ndarray, "N D"], window: int) -> float:
    """Return how far samples lie off their polynomials where the hand is slowest.

    Where it is fast there are also residuals of its motion.
    """
    inner = slice(window // 2, len(values) - window // 2)
    speeds = np.linalg.norm(fit[inner, 1], axis=1)
    slow = speeds <= np.quantile(speeds, SLOWEST)
    residuals = np.abs(values - fit[:, 0])[inner][slow]
    return float(np.linalg.norm(NORMAL * np.median(residuals, axis=0)))


def polynomials(
    times: Float[ndarray, " N"],
    values: Float[ndarray, "N D"],
    at: Float[ndarray, " R"],
    window: int,
) -> Float[ndarray, "R K D"]:
    """Return the coefficients of (s − at)^k, k = 0 … 4, fitted to the `window` nearest samples.

    Args:
        times: Of the samples, rising [s].
        values: The samples.
        at: Where the polynomials stand [s].
        window: Samples in a window, at most N.
    """
    nearest = np.searchsorted((times[1:] + times[:-1]) / 2, at)
    first = np.clip(nearest - window // 2, 0, len(times) - window)
    width = window * (times[-1] - times[0]) / max(len(times) - 1, 1)
    fitted = np.empty((len(at), DEGREE + 1, values.shape[1]))
    for start in range(0, len(at), CHUNK):
        part = slice(start, start + CHUNK)
        samples = first[part, None] + np.arange(window)
        off = (times[samples] - at[part, None]) / width
        basis = off[..., None] ** np.arange(DEGREE + 1)
        turned = basis.swapaxes(1, 2)
        fitted[part] = np.linalg.solve(turned @ basis, turned @ values[samples])
    return np.asarray(fitted / width ** np.arange(DEGREE + 1)[:, None])


def gains(rate_hz: float, window: int) -> tuple[float, float, float]:
    """Return what white noise of deviation 1 leaves in the middle of a whole window.

    Of the position its variance, of velocity [1/s] and acceleration [1/s²] the deviation.
    """
    off = np.arange(-(window // 2), window // 2 + 1) / rate_hz
    filters = np.linalg.pinv(off[:, None] ** np.arange(DEGREE + 1))
    variances = (filters**2).sum(axis=1)
    return float(variances[0]), float(np.sqrt(variances[1])), float(2 * np.sqrt(variances[2]))
