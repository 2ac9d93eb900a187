"""What is taught in which phase: primitives first (TD), or sequences from the start (TND)."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from motionese.caregiver.task import Motion, Task

WORDS = ("primitives", "taught pairs")
"""What a phase may say instead of listing its motions."""

Lesson = str | Annotated[list[str], Field(min_length=1)]


class Curriculum(BaseModel):
    """The lessons of phase 1 and phase 2.

    A lesson is "primitives", "taught pairs", or a list of motions such as "UR ↓↑" or
    "PUSH(R)+RAISE(R)".
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    phase_1: Lesson
    phase_2: Lesson

    def lessons(self, task: Task) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
        """Return the motions of both phases; `TaskError` for one that the task does not allow."""
        return _motions(task, self.phase_1), _motions(task, self.phase_2)


def _motions(task: Task, lesson: Lesson) -> tuple[Motion, ...]:
    if lesson == "primitives":
        return task.sequences(1)
    if lesson == "taught pairs":
        return task.taught_pairs()
    listed = [lesson] if isinstance(lesson, str) else lesson
    return tuple(dict.fromkeys(task.motion(text) for text in listed))
