"""The folder that `--policy.path` takes, written from a trained model."""

from pathlib import Path
from shutil import copyfile

from lerobot.configs import FeatureType, PolicyFeature
from lerobot.utils.constants import ACTION, OBS_STATE

from lerobot_policy_motionese.configuration_motionese import MotioneseConfig
from lerobot_policy_motionese.imitator import Imitator, is_command, sensed_as
from lerobot_policy_motionese.modeling_motionese import MODEL
from lerobot_policy_motionese.processor_motionese import make_motionese_pre_post_processors
from motionese.errors import ChannelError
from motionese.recordings.formats.lerobot_features import features_of, read_info
from motionese.recordings.formats.writing import new_folder
from motionese.runtime import RuntimeModel, load


def write(model: Path, folder: Path, dataset: Path | None = None) -> MotioneseConfig:
    """Write the folder of a policy, whole or not at all; returns its settings.

    Args:
        model: What `motionese train` wrote.
        folder: A new folder.
        dataset: A LeRobotDataset of the robot, for the columns of its state and action. Where
            left out, the state's are the model's channels in their order, but for those of the
            action (`action.…`), which are the action's; where there are none, the action's are
            the state's.

    Raises:
        MotioneseError: A model or dataset that cannot be read, an action without its channel, a
            folder that exists.
    """
    learned = load(model)
    state, action = _plain(learned) if dataset is None else _columns(learned, dataset)
    Imitator(learned, state, action)
    config = MotioneseConfig(
        input_features={OBS_STATE: PolicyFeature(FeatureType.STATE, (len(state),))},
        output_features={ACTION: PolicyFeature(FeatureType.ACTION, (len(action),))},
        state_channels=list(state),
        action_channels=list(action),
    )
    with new_folder(folder) as whole:
        config.save_pretrained(whole)
        copyfile(model, whole / MODEL)
        for pipeline in make_motionese_pre_post_processors(config):
            pipeline.save_pretrained(whole)
    return config


def _plain(model: RuntimeModel) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the channels in the columns of state and action, as the model's names tell."""
    beside = tuple(name for name in model.channels if not name.startswith("observation."))
    state = tuple(name for name in beside if not is_command(name))
    return state, tuple(name for name in beside if is_command(name)) or state


def _columns(model: RuntimeModel, dataset: Path) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the channels in the columns of state and action, as the dataset's features tell."""
    features = {feature.key: feature.channels for feature in features_of(read_info(dataset))}
    if not set(state := features.get(OBS_STATE, ())) & set(model.channels):
        raise ChannelError(
            f"{dataset}: no column of its {OBS_STATE} ({', '.join(state)}) is a channel of the "
            f"model ({', '.join(model.channels)}): give the dataset that it was trained on"
        )
    return state, tuple(_commanded(model, dataset, name) for name in features.get(ACTION, state))


def _commanded(model: RuntimeModel, dataset: Path, name: str) -> str:
    """Return the model's channel for a column of the action: its own, or that of the state."""
    for channel in (name, sensed_as(name)):
        if channel in model.channels:
            return channel
    raise ChannelError(
        f"{dataset}: the model has no channel for the action's column '{sensed_as(name)}', only "
        f"{', '.join(model.channels)}: train it on all columns of {OBS_STATE}"
    )
