"""What is told in the terminal of motions and models: tables, and words."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from rich.table import Table

from motionese.channels import Channels
from motionese.interfaces.commands.terminal import number_table
from motionese.learning import Diagnosis, Fit, Motions
from motionese.unit_interval import CLIP_HIGH, CLIP_LOW


def error_table(fit: Fit) -> Table:
    """Return the root mean squared errors by channel, in its unit and as a share of its range."""
    assert fit.network.channels is not None, "a trained network carries channels"
    errors = {"teacher-forced": fit.teacher_forced_error, "closed loop": fit.closed_loop_error}
    if len(fit.validation_error):
        errors["held out"] = fit.validation_error
    table = number_table("channel", "unit", *errors)
    for i, channel in enumerate(fit.network.channels):
        found = [_rms(e[:, i]) for e in errors.values()]
        told = [f"{error:.3g} ({error / (channel.high - channel.low):.1%})" for error in found]
        table.add_row(channel.name, channel.unit or "–", *told)
    return table


def verdict(fit: Fit, diagnosis: Diagnosis) -> str:
    """Return in words what the errors mean for a robot that is driven by the model, and why.

    Args:
        fit: What was trained.
        diagnosis: Of its last training.
    """
    if np.isnan(diagnosis.closed):
        return "No error can be told: nothing was observed after the motions' first rows."
    worst = np.array([fit.share(e) for e in fit.closed_loop_error])
    which = int(np.nanargmax(worst))
    parts = [
        f"Root mean squared error as a share of range: teacher-forced {diagnosis.forced:.1%}, "
        f"closed loop {diagnosis.closed:.1%} (worst motion '{fit.names[which]}' {worst[which]:.1%})"
    ]
    if len(fit.validation_error):
        parts.append(f"held-out motions {diagnosis.unseen:.1%}, recognised, in closed loop")
    before = len(fit.losses) - diagnosis.epochs
    told = [] if fit.status.failed else diagnosis.sentences(before)
    return " ".join([f"{'; '.join(parts)}.", *told])


def _rms(errors: np.ndarray) -> float:
    known = errors[~np.isnan(errors)]
    return float(np.sqrt((known**2).mean())) if len(known) else float("nan")


def reach(channels: Channels) -> tuple[Float[ndarray, " D"], Float[ndarray, " D"]]:
    """Return the lowest and highest value of every channel; what lies beyond is clipped."""
    ends = np.full((2, len(channels)), [[CLIP_LOW], [CLIP_HIGH]])
    lowest, highest = channels.from_unit(ends)
    return lowest, highest


def share_beyond(motions: Motions) -> float:
    """Return the share of what was observed that is clipped, as the ranges are too narrow."""
    lowest, highest = reach(motions.channels)
    clipped, count = 0, 0
    for values, seen in zip(motions.values, motions.observed, strict=True):
        clipped += int((seen & ((values < lowest) | (values > highest))).sum())
        count += int(seen.sum())
    return clipped / max(count, 1)


def _share_missing(motions: Motions) -> float:
    missing = sum(int((~seen).sum()) for seen in motions.observed)
    return missing / (sum(motions.lengths) * len(motions.channels))


def description(motions: Motions) -> str:
    """Return in words how many motions there are, of what length and rate, and what is missing."""
    shortest, longest = min(motions.lengths), max(motions.lengths)
    rows = f"{shortest}" if shortest == longest else f"{shortest} to {longest}"
    count = f"{len(motions)} motion{'' if len(motions) == 1 else 's'}"
    width = len(motions.channels)
    gaps, beyond = _share_missing(motions), share_beyond(motions)
    return (
        f"{count} of {rows} rows at {motions.rate_hz:g} Hz, "
        f"{width} channel{'' if width == 1 else 's'}"
        + (f", {gaps:.1%} not observed" if gaps else "")
        + (f", {beyond:.1%} beyond their ranges and clipped" if beyond else "")
    )
