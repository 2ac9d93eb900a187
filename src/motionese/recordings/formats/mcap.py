"""MCAP with messages of JSON or ROS: one file an episode, a folder of files a recording.

It is read as bags of ROS are. Messages in other encodings are left out. A topic that we wrote
carries in its MCAP channel's metadata what JSON cannot say (names, units, rate, the episode's
name); its channels keep their plain names.
"""

from motionese.recordings.formats.mcap_writing import write
from motionese.recordings.formats.rosbag import read

__all__ = ["read", "write"]
