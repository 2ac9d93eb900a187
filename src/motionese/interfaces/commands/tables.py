"""Tables for the terminal, and how good a model is before it goes to the robot."""

import numpy as np
from rich.table import Table

from motionese.learning import Fit

GOOD, POOR = 0.03, 0.1
"""Closed-loop errors, as shares of range, up to which a model is good and from which it is poor."""


def number_table(*headings: str) -> Table:
    """Return a table whose first column holds names and whose others hold numbers."""
    table = Table(*headings)
    for column in table.columns:
        # Where there is no room a cell goes on in the next line: no digit is ever left out.
        column.overflow = "fold"
    table.columns[0].no_wrap = True
    for column in table.columns[1:]:
        column.justify = "right"
    return table


def error_table(fit: Fit) -> Table:
    """Return the root mean squared errors by channel, in its unit and as a share of its range."""
    assert fit.network.channels is not None, "a trained network carries channels"
    errors = [fit.teacher_forced_error, fit.closed_loop_error]
    headings = ["channel", "unit", "teacher-forced", "closed loop"]
    if len(fit.validation_error):
        errors.append(fit.validation_error)
        headings.append("held out")
    table = number_table(*headings)
    for i, channel in enumerate(fit.network.channels):
        span = channel.high - channel.low
        told = [f"{_rms(e[:, i]):.3g} ({_rms(e[:, i]) / span:.1%})" for e in errors]
        table.add_row(channel.name, channel.unit or "–", *told)
    return table


def verdict(fit: Fit) -> str:
    """Return in words what the errors mean for a robot that is driven by the model."""
    forced, closed = fit.share(fit.teacher_forced_error), fit.share(fit.closed_loop_error)
    if np.isnan(closed):
        return "No error can be told: nothing was observed after the motions' first rows."
    worst = np.array([fit.share(e) for e in fit.closed_loop_error])
    which = int(np.nanargmax(worst))
    parts = [
        f"Root mean squared error as a share of range: teacher-forced {forced:.1%}, "
        f"closed loop {closed:.1%} (worst motion '{fit.names[which]}' {worst[which]:.1%})"
    ]
    if len(fit.validation_error):
        parts.append(
            f"held-out motions {fit.share(fit.validation_error):.1%}, recognised, in closed loop"
        )
    told = "; ".join(parts) + "."
    if closed > POOR:
        return (
            f"{told} On a robot these motions would not be recognisable: "
            "train longer, or with more units."
        )
    return told if closed <= GOOD else f"{told} Closed-loop errors above {GOOD:.0%} can be seen."


def _rms(errors: np.ndarray) -> float:
    known = errors[~np.isnan(errors)]
    return float(np.sqrt((known**2).mean())) if len(known) else float("nan")
