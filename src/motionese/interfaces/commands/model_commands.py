"""Commands for models: train, recognise, generate."""
# ruff: noqa: PLC0415

import os
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from typer import Argument, Option

from motionese.errors import SettingError
from motionese.interfaces.commands.exit_status import plainly
from motionese.interfaces.commands.recording_options import (
    Texts,
    as_read,
    read_values,
    separated,
    with_recording_options,
)
from motionese.one_core import one_core

Model = Annotated[Path, Argument(metavar="MODEL", help="A model that `train` wrote.")]
ONLINE: dict[str, Any] = {"rich_help_panel": "While it happens"}
LARGEST_SEED = 2**32 - 1
"""Larger seeds would be cut to 32 bits, and mean the same as smaller ones."""


@with_recording_options()
def train(
    data: Annotated[Path, Argument(metavar="DATA", help="Recordings, in any format.")],
    out: Annotated[Path, Option(metavar="MODEL.safetensors", help="The file to write.")],
    reading: dict[str, Any],
    levels: Annotated[
        str | None,
        Option(
            metavar="SIZE:TAU,…",
            help="Context levels, fast first; τ in steps. Default: 40:5,8:70; with --begin the "
            "model's.",
        ),
    ] = None,
    io_tau: Annotated[
        float | None, Option(metavar="TAU", help="τ of the IO level, in steps; default: 2.")
    ] = None,
    epochs: Annotated[
        int | None, Option(min=1, help="In all, with those before --resume; default: 3000.")
    ] = None,
    batch: Annotated[
        int | None,
        Option(
            min=1, metavar="MOTIONS", help="Learned from in one update; default: all. For many."
        ),
    ] = None,
    threads: Annotated[
        int, Option(min=1, help="Cores, or GPUs, over which an update's motions are spread.")
    ] = 1,
    stored: Annotated[
        bool,
        Option("--stored", help="Leave motions in the file, to be read when needed. For large."),
    ] = False,
    held_out: Annotated[
        str | None,
        Option(
            metavar="SHARE|NAMES",
            help="Motions not learned but tested; else as SOURCE says; else 0.1.",
        ),
    ] = None,
    patience: Annotated[
        int | None,
        Option(min=0, metavar="EPOCHS", help="Stop early when the loss no longer falls."),
    ] = None,
    seed: Annotated[
        int, Option(min=0, max=LARGEST_SEED, help="Of weights, held-out motions, noise.")
    ] = 0,
    begin: Annotated[
        Path | None,
        Option(metavar="MODEL", help="Begin from a trained model, with its channels and ranges."),
    ] = None,
    resume: Annotated[
        bool,
        Option("--resume", help="Go on with a training that was stopped, or ended too early."),
    ] = False,
    log: Annotated[
        Texts, Option(metavar="jsonl|tensorboard|rerun …", help="Logs beside the model.")
    ] = None,
    overrides: Annotated[
        Texts, Option("--set", metavar="NAME=VALUE …", help="E.g. teacher_forcing=0.3 bound=10.")
    ] = None,
) -> None:
    """Train a network on recordings; tell how good it is in closed loop."""
    with plainly(partial(_stopped, out)) as console:
        os.environ.update(one_core())
        if threads > 1:
            os.environ["JAX_NUM_CPU_DEVICES"] = str(threads)
        from motionese.interfaces.commands.train import read_training, train_model

        train_model(
            console,
            data,
            out,
            levels=levels,
            io_tau=io_tau,
            held_out=held_out,
            seed=seed,
            begin=begin,
            resume=resume,
            settings=read_training(epochs, patience, overrides or (), batch),
            threads=threads,
            logs=separated(log),
            stored=stored,
            reading=as_read(**reading),
        )


