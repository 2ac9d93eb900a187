"""What is taught in every stage of a study, and what memory of order that demands."""

from dataclasses import dataclass

from motionese.experiment.study import Study
from motionese.task import MemoryDemand, PrimitiveSequence, memory_demand


@dataclass(frozen=True)
class StageLesson:
    """A lesson as it is taught in a stage.

    Attributes:
        stage: Which one, from 1.
        conditions: Those in which it is taught so, or 'all conditions'.
        name: What the task calls it; empty for a list of sequences.
        sequences: The sequences' names.
    """

    stage: int
    conditions: str
    name: str
    sequences: str
    demand: MemoryDemand

    @property
    def numbers(self) -> dict[str, str]:
        """The demand in numbers, by what they are called: D [bit], hold [rows], load."""
        demand = self.demand
        told = {"corner": demand.corner, "last": demand.last, "history": demand.history}
        return {
            **{f"D_{known}": f"{bits:.2f}" for known, bits in told.items()},
            "hold": str(demand.hold),
            "load": f"{demand.load:.1f}",
        }


def stage_lessons(study: Study) -> list[StageLesson]:
    """Return the lessons of a study by stage, one that differs between conditions for each.

    Lessons differ by their sequences or by their demand, as where a caregiver rests longer.
    """
    task, conditions = study.task.task(), study.conditions
    taught: dict[tuple[int, tuple[PrimitiveSequence, ...], MemoryDemand], list[str]] = {}
    for condition in conditions:
        for number, stage in enumerate(study.development(condition), 1):
            demand = memory_demand(stage.lesson, stage.manner.rows_until_next)
            taught.setdefault((number, stage.lesson, demand), []).append(condition.name)
    return [
        StageLesson(
            stage=number,
            conditions="all conditions" if len(names) == len(conditions) else ", ".join(names),
            name=task.lesson_name(lesson),
            sequences=", ".join(sequence.name for sequence in lesson),
            demand=demand,
        )
        for (number, lesson, demand), names in sorted(taught.items(), key=lambda item: item[0][0])
    ]
