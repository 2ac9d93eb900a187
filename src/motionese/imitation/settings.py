"""What may be varied about an imitation, as types with their allowed ranges."""

from collections.abc import Iterator
from typing import Annotated, Any, Literal, TypeVar, get_args

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator, model_validator

from motionese.body import BodySettings
from motionese.caregiver import Manner
from motionese.channels import Channels
from motionese.errors import SettingError, unknown
from motionese.faults import first_fault, refusal
from motionese.imitation.repertoire import Grouping, Sharing
from motionese.learning import Recognition, Training
from motionese.network import InitialIO, Level, Scale
from motionese.task import Task, task_named

Table = dict[str, Any]


class Group(BaseModel):
    """A table of settings: complete, read-only, without unknown names."""

    model_config = ConfigDict(frozen=True, extra="forbid")


M = TypeVar("M", bound=BaseModel)


class TaskSettings(Group):
    """Which task, and where its places are that differ from the task's own [m, world]."""

    name: str
    places: dict[str, tuple[float, float, float]] = {}

    def task(self) -> Task:
        """Return the task; `TaskError` for one, or a place, that does not exist."""
        return task_named(self.name).with_places(self.places)


class LevelSettings(Group):
    """One level of the network; IO has one unit per channel, and may leave its size out."""

    size: int | None = Field(default=None, ge=1)
    tau: float = Field(ge=1, allow_inf_nan=False)


class NetworkSettings(Group):
    """The network as it is drawn, and how a further level is opened."""

    gain: float = Field(ge=0, allow_inf_nan=False)
    scale: Scale
    learned_bias: bool
    initial_io: InitialIO
    influence: float = Field(ge=0, allow_inf_nan=False)
    levels: dict[str, LevelSettings] = Field(min_length=2)

    @field_validator("levels")
    @classmethod
    def _io_comes_first(cls, levels: dict[str, LevelSettings]) -> dict[str, LevelSettings]:
        names = list(levels)
        if names[0] != "io":
            raise ValueError(f"all levels must be listed, from io upwards, got {', '.join(names)}")
        for name in names[1:]:
            if levels[name].size is None:
                raise ValueError(f"level {name} needs a size")
        return levels

    def drawn_levels(self, channels: Channels) -> tuple[Level, ...]:
        """Return the levels from IO upwards, over a body's channels."""
        return tuple(
            Level(each.size or len(channels), each.tau, name) for name, each in self.levels.items()
        )


class Babbling(Group):
    """Point-to-point movements of the own arm before loop 1."""

    movements: int = Field(ge=0)
    epochs: int = Field(ge=1)


class Acting(Group):
    """How the robot acts, what an experience holds, and how many of them are learned from."""

    efference_copy: bool
    feedback: float = Field(ge=0, le=1)
    exploration: float = Field(ge=0, le=1)
    memory: int = Field(ge=1)
    rehearsal: bool


class Attention(Group):
    """What weighs more in equation (3), see `imitation.attention`.

    Attributes:
        to: Rows in which the seen hand rests, or those in which it moves.
        strength: s; with 0 all rows weigh alike.
    """

    to: Literal["rests", "movement"] = "rests"
    strength: float = Field(default=0.0, ge=0, le=100)


class StagedTraining(Training):  # type: ignore[metaclass]
    """Training all through a development.

    Attributes:
        attention: What weighs more.
        shared: By level, which motions share its initial states; nobody where it is not named.
        grouping: How it is known which element of a repertoire a motion begins with; its first
            primitive is always known by name.
        batch: 0: what is remembered is learned all at once. No setting of an experiment.
    """

    batch: Literal[0] = Field(default=0, exclude=True)
    attention: Attention = Attention()
    shared: dict[str, Sharing] = Field(default_factory=dict)
    grouping: Grouping = "labels"


class Online(Group):
    """Recognition while a demonstration is shown, and the lags at which the robot follows it."""

    window: int = Field(ge=2)
    steps: int = Field(ge=0)
    lags: tuple[Annotated[int, Field(ge=0)], ...]
    switches: int = Field(ge=0)


