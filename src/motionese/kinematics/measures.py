"""One motion measured: smoothed, parted into movements and pauses, and counted."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from math import inf, nan
from typing import Any

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import MotionError, SettingError
from motionese.kinematics.definitions import MEASURES
from motionese.kinematics.movements import (
    ABOVE_NOISE,
    SMALLEST,
    Movement,
    Pause,
    movements_of,
    pauses_of,
    still_speed,
)
from motionese.kinematics.shape import extent, repetitiveness
from motionese.kinematics.tracks import WINDOW_S, Track, tracks_of, window_rows

PAUSE_S = 0.15
"""The shortest stillness [s] that counts as a pause."""
ROUNDING = 1e-9
"""Share of the positions' own size below which what looks like a movement is rounding."""
CLOSED = 0.01
"""A movement whose ends are nearer than this share of its way ends where it began."""


@dataclass(frozen=True, eq=False)
class Measures:
    """What is measured of one motion; NaN where something is undefined, with the reason.

    Everything is of the movements and the pauses between them: stillness before the first and
    after the last movement tells when recording began and ended, and counts for nothing.

    Attributes:
        duration: From the first movement's beginning to the last one's end [s].
        speed: Length of all ways over the time of moving [unit/s].
        peak_speed: Largest speed of a movement, mean over movements [unit/s].
        acceleration: Norm of the acceleration, mean over the time of moving [unit/s²].
        peak_acceleration: Its largest in a movement, mean over movements [unit/s²].
        range: Largest distance between two positions [unit].
        roundness: Length of the ways between two rests over the distance of their ends, both
            summed over movements; 1 if straight, π/2 of half a circle. A rest is a pause, or
            stillness at an end of the recording. A movement that ends where it begins has none.
        repetitiveness: Length of the way over that of its parts that are new: 1 if nothing is
            repeated, 3 if everything is done three times.
        pace: Time of moving over time of pausing.
        pause_count: How many pauses there are between two movements.
        pause: How long a pause lasts, on average [s].
        pausing: How long all pauses last [s].
        pace_at_half, pace_at_twice: The pace, were the threshold half or twice as high.
        still: The speed below which the hand counts as still [unit/s].
        from_noise: Whether that threshold is as high as it is because of noise.
        undefined: Why a measure is NaN, by its name.
        movements, pauses: The movements, and the pauses between them.
        tracks: The smoothed motion; several where gaps part it.
    """

    duration: float
    speed: float
    peak_speed: float
    acceleration: float
    peak_acceleration: float
    range: float
    roundness: float
    repetitiveness: float
    pace: float
    pause_count: float
    pause: float
    pausing: float
    pace_at_half: float
    pace_at_twice: float
    still: float
    from_noise: bool
    undefined: Mapping[str, str] = field(repr=False)
    movements: tuple[Movement, ...] = field(repr=False)
    pauses: tuple[Pause, ...] = field(repr=False)
    tracks: tuple[Track, ...] = field(repr=False)

    def numbers(self) -> dict[str, float]:
        """Return the number of every measure by its name, in the order of `MEASURES`."""
        return {name: getattr(self, name) for name in MEASURES}


def measure(
    path: Any,
    rate_hz: float,
    *,
    observed: Any | None = None,
    still: float | None = None,
    pause_s: float = PAUSE_S,
    window_s: float = WINDOW_S,
) -> Measures:
    """Measure how a motion is shown.

    Args:
        path: Positions of a hand, 2-D or 3-D, or joint angles; of one unit. [T, D]
        rate_hz: Rows per second [Hz].
        observed: Which rows, or which of their values, were observed: [T] or [T, D]; where left
            out, those that are not NaN. Gaps of up to half a window are bridged; what lies beyond
            a longer one is measured apart, and the gap counts for nothing.
        still: The speed below which the hand is still [unit/s]; found for None, see
            `kinematics.movements`.
        pause_s: The shortest stillness that counts as a pause [s].
        window_s: Width of the window in which positions are smoothed [s], see `kinematics.tracks`;
            at least 7 rows are taken.

    Raises:
        MotionError: Not an array [T, D] of finite numbers where it was observed, or no rate.
        SettingError: A setting that is no number above 0.
    """
    for name, value in {"still": still, "pause_s": pause_s, "window_s": window_s}.items():
        if value is not None and not 0 < value < inf:
            raise SettingError(f"{name} = {value}: it must be finite and above 0")
    positions, known = _checked(path, observed, rate_hz)
    tracks = tracks_of(positions, known, rate_hz, window_s)
    if not tracks:
        rows = window_rows(rate_hz, window_s)
        return _unmeasured(still or nan, f"fewer than {rows} rows in a piece")
    found = still_speed(tracks)
    reach = extent(np.concatenate([track.positions for track in tracks]))
    noise = max(track.noise for track in tracks)
    rounding = ROUNDING * float(np.abs(positions[known]).max())
    smallest = max(SMALLEST * reach, ABOVE_NOISE * noise, rounding)

    def moved(threshold: float) -> list[list[Movement]]:
        return [movements_of(track, threshold, pause_s, smallest) for track in tracks]

    threshold, from_noise = found if still is None else (still, False)
    movements = moved(threshold)
    numbers, undefined = _numbers(tracks, movements, reach)
    return Measures(
        **numbers,
        pace_at_half=_pace(tracks, moved(threshold / 2)),
        pace_at_twice=_pace(tracks, moved(threshold * 2)),
        still=threshold,
        from_noise=from_noise,
        undefined=undefined,
        movements=tuple(chain.from_iterable(movements)),
        pauses=_pauses(tracks, movements),
        tracks=tracks,
    )


