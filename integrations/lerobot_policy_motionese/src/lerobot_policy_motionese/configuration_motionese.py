"""What can be set of the policy, in its folder's config.json or as `--policy.NAME=VALUE`."""

from dataclasses import dataclass, field
from typing import NoReturn

from lerobot.configs import PreTrainedConfig
from lerobot.utils.constants import ACTION, OBS_STATE

WRITTEN = (
    "train one by `motionese train`, write the policy's folder by `lerobot-policy-motionese MODEL "
    "FOLDER`, and give it as --policy.path=FOLDER"
)
TRAINED_ELSEWHERE = f"a motionese policy is not trained by lerobot-train: {WRITTEN}"


@PreTrainedConfig.register_subclass("motionese")
@dataclass
class MotioneseConfig(PreTrainedConfig):
    """How a model is played.

    Attributes:
        device: The network is computed with NumPy, whatever it is.
        state_channels: The model's channel in every column of `observation.state`.
        action_channels: The model's channel in every column of `action`.
        motion: The learned motion that is played; where left out, the task's, if it names one,
            or the one that is recognised.
        share: How much of the network's input is sensed, from 0 (closed loop) to 1.
        watch: Observations that are looked at before a motion is recognised; the robot keeps
            still meanwhile.
        rate_hz: Steps per second [Hz] that the policy is run at, half to twice the model's; the
            model's where left out.
    """

    device: str | None = "cpu"
    state_channels: list[str] = field(default_factory=list)
    action_channels: list[str] = field(default_factory=list)
    motion: str | None = None
    share: float = 0.0
    watch: int = 1
    rate_hz: float | None = None

    @property
    def observation_delta_indices(self) -> None:
        """None: one observation at a time is taken in."""
        return None

    @property
    def action_delta_indices(self) -> None:
        """None: one action at a time is given out."""
        return None

    @property
    def reward_delta_indices(self) -> None:
        """None: rewards are not looked at."""
        return None

    def get_optimizer_preset(self) -> NoReturn:
        """Refuse, which stops lerobot-train before it begins."""
        raise NotImplementedError(TRAINED_ELSEWHERE)

    def get_scheduler_preset(self) -> None:
        """Return no schedule."""

    def validate_features(self) -> None:
        """Refuse another width of state or action than the model's; `ValueError`."""
        for kind, feature, channels in (
            (OBS_STATE, (self.input_features or {}).get(OBS_STATE), self.state_channels),
            (ACTION, (self.output_features or {}).get(ACTION), self.action_channels),
        ):
            if not channels:
                raise ValueError(f"a motionese policy without a model: {WRITTEN}")
            width = 0 if feature is None else feature.shape[0]
            if width != len(channels):
                raise ValueError(
                    f"{kind} has {width} columns, the policy's model {len(channels)} channels for "
                    f"it ({', '.join(channels)}): write its folder by lerobot-policy-motionese "
                    "with the --dataset of this robot"
                )
