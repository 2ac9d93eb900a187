"""What the roles of levels cannot but be, and is therefore no finding."""

from motionese.analysis.cells import listed
from motionese.analysis.map_numbers import level_names
from motionese.experiment import Study


def by_construction(study: Study) -> list[str]:
    """Return what follows from how a study shares initial states, in sentences."""
    below, top = (name.capitalize() for name in level_names(study))
    sharing = study.training.shared.get(below.lower(), "none")
    if sharing == "none":
        return [f"Every motion has initial states of its own: {below}₀ can hold it as a whole."]
    notes = [
        f"Exchanged are states recognised from fresh demonstrations, in which {below}₀ is free. "
        f"Of learned states it would be no finding that the first stroke follows {below}₀ where "
        "motions share it: they then have the same."
    ]
    whole = [
        condition.name
        for condition in study.conditions
        if study.development(condition)[0].levels == len(study.network.levels)
    ]
    if sharing == "repertoire" and whole:
        notes.append(
            f"In {listed(whole)} {below} is never the top level, and all motions share one "
            f"{below}₀: that {top} takes part in the direction there follows from this."
        )
    return notes
