"""Hands: how a person strays from a way, and shapes that are no motion of a task."""

from itertools import permutations

import numpy as np

from motionese.caregiver import intended_way, lasting, stroke_length


def straying(way, rng, cm):
    """A hand's path along a way: shifted, tilted, scaled, bowed, with a tremor; rms in cm."""
    middle, along = way.mean(axis=0), np.linspace(0, np.pi, len(way))
    off = (way - middle) @ rng.normal(0, 0.15, (3, 3)) + rng.normal(0, 0.01, 3)
    for wave in (1, 2, 3):
        off += np.sin(wave * along)[:, None] * rng.normal(0, 0.01 / wave, 3)
    off += rng.normal(0, 0.001, way.shape)
    return way + off * cm / 100 / np.sqrt((off**2).sum(axis=1).mean())


def no_motions(task, rng, count):
    """Shapes on the surface of a task that are none of its motions, by kind, so many each."""
    long, places = stroke_length(task), {name: task.position(name) for name in task.places}
    middle = np.mean([*places.values()], axis=0)
    across, along = np.linalg.svd(np.array([*places.values()]) - middle)[2][:2]
    strokes = [intended_way(sequence, task) for sequence in task.sequences(1)]
    allowed = {(p.start, p.end) for p in task.primitives}
    pairs = [pair for pair in permutations(places, 2) if pair not in allowed]
    turn, line = np.linspace(0, 2 * np.pi, 60), np.linspace(-1, 1, 60)

    def circle():
        radius, begin, sense = long * rng.uniform(0.3, 0.6), rng.uniform(0, 7), rng.choice([-1, 1])
        around = np.cos(begin + sense * turn)[:, None] * across
        around = around + np.sin(begin + sense * turn)[:, None] * along
        at = [*places.values()][rng.integers(len(places))]
        return radius * around + (at - radius * around[0] if rng.random() < 0.5 else middle)

    def beyond():
        way = strokes[rng.integers(len(strokes))]
        return way + (way[-1] - way[0]) * rng.uniform(0.5, 1.0)

    def wave():
        high = long * rng.uniform(0.25, 0.4)
        return middle + np.outer(line, across) * long / 2 + np.outer(np.sin(9 * line), along) * high

    kinds = {
        "line": lambda: lasting(np.stack([places[n] for n in pairs[rng.integers(len(pairs))]]), 40),
        "circle": circle,
        "beyond": beyond,
        "half": lambda: strokes[rng.integers(len(strokes))][:32],
        "wave": wave,
    }
    return {kind: [shape() for _ in range(count)] for kind, shape in kinds.items()}
