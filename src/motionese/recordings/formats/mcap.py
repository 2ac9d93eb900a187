"""MCAP with messages of JSON or ROS: one file an episode, a folder of files a recording.

Channels are named TOPIC.a.b by where the number stands in the message. Messages in other encodings
are left out. A topic that we wrote carries in its MCAP channel's metadata what JSON cannot say
(names, units, rate, the episode's name); its channels keep their plain names.
"""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from motionese.errors import RecordingError
from motionese.recordings.formats.bag_files import messages
from motionese.recordings.formats.conventions import natural
from motionese.recordings.formats.log_recording import recording_of
from motionese.recordings.formats.mcap_writing import write
from motionese.recordings.formats.takes import Cuts
from motionese.recordings.formats.topic_choice import TopicChoice
from motionese.recordings.recording import Recording

__all__ = ["read", "write"]


def read(
    path: Path,
    topics: Sequence[str] | None = None,
    pause: float | None = None,
    marker: str | None = None,
) -> Recording:
    """Read one .mcap file as one episode, or a folder of them, in natural order.

    Rows and rate are as `recording_of` tells. All channels are usual but headers, stamps, sequence
    numbers, covariances, and what is derived (velocities, efforts of joints, in ROS).

    Args:
        path: The file or folder.
        topics: Patterns of the topics to read, or one; all that tell a motion where left out.
        pause: A silence longer than this [s] cuts an episode in two.
        marker: The topic that marks takes, as `Mark` tells.
    """
    cuts, choice = Cuts(pause, marker), TopicChoice(topics, marker)
    files = [path] if path.is_file() else sorted(path.glob("*.mcap"), key=lambda f: natural(f.name))
    if not files:
        raise RecordingError(f"{path}: holds no .mcap files")
    logs = [choice.read(file, file.stem, partial(messages, file)) for file in files]
    choice.check(path, logs)
    return recording_of(path, logs, cuts)
