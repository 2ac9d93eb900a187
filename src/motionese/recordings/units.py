"""Units of one quantity, and recordings brought from one to another."""

from collections.abc import Mapping
from dataclasses import replace
from math import pi

import numpy as np

from motionese.errors import ChannelError
from motionese.recordings.finding import Finding
from motionese.recordings.recording import Recording

QUANTITIES: tuple[dict[str, float], ...] = (
    {"rad": 1.0, "radian": 1.0, "radians": 1.0, "mrad": 1e-3}
    | dict.fromkeys(("deg", "°", "degree", "degrees"), pi / 180)
    | dict.fromkeys(("turn", "turns", "rev"), 2 * pi),
    {"m": 1.0, "meter": 1.0, "metre": 1.0, "meters": 1.0, "metres": 1.0}
    | {"dm": 0.1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "in": 0.0254, "inch": 0.0254},
    {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9},
    {"rad/s": 1.0, "deg/s": pi / 180, "°/s": pi / 180, "rpm": 2 * pi / 60},
    {"rad/s^2": 1.0, "rad/s2": 1.0, "rad/s²": 1.0}
    | dict.fromkeys(("deg/s^2", "deg/s2", "deg/s²", "°/s²"), pi / 180),
    {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "km/h": 1 / 3.6},
    dict.fromkeys(("m/s^2", "m/s2", "m/s²"), 1.0) | dict.fromkeys(("mm/s^2", "mm/s²"), 1e-3),
    {"N": 1.0, "mN": 1e-3, "kN": 1e3},
    {"V": 1.0, "mV": 1e-3},
    {"A": 1.0, "mA": 1e-3},
    {"kg": 1.0, "g": 1e-3},
    dict.fromkeys(("Nm", "N·m", "N*m"), 1.0) | {"mNm": 1e-3, "Ncm": 1e-2},
    {"px": 1.0, "pixel": 1.0, "pixels": 1.0},
    {"%": 0.01, "percent": 0.01, "1": 1.0},
)
"""How much of the first unit of each quantity one of another is."""


def factor(unit: str, to: str) -> float | None:
    """Return how many of one unit one of another is; None where they measure different things."""
    if unit == to:
        return 1.0
    for units in QUANTITIES:
        folded = {name.casefold(): size for name, size in units.items()}
        one, other = (units.get(u, folded.get(u.casefold())) for u in (unit, to))
        if one is not None and other is not None:
            return one / other
    return None


def in_units(recording: Recording, units: Mapping[str, str]) -> Recording:
    """Return a recording with channels in other units, which is told; unknown units are kept.

    Args:
        recording: Whatever was read.
        units: The units wanted, by channel; empty where unknown.

    Raises:
        ChannelError: A unit that cannot be converted into the one wanted.
    """
    scales = np.ones(len(recording.channels))
    told, findings = list(recording.units), []
    for column, (name, unit) in enumerate(zip(recording.channels, recording.units, strict=True)):
        wanted = units.get(name, "")
        if not (unit and wanted) or unit == wanted:
            continue
        if (scale := factor(unit, wanted)) is None:
            raise ChannelError(
                f"{recording.source}: channel '{name}' is in [{unit}], the model's in [{wanted}], "
                f"and there is no way from one to the other; --unit {name}={wanted} says that it "
                "is in the model's"
            )
        scales[column], told[column] = scale, wanted
        if scale != 1.0:
            findings.append(
                Finding(
                    kind="converted",
                    source=recording.source,
                    what=f"converted from {unit} to the model's {wanted}",
                    remedy=f"--unit {name}={wanted} if it is in {wanted} already",
                    channel=name,
                    size=scale,
                )
            )
    scale_of = dict(zip(recording.channels, scales.tolist(), strict=True))
    ranges = {c: (lo * scale_of[c], hi * scale_of[c]) for c, (lo, hi) in recording.ranges.items()}
    changed = recording.map(lambda e: replace(e, values=e.values * scales))
    return replace(changed, units=tuple(told), ranges=ranges).found(*findings)
