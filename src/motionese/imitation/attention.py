r"""Attention: rows of an experience in which the seen hand rests, or moves, weigh more.

With v_t the speed of the hand that is seen in a row, equation (3) becomes

    E = Σ_t a(v_t) Σ_i (y_{i,t−1} − T_{i,t})²,   a(v) = 1 + s exp(−(v/v₀)²)          rests
                                                 a(v) = 1 + s (1 − exp(−(v/v₀)²))    movement

Nothing is tuned: v₀ is the speed that the noise of the eye alone makes of a hand at rest, root mean
square. The speed of a row is half the way from the row before to the row after (at the ends, from
or to the end itself), so that a deviation σ of azimuth and one of elevation, independent in every
row, make v₀² = ½ (σ_right² + σ_up²) [rad per row]; σ is the pixels' noise by the bearing's slope.
Of pictures that are rendered it is taken to be the same: a third of a pixel is what cutting into
pixels makes as well (1/√12).
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import SimulatedRobot
from motionese.imitation.settings import Settings

SLOPE_PX = 0.5
"""The bearing's slope is taken over so many pixels on either side of the view's middle."""

Weigh = Callable[[Float[ndarray, "T D"]], Float[ndarray, " T"]]
"""How much each row of an experience weighs."""


def attention(body: SimulatedRobot, settings: Settings) -> Weigh | None:
    """Return how an experience's rows weigh; None where all weigh alike."""
    to, strength = settings.training.attention.to, settings.training.attention.strength
    if not strength:
        return None
    noise = noise_speed(body, settings.body.pixel_noise)

    def weigh(values: Float[ndarray, "T D"]) -> Float[ndarray, " T"]:
        speed = seen_speed(body.bearing(values))
        still = np.exp(-((speed / noise) ** 2))
        # Where no hand was seen nothing tells whether it rested.
        return np.nan_to_num(1 + strength * (still if to == "rests" else 1 - still), nan=1.0)

    return weigh


def seen_speed(bearings: Float[ndarray, "T 2"]) -> Float[ndarray, " T"]:
    """Return the speed [rad per row] of a hand seen at azimuths and elevations [rad]."""
    around = np.pad(bearings, ((1, 1), (0, 0)), mode="edge")
    azimuth, elevation = ((around[2:] - around[:-2]) / 2).T
    return np.asarray(np.hypot(azimuth * np.cos(bearings[:, 1]), elevation))


def noise_speed(body: SimulatedRobot, pixel_noise: float) -> float:
    """Return the speed [rad per row] that the eye's noise alone makes of a hand at rest, rms.

    Args:
        body: The robot; the hand is in the view's middle, the joints amid their ranges.
        pixel_noise: Root mean square of the noise of either coordinate [px].
    """
    middle = body.channels.from_unit(np.full((1, len(body.channels)), 0.5))
    seen = body.channels.indices(("u", "v"))
    middle[:, seen] = 0.0
    variance = 0.0
    for channel in seen:
        sides = np.repeat(middle, 2, axis=0)
        sides[:, channel] += [-SLOPE_PX, SLOPE_PX]
        bearings = body.bearing(sides)
        azimuth, elevation = (bearings[1] - bearings[0]) / (2 * SLOPE_PX)
        right = azimuth * np.cos(bearings[:, 1].mean())
        variance += pixel_noise**2 * (right**2 + elevation**2)
    return float(np.sqrt(variance / 2))
