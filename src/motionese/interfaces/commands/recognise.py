"""A motion and a model in, initial states and the recognised motion out."""

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import jax
import numpy as np
from jaxtyping import Array
from rich.console import Console
from rich.progress import track
from rich.table import Table

from motionese.channels import Channels
from motionese.errors import ChannelError, unknown
from motionese.interfaces.commands.initial_states import write_initial_states
from motionese.interfaces.commands.outputs import RECORDINGS, check_apart, check_output
from motionese.interfaces.commands.terminal import number_table, tell_findings
from motionese.learning import Fit, Motions, RecognitionResult, load, read_for, recognise_all


def recognise_motions(
    console: Console,
    model: Path,
    source: Path,
    *,
    observed: Sequence[str] | None,
    out: Path | None,
    initial: Path | None,
    seed: int,
    reading: Mapping[str, Any],
) -> None:
    """Recognise every motion of a recording, and tell how well each was recognised.

    Args:
        observed: Names or patterns of the channels that are looked at; all there are for None.
        out: Where to write the recognised motions, all channels; nowhere for None.
        initial: Where to write the initial states (.json); nowhere for None.
        reading: How `source` is read, as `Motions.read` takes it.
    """
    if initial is not None:
        check_output("--initial", initial, (".json",))
    if out is not None:
        check_output("--out", out, RECORDINGS)
    check_apart([source, model], out, initial)
    fit = load(model)
    motions, seen = read_observed(console, fit, source, observed, reading)
    found = _recognised(console, fit, motions.showing(seen), jax.random.key(seed))
    console.print(_table(fit, motions, found, seen))
    if initial is not None:
        states = {n: f.initial_state for n, f in zip(motions.names, found, strict=True)}
        rows = dict(zip(motions.names, motions.lengths, strict=True))
        write_initial_states(initial, fit.network, states, rows)
        console.print(f"Initial states: {initial}")
    if out is not None:
        paths = [f.path for f in found]
        channels, rate_hz = motions.channels, fit.rate_hz
        Motions.from_arrays(paths, channels, rate_hz, names=motions.names).write(out)
        console.print(f"Recognised motions: {out}")


def read_observed(
    console: Console,
    fit: Fit,
    source: Path,
    observed: Sequence[str] | None,
    reading: Mapping[str, Any],
) -> tuple[Motions, list[str]]:
    """Return motions for a model and the channels that are looked at, and tell which these are."""
    channels = fit.network.channels
    assert channels is not None, "a trained network carries channels"
    needed = None if observed is None else matching_channels(channels, observed)
    motions = read_for(fit, source, needed=needed, **reading)
    there = np.flatnonzero(np.concatenate(motions.observed).any(axis=0))
    seen = [channels.names[column] for column in there]
    absent = [name for name in channels.names if name not in seen]
    told = f"; not in the recording: {', '.join(absent)}" if absent and needed is None else ""
    seen = seen if needed is None else needed
    console.print(f"{source}: looked at {', '.join(seen)}{told}")
    tell_findings(console, motions.examined)
    return motions, seen


def matching_channels(channels: Channels, patterns: Sequence[str]) -> list[str]:
    """Return the model's channels of these names or patterns, in the model's order.

    Raises:
        ChannelError: A name or pattern that no channel fits.
    """
    taken: set[str] = set()
    for pattern in patterns:
        fitting = {n for n in channels.names if n == pattern or fnmatchcase(n, pattern)}
        if not fitting:
            raise ChannelError(unknown("channel", pattern, channels.names))
        taken |= fitting
    return [name for name in channels.names if name in taken]


def _recognised(
    console: Console, fit: Fit, motions: Motions, key: Array
) -> list[RecognitionResult]:
    """Recognise motions one by one, padded to one length so that they share compiled code."""
    keys, size = jax.random.split(key, len(motions)), (1, max(motions.lengths))
    each = list(zip(motions, keys, strict=True))
    off = not console.is_terminal
    shown = track(each, "Recognising", console=console, transient=True, disable=off)
    return [recognise_all(fit, one, key=its, padded_to=size)[0] for one, its in shown]


def _table(
    fit: Fit, motions: Motions, found: Sequence[RecognitionResult], seen: Sequence[str]
) -> Table:
    """Return a row per motion; errors are root mean squares, as shares of range."""
    table = number_table("motion", "looked at", "not looked at", "nearest learned", "verdict")
    table.title = "Root mean squared errors as shares of range"
    hidden = [i for i, name in enumerate(motions.channels.names) if name not in seen]
    for name, value, mask, one in zip(
        motions.names, motions.values, motions.observed, found, strict=True
    ):
        there = mask[:, hidden]
        off = ((one.path - value) / motions.channels.spans)[:, hidden][there]
        missed = f"{np.sqrt((off**2).mean()):.1%}" if len(off) else "–"
        verdict = one.status.ending.value
        table.add_row(name, f"{one.error:.1%}", missed, _nearest(fit, one), verdict)
    return table


def _nearest(fit: Fit, found: RecognitionResult) -> str:
    """Return the learned motion whose initial states of the context are nearest."""
    if not fit.names:
        return "–"
    io = fit.network.io_size
    distances = np.linalg.norm(fit.initial_states[:, io:] - found.initial_state[io:], axis=1)
    return fit.names[int(distances.argmin())]
