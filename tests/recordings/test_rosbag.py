"""Bags of ROS 1 and 2: joints, poses, and whatever else holds numbers become channels."""

import shutil

import bags
import numpy as np
import pytest
from bags import KINDS, joints, made, write
from hypothesis import given, settings
from hypothesis import strategies as st

from motionese import Motions
from motionese.errors import MotioneseError, RecordingError, SettingError
from motionese.recordings import read, survey

bags.define(
    Grip="std_msgs/Header header\nfloat32 width\nbool closed\nstring state\nfloat64[2] force",
)
JOINTS = "sensor_msgs/JointState"


def states(count=12, rate=20.0, names=("shoulder", "elbow"), topic="/joint_states", **more):
    """JointStates with stamps, recorded a little later."""
    for i in range(count):
        positions = {name: np.sin(0.2 * i + k) for k, name in enumerate(names)}
        yield (
            topic,
            JOINTS,
            i / rate + 0.002 * (i % 3),
            lambda v, p=positions, t=i / rate: joints(v, p, t, **more),
        )


@pytest.mark.parametrize("kind", KINDS)
def test_joints_are_read_from_every_kind_of_bag(tmp_path, kind):
    path = write(tmp_path / "wave", kind, states(velocity=[1, 2]))
    found = read(path)

    names = tuple(
        f"/joint_states.{what}.{j}"
        for what in ("position", "velocity")
        for j in ("shoulder", "elbow")
    )
    assert found.channels == names
    assert (found.usual, found.units, found.findings) == (names[:2], ("",) * 4, ())
    (episode,) = found.episodes
    assert (episode.name, found.rate_hz) == ("wave", 20.0)
    np.testing.assert_allclose(episode.times, np.arange(12) / 20, atol=1e-9)
    np.testing.assert_array_equal(episode.values[:, 0], np.sin(0.2 * np.arange(12)))
    assert episode.observed.all()
    if path.is_dir():
        (file,) = (p for p in path.iterdir() if p.name != "metadata.yaml")
        np.testing.assert_array_equal(read(file).episodes[0].values, episode.values)
