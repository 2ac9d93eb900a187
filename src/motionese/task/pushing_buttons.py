"""The paper's task: five strokes between four corners, two of which press a button.

The six pairs and seven triples of the paper's experiment (its Table II) follow from the
primitives. The corners lie on the surface that the Actroid's hand reaches.
"""

from importlib.resources import files
from typing import Any

import numpy as np

from motionese.task.due_effects import due_effects
from motionese.task.sequence import Place, Primitive, PrimitiveSequence
from motionese.task.task import Attempt, Outcome, Task

PRESSED_MM = 5.0
"""A button that is deeper than this counts as pressed [mm]; its stroke is 15 mm."""
UPPER, LOWER = (0.5201350465164571, 1.0544599580381713), (0.4611036090808577, 0.8288249158568406)
"""How far ahead a corner is, and how high [m, world]."""
RIGHT, LEFT = -0.29561591794016756, -0.06438408205983244
"""How far to the left [m, world]."""


def presses(sequence: PrimitiveSequence, attempt: Attempt) -> dict[str, Any]:
    """Return how many presses were due and made, and how deep they were [mm]."""
    due = due_effects(sequence, attempt.begins, len(attempt.path))
    depths = [float(attempt.effects[primitive.effect][rows].max()) for primitive, rows in due]
    return {
        "buttons_due": len(depths),
        "buttons_pressed": sum(depth > PRESSED_MM for depth in depths),
        "press_depth_mm": float(np.mean(depths)) if depths else np.nan,
        "press_depths_mm": " ".join(f"{depth:.2f}" for depth in depths),
    }


PUSHING_BUTTONS = Task(
    name="pushing_buttons",
    title="pushing two buttons",
    places={
        "UR": Place("UR", (UPPER[0], RIGHT, UPPER[1]), "the upper right"),
        "UL": Place("UL", (UPPER[0], LEFT, UPPER[1]), "the upper left"),
        "LR": Place("LR", (LOWER[0], RIGHT, LOWER[1]), "the lower right, where a button is"),
        "LL": Place("LL", (LOWER[0], LEFT, LOWER[1]), "the lower left, where a button is"),
    },
    primitives=(
        Primitive("PUSH(R)", "↓", "UR", "LR", "down", effect="right_button"),
        Primitive("RAISE(R)", "↑", "LR", "UR", "up"),
        Primitive("SLIDE", "←", "UR", "UL", "to the left"),
        Primitive("PUSH(L)", "↓", "UL", "LL", "down", effect="left_button"),
        Primitive("RAISE(L)", "↑", "LL", "UL", "up"),
    ),
    achieved=presses,
    outcomes=(
        Outcome("buttons_pressed", "due presses that were made", of="buttons_due"),
        Outcome("press_depth_mm", "depth of due presses", "mm"),
    ),
    untaught=frozenset({("RAISE(R)", "PUSH(R)"), ("RAISE(L)", "PUSH(L)")}),
    lessons={
        "taught pairs": ("UR ↓↑", "LR ↑←", "UR ←↓", "UL ↓↑"),
        "branching": ("UR ↓↑", "LR ↑↓", "LR ↑←", "UR ←↓", "UL ↓↑"),
        "all pairs": ("UR ↓↑", "LR ↑↓", "LR ↑←", "UR ←↓", "UL ↓↑", "LL ↑↓"),
        "pairs and triples": ("LR ↑←", "LR ↑↓", "UR ↓↑←", "UR ↓↑↓", "UR ←↓", "UL ↓↑"),
    },
    novel={"triples": ("UR ↓↑↓", "UR ↓↑←", "LR ↑↓↑", "LR ↑←↓", "UR ←↓↑", "UL ↓↑↓", "LL ↑↓↑")},
    fixtures=files(__package__).joinpath("pushing_buttons.xml").read_text(encoding="utf-8"),
    effects=("right_button", "left_button"),
    needed_mm=PRESSED_MM,
)
"""Upper and lower, right and left corners, the lower ones being buttons."""
