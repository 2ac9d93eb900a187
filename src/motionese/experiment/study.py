"""A study: a robot that imitates, stages of development, and the factors that are varied."""

from collections.abc import Callable, Iterable, Mapping
from typing import Annotated, Any

from pydantic import Discriminator, Field, Tag, field_validator, model_validator

from motionese.body import open_body
from motionese.caregiver import Manner, check_reach
from motionese.errors import MotioneseError, SettingError, unknown
from motionese.experiment.changes import check_changes
from motionese.experiment.conditions import Condition, conditions_of
from motionese.imitation import Choosing, Development, Group, Settings, Stage, Until, checked
from motionese.task import Task

Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9]+$")]
"""Of a choice: it becomes part of a folder's name."""
Lesson = str | Annotated[list[str], Field(min_length=1)]
Levels = Annotated[list[str], Field(min_length=2)]


def _given(model: type[Group]) -> Callable[[Any], str]:
    """Return what tells whether a value is one for all conditions, or given by choice."""

    def given(value: Any) -> str:
        tables = isinstance(value, Mapping) and all(
            isinstance(v, Mapping | model) for v in value.values()
        )
        own = not tables or not value or value.keys() & model.model_fields.keys()
        return "for all" if own else "by choice"

    return given


Ending = Annotated[
    Annotated[Until, Tag("for all")] | Annotated[dict[str, Until], Tag("by choice")],
    Discriminator(_given(Until)),
]
Choice = Annotated[
    Annotated[Choosing, Tag("for all")] | Annotated[dict[str, Choosing], Tag("by choice")],
    Discriminator(_given(Choosing)),
]


class StageSettings(Group):
    """One stage. Every entry holds for all conditions, or is given by choice.

    Attributes:
        lesson: A lesson of the task, or sequences such as "UR ↓↑" or "PUSH(R)+RAISE(R)".
        levels: The open levels of the network, from io upwards.
        caregiver: How the caregiver moves where that differs from `[caregiver]`.
        until: When it ends.
        choosing: What of the lesson is shown in a loop.
    """

    lesson: Lesson | dict[str, Lesson]
    levels: Levels | dict[str, Levels]
    caregiver: dict[str, Any] = Field(default_factory=dict)
    until: Ending
    choosing: Choice = Choosing()


