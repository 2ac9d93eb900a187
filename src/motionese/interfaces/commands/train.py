"""Recordings in, a trained model out."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import jax
from jax import Device
from jaxtyping import Array
from rich.console import Console

from motionese.errors import SettingError, StorageError, unknown
from motionese.interfaces.commands.display import TrainingDisplay
from motionese.interfaces.commands.model_commands import checkpoint_of
from motionese.interfaces.commands.outputs import MODEL_SUFFIX, check_apart, check_output
from motionese.interfaces.commands.summaries import description, error_table, verdict
from motionese.interfaces.commands.terminal import tell_findings
from motionese.interfaces.commands.training_start import (
    ORIGIN,
    Start,
    check_levels,
    gone_on,
    read_begun,
)
from motionese.interfaces.logs.training_logs import open_logs
from motionese.learning import (
    Fit,
    Motions,
    Progress,
    Training,
    diagnose,
    split,
    train,
    write_fit,
)
from motionese.learning.training.trainer import origin_of
from motionese.network import MTRNN, Level, network_of

LEVELS, IO_TAU = "40:5,8:70", 2.0
"""Context levels as SIZE:TAU, and the time constant of the IO level, where none are given."""
BY_LEVEL = ("bound", "noise")
"""Settings that can be given by level, as in 'bound=cf:5,cs:2'."""
PAYS = 800
"""Rows of an update for every thread from which on several are faster than one; see
`benchmarks/large_recordings.py`."""
MOST_UNITS = 5000
"""Every pair of units has a weight: beyond it, no memory holds what is trained."""


def train_model(
    console: Console,
    source: Path,
    out: Path,
    *,
    levels: str | None,
    io_tau: float | None,
    held_out: str | None,
    seed: int,
    begin: Path | None,
    resume: bool,
    settings: Training,
    threads: int,
    logs: Sequence[str],
    stored: bool,
    reading: Mapping[str, Any],
) -> Fit:
    """Train a network on recordings, save it, and tell how good it is.

    Everything is checked before anything is written.

    Args:
        levels: Context levels as SIZE:TAU,SIZE:TAU, fast ones first; `LEVELS` for None.
        io_tau: Time constant of the IO level [steps]; `IO_TAU` for None.
        held_out: A share of the motions or their names, as in '0.2' or 'wave,lift'; see `split`.
        seed: Of the initial weights, the held-out motions and the state noise.
        begin: A model whose network, ranges and initial states it begins from; None to draw one.
        resume: Whether it goes on, from where it was stopped or has ended.
        threads: Devices of JAX that share an update.
        logs: Kinds of logs, see `open_logs`.
        stored: Whether motions stay in `source`, and are read when they are needed.
        reading: How `source` is read, as `Motions.read` takes it.
    """
    if stored and not settings.batch:
        raise SettingError(
            "--stored reads one batch of motions after another; give --batch, as in 64"
        )
    checkpoint = _checkpoint(out, resume)
    check_apart([source, *([begin] if begin else [])], out, checkpoint)
    drawn, noise = jax.random.split(jax.random.key(seed))
    context = None if levels is None else read_levels(levels)
    network, motions = _begun(begin, source, context, io_tau, stored, reading, drawn)
    learned, unseen = split(motions, read_held_out(held_out, motions), seed=seed)
    origin = origin_of(network, learned, settings, unseen, noise)
    start = Start(network, settings, noise)
    if resume:
        start = gone_on(out, origin, start)
    console.print(f"{source}: {description(motions)}")
    tell_findings(console, motions.examined)
    told = "as the file says" if held_out is None and motions.set_apart else ""
    console.print(_told(start, begin, learned, unseen, told))
    devices = _devices(console, threads, settings, learned)
    display = TrainingDisplay(console, settings.epochs, start.done)
    earlier = start.done - start.stopped
    with open_logs(logs, out, start.done) as log, display:

        def progress(now: Progress) -> None:
            now = now._replace(epoch=now.epoch + earlier)
            display.show(now)
            numbers = {k: v for k, v in now._asdict().items() if v is not None and k != "epoch"}
            log.write(now.epoch, numbers)

        trained = train(
            start.network,
            learned,
            settings=start.settings,
            validation=unseen,
            key=start.key,
            progress=progress,
            checkpoint=checkpoint,
            devices=devices,
        )
    fit = trained if start.earlier is None else trained.after(start.earlier)
    write_fit(out, fit, {}, {ORIGIN: origin})
    checkpoint.unlink(missing_ok=True)  # not before: what was learned is in one of the two files
    console.print(error_table(fit))
    console.print(verdict(fit, diagnose(trained, learned, settings.teacher_forcing)))
    console.print(f"{fit.status}. The model is {out}")
    if fit.status.failed:
        raise SettingError(f"{out}: {fit.status}; train with smaller rates, --set weight_rate=0.01")
    return fit


def _begun(
    begin: Path | None,
    source: Path,
    context: Sequence[Level] | None,
    io_tau: float | None,
    stored: bool,
    reading: Mapping[str, Any],
    key: Array,
) -> tuple[MTRNN | Fit, Motions]:
    """Return a network that is drawn, or a model to begin from, and the motions that it learns."""
    if begin is not None:
        if stored:
            raise SettingError(
                "--stored: with --begin motions are read whole; leave one of them out"
            )
        fit, motions = read_begun(begin, source, reading)
        check_levels(begin, fit.network, io_tau, context)
        return fit, motions
    context = read_levels(LEVELS) if context is None else context
    motions = Motions.read(source, stored=stored, **reading)
    io = Level(len(motions.channels), IO_TAU if io_tau is None else io_tau)
    return MTRNN.draw([io, *context], key=key), motions


def _told(
    start: Start, begin: Path | None, learned: Motions, unseen: Motions | None, why: str
) -> str:
    """Return in words what is trained, and from where."""
    io, *context = (f"{level.size}:{level.taus[0]:g}" for level in network_of(start.network).levels)
    told = [
        f"Levels io {io}, {','.join(context)}; {len(learned)} motions to learn, "
        f"{len(unseen or ())} held out{why and f', {why}'}; Ctrl-C stops, --resume goes on"
    ]
    if isinstance(start.network, Fit) and not start.stopped:
        known = len(set(start.network.names) & set(learned.names))
        what = f"{begin}" if start.earlier is None else f"its {start.done} epochs"
        told.append(
            f"Goes on from {what}: {known} motions from their initial states there; the "
            "optimiser's memory and the schedule of its rates begin anew"
        )
    return "\n".join(told)


def read_levels(levels: str | Sequence[tuple[int, float]]) -> list[Level]:
    """Return the context levels that `40:5,8:70` or pairs (size, τ [steps]) stand for, fast first.

    Raises:
        SettingError: The text is not of that form, or a level cannot have such a size or τ.
    """
    try:
        given = map(_size_and_tau, levels.split(",")) if isinstance(levels, str) else levels
        pairs = [(size, float(tau)) for size, tau in given]
    except (TypeError, ValueError) as error:
        raise SettingError(
            f"levels must be given as SIZE:TAU,SIZE:TAU such as 40:5,8:70, got {levels!r}"
        ) from error
    units = sum(size for size, _ in pairs if isinstance(size, int))
    if units > MOST_UNITS:
        raise SettingError(f"levels of {units} units in all; at most {MOST_UNITS} can be trained")
    return [Level(size, tau) for size, tau in pairs]


def _devices(
    console: Console, threads: int, settings: Training, motions: Motions
) -> list[Device] | None:
    """Return the devices that share an update, several alone; tell where they would not pay."""
    if threads == 1:
        return None
    devices = jax.devices()
    if threads > len(devices):
        raise SettingError(f"--threads {threads}: there are {len(devices)} {devices[0].platform}s")
    rows = (settings.batch or len(motions)) * max(motions.lengths)
    if rows < PAYS * threads:
        console.print(
            f"An update is of {rows} rows: {threads} threads pay from about {PAYS * threads} on, "
            "one is about as fast"
        )
    return devices[:threads]


def read_training(
    epochs: int | None, patience: int | None, overrides: Sequence[str], batch: int | None = None
) -> Training:
    """Return the settings of training of texts such as 'weight_rate=0.02'.

    Raises:
        SettingError: A setting that does not exist, or a value that is not allowed.
    """
    own = {"epochs": epochs, "patience": patience, "batch": batch}
    given: dict[str, Any] = {name: value for name, value in own.items() if value is not None}
    for text in overrides:
        name, _, told = text.partition("=")
        if name not in Training.model_fields:
            raise SettingError(unknown("setting", name, Training.model_fields))
        given[name] = _by_level(told) if name in BY_LEVEL and ":" in told else told
        if name == "learned":
            given[name] = told.split(",")
    return Training(**given)


def read_held_out(text: str | None, motions: Motions) -> float | list[str] | None:
    """Return the share or the names that a text is; below 1 a number is always a share."""
    if text is None:
        return None
    with suppress(ValueError):
        share = float(text)
        if 0 <= share < 1 or text not in motions.names:
            return share
    return [name.strip() for name in text.split(",")]


def _size_and_tau(text: str) -> tuple[int, float]:
    size, tau = text.split(":")
    return int(size), float(tau)


def _by_level(told: str) -> dict[str, str]:
    """Return the values of a text such as 'cf:5,cs:2' by level."""
    parts = (part.partition(":") for part in told.split(","))
    return {level: value for level, _, value in parts}


def _checkpoint(out: Path, resume: bool) -> Path:
    """Return where training is kept, after checking that it may be begun, or gone on with."""
    check_output("--out", out, (MODEL_SUFFIX,))
    checkpoint = checkpoint_of(out)
    if checkpoint.exists() and not resume:
        raise StorageError(
            f"{checkpoint}: a training of this model was stopped; go on with it with --resume, "
            "or remove the file to begin afresh"
        )
    return checkpoint
