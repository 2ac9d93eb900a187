"""Motions of which everything is known: minimum-jerk strokes with rests, along lines and arcs."""

import numpy as np

LENGTH_M, LEAD_S = 0.3, 0.4


def done(seconds, duration):
    """Return the share of a stroke that is done, from 0 s on."""
    phase = np.clip(np.asarray(seconds) / duration, 0.0, 1.0)
    return phase**3 * (10 - 15 * phase + 6 * phase**2)


def through(places, duration, rest, rate_hz, *, lead=LEAD_S):
    """Return a hand [T, D] that goes straight from place to place [K, D], with rests there."""
    places = np.asarray(places, dtype=float)
    count = len(places) - 1
    total = 2 * lead + count * duration + (count - 1) * rest
    times = np.arange(round(total * rate_hz) + 1) / rate_hz
    begins = lead + (duration + rest) * np.arange(count)
    shares = np.stack([done(times - at, duration) for at in begins], axis=1)
    return places[0] + shares @ np.diff(places, axis=0)


def strokes(duration, rest, rate_hz, count=4, *, lead=LEAD_S):
    """Return a hand [T, 2] that goes to and fro, a rest after each stroke but the last."""
    ends = LENGTH_M * np.array([[0.0, 0.0], [0.8, 0.6]])
    return through(ends[np.arange(count + 1) % 2], duration, rest, rate_hz, lead=lead)


def arc(angle, duration, rate_hz, *, lead=LEAD_S, radius=0.2):
    """Return a hand [T, 2] that goes along an arc of so many radians, from rest to rest."""
    times = np.arange(round((duration + 2 * lead) * rate_hz) + 1) / rate_hz
    gone = angle * done(times - lead, duration)
    return radius * np.stack([np.cos(gone), np.sin(gone)], axis=1)
