"""What LeRobot does to observations and actions on their way; their values stay as they are."""

from typing import Any

from lerobot.processor import (
    AddBatchDimensionProcessorStep,
    DeviceProcessorStep,
    RenameObservationsProcessorStep,
    make_policy_processor_pipelines,
)

from lerobot_policy_motionese.configuration_motionese import MotioneseConfig


def make_motionese_pre_post_processors(
    config: MotioneseConfig, dataset_stats: Any = None
) -> tuple[Any, Any]:
    """Return the pipelines before and behind the policy.

    Nothing is normalised: the model carries its channels' ranges, and takes and gives their units.
    """
    return make_policy_processor_pipelines(
        input_steps=[
            RenameObservationsProcessorStep(rename_map={}),
            AddBatchDimensionProcessorStep(),
            DeviceProcessorStep(device=config.device),
        ],
        output_steps=[DeviceProcessorStep(device="cpu")],
    )
