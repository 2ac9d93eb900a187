"""Which channels of a recording tell how a motion is shown: a hand's position, or joints."""

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from motionese.errors import ChannelError, SettingError
from motionese.recordings import (
    OPTIONS,
    Choice,
    Recording,
    choose,
    chosen,
    evened,
    examined,
    factor,
    read,
    refuse_any,
)

AXIS = re.compile(r"(?:(.*?)(?:[\W_]+|(?<=[a-z])(?=[XYZ])))?([xyzXYZ])[\W_]*")
"""A name that ends in an axis, such as 'x', 'hand_y', 'handZ' or '/hand.position[x]'."""
LENGTHS = ("m", "px")
"""A position is in a unit of one of these quantities."""
FEWEST, MOST = 2, 3
"""Axes of a hand."""


@dataclass(frozen=True)
class Shown:
    """Motions that can be measured: all channels in one unit, on an even grid.

    Attributes:
        recording: Its channels are those measured.
        hand: Whether they are a hand's position; joint angles otherwise.
        unit: Of all channels; empty where unknown.
        supposed: Whether a channel tells no unit, and is taken to be in this one.
    """

    recording: Recording
    hand: bool
    unit: str
    supposed: bool

    @property
    def what(self) -> str:
        """What is measured, in words."""
        names = ", ".join(self.recording.channels)
        kind = "the hand at" if self.hand else "joints"
        supposed = " (taken to be, where no unit is told)" if self.unit and self.supposed else ""
        return f"{kind} {names} [{self.unit or 'no unit told'}]{supposed}"


def read_shown(
    source: Path, hand: Sequence[str], reading: Mapping[str, Any], unit: str = ""
) -> Shown:
    """Read what is to be measured.

    Args:
        source: A file or folder of recordings.
        hand: Names or patterns of the channels that are the hand's position; found if empty.
        reading: How `source` is read, as `Motions.read` takes it.
        unit: What positions are brought to, if theirs can be; else they stay in their own.

    Raises:
        SettingError: Channels that are no hand.
        ChannelError: Channels in units that do not fit each other.
        MotioneseError: Whatever `recordings` refuses.
    """
    if hand and reading.get("channels"):
        raise SettingError("--hand says which channels are measured; leave out --channels")
    columns = {name: reading[name] for name in ("format", *OPTIONS) if name in reading}
    given = {name: told for name, told in reading.items() if name not in columns}
    choice = choose(**given | ({"channels": tuple(hand)} if hand else {}))
    whole = read(source, **columns)
    taken = chosen(whole, choice)
    names = taken.channels if hand else _hand(taken)
    if hand and not FEWEST <= len(names) <= MOST:
        raise SettingError(
            f"{source}: --hand names the 2 or 3 channels of a position, got {', '.join(names)}"
        )
    own = _unit(taken, names) if names else "rad"
    unit = unit if unit and factor(own or unit, unit) is not None else own
    measured = names or _joints(taken, told=choice.channels is not None)
    exact = choice.model_copy(update={"channels": measured, "exclude": ()})
    recording = _even(chosen(whole, exact), exact)
    supposed = not all(recording.units)
    return Shown(_in_unit(recording, unit), bool(names), unit, supposed)


def _even(recording: Recording, choice: Choice) -> Recording:
    recording = evened(examined(recording, choice), choice)
    if choice.strict:
        refuse_any(recording.findings)
    return recording


def _hand(recording: Recording) -> tuple[str, ...]:
    """Return the channels of the one hand in a recording; none where there is no hand.

    Those in a unit of length are; or else those without a unit that are called x, y, z.
    """
    units = dict(zip(recording.channels, recording.units, strict=True))
    lengths = [name for name in units if _is_length(units[name])]
    if FEWEST <= len(lengths) <= MOST:
        return tuple(lengths)
    found: defaultdict[str, dict[str, str]] = defaultdict(dict)
    for name in lengths or (name for name in units if not units[name]):
        if told := AXIS.fullmatch(name):
            found[told[1] or ""][told[2].lower()] = name
    hands = [tuple(axes[a] for a in sorted(axes)) for axes in found.values() if len(axes) >= FEWEST]
    if len(hands) > 1 or (lengths and not hands):
        several = [", ".join(axes) for axes in hands] or lengths
        raise SettingError(
            f"{recording.source}: say which channels are the hand, --hand X Y [Z]; "
            f"positions are: {'; '.join(several)}"
        )
    return hands[0] if hands else ()


def _joints(recording: Recording, *, told: bool) -> tuple[str, ...]:
    """Return the channels that are joints: in a unit of angle, or without any."""
    units = dict(zip(recording.channels, recording.units, strict=True))
    angles = [name for name, unit in units.items() if unit and factor(unit, "rad") is not None]
    unknown = [name for name, unit in units.items() if not unit]
    others = [name for name in units if name not in angles and name not in unknown]
    if others and (told or not (angles or unknown)):
        raise ChannelError(
            f"{recording.source}: channel '{others[0]}' is in [{units[others[0]]}], neither a "
            "position nor an angle; choose others with --hand or --channels"
        )
    return recording.channels if told else tuple(angles or unknown)


def _unit(recording: Recording, names: Sequence[str]) -> str:
    """Return the unit that a position is told in: that of its first channel which has one."""
    units = dict(zip(recording.channels, recording.units, strict=True))
    return next((units[name] for name in names if units[name]), "")


def _is_length(unit: str) -> bool:
    return bool(unit) and any(factor(unit, length) is not None for length in LENGTHS)


def _in_unit(recording: Recording, unit: str) -> Recording:
    """Return a recording whose channels are all in one unit; those without are taken to be."""
    scales = []
    for name, own in zip(recording.channels, recording.units, strict=True):
        scale = factor(own or unit, unit)
        if scale is None:
            raise ChannelError(
                f"{recording.source}: channel '{name}' is in [{own}], which is no [{unit}]; "
                "the channels of a position must be in units of one quantity"
            )
        scales.append(scale)
    changed = recording.map(lambda e: replace(e, values=e.values * np.array(scales)))
    return replace(changed, units=(unit,) * len(scales))