class Roles(Group):
    """What role each level plays: how it is looked at.

    Attributes:
        demonstrations: Of every motion of the last lesson, afresh.
        adam: Iterations of Adam, by which they are recognised as controls; 0 for none.
        pace: Of the fastest context level in the second control, see `Recognition.slower`.
    """

    demonstrations: int = Field(ge=1)
    adam: int = Field(ge=0)
    pace: float = Field(gt=0, le=1)


class Evaluation(Group):
    """Recognition of new motions and of shown ones, and the map of the slow initial states.

    Attributes:
        motionese: Whether what is shown has what is left of motionese after the last loop, or is
            as to an adult.
    """

    recognition: Recognition
    repertoire: Recognition
    online: Online
    roles: Roles
    map_points: int = Field(ge=2)
    map_range: float = Field(gt=0, allow_inf_nan=False)
    motionese: bool = False


class Settings(Group):
    """All settings of a robot that imitates; presets explain each where they give its value."""

    task: TaskSettings
    body: BodySettings
    network: NetworkSettings
    caregiver: Manner
    babbling: Babbling
    imitation: Acting
    training: StagedTraining
    recognition: Recognition
    evaluation: Evaluation

    @model_validator(mode="after")
    def _levels_exist(self) -> "Settings":
        known = list(self.network.levels)
        for group in ("training", "recognition"):
            for field in ("bound", "noise", "slower"):
                by_level = getattr(getattr(self, group), field, {})
                for level in by_level if isinstance(by_level, dict) else ():
                    if level not in known:
                        raise ValueError(unknown(f"level in {group}.{field}", level, known))
        below = known[1:-1]
        for level in self.training.shared:
            if level == known[-1]:
                raise ValueError(
                    f"training.shared.{level}: {level} is the top level, whose initial states "
                    f"belong to single motions; shared can be those of {', '.join(below) or 'none'}"
                )
            if not below:
                raise ValueError(
                    f"training.shared.{level}: a network of one context level has none to share"
                )
            if level not in below:
                raise ValueError(unknown("level in training.shared", level, below))
        return self

    @model_validator(mode="after")
    def _rest_can_be_told_from_noise(self) -> "Settings":
        if self.training.attention.strength and not self.body.pixel_noise:
            raise ValueError(
                "training.attention.strength above 0 needs body.pixel_noise above 0: what rests is "
                "told by the speed that this noise alone makes"
            )
        return self


def checked(model: type[M], table: Table) -> M:
    """Return the settings of a complete table; `SettingError` names the first that is wrong."""
    try:
        return model.model_validate(table)
    except ValidationError as error:
        fault = first_fault(error, table)
        name, here = fault.name, fault.value
        if fault.kind == "union_tag_invalid":
            told = error.errors()[0]["ctx"]
            raise SettingError(
                f"setting {name}.name = '{told['tag']}': input should be {told['expected_tags']}"
            ) from error
        if fault.kind == "missing":
            few = f" = {here}: it has too few entries" if isinstance(here, list) else " is missing"
            raise SettingError(f"setting {name}{few}") from error
        known = [n for n in setting_names(model, fault.path[:-1]) if n != name]
        raise refusal(fault, known) from error


def setting_names(model: type[BaseModel], path: list[str]) -> list[str]:
    """Return the full names of the settings in a group; none where its names are not fixed."""
    groups = [model]
    for part in path:
        if part.isdecimal():  # a place in a list, whose type its field has told
            continue
        fields = [g.model_fields[part].annotation for g in groups if part in g.model_fields]
        groups = [g for annotation in fields for g in _groups_in(annotation)]
    names = dict.fromkeys(name for group in groups for name in group.model_fields)
    return [".".join([*path, name]) for name in names]


def _groups_in(annotation: Any) -> Iterator[type[BaseModel]]:
    """Yield the groups of settings that a type is, or is a union or a container of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield annotation
    for part in get_args(annotation):
        yield from _groups_in(part)
