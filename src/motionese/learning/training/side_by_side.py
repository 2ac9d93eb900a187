"""Updates of many trainings: on every core of a CPU, or in one call of an accelerator."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from motionese.learning.status import Status
from motionese.learning.training.trainer import Trainer
from motionese.learning.training.training_state import TrainingState
from motionese.learning.training.updates import Iterate, run_updates

Judged = tuple[TrainingState, Status | None]
Advance = Callable[[Sequence[Trainer], Sequence[TrainingState]], list[Judged]]
"""What `Trainer.advanced` does, of several trainings that have had as many updates."""


def on_every_core(trainers: Sequence[Trainer], states: Sequence[TrainingState]) -> list[Judged]:
    """Advance each training by itself, as many at a time as there are cores.

    XLA runs outside of Python's lock, and every training to the same bits as alone.
    """
    double = jnp.result_type(float) == np.float64  # as the calling thread has it, maybe alone

    def advanced(trainer: Trainer, state: TrainingState) -> Judged:
        with jax.enable_x64(double):
            return trainer.advanced(state)

    cores = int(os.environ.get("OMP_NUM_THREADS") or os.cpu_count() or 1)
    with ThreadPoolExecutor(cores) as pool:
        return list(pool.map(advanced, trainers, states))


def in_one_call(most: int) -> Advance:
    """Return what advances up to so many trainings in one call, each as a lane of a map.

    They learn from all of their motions at once, not in batches.

    Fewer are filled up with copies to a half, a quarter, … of the most, so that few numbers of
    lanes are ever compiled.
    """
    stacked: dict[tuple[int, ...], Any] = {}

    def advanced(trainers: Sequence[Trainer], states: Sequence[TrainingState]) -> list[Judged]:
        lanes = most >> ((most // len(trainers)).bit_length() - 1)
        which = [*range(len(trainers)), *[0] * (lanes - len(trainers))]
        members = tuple(id(trainers[i]) for i in which)
        if members not in stacked:
            stacked.clear()
            stacked[members] = _stacked([trainers[i].problem(states[i]) for i in which])
        latest = jax.tree.map(lambda *each: np.stack(each), *(states[i].latest for i in which))
        length = trainers[0].problem(states[0])["length"]
        later = _lanes(latest, stacked[members], length)
        following, losses = jax.device_get(later)
        return [
            trainer.judged(state, jax.tree.map(lambda of, i=i: of[i], following), losses[i])
            for i, (trainer, state) in enumerate(zip(trainers, states, strict=True))
        ]

    return advanced


def _stacked(problems: Sequence[dict[str, Any]]) -> tuple[Any, Any, Any]:
    """Return arrays of all lanes, the axis along which each is mapped, and what is no array.

    An array that is the same object in every problem, such as the motions that all learn, is there
    once, and mapped along no axis.
    """
    arrays, others = zip(*(eqx.partition(each, eqx.is_array) for each in problems), strict=True)
    axes = jax.tree.map(
        lambda *each: 0 if any(one is not each[0] for one in each) else None, *arrays
    )

    def stack(*each: Array) -> Any:
        if all(one is each[0] for one in each):
            return each[0]
        if jnp.issubdtype(each[0].dtype, jax.dtypes.prng_key):
            data = jnp.asarray(np.stack([jax.random.key_data(key) for key in each]))
            return jax.random.wrap_key_data(data, impl=jax.random.key_impl(each[0]))
        return jnp.asarray(np.stack(each))

    return jax.tree.map(stack, *arrays), axes, others[0]


@eqx.filter_jit
def _lanes(latest: Iterate, stacked: tuple[Any, Any, Any], length: int) -> tuple[Iterate, Array]:
    problems, axes, others = stacked

    def lane(latest: Iterate, problem: Any) -> tuple[Iterate, Array]:
        return run_updates(latest, **{**eqx.combine(problem, others), "length": length})

    return jax.vmap(lane, in_axes=(0, axes))(latest, problems)
