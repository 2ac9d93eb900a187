"""Pauses: the same square shown to an adult and to a child, and what is measured of it."""

from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

CORNERS = 0.3 * np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]])
RATE_HZ = 60.0


def square(stroke_s, rest_s, bow, rng):
    """Return a hand [T, 2] that goes around a square, resting at its corners [m]."""
    rows = [np.tile(CORNERS[0], (30, 1))]
    for start, end in pairwise(CORNERS):
        s = np.linspace(0, 1, round(stroke_s * RATE_HZ))[:, None]
        s = s**3 * (10 - 15 * s + 6 * s**2)
        aside = (end - start) @ np.array([[0, -1], [1, 0]])
        rows += [start + s * (end - start) + bow * np.sin(np.pi * s) * aside]
        rows += [np.tile(end, (round(rest_s * RATE_HZ), 1))]
    path = np.concatenate(rows)
    return path + 0.0003 * rng.normal(size=path.shape)


rng = np.random.default_rng(0)
shown = {"to an adult": square(0.7, 0.2, 0.05, rng), "to a child": square(1.0, 0.6, 0.2, rng)}
figure, panels = plt.subplots(2, 2, figsize=(9, 6), layout="tight", width_ratios=[2, 3])
for (place, course), (name, path) in zip(panels, shown.items(), strict=True):
    found = mo.measure(path, RATE_HZ)
    place.plot(*path.T, color="#0072b2")
    for pause in found.pauses:
        place.scatter(*pause.position, s=300 * pause.seconds, color="#d55e00", zorder=3)
        course.axvspan(pause.start_s, pause.end_s, color="#e69f00", alpha=0.4, linewidth=0)
    for track in found.tracks:
        course.plot(track.times, track.speeds, color="#0072b2")
    course.axhline(found.still, color="black", linestyle="--", linewidth=0.9)
    numbers = f"pace {found.pace:.1f}, roundness {found.roundness:.2f}, {found.speed:.2f} m/s"
    course.set(xlabel="time [s]", ylabel="speed [m/s]", title=numbers, xlim=(0, 7))
    place.set(xlabel="x [m]", ylabel="y [m]", title=name, aspect="equal")
figure.savefig("pauses.png", dpi=120)
