"""How the figures of a report look.

A condition has the same colour, line and marker in every figure (see `looks_of`): blue for teaching
in phases, orange for sequences from the start; dark and solid for a growing network, light and
dashed for a whole one (after Okabe & Ito's palette, distinguishable without colour vision).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes

from motionese.experiment import conditions_of
from motionese.figure_style import HUES, PAPER

ASTRAY = "#cc79a7"


@dataclass(frozen=True)
class Look:
    """Colour, line style and marker of a condition."""

    colour: str
    line: str
    marker: str

    def curve(self) -> dict[str, Any]:
        """Return the arguments that draw a curve in this look."""
        return {
            "color": self.colour,
            "linestyle": self.line,
            "marker": self.marker,
            "markerfacecolor": self.colour if self.line == "-" else PAPER,
        }


GREYS = ("#1b1f24", "#808890")
LINES = ("-", "--", ":", "-.")
MARKERS = "os^DvPX*"


def looks_of(factors: Mapping[str, tuple[str, ...]]) -> dict[str, Look]:
    """Return the look of every condition of a study, by its name.

    The first factor's choice sets the hue, the others' the shade and the line, the first of them
    dark and solid: the same condition looks the same in every figure, whichever others were run.
    """
    looks = {}
    first = next(iter(factors.values()))
    for place, condition in enumerate(conditions_of(factors)):
        hue = first.index(condition.choices[0])
        within = place % (len(conditions_of(factors)) // len(first))
        shades = HUES[hue] if hue < len(HUES) else GREYS
        looks[condition.name] = Look(
            shades[min(within, 1)], LINES[within % len(LINES)], MARKERS[place % len(MARKERS)]
        )
    return looks


def light_grid(axes: Axes) -> None:
    """Draw faint level lines behind the data."""
    axes.grid(visible=True, axis="y")
    axes.set_axisbelow(True)
