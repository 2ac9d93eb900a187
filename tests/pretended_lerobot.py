"""What the plug-in for LeRobot takes from it and from PyTorch, as little as will do."""

import json
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np


class Tensor:
    """An array with the few methods of a tensor."""

    def __init__(self, values, dtype=np.float32):
        self.array = np.array(values, dtype)
        self.shape, self.dtype = self.array.shape, self.array.dtype

    def float(self):
        return Tensor(self.array)

    def detach(self):
        return self

    def cpu(self):
        return self

    def numpy(self):
        return self.array

    def new_tensor(self, values):
        return Tensor(values, self.dtype)

    def unsqueeze(self, axis):
        return Tensor(np.expand_dims(self.array, axis), self.dtype)


class FeatureType(StrEnum):
    STATE = "STATE"
    ACTION = "ACTION"


@dataclass
class PolicyFeature:
    type: FeatureType
    shape: tuple[int, ...]


@dataclass
class PreTrainedConfig:
    input_features: dict[str, Any] | None = field(default_factory=dict)
    output_features: dict[str, Any] | None = field(default_factory=dict)
    device: str | None = None

    @classmethod
    def register_subclass(cls, name):
        def registered(kind):
            kind.type = name
            return kind

        return registered

    def save_pretrained(self, folder):
        content = {"type": self.type, **asdict(self)}
        (Path(folder) / "config.json").write_text(json.dumps(content))


class PreTrainedPolicy:
    def __init__(self, config):
        self.config = config

    @classmethod
    def from_pretrained(cls, folder, *, config, strict=False, **kwargs):
        policy = cls(config, **kwargs)
        file = str(Path(folder) / "model.safetensors")
        return cls._load_as_safetensor(policy, file, config.device, strict)

    def save_pretrained(self, folder):
        Path(folder).mkdir()
        self._save_pretrained(Path(folder))


class Step:
    def __init__(self, **settings):
        self.settings = settings


class AddBatchDimensionProcessorStep(Step):
    pass


class DeviceProcessorStep(Step):
    pass


class RenameObservationsProcessorStep(Step):
    pass


class Pipeline:
    def __init__(self, name, steps):
        self.name, self.steps = name, steps

    def save_pretrained(self, folder):
        content = {"steps": [type(step).__name__ for step in self.steps]}
        (Path(folder) / f"{self.name}.json").write_text(json.dumps(content))


def make_policy_processor_pipelines(input_steps, output_steps):
    return (
        Pipeline("policy_preprocessor", input_steps),
        Pipeline("policy_postprocessor", output_steps),
    )


def modules():
    """The modules by name, for sys.modules."""
    configs = SimpleNamespace(
        FeatureType=FeatureType, PolicyFeature=PolicyFeature, PreTrainedConfig=PreTrainedConfig
    )
    processor = SimpleNamespace(
        AddBatchDimensionProcessorStep=AddBatchDimensionProcessorStep,
        DeviceProcessorStep=DeviceProcessorStep,
        RenameObservationsProcessorStep=RenameObservationsProcessorStep,
        make_policy_processor_pipelines=make_policy_processor_pipelines,
    )
    held = {
        "lerobot": SimpleNamespace(),
        "lerobot.configs": configs,
        "lerobot.policies": SimpleNamespace(PreTrainedPolicy=PreTrainedPolicy),
        "lerobot.processor": processor,
        "lerobot.utils": SimpleNamespace(),
        "lerobot.utils.constants": SimpleNamespace(ACTION="action", OBS_STATE="observation.state"),
    }
    made = {}
    for name, names in held.items():
        made[name] = ModuleType(name)
        vars(made[name]).update(vars(names))
    return made
