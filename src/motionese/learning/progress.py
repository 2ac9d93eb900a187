"""How far a training is."""

from typing import NamedTuple


class Progress(NamedTuple):
    """How far a training is.

    Attributes:
        epoch: Epochs done.
        loss: Equation (3) before the last update.
        closed_loop_error: Root mean squared error in closed loop, as a share of range.
        validation_loss: Of the held-out motions; None without any.
        validation_error: `closed_loop_error` of the held-out motions; None without any.
    """

    epoch: int
    loss: float
    closed_loop_error: float
    validation_loss: float | None
    validation_error: float | None
