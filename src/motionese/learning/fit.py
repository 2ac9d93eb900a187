"""What training leaves: a network, the initial states of its motions, and how good they are."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.arguments import place_of, refusing
from motionese.errors import HELD_OUT, NO_MOTION, SettingError
from motionese.learning.accuracy import share_of_range
from motionese.learning.memory import Memory
from motionese.learning.status import Status
from motionese.network import MTRNN


@dataclass(frozen=True)
class Fit:
    """What training leaves.

    Attributes:
        network: The trained network; it carries the motions' channels.
        initial_states: u_0 of every motion, all levels; IO as the first row was sensed. [S, N]
        lengths: The motions' rows.
        rate_hz: Rows per second [Hz].
        losses: Equation (3) per epoch, summed over motions, before that epoch's update. [E]
        validation_losses: The same of the held-out motions, recognised after every chunk of
            epochs; empty without any. [V]
        teacher_forced_error: Root mean squared error of every motion with what was sensed as
            the input of every step, each channel in its unit. [S, D]
        closed_loop_error: Root mean squared error of every motion in closed loop, each channel in
            its unit. [S, D]
        validation_error: `closed_loop_error` of the held-out motions, recognised from all that
            was observed of them. [H, D]
        status: How training ended.
    """

    network: MTRNN
    initial_states: Float[ndarray, "S N"]
    names: tuple[str, ...]
    lengths: tuple[int, ...]
    rate_hz: float
    losses: Float[ndarray, " E"]
    validation_losses: Float[ndarray, " V"]
    teacher_forced_error: Float[ndarray, "S D"]
    closed_loop_error: Float[ndarray, "S D"]
    validation_names: tuple[str, ...]
    validation_error: Float[ndarray, "H D"]
    status: Status

    @property
    def memory(self) -> Memory:
        """The motions it learned, as recognition starts from them."""
        return Memory(self.names, self.initial_states, self.closed_loop_error)

    def after(self, earlier: "Fit") -> "Fit":
        """Return the fit of a training that went on from an earlier fit, with all its losses."""
        before = len(earlier.losses)
        return replace(
            self,
            losses=np.concatenate([earlier.losses, self.losses]),
            validation_losses=np.concatenate([earlier.validation_losses, self.validation_losses]),
            status=replace(self.status, sentence=f"{self.status.sentence}, after {before} before"),
        )

    @refusing()
    def index(self, motion: str | int) -> int:
        """Return the place of a motion by its name or place; `SettingError` if there is none."""
        if not self.names:
            raise SettingError(NO_MOTION)
        if str(motion) in self.validation_names:
            raise SettingError(f"motion '{motion}' {HELD_OUT}")
        return place_of("motion", motion, self.names, SettingError)

    def states_of(self, motions: Sequence[str]) -> Float[ndarray, "M N"]:
        """Return the initial states of motions by name; 0 of those that it did not learn."""
        known = dict(zip(self.names, self.initial_states, strict=True))
        nothing = np.zeros(self.network.size)
        return np.array([known.get(name, nothing) for name in motions])

    @refusing()
    def share(self, errors: Float[ndarray, "*batch D"]) -> float:
        """Return errors in the channels' units as one share of the channels' ranges."""
        assert self.network.channels is not None, "a trained network carries channels"
        errors = np.asarray(errors, dtype=np.float64)
        if errors.shape[-1:] != (self.network.io_size,):
            raise SettingError(
                f"errors must have one value per channel ({self.network.io_size}), "
                f"got shape {errors.shape}"
            )
        return share_of_range(errors, self.network.channels)
