"""The multiple-timescale recurrent network: levels, weights, time constants, channels."""

import math
from collections.abc import Mapping, Sequence
from typing import Literal, get_args

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from motionese.channels import Channels
from motionese.errors import SettingError, unknown
from motionese.network.levels import Level, named
from motionese.network.wiring import Scale, draw_weights, wiring
from motionese.time_constants import scaled_tau

InitialIO = Literal["sensed", "zero"]


class MTRNN(eqx.Module):
    """An MTRNN (Yamashita & Tani 2008) of any number of levels; the first is IO.

    Attributes:
        weights: `weights[i, j]` is w_ij, from unit j to unit i; 0 where nothing is wired. [N, N]
        bias: Added to every unit's summed input; stays 0 where it is not learned. [N]
        tau: Time constants τ_i [steps]. [N]
        levels: Sizes, time constants and names, from IO upwards.
        channels: What the IO units stand for; None until the network is trained on motions.
        learned_bias: Whether the bias is learned (the paper's equation (1) has none).
        initial_io: u_IO,0 is the logit of the first sensed value (`"sensed"`), or 0 (`"zero"`,
            the paper).
    """

    weights: Float[Array, "N N"]
    bias: Float[Array, " N"]
    tau: Float[Array, " N"]
    levels: tuple[Level, ...] = eqx.field(static=True)
    channels: Channels | None = eqx.field(static=True)
    learned_bias: bool = eqx.field(static=True)
    initial_io: InitialIO = eqx.field(static=True)

    def __init__(
        self,
        levels: Sequence[Level],
        *,
        key: Array,
        gain: float = 2.0,
        scale: Scale = "fan_in",
        learned_bias: bool = True,
        initial_io: InitialIO = "sensed",
        channels: Channels | None = None,
    ) -> None:
        """Draw a network's initial weights.

        Args:
            levels: From IO upwards; names that are left empty become io, cf, cs, c4, ….
            key: JAX random key of the initial weights.
            gain: Gain of the initial weights, see `wiring.weight_scales`.
            scale: One scale per block by its fan-in, or one for all.
            learned_bias: Whether training moves the bias.
            initial_io: What the IO units' potentials start from.
            channels: What the IO units stand for, one channel each.
        """
        self.levels = named(levels)
        if not (math.isfinite(gain) and gain >= 0):
            raise SettingError(f"the gain of the initial weights must be ≥ 0, got {gain}")
        if initial_io not in get_args(InitialIO):
            raise SettingError(unknown("initial_io", initial_io, get_args(InitialIO)))
        if channels is not None and len(channels) != self.levels[0].size:
            raise SettingError(
                f"level '{self.levels[0].name}' needs one unit per channel "
                f"({len(channels)}), got {self.levels[0].size}"
            )
        self.weights = draw_weights(self.sizes, gain, scale, key)
        self.bias = jnp.zeros(self.size, self.weights.dtype)
        taus = [tau for level in self.levels for tau in level.taus]
        self.tau = jnp.asarray(taus, self.weights.dtype)
        self.channels = channels
        self.learned_bias = learned_bias
        self.initial_io = initial_io

    @property
    def sizes(self) -> tuple[int, ...]:
        """Units per level."""
        return tuple(level.size for level in self.levels)

    @property
    def size(self) -> int:
        """Number of units N."""
        return sum(self.sizes)

    @property
    def io_size(self) -> int:
        """Number of IO units D, one per channel."""
        return self.levels[0].size

    def units(self, level: str) -> slice:
        """Return where a level's units lie among all N; `SettingError` for an unknown level."""
        names = [known.name for known in self.levels]
        if level not in names:
            raise SettingError(unknown("level", level, names))
        place = names.index(level)
        start = sum(self.sizes[:place])
        return slice(start, start + self.sizes[place])

    def with_parameters(self, weights: Float[Array, "N N"], bias: Float[Array, " N"]) -> "MTRNN":
        """Return the same network with other weights and bias."""
        other: MTRNN = eqx.tree_at(lambda n: (n.weights, n.bias), self, (weights, bias))
        return other

    def carrying(self, channels: Channels) -> "MTRNN":
        """Return the same network, its IO units standing for these channels."""
        drawn = MTRNN(
            self.levels,
            key=jax.random.key(0),
            learned_bias=self.learned_bias,
            initial_io=self.initial_io,
            channels=channels,
        )
        other: MTRNN = eqx.tree_at(
            lambda n: (n.weights, n.bias, n.tau), drawn, (self.weights, self.bias, self.tau)
        )
        return other

    def lasting(self, scale: float) -> "MTRNN":
        """Return the same network, its motions lasting `scale` times as long (0.5 to 2)."""
        other: MTRNN = eqx.tree_at(
            lambda n: n.tau, self, jnp.asarray(scaled_tau(np.asarray(self.tau), scale))
        )
        return other

    def wired_weights(self) -> Float[Array, "N N"]:
        """Return the weights with what is not wired held at 0, in value and in gradient."""
        return self.weights * jnp.asarray(wiring(self.sizes), self.weights.dtype)

    def per_unit(self, values: float | Mapping[str, float], other: float) -> Float[Array, " N"]:
        """Spread values over the units.

        Args:
            values: One value for all context levels, or values by level name.
            other: The value of IO, and of levels that are not named.
        """
        spread = jnp.full(self.size, other, self.weights.dtype)
        if not isinstance(values, Mapping):
            return spread.at[self.io_size :].set(values)
        for level, value in values.items():
            spread = spread.at[self.units(level)].set(value)
        return spread
