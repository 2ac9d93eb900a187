"""Many learners at once against one after the other, in the same run.

On a CPU: 64 networks of the paper's size by `train_ensemble` and by 64 calls of `train`, in turns.
Times are of the clock, which tells what the cores bring, and of the processor. With a GPU: 1, 100,
1,000 and 10,000 networks, their memory, and how much of the card's measured rate of large matrix
products they reach.

    python benchmarks/ensemble.py
"""

from time import perf_counter, process_time

import jax
import jax.numpy as jnp
import numpy as np
from rich.console import Console
from rich.table import Table

from motionese import MTRNN, Level, Motions, Training, train, train_ensemble

SIZES, TAUS, MOTIONS, STEPS = (6, 40, 2), (2.0, 5.0, 70.0), 9, 80
SETTINGS = Training(epochs=300)
LEARNERS, ROUNDS, ON_A_GPU = 64, 3, (1, 100, 1_000, 10_000)


def curves() -> Motions:
    """Smooth random motions."""
    rng = np.random.default_rng(0)
    t = np.linspace(0.0, 2 * np.pi, STEPS)[:, None, None]
    phases = rng.uniform(0, 6, (MOTIONS, 1, 3, SIZES[0]))
    waves = np.sin(t * rng.uniform(0.5, 2.0, (3, SIZES[0])) + phases).mean(2)
    return Motions.from_arrays(list(waves), [f"channel {i}" for i in range(SIZES[0])], 10.0)


def networks(count: int) -> list[MTRNN]:
    """Draw networks from keys of their own."""
    levels = [Level(size, tau) for size, tau in zip(SIZES, TAUS, strict=True)]
    return [MTRNN.draw(levels, key=jax.random.key(seed)) for seed in range(count)]


def seconds(function) -> tuple[float, float]:
    """Measure the time of the clock and of the processor."""
    clock, processor = perf_counter(), process_time()
    function()
    return perf_counter() - clock, process_time() - processor


def on_a_cpu(console: Console) -> None:
    """Compare with one training after the other."""
    motions, drawn = curves(), networks(LEARNERS)

    def singly() -> list:
        return [train(network, motions, settings=SETTINGS) for network in drawn]

    def at_once() -> list:
        return train_ensemble(drawn, motions, settings=SETTINGS)

    for one, other in zip(singly(), at_once(), strict=True):
        np.testing.assert_array_equal(one.losses, other.losses)
    turns = np.array([(seconds(singly), seconds(at_once)) for _ in range(ROUNDS)])
    table = Table(title=f"{LEARNERS} learners, {SETTINGS.epochs} epochs, to the same bits")
    for heading in ("", "clock, s", "processor, s"):
        table.add_column(heading, justify="right")
    for name, times in zip(("one after the other", "at once"), np.median(turns, 0), strict=True):
        table.add_row(name, *(f"{time:.1f}" for time in times))
    ratios = np.median(turns[:, 0] / turns[:, 1], axis=0)
    table.add_row("times faster", *(f"{ratio:.2f}" for ratio in ratios))
    console.print(table)


def rate_of_products() -> float:
    """Measure how many floating-point operations a second large products of float32 come to."""
    size, repeated = 8192, 20
    a = jnp.ones((size, size))
    product = jax.jit(lambda a: a @ a)
    product(a).block_until_ready()
    began = perf_counter()
    for _ in range(repeated):
        result = product(a)
    result.block_until_ready()
    return repeated * 2 * size**3 / (perf_counter() - began)


def on_a_gpu(console: Console) -> None:
    """Measure ensembles that grow."""
    motions, rate = curves(), rate_of_products()
    # Three products a step: forward, backward, and the weights' gradient.
    operations = 3 * 2 * sum(SIZES) ** 2 * MOTIONS * (STEPS - 1) * SETTINGS.epochs
    table = Table(title=f"{SETTINGS.epochs} epochs; products reach {rate / 1e12:.1f} TFLOP/s")
    for heading in (
        "learners",
        "ms an epoch",
        "µs a learner",
        "share of the rate",
        "most GB so far",
    ):
        table.add_column(heading, justify="right")
    for count in ON_A_GPU:
        drawn = networks(count)
        train_ensemble(drawn, motions, settings=SETTINGS)  # compiles
        clock, _ = seconds(lambda drawn=drawn: train_ensemble(drawn, motions, settings=SETTINGS))
        most = (jax.devices()[0].memory_stats() or {}).get("peak_bytes_in_use", float("nan"))
        epoch = clock / SETTINGS.epochs
        share = count * operations / clock / rate
        numbers = (f"{epoch * 1e3:.2f}", f"{epoch / count * 1e6:.2f}", f"{share:.1%}")
        table.add_row(f"{count:,}", *numbers, f"{most / 1e9:.1f}")
    console.print(table)


def main() -> None:
    """Measure what this machine has."""
    console = Console()
    if jax.default_backend() == "cpu":
        on_a_cpu(console)
        console.print("No GPU is here: thousands of learners in one call were not measured.")
    else:
        on_a_gpu(console)


if __name__ == "__main__":
    main()
