"""Run folders as their reports leave them, of invented measures by seed, without any run."""

import json

import numpy as np
import pandas as pd
from invented_runs import CONDITIONS, STUDY, list_anew, write_settings

from motionese.analysis.beside_kept import SHOWN

COLUMNS = [column for columns in SHOWN.values() for column in columns]


def measures_table(seeds, level=0.5, step=0.01, without=()):
    """Measures that rise with the seed from a level on, the same in all conditions."""
    rows = [
        {"condition": condition.name, "seed": seed} | dict.fromkeys(COLUMNS, level + step * place)
        for condition in CONDITIONS
        for place, seed in enumerate(seeds)
    ]
    return pd.DataFrame(rows).assign(**dict.fromkeys(without, np.nan))


def write_reported(folder, measures, study=STUDY, preset="order", ends=()):
    """Write what stands beside a report; `ends` tells how runs ended that did not finish."""
    folder.mkdir(parents=True)
    write_settings(folder, study, preset=preset)
    (folder / "environment.json").write_text(json.dumps({"motionese": "0.7"}))
    measures.to_csv(folder / "measures.csv", index=False)
    rows = [
        {"condition": c, "seed": s, "loops": 8, "seconds": 12.5}
        | {"status": status, "reason": "" if status == "finished" else "loop 2: diverged"}
        for (c, s), status in {
            **dict.fromkeys(zip(measures["condition"], measures["seed"], strict=True), "finished"),
            **dict(ends),
        }.items()
    ]
    pd.DataFrame(rows).to_csv(folder / "runs.csv", index=False)
    list_anew(folder)
    return folder
