"""The robot's side: how long a step takes, and whether a loop of 50 Hz keeps its deadlines.

A step takes what was sensed and moves the network on. The runtime's (NumPy) stands beside the same
step exported to ONNX, run by onnxruntime, and compiled by jax.jit; all run from the same state in
one process on one core. Then a loop of 50 Hz runs for 60 s on one core, while another process on
another core recognises motions without a pause, as a robot would that watches while it moves.

    python benchmarks/control_loop.py
"""

import multiprocessing
import os
import sys
import tempfile
from collections.abc import Callable
from multiprocessing.synchronize import Event
from pathlib import Path
from time import perf_counter_ns

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = "1"

import jax
import jax.numpy as jnp
import numpy as np
from rich.console import Console
from rich.table import Table

import motionese as mo
from motionese.interfaces.onnx_export import export_onnx
from motionese.runtime import ControlLoop, Part, Player, Stepper, load

try:
    import onnxruntime
except ImportError:
    sys.exit("this benchmark compares with onnxruntime: pip install 'motionese[onnx]'")

CHANNELS, RATE_HZ, SECONDS = 8, 50.0, 60.0
MODELS = {"48 units: 8 IO, 34, 6": (8, 34, 6), "48 context units: 8 IO, 40, 8": (8, 40, 8)}
STEPS, TARGET_US = 20_000, 25.0
CORES = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []


def trained(sizes: tuple[int, ...]) -> mo.Fit:
    """Train shortly on smooth random motions: what a step costs does not depend on the weights."""
    rng = np.random.default_rng(0)
    t = np.linspace(0.0, 2 * np.pi, 150)[:, None]
    arrays = [np.sin(t * rng.uniform(0.5, 2, CHANNELS) + rng.uniform(0, 6, CHANNELS)) for _ in "ab"]
    names = [f"joint {i}" for i in range(CHANNELS)]
    motions = mo.Motions.from_arrays(arrays, names, RATE_HZ, names=["a", "b"])
    levels = [mo.Level(s, tau) for s, tau in zip(sizes, (2.0, 5.0, 70.0), strict=True)]
    return mo.train(mo.MTRNN.draw(levels, key=jax.random.key(0)), motions, epochs=300)


def microseconds(step: Callable[[], object]) -> tuple[float, float]:
    """Measure a step's median and 99th percentile, each step by itself."""
    took = np.empty(STEPS)
    for i in range(STEPS):
        began = perf_counter_ns()
        step()
        took[i] = perf_counter_ns() - began
    return float(np.median(took)) / 1e3, float(np.percentile(took, 99)) / 1e3


def runtime_step(path: Path) -> Callable[[], object]:
    """The step of the runtime alone, in the unit interval."""
    model = load(path)
    stepper, state = Stepper(model), model.begin("a")
    sensed, share = np.full(CHANNELS, 0.5), np.full(CHANNELS, 0.1)
    return lambda: stepper.step(state, sensed, share)


def player_step(path: Path) -> Callable[[], object]:
    """The step with all that a robot needs around it: units, readings that may be missing."""
    model = load(path)
    player, reading = Player(model, model.begin("a"), 0.1), np.zeros(CHANNELS)
    return lambda: player.step(reading)


def onnx_step(fit: mo.Fit, path: Path) -> Callable[[], object]:
    """The exported step in closed loop, run by onnxruntime on one thread."""
    export_onnx(path, fit)
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    session = onnxruntime.InferenceSession(path, options, providers=["CPUExecutionProvider"])
    fed = {"x": np.full(CHANNELS, 0.5, np.float32), "u": fit.initial_states[0].astype(np.float32)}

    def step() -> None:
        fed["x"], fed["u"] = session.run(["y", "u_next"], fed)

    return step


def jax_step(fit: mo.Fit) -> Callable[[], object]:
    """The same step compiled by jax.jit, its y handed out as NumPy."""
    network = fit.network
    rate = 1 / network.tau
    scaled, offset, kept = rate[:, None] * network.wired_weights(), rate * network.bias, 1 - rate

    @jax.jit
    def compiled(x: jax.Array, u: jax.Array) -> tuple[jax.Array, jax.Array]:
        inputs = jnp.concatenate([x, jax.nn.sigmoid(u[CHANNELS:])])
        following = kept * u + scaled @ inputs + offset
        return jax.nn.sigmoid(following[:CHANNELS]), following

    now = {"x": np.full(CHANNELS, 0.5, np.float32), "u": jnp.asarray(fit.initial_states[0])}

    def step() -> None:
        y, now["u"] = compiled(now["x"], now["u"])
        now["x"] = np.asarray(y)

    step()
    return step


def time_steps(console: Console, name: str, fit: mo.Fit, folder: Path) -> None:
    """Print a table of one model's steps."""
    path = folder / "model.safetensors"
    table = Table(title=f"One step, {name}; target ≤ {TARGET_US:g} µs in NumPy")
    for heading in ("", "median [µs]", "99 % [µs]", "target"):
        table.add_column(heading, justify="left" if not heading else "right")
    for label, step, judged in (
        ("runtime, NumPy", runtime_step(path), True),
        ("  with units and missing readings", player_step(path), True),
        ("onnxruntime", onnx_step(fit, folder / "step.onnx"), False),
        ("jax.jit", jax_step(fit), False),
    ):
        median, slow = microseconds(step)
        verdict = ("met" if median <= TARGET_US else "missed") if judged else ""
        table.add_row(label, f"{median:.1f}", f"{slow:.1f}", verdict)
    console.print(table)


def recognise_on(path: Path, ready: Event, over: Event) -> None:
    """Recognise one motion after another until told to end, on the last core."""
    if CORES:
        os.sched_setaffinity(0, CORES[-1:])
    fit = mo.load(path)
    motion = mo.generate(fit.network, fit.initial_states[0], 150)
    while not over.is_set():
        mo.recognise(fit.network, motion, observed=["joint 0", "joint 3", "joint 5"])
        ready.set()


def run_loop(console: Console, path: Path) -> None:
    """Run the loop beside recognition and print what it missed."""
    context = multiprocessing.get_context("spawn")
    ready, over = context.Event(), context.Event()
    other = context.Process(target=recognise_on, args=(path, ready, over))
    other.start()
    if not ready.wait(timeout=120):
        other.kill()
        sys.exit("recognition in the other process has not begun")
    if CORES:
        os.sched_setaffinity(0, CORES[:1])
    model, arm = load(path), dict.fromkeys((f"joint {i}" for i in range(CHANNELS)), 0.0)
    loop = ControlLoop(model, lambda: arm, arm.update, rate_hz=RATE_HZ, share=0.1)
    try:
        ran = loop.run(Part("a", int(SECONDS * RATE_HZ)))
    finally:
        over.set()
        other.join()
    where = f"core {CORES[0]}, recognition on core {CORES[-1]}" if CORES else "cores as they come"
    console.print(
        f"{RATE_HZ:g} Hz for {SECONDS:g} s on {where}: {ran.steps} commands, "
        f"{ran.missed} deadlines missed (target 0: {'missed' if ran.missed else 'met'}), "
        f"worst lateness {ran.worst_lateness_s * 1e3:.2f} ms of {1e3 / RATE_HZ:g} ms, "
        f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    )


def main() -> None:
    """Time the steps of both models, then run the loop."""
    console = Console()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for label, sizes in MODELS.items():
            fit = trained(sizes)
            mo.save(folder / "model.safetensors", fit)
            time_steps(console, label, fit, folder)
        run_loop(console, folder / "model.safetensors")


if __name__ == "__main__":
    main()