def _unmeasured(still: float, why: str) -> Measures:
    """Return the measures of a motion of which nothing can be told."""
    numbers: dict[str, Any] = dict.fromkeys(MEASURES, nan)
    return Measures(
        **numbers,
        pace_at_half=nan,
        pace_at_twice=nan,
        still=still,
        from_noise=False,
        undefined=dict.fromkeys(MEASURES, why),
        movements=(),
        pauses=(),
        tracks=(),
    )


def _numbers(
    tracks: Sequence[Track], each: Sequence[Sequence[Movement]], reach: float
) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the measures by name, and why some are undefined."""
    movements, pauses = tuple(chain.from_iterable(each)), _pauses(tracks, each)
    if not movements:
        return dict.fromkeys(MEASURES, nan), dict.fromkeys(MEASURES, "nothing moves")
    seconds = sum(m.seconds for m in movements)
    pausing = sum((p.seconds for p in pauses), 0.0)
    between = [m for m in movements if m.from_rest and m.to_rest]
    apart = [m for m in between if m.distance > CLOSED * m.length]
    undefined = {} if pauses else dict.fromkeys(("pace", "pause"), "no pause between movements")
    if not apart:
        why = "no movement from rest to rest" if not between else "movements end where they began"
        undefined["roundness"] = why
    return {
        "duration": sum(part[-1].end_s - part[0].start_s for part in each if part),
        "speed": sum(m.length for m in movements) / seconds,
        "peak_speed": float(np.mean([m.peak_speed for m in movements])),
        "acceleration": sum(m.velocity_change for m in movements) / seconds,
        "peak_acceleration": float(np.mean([m.peak_acceleration for m in movements])),
        "range": reach,
        "roundness": _over(sum(m.length for m in apart), sum(m.distance for m in apart)),
        "repetitiveness": repetitiveness(tracks, each, reach),
        "pace": _pace(tracks, each),
        "pause_count": len(pauses),
        "pause": _over(pausing, len(pauses)),
        "pausing": pausing,
    }, undefined


def _pauses(tracks: Sequence[Track], each: Sequence[Sequence[Movement]]) -> tuple[Pause, ...]:
    return tuple(chain.from_iterable(map(pauses_of, tracks, each)))


def _pace(tracks: Sequence[Track], each: Sequence[Sequence[Movement]]) -> float:
    moving = sum(m.seconds for m in chain.from_iterable(each))
    return _over(moving, sum(p.seconds for p in _pauses(tracks, each)))


def _over(part: float, whole: float) -> float:
    return part / whole if whole else nan


def _checked(
    path: Any, observed: Any | None, rate_hz: float
) -> tuple[Float[ndarray, "T D"], Bool[ndarray, " T"]]:
    """Return positions, 0 where not observed, and the rows at which all were observed."""
    positions = np.asarray(path, dtype=np.float64)
    if positions.ndim != 2 or not positions.shape[1]:
        raise MotionError(f"a path is an array [T, D], got shape {positions.shape}")
    if not (np.isfinite(rate_hz) and rate_hz > 0):
        raise MotionError(f"rate_hz must be finite and > 0, got {rate_hz}")
    seen = ~np.isnan(positions) if observed is None else np.asarray(observed, dtype=bool)
    if seen.shape not in (positions.shape, positions.shape[:1]):
        raise MotionError(f"observed has shape {seen.shape}, the path {positions.shape}")
    known = np.asarray(seen if seen.ndim == 1 else seen.all(axis=1))
    wrong = np.flatnonzero(known & ~np.isfinite(positions).all(axis=1))
    if len(wrong):
        raise MotionError(f"row {wrong[0]} of the path is not finite; say what was not observed")
    return np.where(known[:, None], positions, 0.0), known
