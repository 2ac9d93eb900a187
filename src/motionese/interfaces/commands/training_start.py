"""Where a training begins: drawn anew, from a model, or from where it was stopped or has ended."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import jax
from jaxtyping import Array

from motionese.errors import SettingError, StorageError
from motionese.interfaces.commands.model_commands import checkpoint_of
from motionese.learning import Fit, Motions, Training, load, read_fit, read_for
from motionese.learning.training.training_state import checkpoint_facts
from motionese.network import MTRNN, Level

ORIGIN = "origin"
"""The fact in a model's file that tells of what it was trained; see `origin_of`."""
SAME_TAU = 1e-3
"""Share by which time constants may differ and count as the same: they may have been learned."""


@dataclass(frozen=True)
class Start:
    """Where a training begins.

    Attributes:
        network: The network, or what training left of it.
        settings: Of the training; its epochs are those that are left.
        key: Of the state noise.
        earlier: The fit that is gone on from, if it is one of the same training; its epochs count.
        stopped: Epochs after which it was stopped, beside those.
    """

    network: MTRNN | Fit
    settings: Training
    key: Array
    earlier: Fit | None = None
    stopped: int = 0

    @property
    def done(self) -> int:
        """Epochs that were done before."""
        return (0 if self.earlier is None else len(self.earlier.losses)) + self.stopped


def gone_on(out: Path, origin: Mapping[str, str], start: Start) -> Start:
    """Return where a training goes on: from its checkpoint, or from the model that it left.

    Args:
        out: The model's file.
        origin: Of what the training that is to go on would be, see `origin_of`.
        start: Where it began.

    Raises:
        StorageError: There is no such training, or it was begun otherwise.
        SettingError: It has had as many epochs.
    """
    checkpoint = checkpoint_of(out)
    stopped = checkpoint_facts(checkpoint) if checkpoint.exists() else {}
    epochs = int(stopped.get("epochs", 0))
    if stopped.get("networks") == origin["networks"]:
        return replace(start, stopped=epochs)
    if not out.exists():
        if stopped:  # of another network, as its sentence will say
            return replace(start, stopped=epochs)
        raise StorageError(f"--resume: there is no training to go on with at {checkpoint}")
    earlier, _, facts = read_fit(out)
    _check_same(out, facts.get(ORIGIN), origin, stopped=bool(stopped))
    done, wanted = len(earlier.losses), start.settings.epochs
    if earlier.status.failed:
        raise StorageError(f"{out}: {earlier.status}; begin afresh, with smaller rates")
    if done >= wanted:
        raise SettingError(
            f"--resume: {out} has had {done} epochs, {wanted} were asked for in all; to go on give "
            f"more, such as --epochs {2 * done}"
        )
    return Start(
        network=earlier,
        settings=start.settings.model_copy(update={"epochs": wanted - done}),
        key=jax.random.fold_in(start.key, done),
        earlier=earlier,
        stopped=epochs,
    )


def _check_same(
    out: Path, found: Mapping[str, str] | None, origin: Mapping[str, str], *, stopped: bool
) -> None:
    way = f"begin from the model with --begin {out}"
    if found is None:
        raise StorageError(f"--resume: {out} does not tell how it was trained; {way}")
    for part, digest in origin.items():
        if found.get(part) != digest:
            remove = f", or remove {checkpoint_of(out)} to begin afresh" if stopped else ""
            raise StorageError(
                f"--resume: {out}: this training was begun with other {part}; "
                f"go on with the same, or {way}{remove}"
            )


def read_begun(model: Path, source: Path, reading: Mapping[str, Any]) -> tuple[Fit, Motions]:
    """Return a model to begin from, and motions to learn over its channels, in their ranges.

    Raises:
        SettingError: Ranges or units that are given: they are the model's.
        ChannelError: A channel of the model is missing.
    """
    fit = load(model)
    assert fit.network.channels is not None, "a trained network carries channels"
    own = {"--range": reading["ranges"], "--margin": reading["margin"]}
    given = [option for option, value in own.items() if value]
    if given:
        raise SettingError(f"{given[0]}: with --begin the ranges are the model's; leave it out")
    return fit, read_for(fit, source, needed=fit.network.channels.names, **reading)


def check_levels(
    model: Path, network: MTRNN, io_tau: float | None, context: Sequence[Level] | None
) -> None:
    """Refuse levels that contradict those of a model; None stands for the model's.

    Raises:
        SettingError: Another size or time constant, or another number of levels.
    """
    first, *others = network.levels
    io = first if io_tau is None else Level(first.size, io_tau)
    given = [io, *(others if context is None else context)]
    if not (len(given) == 1 + len(others) and all(map(_same, given, network.levels))):
        told = ",".join(f"{level.size}:{level.taus[0]:g}" for level in others)
        raise SettingError(
            f"{model}: the model's levels are io {first.size}:{first.taus[0]:g}, {told}; with "
            "--begin leave --levels and --io-tau out"
        )


def _same(wanted: Level, level: Level) -> bool:
    pairs = zip(wanted.taus, level.taus, strict=False)
    return wanted.size == level.size and all(
        abs(mine - other) <= SAME_TAU * other for mine, other in pairs
    )
