"""ManiSkill's HDF5: groups `traj_0`, … at the top with `obs`, `actions`, `env_states`, `success`.

There is one observation more than actions: their last row is a gap. The .json beside the file
tells the rate, `control_freq` of its environment, and how many steps every episode has.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import natural
from motionese.recordings.formats.hdf5_columns import (
    ACTIONS,
    is_dataset,
    is_group,
    paths,
    rate_in,
    read_json,
    recording_of,
)
from motionese.recordings.recording import Recording

WHAT = "groups traj_0, traj_1, …"
PREFIX, OBSERVED, STATES = "traj_", "obs", "env_states"


def holds(file: Any) -> bool:
    """Tell whether a file is of this layout."""
    return bool(_trajectories(file))


def recording(path: Path, file: Any) -> Recording:
    """Return the trajectories, in natural order."""
    names = _trajectories(file)
    told = _beside(path)
    found = recording_of(
        path,
        [(name, file[name]) for name in names],
        paths(file[names[0]]),
        OBSERVED,
        _rate(told.get("env_info")),
        ahead=(OBSERVED, STATES),
    )
    return found.found(*_gaps(found), *_lengths(path, told, file))


def _trajectories(file: Any) -> list[str]:
    groups = (key for key in file if key.startswith(PREFIX) and is_group(file[key]))
    return sorted(groups, key=natural)


def _beside(path: Path) -> dict[str, Any]:
    """Return what the .json of the same name tells; nothing where there is none."""
    try:
        told = read_json(path.with_suffix(".json").read_bytes())
    except OSError:
        return {}
    return told if isinstance(told, dict) else {}


def _rate(told: Any) -> float | None:
    """Return the rate [Hz] that is told anywhere in what the environment was made with."""
    parts = told.values() if isinstance(told, dict) else ()
    return rate_in(told) or next(filter(None, map(_rate, parts)), None)


def _gaps(recording: Recording) -> Iterable[Finding]:
    """Yield, once, that no action was recorded in the last row."""
    gaps = [e for e in recording.episodes if len(e.values) and not e.observed[-1].all()]
    if gaps:
        missing = recording.channels[int(np.argmin(gaps[0].observed[-1]))]
        yield Finding(
            "layout",
            recording.source,
            "nothing was recorded after the last observation: a gap in the last row",
            episode=gaps[0].name,
            channel=missing,
            row=len(gaps[0].values) - 1,
            count=len(gaps),
        )


def _lengths(path: Path, told: dict[str, Any], file: Any) -> Iterable[Finding]:
    """Yield, once, that the .json tells another number of steps than there are actions."""
    episodes = told.get("episodes")
    steps = {
        f"{PREFIX}{e.get('episode_id')}": e.get("elapsed_steps")
        for e in (episodes if isinstance(episodes, list) else ())
        if isinstance(e, dict)
    }
    wrong = []
    for name in _trajectories(file):
        actions = next(filter(is_dataset, map(file[name].get, ACTIONS)), None)
        if isinstance(steps.get(name), int) and actions is not None and len(actions) != steps[name]:
            wrong.append((name, f"has {len(actions)} actions; its .json tells {steps[name]} steps"))
    if wrong:
        yield Finding("time", path, wrong[0][1], episode=wrong[0][0], count=len(wrong))
