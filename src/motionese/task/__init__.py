"""Tasks: places, ways, primitives, the sequences they allow, and what counts as success."""

from motionese.errors import TaskError, unknown
from motionese.task.due_effects import due_effects
from motionese.task.memory_demand import MemoryDemand, memory_demand
from motionese.task.pushing_buttons import PUSHING_BUTTONS
from motionese.task.sequence import Place, Primitive, PrimitiveSequence, common_beginning
from motionese.task.shapes import SHAPES
from motionese.task.task import Attempt, Outcome, Task
from motionese.task.way import Arc, ViaPoints, Way, straight

TASKS = {task.name: task for task in (PUSHING_BUTTONS, SHAPES)}
"""Every task by its name in settings; a new one is a row here."""


def task_named(name: str) -> Task:
    """Return a task; `TaskError` for a name that does not exist."""
    if name not in TASKS:
        raise TaskError(unknown("task", name, TASKS))
    return TASKS[name]


__all__ = [
    "PUSHING_BUTTONS",
    "SHAPES",
    "TASKS",
    "Arc",
    "Attempt",
    "MemoryDemand",
    "Outcome",
    "Place",
    "Primitive",
    "PrimitiveSequence",
    "Task",
    "ViaPoints",
    "Way",
    "common_beginning",
    "due_effects",
    "memory_demand",
    "straight",
    "task_named",
]
