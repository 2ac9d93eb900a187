"""How well time constants are recovered from motions of a network whose τ is known.

A network of known τ generates motions. A second one begins with other τ and learns one factor a
level: alone; together with the motions' initial states; and together with these and with weights
that were disturbed, where other weights can take a time constant's place.

    python benchmarks/learned_tau.py
"""

from dataclasses import replace

import jax
import numpy as np
from rich.console import Console
from rich.table import Table

import motionese as mo

SIZES, TRUE, BEGIN = (3, 12, 3), (2.0, 6.0, 40.0), (3.0, 3.0, 15.0)
CHANNELS = mo.Channels([mo.Channel(name, "", 0.0, 1.0) for name in "xyz"])
SEEDS, ROWS, MOTIONS, DISTURBANCE = 5, 60, 12, 0.1
WAYS: dict[str, tuple[tuple[str, ...], float]] = {
    "τ alone": (("tau",), 0.0),
    "τ and states": (("tau", "initial_states"), 0.0),
    "all": (("weights", "bias", "tau", "initial_states"), DISTURBANCE),
}


def levels(taus: tuple[float, ...]) -> list[mo.Level]:
    """Return the levels with these time constants."""
    return [mo.Level(size, tau) for size, tau in zip(SIZES, taus, strict=True)]


def recovered(seed: int, learned: tuple[str, ...], disturbance: float) -> tuple[float, ...]:
    """Return every level's τ as it was learned."""
    drawn, states, disturbed = jax.random.split(jax.random.key(seed), 3)
    teacher = mo.MTRNN.draw(levels(TRUE), key=drawn, gain=5.0, channels=CHANNELS)
    initial = 2 * np.asarray(jax.random.normal(states, (MOTIONS, teacher.size)))
    motions = mo.Motions.from_arrays(mo.generate(teacher, initial, ROWS), CHANNELS, rate_hz=10.0)
    noise = disturbance * jax.random.normal(disturbed, teacher.weights.shape)
    begin = mo.MTRNN.draw(levels(BEGIN), key=drawn).tau
    fit = mo.train(
        replace(teacher, tau=begin, weights=teacher.weights * (1 + noise)),
        motions,
        settings=mo.Training(
            epochs=3000, learned=learned, weight_rate=0.02, initial_rate=0.02, bound=100.0
        ),
        initial_states=initial,
    )
    return tuple(float(np.mean(level.tau)) for level in fit.network.levels)


def main() -> None:
    """Print true and recovered time constants."""
    table = Table("τ [steps]", "io", "cf", "cs", title=f"Recovered τ, {SEEDS} seeds")
    table.add_row("true", *(f"{tau:g}" for tau in TRUE))
    table.add_row("at first", *(f"{tau:g}" for tau in BEGIN))
    for name, (learned, disturbance) in WAYS.items():
        for seed in range(SEEDS):
            taus = recovered(seed, learned, disturbance)
            table.add_row(f"{name}, seed {seed}", *(f"{tau:.2f}" for tau in taus))
    Console().print(table)


if __name__ == "__main__":
    main()
