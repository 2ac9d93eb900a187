"""What Mochizuki et al. claim (IROS 2013), and how this experiment departs from it.

Shown only where a study has the paper's design: teaching (TD, TND) by structuring (MD, MND) over
two stages of pushing two buttons, with a slow level above a fast one.
"""

from motionese.analysis.mochizuki2013.answer import answer
from motionese.analysis.mochizuki2013.claims import (
    CONVERGED_CM,
    QUESTION,
    SAME,
    answer_by_map,
    claims,
)
from motionese.analysis.mochizuki2013.departures import departures
from motionese.analysis.mochizuki2013.findings import findings, findings_table, preset_of
from motionese.experiment import Study

FACTORS = [("TD", "TND"), ("MD", "MND")]


def has_its_design(study: Study) -> bool:
    """Whether a study varies what the paper varies, in the paper's task and stages."""
    return (
        study.task.name == "pushing_buttons"
        and list(study.factors.values()) == FACTORS
        and len(study.stages) == 2
        and len(study.network.levels) == 3
    )


__all__ = [
    "CONVERGED_CM",
    "QUESTION",
    "SAME",
    "answer",
    "answer_by_map",
    "claims",
    "departures",
    "findings",
    "findings_table",
    "has_its_design",
    "preset_of",
]
