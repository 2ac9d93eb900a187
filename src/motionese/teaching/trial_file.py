"""How a try at a motion is kept in a file, as arrays alone."""

import io
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np

from motionese.files import write_whole
from motionese.imitation import Performance
from motionese.teaching.result import Push, Result
from motionese.teaching.trial import Trial

EFFECT, PUSH = "effect.", "push."
PLAIN = [field.name for field in fields(Performance) if field.name != "effects"]
PUSHED = [field.name for field in fields(Push)]


def write_trial(path: Path, trial: Trial) -> None:
    """Write a trial; `OSError` if it cannot be written."""
    done, content = trial.performance, io.BytesIO()
    arrays: dict[str, Any] = {name: getattr(done, name) for name in PLAIN}
    arrays |= {f"{EFFECT}{name}": values for name, values in done.effects.items()}
    arrays |= {"state": trial.state, "error_cm": trial.error_cm}
    pushes = trial.result.pushes
    arrays |= {f"{PUSH}{name}": [getattr(push, name) for push in pushes] for name in PUSHED}
    arrays |= {"levels": [*trial.levels], "sizes": [*trial.levels.values()]}
    np.savez_compressed(content, **arrays)
    write_whole(path, content.getvalue())


def read_trial(path: Path) -> Trial:
    """Read a trial; `OSError`, `ValueError` or `KeyError` where the file is none."""
    with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
        told = {name: arrays[name] for name in arrays.files}
    plain: dict[str, Any] = {name: told[name] for name in PLAIN}
    plain["joints"] = tuple(int(i) for i in told["joints"])
    effects = {n.removeprefix(EFFECT): told[n] for n in told if n.startswith(EFFECT)}
    columns = [told[f"{PUSH}{name}"].tolist() for name in PUSHED]
    pushes = tuple(Push(*each) for each in zip(*columns, strict=True))
    return Trial(
        performance=Performance(**plain, effects=effects),
        state=told["state"],
        result=Result(float(told["error_cm"]), pushes),
        levels=dict(zip(told["levels"].tolist(), told["sizes"].tolist(), strict=True)),
    )
