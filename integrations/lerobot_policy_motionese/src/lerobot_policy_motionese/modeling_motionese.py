"""The policy: tensors in and out, an imitator for every robot or environment of the batch."""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from lerobot.policies import PreTrainedPolicy
from lerobot.utils.constants import OBS_STATE

from lerobot_policy_motionese.configuration_motionese import (
    TRAINED_ELSEWHERE,
    WRITTEN,
    MotioneseConfig,
)
from lerobot_policy_motionese.imitator import Imitator
from motionese.errors import ControlError
from motionese.runtime import RuntimeModel, load

if TYPE_CHECKING:
    from torch import Tensor

MODEL = "model.safetensors"
"""The model's file in the policy's folder: as `motionese train` wrote it."""


class MotionesePolicy(PreTrainedPolicy):
    """Plays motions that a model of motionese has learned."""

    config_class = MotioneseConfig
    name = "motionese"

    def __init__(self, config: MotioneseConfig, **_: Any) -> None:
        """Be without a model; `from_pretrained` brings it. Statistics of a dataset are not used."""
        super().__init__(config)
        config.validate_features()
        self._file = b""
        self._model: RuntimeModel | None = None
        self._imitators: list[Imitator] = []

    def reset(self) -> None:
        """Begin anew: which motion is played is decided by what is observed next."""
        # One is ready before the robot's first observation: learned motions take a moment.
        self._imitators = [] if self._model is None else [self._imitator()]

    def select_action(self, batch: dict[str, Any], **_: Any) -> "Tensor":
        """Return the action for this step, [B, A], in the units of the recordings.

        Args:
            batch: `observation.state` [B, S] and, if there is one, `task`: a text, or B of them.
        """
        state, told = batch[OBS_STATE].float(), batch.get("task") or ""
        rows = state.detach().cpu().numpy()
        tasks = [told] * len(rows) if isinstance(told, str) else told
        while len(self._imitators) < len(rows):
            self._imitators.append(self._imitator())
        observed = enumerate(zip(rows, tasks, strict=True))
        actions = [self._imitators[i].act(row, task) for i, (row, task) in observed]
        return state.new_tensor(np.array(actions))

    def predict_action_chunk(self, batch: dict[str, Any], **_: Any) -> "Tensor":
        """Return a chunk of one action, [B, 1, A]: the next one depends on what is sensed then."""
        return self.select_action(batch).unsqueeze(1)

    def forward(self, batch: dict[str, Any]) -> NoReturn:
        """Refuse to be trained."""
        raise NotImplementedError(TRAINED_ELSEWHERE)

    def get_optim_params(self) -> NoReturn:
        """Refuse to be trained."""
        raise NotImplementedError(TRAINED_ELSEWHERE)

    def _imitator(self) -> Imitator:
        if self._model is None:
            raise ControlError(f"a motionese policy without a model: {WRITTEN}")
        settings = self.config
        return Imitator(
            self._model,
            settings.state_channels,
            settings.action_channels,
            motion=settings.motion,
            share=settings.share,
            watch=settings.watch,
        )

    @classmethod
    def _load_as_safetensor(
        cls, model: "MotionesePolicy", model_file: str, map_location: str, strict: bool
    ) -> "MotionesePolicy":
        """Read the model's file by ourselves: what it tells beside its tensors is needed."""
        learned, rate_hz = load(model_file), model.config.rate_hz
        model._file = Path(model_file).read_bytes()
        model._model = learned if rate_hz is None else learned.with_rate(rate_hz)
        model.reset()
        return model

    def _save_pretrained(self, save_directory: Path, state_dict: Any = None) -> None:
        """Write the settings, and the model as it was read."""
        self.config.save_pretrained(save_directory)
        (save_directory / MODEL).write_bytes(self._file)
