"""Three MTRNNs whose weights are written by hand, and whose levels play known roles.

Each makes the hand go from the middle of the plane to one side, and from there up or down: the
motions differ in their first direction ("side") and in what follows it ("order").

- `separate`: Cf_0 decides the side, Cs_0 the order.
- `all_in_cf`: Cf_0 decides both. Nothing that Cs does is heard.
- `all_in_cs`: Cs_0 decides both. Cf_0 is the same for all motions.

All three have the same fast units. "side" and "order" are either kept, by a weight to themselves
under which u = ±10 stays, or told by the slow unit of that name, which decays with τ = 70 and is
still well on one side of 0 when the motion ends. "timer" decays as −3 + 28 (1 − 1/5)^t, through 0
in row 10. "up" and "down" are the order, and the timer having run out; being slow themselves, they
move the hand from row 14 on. IO follows at once: it is driven towards sigmoid(±1.75) = 0.5 ± 0.35.

The two values of what is decided are not opposite: their mean, +1, is a decision for "right" or for
"up". A level whose initial state is its mean over the motions is thus right in half of them, and a
slow level that is cut off as well (its absence tells "left" and "down").
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from motionese.channels import Channel, Channels
from motionese.network import MTRNN
from motionese.task import Place, Primitive, Task

MOTIONS = tuple(product(("right", "left"), ("up", "down")))
"""Every motion: its first direction, its second direction."""
BEGINS = (0, 14)
"""The rows at which its strokes begin."""
ROWS = 28
FIRST = np.zeros(2)
"""Where every motion begins."""
DIRECTIONS = {"right": 0.0, "up": np.pi / 2, "left": np.pi, "down": -np.pi / 2}
"""Of the strokes [rad]."""
CHANNELS = Channels([Channel("x", "rad", -0.2, 0.2), Channel("y", "rad", -0.2, 0.2)])

UNITS = {
    "io": ("x", "y"),
    "cf": ("side", "order", "timer", "up", "down"),
    "cs": ("slow side", "slow order"),
}
TAUS = {"io": 2.0, "cf": 5.0, "cs": 70.0}
DECIDED = {"right": 8.0, "left": -6.0, "up": 8.0, "down": -6.0}
"""The initial potential of a unit that decides."""

WEIGHTS = {
    ("x", "side"): 3.5,
    ("y", "up"): 1.75,
    ("y", "down"): -1.75,
    ("up", "order"): 20.0,
    ("up", "timer"): -20.0,
    ("down", "order"): -20.0,
    ("down", "timer"): -20.0,
}
"""By the unit that is reached and the one that reaches it."""
BIASES = {"x": -1.75, "timer": -3.0, "up": -10.0, "down": 10.0, "side": -10.0, "order": -10.0}
REST = {"timer": 25.0, "up": -10.0, "down": -10.0}
"""Initial potentials that are the same for all motions; those not named are 0."""
TOLD_BY_CS = {"separate": ("order",), "all_in_cf": (), "all_in_cs": ("side", "order")}


@dataclass(frozen=True)
class RoleNetwork:
    """A network, and the initial state of each of its MOTIONS. [N]"""

    network: MTRNN
    states: dict[tuple[str, str], np.ndarray]


def role_network(name):
    """Return one of the three networks."""
    units = [unit for level in UNITS.values() for unit in level]
    place = {unit: i for i, unit in enumerate(units)}
    decides = {u: f"slow {u}" if u in TOLD_BY_CS[name] else u for u in ("side", "order")}
    weights, bias = np.zeros((len(units), len(units))), np.zeros(len(units))
    for (to, by), weight in (WEIGHTS | dict.fromkeys(decides.items(), 20.0)).items():
        weights[place[to], place[by]] = weight
    for unit, value in BIASES.items():
        bias[place[unit]] = value
    network = MTRNN(
        weights=weights,
        bias=bias,
        tau=np.repeat(list(TAUS.values()), [len(level) for level in UNITS.values()]),
        names=tuple(UNITS),
        sizes=tuple(len(level) for level in UNITS.values()),
        channels=CHANNELS,
    )
    states = {}
    for side, order in MOTIONS:
        begin = {decides["side"]: DECIDED[side], decides["order"]: DECIDED[order], **REST}
        states[side, order] = np.array([begin.get(unit, 0.0) for unit in units])
    return RoleNetwork(network, states)


def bearing(values):
    """Azimuth (to the left) and elevation [rad] of the hand that is seen. [..., 2]"""
    return np.stack([-values[..., 0], values[..., 1]], axis=-1)


SIGNS = {"right": "→", "left": "←", "up": "↑", "down": "↓"}


def _crossing():
    sides = {"right": 1.0, "left": -1.0}
    at = {"middle": (0.0, 0.0)} | {side: (x, 0.0) for side, x in sides.items()}
    at |= {
        f"{side} {order}": (sides[side], {"up": 1.0, "down": -1.0}[order])
        for side, order in MOTIONS
    }
    places = {name: Place(name, (1.0, -x, y), name) for name, (x, y) in at.items()}
    first = (Primitive(f"TO {side}", SIGNS[side], "middle", side, side) for side in sides)
    second = (
        Primitive(f"{side} {order}", SIGNS[order], side, f"{side} {order}", order)
        for side, order in MOTIONS
    )
    return Task("crossing", "to a side", places, (*first, *second), lambda *_: {}, ())


CROSSING = _crossing()
"""The motions as a task: from the middle to a side, and from there up or down."""


def sequence_of(motion):
    """Return a motion as a sequence of the task's primitives, such as 'middle →↑'."""
    return CROSSING.sequence("middle " + "".join(SIGNS[stroke] for stroke in motion))
