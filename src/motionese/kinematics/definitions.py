"""The measures of motionese: what is counted, in which unit, and after whom.

The sources: R. J. Brand, D. A. Baldwin and L. A. Ashburn, Evidence for 'motionese': modifications
in mothers' infant-directed action, Developmental Science 5 (2002), had range of motion and
repetitiveness, among others, rated by people who watched. K. J. Rohlfing, J. Fritsch, B. Wrede and
T. Jungmann, How can multimodal cues from child-directed interaction reduce learning complexity in
robots?, Advanced Robotics 20 (2006), computed measures from the path of the hand. Y. Nagai and
K. J. Rohlfing, Computational analysis of motionese toward scaffolding robot action learning, IEEE
Transactions on Autonomous Mental Development 1 (2009), asked by a model of attention what a robot
would see of it. What is counted, and how, is laid down here where they leave it open.
"""

from collections.abc import Mapping
from typing import NamedTuple


class Measure(NamedTuple):
    """What one measure is.

    Attributes:
        label: What it is called in tables.
        unit: With {} for the unit of the path; empty for a plain number.
        definition: How it is computed, in words.
        source: Where the field has it from.
    """

    label: str
    unit: str
    definition: str
    source: str


BRAND, ROHLFING = "Brand et al. 2002", "Rohlfing et al. 2006"
MEASURES: Mapping[str, Measure] = {
    "duration": Measure(
        "duration", "s", "from the first movement's beginning to the last one's end", ROHLFING
    ),
    "speed": Measure(
        "mean speed", "{}/s", "length of all movements' ways over the time they take", ROHLFING
    ),
    "peak_speed": Measure(
        "peak speed", "{}/s", "largest speed of a movement, mean over movements", ROHLFING
    ),
    "acceleration": Measure(
        "mean acceleration",
        "{}/s²",
        "norm of the acceleration, mean over the movements' time",
        ROHLFING,
    ),
    "peak_acceleration": Measure(
        "peak acceleration",
        "{}/s²",
        "largest norm of the acceleration of a movement, mean over movements",
        ROHLFING,
    ),
    "range": Measure(
        "range", "{}", "largest distance between two positions of the whole motion", BRAND
    ),
    "roundness": Measure(
        "roundness",
        "",
        "length of the ways between two rests over the distance of their ends, both summed",
        ROHLFING,
    ),
    "repetitiveness": Measure(
        "repetitiveness", "", "length of the way over the length of its parts that are new", BRAND
    ),
    "pace": Measure("pace", "", "time of moving over time of pausing", ROHLFING),
    "pause_count": Measure("pauses", "", "number of pauses between two movements", ROHLFING),
    "pause": Measure("mean pause", "s", "how long a pause lasts, mean over pauses", ROHLFING),
    "pausing": Measure("time in pauses", "s", "how long all pauses last together", ROHLFING),
}
"""By the name of the attribute, in the order of tables."""