@with_recording_options("range", "margin", "binary")
def recognise(
    model: Model,
    motion: Annotated[Path, Argument(metavar="MOTION", help="A recording of motions.")],
    reading: dict[str, Any],
    observed: Annotated[
        Texts, Option(metavar="PATTERN …", help="Channels to look at; default: all.")
    ] = None,
    out: Annotated[
        Path | None,
        Option(
            metavar="PATH.csv|.npz",
            help="Write the recognised motions, all channels; with --online what was known at "
            "each row (.csv), and its figure beside it; default then: NAME.online.csv here.",
        ),
    ] = None,
    initial: Annotated[
        Path | None, Option(metavar="FILE.json", help="Write the initial states.")
    ] = None,
    seed: Annotated[int, Option(min=0, max=LARGEST_SEED, help="Of the random starts.")] = 0,
    online: Annotated[
        bool, Option("--online", help="Row by row, as a robot that looks on would.", **ONLINE)
    ] = False,
    window: Annotated[
        int | None, Option(metavar="ROWS", help="Rows looked back on; default: 20.", **ONLINE)
    ] = None,
    ahead: Annotated[
        int | None,
        Option(min=1, max=1000, metavar="ROWS", help="Rows predicted; default: 5.", **ONLINE),
    ] = None,
    log: Annotated[
        Texts,
        Option(metavar="rerun|jsonl|tensorboard …", help="Logs beside the table.", **ONLINE),
    ] = None,
) -> None:
    """Find the initial states from which a model generates a motion, from what is observed.

    With --online tell instead, at each row, which learned motion is being shown and what follows.
    """
    told = "nothing but the log was written" if log else "nothing was written"
    with plainly(f"stopped; {told}") as console:
        os.environ.update(one_core())
        own = {"--window": window, "--ahead": ahead, "--log": log}
        _check_options(online, {"--initial": initial}, own)
        seen, read = separated(observed) or None, as_read(**reading)
        if not online:
            from motionese.interfaces.commands.recognise import recognise_motions

            recognise_motions(
                console,
                model,
                motion,
                observed=seen,
                out=out,
                initial=initial,
                seed=seed,
                reading=read,
            )
            return
        from motionese.interfaces.commands.recognise_online import recognise_online_motions

        recognise_online_motions(
            console,
            model,
            motion,
            observed=seen,
            out=out or Path(f"{motion.resolve().stem}.online.csv"),
            window=20 if window is None else window,
            ahead=ahead or 5,
            logs=separated(log),
            reading=read,
        )


def generate(
    model: Model,
    out: Annotated[
        Path, Option(metavar="PATH.csv|.npz|.svg", help="Recording or picture to write.")
    ],
    like: Annotated[
        Texts, Option(metavar="EPISODE …", help="Learned motions; several are blended in sequence.")
    ] = None,
    initial: Annotated[
        Path | None, Option(metavar="FILE.json", help="Initial states from `recognise`.")
    ] = None,
    steps: Annotated[
        int | None, Option(min=2, max=1_000_000, help="Rows a motion; default: as it was, scaled.")
    ] = None,
    duration_scale: Annotated[
        float, Option(metavar="SCALE", help="How many times as long: 0.5 to 2.")
    ] = 1.0,
    start: Annotated[
        Texts, Option(metavar="NAME=VALUE …", help="Where the robot is; else as it was recorded.")
    ] = None,
    blend: Annotated[
        int | None,
        Option(min=0, metavar="ROWS", help="Of a transition; default: no faster than else."),
    ] = None,
) -> None:
    """Generate a motion in closed loop, as a recording or a picture."""
    with plainly("stopped; nothing was written") as console:
        os.environ.update(one_core())
        from motionese.interfaces.commands.generate import generate_motion

        generate_motion(
            console,
            model,
            like=separated(like),
            initial=initial,
            steps=steps,
            duration=duration_scale,
            start=read_values("--start", start),
            blend=blend,
            out=out,
        )


def checkpoint_of(model: Path) -> Path:
    """Return where the training of a model is kept."""
    return model.with_suffix(".checkpoint")


def _stopped(model: Path) -> str:
    """Return what to say when the training of a model was stopped."""
    if checkpoint_of(model).exists():
        return "stopped; the same command with --resume goes on"
    return "stopped; there is no training to go on with"


def _check_options(online: bool, whole: Mapping[str, Any], own: Mapping[str, Any]) -> None:
    """Refuse options that do not belong to how motions are recognised.

    Args:
        online: Whether they are recognised while they happen.
        whole: Options of recognising whole motions alone; None where one is not given.
        own: Options of recognising them while they happen alone; None where one is not given.

    Raises:
        SettingError: An option of the other.
    """
    given = [name for name, value in (whole if online else own).items() if value is not None]
    if given and online:
        raise SettingError(f"{given[0]} is not for --online, which finds no initial states")
    if given:
        raise SettingError(f"{given[0]} is for recognition row by row alone; add --online")
