"""Many learners at once: networks of one shape, each trained as `train` would train it alone.

On a CPU networks this small are fastest one by one: what `train` compiles is called for one learner
after the other, on every core at the same time. Each learner comes to the bits of a training alone.

An accelerator is slow at one small network and fast at many, so there all learners go through the
same epochs in one call (`jax.vmap`); learners in batches go one after the other. The sums in its
matrix products run in another order than those of a single network: losses agree to rounding at
first (1e-8 of themselves in float64 over 30 epochs), and then drift apart as fast as the training
amplifies rounding, as they do between two machines.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import monotonic

import jax
import jax.numpy as jnp
from jaxtyping import Array

from motionese.arguments import refusing
from motionese.errors import SettingError
from motionese.learning.fit import Fit
from motionese.learning.motions.motions import Motions
from motionese.learning.settings import Training
from motionese.learning.status import Progress, Status
from motionese.learning.training.shared_states import Groups
from motionese.learning.training.side_by_side import in_one_call, on_every_core
from motionese.learning.training.train import CHECKPOINT_EVERY_S
from motionese.learning.training.trainer import Trainer, make_trainer
from motionese.learning.training.training_state import TrainingState
from motionese.network import MTRNN

OF_ONE_KIND = ("names", "sizes", "channels", "learned_bias", "initial_io", "variance")
"""What all networks of an ensemble have in common; weights and time constants are each one's."""


@dataclass
class Learner:
    """One training of an ensemble, where it stands, and the file that keeps it."""

    trainer: Trainer
    state: TrainingState
    status: Status | None
    checkpoint: Path | None

    @classmethod
    def begun(cls, trainer: Trainer, checkpoint: Path | None) -> "Learner":
        """Return a learner at the beginning, or where its checkpoint left it."""
        state = trainer.beginning
        if checkpoint and checkpoint.exists():
            state = state.resumed(checkpoint, trainer.origin)
        return cls(trainer, state, trainer.ended(state), checkpoint)

    @property
    def updates(self) -> int:
        """Updates done."""
        return len(self.state.losses)

    def keep(self) -> None:
        """Write the checkpoint, where there is to be one."""
        if self.checkpoint and not (self.status and self.status.failed):
            epochs = self.trainer.epochs(self.state)
            self.state.write(self.checkpoint, self.trainer.origin, epochs)

    def fit(self) -> Fit:
        """Return what training left, on the device that all began on."""
        assert self.status is not None, "asked of learners that have ended"
        latest, best = jax.tree.map(jnp.asarray, (self.state.latest, self.state.best))
        return self.trainer.fit(replace(self.state, latest=latest, best=best), self.status)


@refusing()
def train_ensemble(
    networks: Sequence[MTRNN | Fit],
    motions: Motions | Sequence[Motions],
    *,
    epochs: int | None = None,
    settings: Training | None = None,
    shared: Groups | None = None,
    validation: Motions | None = None,
    keys: Sequence[Array] | None = None,
    padded_to: tuple[int, int] | None = None,
    progress: Callable[[list[Progress]], None] | None = None,
    checkpoints: str | Path | None = None,
) -> list[Fit]:
    """Train many networks, each as `train` would; return what training left of every one.

    A learner that converges or diverges ends, as its status says; the others go on. On a CPU as
    many learn at a time as there are cores, or as `OMP_NUM_THREADS` says.

    Args:
        networks: Where to start from: networks of one kind, or what training left of them.
        motions: What all learn, or what each learns, over the same channels in the same ranges.
        epochs: As of `train`, for every learner; so are `settings`, `shared` and `validation`.
        keys: JAX random keys of the state noise, one a network; needed where there is any.
        padded_to: As of `train`; all sets of motions are padded to one size in any case.
        progress: Called between chunks of epochs, with how far every learner is.
        checkpoints: A folder in which every learner has a checkpoint, as of `train`.

    Raises:
        SettingError: As of `train`; networks of different kinds, or another number of networks
            than of sets of motions or of keys.
        StorageError: A checkpoint belongs to another training, or cannot be read.
    """
    sets = [motions] * len(networks) if isinstance(motions, Motions) else list(motions)
    drawn = [None] * len(networks) if keys is None else list(keys)
    if not networks:
        raise SettingError("an ensemble needs at least one network, got none")
    for what, given in (("sets of motions", sets), ("keys", drawn)):
        if len(given) != len(networks):
            raise SettingError(f"{len(networks)} networks need as many {what}, got {len(given)}")
    size = padded_to or (max(map(len, sets)), max(max(own.lengths) for own in sets))
    common = (epochs, settings or Training(), None, shared or {}, validation)
    trainers = [
        make_trainer(network, own, *common, key, size)
        for network, own, key in zip(networks, sets, drawn, strict=True)
    ]
    _check_alike(trainers)
    if isinstance(motions, Motions) and not common[1].batch:
        trainers = [replace(trainer, feed=trainers[0].feed) for trainer in trainers]
    folder = None if checkpoints is None else Path(checkpoints)
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
    learners = [
        Learner.begun(trainer, folder and folder / f"{place}")
        for place, trainer in enumerate(trainers)
    ]
    try:
        _train(learners, progress)
    finally:
        _keep(learners)
    return [learner.fit() for learner in learners]


def _check_alike(trainers: Sequence[Trainer]) -> None:
    first, *others = (trainer.start.network for trainer in trainers)
    for place, network in enumerate(others, 1):
        for what in OF_ONE_KIND:
            if getattr(network, what) != getattr(first, what):
                raise SettingError(
                    f"network {place} differs from network 0 in its {what}; "
                    "the networks of an ensemble must be of one kind"
                )


def _train(learners: Sequence[Learner], progress: Callable[[list[Progress]], None] | None) -> None:
    """Train chunk by chunk, until all have ended; those that are furthest behind go first."""
    one_by_one = jax.default_backend() == "cpu" or learners[0].trainer.settings.batch
    advanced = on_every_core if one_by_one else in_one_call(len(learners))
    written = monotonic()
    while going := [learner for learner in learners if learner.status is None]:
        behind = min(learner.updates for learner in going)
        turn = [learner for learner in going if learner.updates == behind]
        later = advanced([each.trainer for each in turn], [each.state for each in turn])
        for learner, (state, status) in zip(turn, later, strict=True):
            learner.state, learner.status = state, status
        if progress:
            progress([learner.trainer.progress(learner.state) for learner in learners])
        if monotonic() - written > CHECKPOINT_EVERY_S:
            _keep(learners)
            written = monotonic()


def _keep(learners: Sequence[Learner]) -> None:
    for learner in learners:
        learner.keep()
