"""What an imitation has brought about among the task's things, in words."""

from motionese.imitation import Performance
from motionese.task import PrimitiveSequence, Task
from motionese.task.pushing_buttons import PRESSED_MM


def pressed(performance: Performance, task: Task, sequence: PrimitiveSequence | None) -> str:
    """Return which presses that a sequence asks for were made; empty where it asks for none."""
    strokes = sequence.primitives if sequence else ()
    due = {p.effect: task.places[p.end].title for p in strokes if p.effect}
    deepest = {effect: float(performance.effects[effect].max()) for effect in due}
    made = [due[effect] for effect in due if deepest[effect] > PRESSED_MM]
    missed = [
        f"{due[effect]} ({deepest[effect]:.1f} of {PRESSED_MM:g} mm)"
        for effect in due
        if deepest[effect] <= PRESSED_MM
    ]
    parts = [f"it pressed {' and '.join(made)}"] if made else []
    parts += [f"it did not press {' and '.join(missed)}"] if missed else []
    return ", but ".join(parts)
