"""Motions and a model in, what a robot that looks on would have known at each row out."""

from collections.abc import Iterable, Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from rich.console import Console
from rich.progress import track
from rich.table import Table

from motionese.errors import MotionError, SettingError
from motionese.files import write_whole
from motionese.interfaces.commands.belief_figure import write_belief_figure
from motionese.interfaces.commands.online_trace import OnlineTrace, table_of, trace
from motionese.interfaces.commands.outputs import PICTURES, check_apart, check_output
from motionese.interfaces.commands.recognise import read_observed
from motionese.interfaces.commands.terminal import number_table
from motionese.interfaces.logs.training_logs import open_logs
from motionese.learning import Motions, load, recognise_online


def recognise_online_motions(
    console: Console,
    model: Path,
    source: Path,
    *,
    observed: Sequence[str] | None,
    out: Path,
    window: int,
    ahead: int,
    logs: Sequence[str],
    reading: Mapping[str, Any],
) -> None:
    """Recognise every motion of a recording row by row; write and draw what was known.

    Everything is checked before anything is written.

    Args:
        observed: Names or patterns of the channels that are looked at; all there are for None.
        out: Where to write what was known (.csv); the figure (.svg) lies beside it.
        window: Rows that are looked back on.
        ahead: Rows that are predicted.
        logs: Kinds of logs, see `open_logs`; they are called after `out`.
        reading: How `source` is read, as `Motions.read` takes it.
    """
    figure = out.with_suffix(".svg")
    check_output("--out", out, (".csv",))
    check_output("the figure of --out,", figure, PICTURES)
    check_apart([source, model], out, figure)
    fit = load(model)
    motions, seen = read_observed(console, fit, source, observed, reading)
    motions, channels = motions.showing(seen), motions.channels
    _check_window(source, motions, window)
    traces = []
    with open_logs(logs, out, timeline="row") as log:
        for name, rows in _tracked(console, motions):
            recogniser = recognise_online(fit, observed=seen, window=window, ahead=ahead)
            traces.append(trace(name, rows, recogniser, motions.rate_hz, log))
    write_whole(out, table_of(traces, channels, ahead))
    title = f"{source.name}: belief while it was shown, window of {window} rows"
    write_belief_figure(figure, traces, title)
    console.print(_table(traces))
    for told in _note(motions, window, fit.network.size - len(channels)):
        console.print(told)
    console.print(f"What was known: {out}, {figure}")


def _check_window(source: Path, motions: Motions, window: int) -> None:
    """Refuse a window that a motion does not fill, and a motion of which nothing is seen."""
    rows, name = min(zip(motions.lengths, motions.names, strict=True))
    if window > rows:
        raise SettingError(
            f"{source}: motion '{name}' has {rows} rows, fewer than the window of {window}; "
            f"take a shorter one, --window {rows} at most"
        )
    for name, seen in zip(motions.names, motions.observed, strict=True):
        if not seen.any():
            raise MotionError(f"{source}: of motion '{name}' nothing was observed")


def _tracked(console: Console, motions: Motions) -> Iterable[tuple[str, Float[ndarray, "_ D"]]]:
    """Yield every motion's name, and its rows with NaN where nothing was observed."""
    off = not console.is_terminal
    each = list(zip(motions.names, motions.values, motions.observed, strict=True))
    for name, values, seen in track(
        each, "Recognising", console=console, transient=True, disable=off
    ):
        yield name, np.where(seen, values, np.nan)


def _table(traces: Sequence[OnlineTrace]) -> Table:
    """Return a row per motion: what was believed at its end, since when, and how long rows took."""
    headings = "at the end", "belief", "from row", "window error", "median ms a row"
    table = number_table("motion", *headings)
    table.title = "What was known at the end, from which row on, and its error as a share of range"
    for one in traces:
        table.add_row(
            one.name,
            one.hypotheses[one.likeliest[-1]],
            f"{one.belief[-1].max():.1%}",
            str(one.settled),
            f"{one.error[-1]:.1%}" if np.isfinite(one.error[-1]) else "–",
            f"{np.median(one.milliseconds):.2f}",
        )
    return table


def _note(motions: Motions, window: int, context: int) -> list[str]:
    """Say it where a window holds fewer observed values than there are context units."""
    a_row = np.concatenate(motions.observed).sum(axis=1).mean()
    needed = 1 + ceil(context / a_row)  # the first row predicts nothing
    if window >= needed:
        return []
    return [
        f"A window of {window} rows holds {(window - 1) * a_row:.0f} observed values after its "
        f"first, fewer than the network's {context} context units: what they leave open stays as "
        f"it was learned; {needed} rows would be needed"
    ]
