"""How motions are shown, measured, told, written and drawn: one group of recordings, or two."""

import csv
from collections.abc import Mapping, Sequence
from io import StringIO
from math import isnan, nan
from pathlib import Path
from typing import Any

from rich.console import Console

from motionese.errors import StorageError
from motionese.files import write_whole
from motionese.interfaces.commands.measure_figures import write_groups_figure, write_pauses_figure
from motionese.interfaces.commands.measure_tables import tell_comparison, tell_group
from motionese.interfaces.commands.measured_group import (
    Group,
    Manner,
    comparable,
    measured_group,
)
from motionese.interfaces.commands.outputs import PICTURES, check_apart, check_output
from motionese.interfaces.commands.shown_channels import read_shown
from motionese.kinematics import MEASURES


def measure_recordings(
    console: Console,
    sources: Sequence[Path],
    hand: Sequence[str],
    manner: Manner,
    *,
    out: Path | None,
    plot: Path | None,
    reading: Mapping[str, Any],
) -> None:
    """Measure one file or folder of recordings, or two and compare them; write and draw it.

    Args:
        sources: One, or two.
        hand: Channels of the hand's position; found if empty.
        manner: How it is measured.
        out: A table to write.
        plot: A picture to draw.
        reading: How `sources` are read, as `Motions.read` takes it.
    """
    if out:
        check_output("--out", out, (".csv",))
    if plot:
        check_output("--plot", plot, PICTURES)
    check_apart(sources, out, plot)
    groups: list[Group] = []
    for source in sources:
        unit = groups[0].shown.unit if groups else ""
        groups.append(measured_group(read_shown(source, hand, reading, unit), manner))
    if len(groups) > 1:
        groups = comparable(groups)
    for group in groups:
        tell_group(console, group, manner)
    if len(groups) > 1:
        tell_comparison(console, groups)
    if out:
        try:
            write_whole(out, _as_csv(groups))
        except OSError as error:
            raise StorageError(f"{out}: cannot be written: {error.strerror}") from error
        console.print(f"Table: {out}")
    if plot:
        _draw(plot, groups)
        console.print(f"Plot: {plot}")


def _as_csv(groups: Sequence[Group]) -> str:
    """Return a line an episode; empty where undefined."""
    text, unit = StringIO(), groups[0].shown.unit or "unit"
    table = csv.writer(text, lineterminator="\n")
    several = len(groups) > 1
    table.writerow(
        [
            *(["group"] if several else []),
            "episode",
            *(groups[0].label(name) for name in MEASURES),
            *("pace at half the threshold", "pace at twice the threshold"),
            *(f"threshold [{unit}/s]", f"noise [{unit}]"),
        ]
    )
    for group in groups:
        for name, measured in group.measured.items():
            noise = max((track.noise for track in measured.tracks), default=nan)
            more = (measured.pace_at_half, measured.pace_at_twice, measured.still, noise)
            numbers = [*measured.numbers().values(), *more]
            cells = ("" if isnan(value) else f"{value:.9g}" for value in numbers)
            table.writerow([*([group.name] if several else []), name, *cells])
    return text.getvalue()


def _draw(path: Path, groups: Sequence[Group]) -> None:
    if len(groups) > 1:
        names = [group.name for group in groups]
        values = {groups[0].label(m): [g.values(m) for g in groups] for m in MEASURES}
        write_groups_figure(path, names, values)
        return
    (group,) = groups
    channels = group.shown.recording.channels
    title = f"{group.name}: {len(group.measured)} episode{'s' * (len(group.measured) > 1)}"
    write_pauses_figure(path, group.measured, channels, group.shown.unit, title)
