"""Motions learned by motionese as a policy of LeRobot, which finds it by the package's name."""

from lerobot_policy_motionese.configuration_motionese import MotioneseConfig
from lerobot_policy_motionese.modeling_motionese import MotionesePolicy
from lerobot_policy_motionese.processor_motionese import make_motionese_pre_post_processors

__all__ = ["MotioneseConfig", "MotionesePolicy", "make_motionese_pre_post_processors"]
