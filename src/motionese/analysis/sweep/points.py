"""The points of a sweep that have runs: their measures, and which of them is the preset itself."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from motionese.analysis.reported import Reported, read_reported
from motionese.errors import RunFolderError
from motionese.experiment import read_settings
from motionese.experiment.sweeps import Sweep

Points = Mapping[str, Reported]
"""What was run, by the point's label, in the order of the sweep."""


def points_of(sweep: Sweep, run_folders: Sequence[Path]) -> Points:
    """Return the points whose run folders are among these.

    Raises:
        RunFolderError: None is, or one has no report.
    """
    by_name = {folder.resolve().name: folder for folder in run_folders}
    labels = [point.label for point in sweep.points if point.label in by_name]
    if not labels:
        raise RunFolderError(f"no run folder of the sweep's points: {', '.join(by_name)}")
    return {label: read_reported(by_name[label]) for label in labels}


def reference_of(sweep: Sweep, points: Points) -> str:
    """Return the point that the others are compared with.

    It is the one that changes nothing of its preset; the first, if all change something.
    """
    plain = read_settings(sweep.preset)
    of = {
        point.label
        for point in sweep.points
        if read_settings(sweep.preset, point.overrides) == plain
    }
    return next((label for label in points if label in of), next(iter(points)))
