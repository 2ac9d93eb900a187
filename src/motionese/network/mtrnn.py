"""The multiple-timescale recurrent network: weights, time constants, levels, channels."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, replace
from typing import Any, Literal, get_args

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from motionese.arguments import refusing
from motionese.channels import Channels
from motionese.errors import SettingError, unknown
from motionese.network.levels import Level, named
from motionese.network.wiring import Scale, draw_weights, wiring
from motionese.time_constants import scaled_tau

InitialIO = Literal["sensed", "zero"]
FIRST_DEVIATION = 0.1
"""Standard deviation, in the unit interval, that a network predicts before it is trained."""


def shapes(sizes: tuple[int, ...], variance: bool) -> dict[str, tuple[int, ...]]:
    """Return the shapes of a network's arrays, by the names of its fields."""
    units, io = sum(sizes), sizes[0]
    own: dict[str, tuple[int, ...]] = {"weights": (units, units), "bias": (units,), "tau": (units,)}
    return own | (
        {"variance_weights": (io, units - io), "variance_bias": (io,)} if variance else {}
    )


def _array(value: Any) -> Array | None:
    return None if value is None else jnp.asarray(value)


class MTRNN(eqx.Module):
    """An MTRNN (Yamashita & Tani 2008) of any number of levels; the first is IO.

    `MTRNN.draw` draws one, as does `MTRNN(levels, key=key)`, with the arguments of `draw`;
    `dataclasses.replace` gives the same network with other fields.

    Attributes:
        weights: `weights[i, j]` is w_ij, from unit j to unit i; 0 where nothing is wired. [N, N]
        bias: Added to every unit's summed input; stays 0 where it is not learned. [N]
        tau: Time constants τ_i [steps]. [N]
        names: The levels' names, from IO upwards.
        sizes: Units per level.
        channels: What the IO units stand for; None until the network is trained on motions.
        learned_bias: Whether the bias is learned (the paper's equation (1) has none).
        initial_io: u_IO,0 is the logit of the first sensed value (`"sensed"`), or 0 (`"zero"`,
            the paper).
        variance_weights: Read-out R of the predicted variance from the context units, see
            `predict`; None where none is predicted. [D, N − D]
        variance_bias: Its r; None where none is predicted. [D]

    Raises:
        SettingError: Fewer than two levels, names that are not unique, arrays or channels that do
            not fit the levels.
    """

    weights: Float[Array, "N N"] = eqx.field(converter=jnp.asarray)
    bias: Float[Array, " N"] = eqx.field(converter=jnp.asarray)
    tau: Float[Array, " N"] = eqx.field(converter=jnp.asarray)
    names: tuple[str, ...] = eqx.field(static=True)
    sizes: tuple[int, ...] = eqx.field(static=True)
    channels: Channels | None = eqx.field(static=True, default=None)
    learned_bias: bool = eqx.field(static=True, default=True)
    initial_io: InitialIO = eqx.field(static=True, default="sensed")
    variance_weights: Float[Array, "D C"] | None = eqx.field(converter=_array, default=None)
    variance_bias: Float[Array, " D"] | None = eqx.field(converter=_array, default=None)

    def __init__(self, levels: Any = None, *, key: Any = None, **given: Any) -> None:
        fields = {f.name: f for f in dataclasses.fields(self)}
        if levels is not None or key is not None:
            drawn = MTRNN.draw(levels, key=key, **given)
            given = {name: getattr(drawn, name) for name in fields}
        missing = [n for n, f in fields.items() if n not in given and f.default is MISSING]
        if missing or not fields.keys() >= given.keys():
            raise SettingError(
                "an MTRNN is drawn from levels and a key, MTRNN.draw(levels, key=key), "
                f"or made of all its fields: {', '.join(fields)}"
            )
        for name, field in fields.items():
            setattr(self, name, given.get(name, field.default))

    def __check_init__(self) -> None:
        if len(self.names) < 2:
            raise SettingError(
                f"an MTRNN has the level io and at least one context, got {len(self.names)}"
            )
        if len(set(self.names)) < len(self.names):
            raise SettingError(f"level names must be unique, got {', '.join(self.names)}")
        if self.initial_io not in get_args(InitialIO):
            raise SettingError(unknown("initial_io", self.initial_io, get_args(InitialIO)))
        if self.channels is not None and len(self.channels) != self.io_size:
            raise SettingError(
                f"level '{self.names[0]}' needs one unit per channel "
                f"({len(self.channels)}), got {self.io_size}"
            )
        for name, shape in shapes(self.sizes, self.variance).items():
            got = np.shape(getattr(self, name))
            if got != shape:
                raise SettingError(f"{name} must have shape {shape}, got {got}")

    @classmethod
    @refusing()
    def draw(
        cls,
        levels: Sequence[Level],
        *,
        key: Array,
        gain: float = 2.0,
        scale: Scale = "fan_in",
        learned_bias: bool = True,
        initial_io: InitialIO = "sensed",
        channels: Channels | None = None,
        variance: bool = False,
    ) -> "MTRNN":
        """Draw a network's initial weights.

        Args:
            levels: From IO upwards; names that are left empty become io, cf, cs, c4, ….
            key: JAX random key of the initial weights.
            gain: Gain of the initial weights, see `wiring.weight_scales`.
            scale: One scale per block by its fan-in, or one for all.
            learned_bias: As the field; so are `initial_io` and `channels`.
            variance: Whether the network predicts the variance of every channel as well, see
                `predict`; its read-out begins without any influence of the context.
        """
        if not (math.isfinite(gain) and gain >= 0):
            raise SettingError(f"the gain of the initial weights must be ≥ 0, got {gain}")
        if not levels:
            raise SettingError("an MTRNN has the level io and at least one context, got none")
        levels = named(levels)
        sizes = tuple(level.size for level in levels)
        weights = draw_weights(sizes, gain, scale, key)
        read_out: dict[str, Any] = {}
        if variance:
            shape, log_variance = (sizes[0], sum(sizes[1:])), 2 * math.log(FIRST_DEVIATION)
            read_out["variance_weights"] = jnp.zeros(shape, weights.dtype)
            read_out["variance_bias"] = jnp.full(sizes[0], log_variance, weights.dtype)
        return cls(
            weights=weights,
            bias=jnp.zeros(sum(sizes), weights.dtype),
            tau=jnp.asarray([tau for level in levels for tau in level.taus], weights.dtype),
            names=tuple(level.name for level in levels),
            sizes=sizes,
            channels=channels,
            learned_bias=learned_bias,
            initial_io=initial_io,
            **read_out,
        )

    @property
    def arrays(self) -> dict[str, Array]:
        """Everything that has a value for every unit or weight, by the names of the fields."""
        return {name: getattr(self, name) for name in shapes(self.sizes, self.variance)}

    @property
    def variance(self) -> bool:
        """Whether the network predicts the variance of its channels."""
        return self.variance_weights is not None or self.variance_bias is not None

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels from IO upwards, their τ as it is now: learned, or scaled in duration."""
        ends = np.cumsum(self.sizes)[:-1]
        taus = [part.tolist() for part in np.split(np.asarray(self.tau), ends)]
        return tuple(
            Level(size, own[0] if len(set(own)) == 1 else tuple(own), name)
            for name, size, own in zip(self.names, self.sizes, taus, strict=True)
        )

    @property
    def size(self) -> int:
        """Number of units N."""
        return sum(self.sizes)

    @property
    def io_size(self) -> int:
        """Number of IO units D, one per channel."""
        return self.sizes[0]

    def units(self, level: str) -> slice:
        """Return where a level's units lie among all N; `SettingError` for an unknown level."""
        if level not in self.names:
            raise SettingError(unknown("level", level, self.names))
        place = self.names.index(level)
        start = sum(self.sizes[:place])
        return slice(start, start + self.sizes[place])

    def lasting(self, scale: float) -> "MTRNN":
        """Return the same network, its motions lasting `scale` times as long (0.5 to 2)."""
        return replace(self, tau=jnp.asarray(scaled_tau(np.asarray(self.tau), scale)))

    def wired_weights(self) -> Float[Array, "N N"]:
        """Return the weights with what is not wired held at 0, in value and in gradient."""
        return self.weights * jnp.asarray(wiring(self.sizes), self.weights.dtype)

    def per_unit(self, values: float | Mapping[str, float], other: float) -> Float[Array, " N"]:
        """Spread one value over all context units, or values by level; elsewhere `other`."""
        spread = jnp.full(self.size, other, self.weights.dtype)
        if not isinstance(values, Mapping):
            return spread.at[self.io_size :].set(values)
        for level, value in values.items():
            spread = spread.at[self.units(level)].set(value)
        return spread
