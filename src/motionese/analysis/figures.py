"""Which figures the report shows, and what their captions say."""

from collections.abc import Iterator
from dataclasses import dataclass

from matplotlib import rc_context

from motionese.analysis.collected import Collected
from motionese.analysis.curves import buttons_pressed, error_sources, learning_curves
from motionese.analysis.directions import true_strokes
from motionese.analysis.figures_inside import of_the_inside, seeds_shown
from motionese.analysis.measures import Measures, typical_seed
from motionese.analysis.new_motions import new_motions
from motionese.analysis.slow_map import slow_state_map
from motionese.analysis.style import SETTINGS, Drawing, Sketch, finished

OVER_SEEDS = (
    "Lines are medians over seeds of a loop's mean over its motions, bands their bootstrap 95 % "
    "intervals."
)


@dataclass(frozen=True)
class Shown:
    """A figure with its name, the report's section it belongs to, and its caption."""

    name: str
    section: str
    caption: str
    drawing: Drawing


def figures(collected: Collected, measures: Measures) -> Iterator[Shown]:
    """Draw all figures that the runs allow, one after the other."""
    for draw in (_over_loops, _of_new_motions, _of_the_map, of_the_inside):
        with rc_context(SETTINGS):
            drawn = [
                Shown(each.name, each.section, each.caption, finished(each.figure, each.name))
                for each in draw(collected, measures)
            ]
        yield from drawn


def _over_loops(collected: Collected, measures: Measures) -> Iterator[Sketch]:
    loops, conditions = collected.loops, collected.conditions
    yield Sketch(
        "learning_curves",
        "learning",
        "Imitation error over the loops (the paper's Fig. 8): mean distance of the robot's hand "
        f"from the shown one. {OVER_SEEDS} The upright line is the change of phase: teaching moves "
        "on to sequences (TD), the network opens its slow level (MD).",
        learning_curves(loops, conditions),
    )
    yield Sketch(
        "error_sources",
        "learning",
        "Where the error comes from: what was recognised against what was shown, what the body did "
        "against what the network predicted, and what the trained network reproduces of its own "
        f"experience. {OVER_SEEDS}",
        error_sources(loops, conditions),
    )
    yield Sketch(
        "buttons",
        "buttons",
        "Presses that were due and were made, all seeds and motions of a loop together; the dotted "
        "line is at 90 %.",
        buttons_pressed(loops, conditions),
    )


def _of_new_motions(collected: Collected, measures: Measures) -> Iterator[Sketch]:
    present = set(collected.triples["condition"])
    conditions = tuple(c for c in collected.conditions if c.name in present)
    if conditions:
        yield Sketch(
            "new_motions",
            "new motions",
            "Imitation of triples after the last loop (Fig. 9), none of which was taught as a "
            "whole: of taught pairs (trained), and with a pair that is never taught (untrained). "
            "A point is a seed's mean over motions, joined across the two; black bars beside them "
            "are medians over seeds with their bootstrap 95 % intervals.",
            new_motions(measures, conditions),
        )


def _of_the_map(collected: Collected, measures: Measures) -> Iterator[Sketch]:
    lengths = measures.resultant_length
    shown = {
        c: typical_seed(lengths[c.name])
        for c in collected.conditions
        if lengths[c.name].notna().any()
    }
    if not shown:
        return
    strokes = true_strokes(collected.facts.settings.caregiver)
    for segment, what, right in (
        (1, "the first segment", "the primitive's own direction"),
        (2, "the second segment", "the direction of a primitive that may follow"),
    ):
        yield Sketch(
            f"slow_state_map_{segment}",
            "map",
            f"The map of Cs₀ (Fig. 10), {what}: where the hand goes, as the robot sees it, when "
            "each primitive's Cf₀ is held and Cs₀ is varied. In the condition's colour: within 45° "
            f"of {right}; in pink: beyond. An arrow fills its cell where the hand goes as far as "
            "the stroke is long. Shown is the seed of median resultant length: "
            f"{seeds_shown(shown)}; the numbers below are over all seeds.",
            slow_state_map(collected.slow_state_map, shown, strokes, segment),
        )
