"""The figures of single performances: where the hand went, what went on inside, a film strip."""

from collections.abc import Iterator, Mapping

from numpy import ndarray

from motionese.analysis.collected import Collected
from motionese.analysis.film import film
from motionese.analysis.inside import Performed, inside, levels_of
from motionese.analysis.measures import Measures, typical_seed
from motionese.analysis.paths import paths
from motionese.analysis.style import Sketch
from motionese.experiment.conditions import Condition
from motionese.experiment.evaluation import LOOKED_INTO, NEW_MOTIONS
from motionese.experiment.settings import Settings

Kept = Mapping[str, ndarray]
"""What a run kept of its performances."""


def of_the_inside(collected: Collected, measures: Measures) -> Iterator[Sketch]:
    """Draw paths, activity and a film strip of each condition's run of median error on triples."""
    seeds = _typical(collected)
    kept = {c: arrays for c, s in seeds.items() if (arrays := collected.inside(c, s)) is not None}
    if not kept:
        return
    chosen = f"Shown is the seed of median error: {seeds_shown({c: seeds[c] for c in kept})}."
    settings = collected.facts.settings
    yield Sketch(
        "paths",
        "inside",
        "The hand's path (coloured) against the shown one (grey), as the robot sees them, for "
        f"every new motion; the dot is where it starts, bars are the buttons. {chosen}",
        paths(kept, [motion.name for motion in NEW_MOTIONS], settings.caregiver),
    )
    yield Sketch(
        "inside",
        "inside",
        f"The network while it performs {LOOKED_INTO.name}: activity of every unit, the slowest "
        "level on top, and the way of Cf and Cs through the plane of their largest variance. "
        "Upright lines and circled numbers: where the second and the third primitive begin; dot: "
        f"start; square: end. {chosen}",
        inside({c: _performed(kept[c], settings) for c in kept}, LOOKED_INTO.name),
    )
    pressing = max(kept, key=lambda c: float(kept[c]["depths"].max()))
    strip, note = film(kept[pressing], settings.body.rate_hz)
    yield Sketch(
        "film",
        "inside",
        f"The robot presses a button: {pressing.name}, seed {seeds[pressing]}, in the performance "
        f"of {LOOKED_INTO.name} that presses deepest. {note}".strip(),
        strip,
    )


def seeds_shown(shown: Mapping[Condition, int]) -> str:
    """Return which seed of each condition is shown, in words."""
    return ", ".join(f"{condition.name} {seed}" for condition, seed in shown.items())


def _typical(collected: Collected) -> dict[Condition, int]:
    errors = collected.triples.pivot_table(
        index="seed", columns="condition", values="imitation_error_cm"
    )
    return {c: typical_seed(errors[c.name]) for c in collected.conditions if c.name in errors}


def _performed(kept: Kept, settings: Settings) -> Performed:
    activity = kept["activity"]
    sizes = {name: level.size for name, level in settings.network.levels.items()}
    count = len(LOOKED_INTO.primitives)
    return Performed(
        activity=activity,
        levels=levels_of(sizes, activity.shape[1]),
        boundaries=[round(len(activity) * place / count) for place in range(1, count)],
        rate_hz=settings.body.rate_hz,
    )
