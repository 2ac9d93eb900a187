"""Everything that may be varied, as types with their allowed ranges."""

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from motionese.body import BodySettings
from motionese.caregiver import PUSHING_BUTTONS, Curriculum, Demonstrating, Motion
from motionese.errors import unknown
from motionese.experiment.conditions import Teaching
from motionese.learning import Recognition, Training
from motionese.network import InitialIO, Level, Scale


class Group(BaseModel):
    """A table of settings: complete, read-only, without unknown names."""

    model_config = ConfigDict(frozen=True, extra="forbid")


class Phases(Group):
    """How many loops, and after which of them phase 2 begins."""

    loops: int = Field(ge=1)
    change_after: int = Field(ge=0)


class LevelSettings(Group):
    """One level of the network."""

    size: int = Field(ge=1)
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
        if next(iter(levels)) != "io":
            raise ValueError(f"all levels must be listed, from io upwards, got {', '.join(levels)}")
        return levels

    def drawn_levels(self) -> tuple[Level, ...]:
        """Return the levels from IO upwards."""
        return tuple(Level(each.size, each.tau, name) for name, each in self.levels.items())


class Babbling(Group):
    """Point-to-point movements of the own arm before loop 1."""

    movements: int = Field(ge=0)
    epochs: int = Field(ge=1)


class Imitation(Group):
    """What an experience holds, and how many of them are learned from."""

    efference_copy: bool
    feedback: float = Field(ge=0, le=1)
    exploration: float = Field(ge=0, le=1)
    memory: int = Field(ge=1)
    rehearsal: bool


class Evaluation(Group):
    """Recognition of new motions, and the map of the slow initial states."""

    recognition: Recognition
    map_points: int = Field(ge=2)
    map_range: float = Field(gt=0, allow_inf_nan=False)


class Settings(Group):
    """All settings of the experiment; `default.toml` explains each where it gives its value."""

    phases: Phases
    network: NetworkSettings
    body: BodySettings
    caregiver: Demonstrating
    teaching: dict[Teaching, Curriculum]
    babbling: Babbling
    imitation: Imitation
    training: Training
    recognition: Recognition
    evaluation: Evaluation

    @model_validator(mode="after")
    def _levels_exist(self) -> "Settings":
        known = list(self.network.levels)
        for group in ("training", "recognition"):
            for field in ("bound", "noise"):
                by_level = getattr(getattr(self, group), field, {})
                for level in by_level if isinstance(by_level, dict) else ():
                    if level not in known:
                        raise ValueError(unknown(f"level in {group}.{field}", level, known))
        return self

    def lessons(self, teaching: Teaching) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
        """Return what is taught in phase 1 and in phase 2."""
        return self.teaching[teaching].lessons(PUSHING_BUTTONS)