class Study(Settings):
    """All settings of a study; presets explain each where they give its value.

    Attributes:
        factors: What is varied, each with its choices; conditions are their combinations.
        stages: The stages.
        opens: When a level opens beside them, by its name: how long the network stays without it.
    """

    factors: dict[str, tuple[Name, ...]]
    stages: list[StageSettings] = Field(min_length=1)
    opens: dict[str, Ending] = Field(default_factory=dict)

    @field_validator("factors")
    @classmethod
    def _choices_are_unique(cls, factors: dict[str, tuple[str, ...]]) -> dict[str, tuple[str, ...]]:
        choices = [choice for listed in factors.values() for choice in listed]
        doubled = sorted({c for c in choices if choices.count(c) > 1})
        if not choices or not all(factors.values()) or doubled:
            raise ValueError(
                "every factor needs choices, each of a name of its own; "
                f"got {', '.join(choices) or 'none'}"
            )
        return factors

    @model_validator(mode="after")
    def _stages_can_be_gone_through(self) -> "Study":
        try:
            stages = [stage for each in self.conditions for stage in self.course(each).stages]
            emphatic = [s for s in stages if s.manner.motionese.leaves_the_way]
            if emphatic:
                self._check_reach(emphatic)
        except MotioneseError as error:
            raise ValueError(str(error)) from error
        return self

    def _check_reach(self, stages: Iterable[Stage]) -> None:
        """Refuse motionese that no robot can follow, before anything is run."""
        task = self.task.task()
        body = open_body(self.body.model_copy(update={"vision": "projection"}), task)
        shown = {(repr(s.manner), s.lesson): s for s in stages}
        for stage in shown.values():
            check_reach(task, stage.manner, body, stage.lesson)

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """All conditions, the first factor changing slowest."""
        return conditions_of(self.factors)

    def course(self, condition: Condition) -> Development:
        """Return the development that a condition goes through, beside stages when levels open.

        Raises:
            TaskError: A lesson or sequence that the task does not have.
            SettingError: Levels that do not exist, one that is open and would be closed, or a
                change that can never come.
        """
        course = Development(self.development(condition), self._openings(condition))
        check_changes(course, list(self.network.levels), condition.name)
        return course

    def development(self, condition: Condition) -> tuple[Stage, ...]:
        """Return the stages that a condition goes through.

        Raises:
            TaskError: A lesson or sequence that the task does not have.
            SettingError: Levels that do not exist, or one that is open and would be closed.
        """
        task, stages, opened = self.task.task(), [], 0
        for number, stage in enumerate(self.stages):
            levels = self._open(number, self._chosen(stage.levels, condition))
            if levels < opened:
                raise SettingError(
                    f"stages.{number}.levels closes a level that stage {number - 1} has opened in "
                    f"{condition.name}: a network grows, and keeps what it has"
                )
            opened = levels
            lesson = self._lesson(task, number, self._chosen(stage.lesson, condition))
            stages.append(
                Stage(
                    lesson=lesson,
                    levels=levels,
                    manner=self._manner(number, self._chosen(stage.caregiver, condition)),
                    until=self._one(f"stages.{number}.until", stage.until, condition),
                    choosing=self._choosing(number, stage.choosing, condition, len(lesson)),
                )
            )
        return tuple(stages)

    def most_loops(self) -> int:
        """Return how many loops a run has at most, whichever its condition."""
        return max(self.course(condition).most_loops() for condition in self.conditions)

    @property
    def emerging(self) -> tuple[str, ...]:
        """The levels whose emergence any change waits for, in any condition."""
        endings = [*(stage.until for stage in self.stages), *self.opens.values()]
        every = [u for e in endings for u in (e.values() if isinstance(e, dict) else (e,))]
        asked = {until.emerged.level for until in every if until.emerged is not None}
        return tuple(level for level in self.network.levels if level in asked)

    def _chosen(self, value: Any, condition: Condition) -> Any:
        """Return what holds for a condition: a value for all, or that of one of its choices."""
        if not isinstance(value, dict):
            return value
        for choices, choice in zip(self.factors.values(), condition.choices, strict=True):
            if value and value.keys() <= set(choices):
                if choice not in value:
                    raise SettingError(
                        f"a stage says nothing for {choice}; it does for {', '.join(value)}"
                    )
                return value[choice]
        return value

    def _open(self, number: int, levels: Any) -> int:
        known = list(self.network.levels)
        for name in levels:
            if name not in known:
                where = f"level in stages.{number}.levels"
                raise SettingError(unknown(where, name, [*known, *self._choices()]))
        if levels != known[: len(levels)]:
            raise SettingError(
                f"stages.{number}.levels must be the network's, from io upwards without a gap "
                f"({', '.join(known)}), got {', '.join(levels)}"
            )
        return len(levels)

    def _lesson(self, task: Task, number: int, lesson: Any) -> Any:
        if isinstance(lesson, dict):
            name = next(iter(lesson))
            raise SettingError(unknown(f"choice in stages.{number}.lesson", name, self._choices()))
        return task.lesson(lesson)

    def _manner(self, number: int, differing: dict[str, Any]) -> Manner:
        for name in differing:
            if name not in Manner.model_fields:
                known = [*Manner.model_fields, *self._choices()]
                raise SettingError(unknown(f"setting in stages.{number}.caregiver", name, known))
        try:
            return checked(Manner, _laid_over(self.caregiver.model_dump(), differing))
        except SettingError as error:
            raise SettingError(f"stages.{number}.caregiver: {error}") from error

    def _one(self, where: str, value: Any, condition: Condition) -> Any:
        """Return what holds for a condition of a group of settings that may be given by choice."""
        one = self._chosen(value, condition)
        if isinstance(one, dict):
            raise SettingError(unknown(f"choice in {where}", next(iter(one)), self._choices()))
        return one

    def _choosing(self, number: int, value: Any, condition: Condition, many: int) -> Choosing:
        choosing: Choosing = self._one(f"stages.{number}.choosing", value, condition)
        if choosing.shown is not None and choosing.shown > many:
            raise SettingError(
                f"stages.{number}.choosing.shown = {choosing.shown}: the lesson has {many} motions"
            )
        return choosing

    def _openings(self, condition: Condition) -> dict[int, Until]:
        """Return by how many levels are open until when that stays so."""
        known = list(self.network.levels)
        for name in self.opens:
            if name not in known[2:]:
                raise SettingError(unknown("level in opens", name, known[2:]))
        return {
            known.index(name): self._one(f"opens.{name}", value, condition)
            for name, value in self.opens.items()
        }

    def _choices(self) -> list[str]:
        return [choice for choices in self.factors.values() for choice in choices]


def _laid_over(table: dict[str, Any], differing: dict[str, Any]) -> dict[str, Any]:
    """Return a table with what differs, group by group."""
    within = {
        name: _laid_over(table[name], value)
        for name, value in differing.items()
        if isinstance(value, dict) and isinstance(table.get(name), dict)
    }
    return {**table, **differing, **within}
