"""What was known at each row of a motion while it was shown: kept, logged, written as a table."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from time import perf_counter

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.channels import Channel, Channels
from motionese.interfaces.logs.training_logs import Logs
from motionese.runtime import OnlineRecognition, OnlineResult


@dataclass(frozen=True, eq=False)
class OnlineTrace:
    """What was known at each of a motion's T rows.

    Attributes:
        name: The motion that was shown.
        rate_hz: Rows per second [Hz].
        hypotheses: The M learned motions' names, and none of them.
        belief: How likely each of these is. [T, M + 1]
        error: Root mean squared error in the window, as a share of range; NaN in the first row.
            [T]
        predicted: The row `ahead` rows further, in the channels' units. [T, D]
        spread: Its standard deviation. [T, D]
        milliseconds: How long each row took [ms]. [T]
    """

    name: str
    rate_hz: float
    hypotheses: tuple[str, ...]
    belief: Float[ndarray, "T H"]
    error: Float[ndarray, " T"]
    predicted: Float[ndarray, "T D"]
    spread: Float[ndarray, "T D"]
    milliseconds: Float[ndarray, " T"]

    @property
    def likeliest(self) -> Int[ndarray, " T"]:
        """Which hypothesis is believed in most in each row."""
        return np.asarray(self.belief.argmax(axis=1))

    @property
    def settled(self) -> int:
        """The row from which on that which is believed in at the end was believed in most."""
        others = np.flatnonzero(self.likeliest != self.likeliest[-1])
        return int(others[-1]) + 1 if len(others) else 0


def trace(
    name: str,
    rows: Float[ndarray, "T D"],
    recogniser: OnlineRecognition,
    rate_hz: float,
    log: Logs,
) -> OnlineTrace:
    """Show a motion to what recognises it, row by row, and keep what is known after each.

    Args:
        name: The motion's name.
        rows: What is observed, in the channels' units; NaN where nothing is. [T, D]
        recogniser: What recognises it; it has seen nothing yet and predicts at least one row.
        rate_hz: Rows per second [Hz].
        log: Takes the numbers of every row as they come; what is predicted is logged at the row
            that it is predicted for.
    """
    known, milliseconds, channels = [], [], recogniser.model.channels
    for row, reading in enumerate(rows):
        began = perf_counter()
        result = recogniser.observe(reading)
        milliseconds.append(1000 * (perf_counter() - began))
        coming, spread = result.ahead[-1], result.spread[-1]
        known.append((list(result.belief.values()), result.error, coming, spread))
        log.write(row, _present(name, result, dict(zip(channels, reading, strict=True))))
        further = {f"{name}/predicted/{c}": v for c, v in zip(channels, coming, strict=True)}
        log.write(row + len(result.ahead), further)
    belief, error, predicted, spread = (np.array(each) for each in zip(*known, strict=True))
    hypotheses, taken = tuple(result.belief), np.array(milliseconds)
    return OnlineTrace(name, rate_hz, hypotheses, belief, error, predicted, spread, taken)


def _present(name: str, result: OnlineResult, reading: dict[str, float]) -> dict[str, float]:
    """Return the numbers of the present row by the paths under which they are logged."""
    belief = {f"{name}/belief/{motion}": share for motion, share in result.belief.items()}
    seen = {f"{name}/observed/{c}": float(v) for c, v in reading.items() if np.isfinite(v)}
    return {**belief, f"{name}/error": result.error, **seen}


def table_of(traces: Sequence[OnlineTrace], channels: Channels, ahead: int) -> str:
    """Return what was known as a table in CSV, one row for each row of the motions."""
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    numbers = "belief", "belief in none of these", "window error [share of range]"
    coming = [f"{c.name} in {ahead} rows{_unit(c)}" for c in channels]
    spread = [f"spread of {c.name} in {ahead} rows{_unit(c)}" for c in channels]
    table.writerow(["episode", "row", "time [s]", "likeliest", *numbers, *coming, *spread])
    for one in traces:
        for row, which in enumerate(one.likeliest):
            told = [*one.belief[row, [which, -1]], one.error[row]]
            told += [*one.predicted[row], *one.spread[row]]
            cells = (f"{v:.6g}" if np.isfinite(v) else "" for v in told)
            time = round(row / one.rate_hz, 6)
            table.writerow([one.name, row, time, one.hypotheses[which], *cells])
    return text.getvalue()


def _unit(channel: Channel) -> str:
    return f" [{channel.unit}]" if channel.unit else ""
