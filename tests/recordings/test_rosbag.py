"""Bags of ROS 1 and 2: joints, poses, and whatever else holds numbers become channels."""

import itertools
import re
import shutil
import sqlite3
import subprocess
import sys
from pathlib import Path

import bags
import mcap.writer
import numpy as np
import pytest
from bags import KINDS, joints, made, write
from hypothesis import given, settings
from hypothesis import strategies as st
from typed import refused, typed

from motionese import Motions
from motionese.errors import MissingPackageError, MotioneseError, RecordingError, SettingError
from motionese.recordings import read, survey
from motionese.recordings import write as write_recording

bags.define(
    Grip="std_msgs/Header header\nfloat32 width\nbool closed\nstring state\nfloat64[2] force",
    Mixed="float64 x\nfloat32[] cloud",
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


def one(tmp_path, messages, kind="db3", **options):
    """Read a bag of these messages as a recording of one episode."""
    found = read(write(tmp_path / "bag", kind, messages), **options)
    (episode,) = found.episodes
    return found, {
        name: (episode.values[:, i], episode.observed[:, i])
        for i, name in enumerate(found.channels)
    }


# --- what becomes a channel ---


def test_joints_in_changing_order_and_with_some_missing_go_by_their_names(tmp_path):
    names = [("a", "b"), ("b", "a"), ("c", "a"), ()]
    messages = [
        ("/j", JOINTS, i / 10, lambda v, n=n, i=i: joints(v, {k: i + ord(k) for k in n}, i / 10))
        for i, n in enumerate(names)
    ]
    found, by = one(tmp_path, messages)

    assert found.channels == ("/j.position.a", "/j.position.b", "/j.position.c")
    values, seen = by["/j.position.a"]
    assert (values[seen].tolist(), seen.tolist()) == ([97, 98, 99], [True, True, True])
    values, seen = by["/j.position.b"]
    assert (values[seen].tolist(), seen.tolist()) == ([98, 99], [True, True, False])
    assert by["/j.position.c"][1].tolist() == [False, False, True]


def test_two_that_speak_on_one_topic_are_put_side_by_side(tmp_path):
    arm = [("/j", JOINTS, i / 50, lambda v, t=i / 50: joints(v, {"a": t}, t)) for i in range(50)]
    # The gripper's stamps are a little older than those of the arm that was recorded before.
    grip = [
        ("/j", JOINTS, i / 10 + 0.001, lambda v, t=i / 10: joints(v, {"g": t}, t - 0.003))
        for i in range(10)
    ]
    found, by = one(tmp_path, sorted(arm + grip, key=lambda m: m[2]))

    assert (found.rate_hz, found.findings) == (50.0, ())
    assert (by["/j.position.a"][1].sum(), by["/j.position.g"][1].sum()) == (50, 10)


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
def test_fields_are_named_by_where_they_stand_with_the_units_of_their_types(tmp_path, kind):
    messages = [
        ("/hand", "geometry_msgs/PoseStamped", 0, {"pose__position__x": 0.5}),
        ("/base", "geometry_msgs/Twist", 0, {"linear__x": 2.0, "angular__z": 3.0}),
        ("/push", "geometry_msgs/WrenchStamped", 0, {"wrench__torque__y": 4.0}),
        ("/odom", "nav_msgs/Odometry", 0, {"pose__pose__position__z": 5.0}),
        ("/turn", "geometry_msgs/Quaternion", 0, {"w": 1.0}),
        ("/at", "geometry_msgs/TransformStamped", 0, {"transform__translation__x": 6.0}),
        ("/go", "std_msgs/Float64", 0, {"data": 7.0}),
        ("/shut", "std_msgs/Bool", 0, {"data": True}),
        ("/all", "std_msgs/Float32MultiArray", 0, {"data": [8.0, 9.0]}),
        ("/codes", "std_msgs/UInt8MultiArray", 0, {"data": [3]}),
        ("/grip", "my_msgs/Grip", 0, {"width": 0.5, "force": [1, 2], "state": "on"}),
    ]
    found, by = one(tmp_path, messages, kind)

    told = dict(zip(found.channels, found.units, strict=True))
    for name, unit, value in (
        ("/hand.pose.position.x", "m", 0.5),
        ("/hand.pose.orientation.w", "", 0),
        ("/base.linear.x", "m/s", 2),
        ("/base.angular.z", "rad/s", 3),
        ("/push.wrench.force.x", "N", 0),
        ("/push.wrench.torque.y", "Nm", 4),
        ("/odom.pose.pose.position.z", "m", 5),
        ("/odom.twist.twist.angular.x", "rad/s", 0),
        ("/turn.w", "", 1),
        ("/at.transform.translation.x", "m", 6),
        ("/go.data", "", 7),
        ("/shut.data", "", 1),
        ("/all.data[1]", "", 9),
        ("/codes.data[0]", "", 3),
        ("/grip.width", "", 0.5),
        ("/grip.closed", "", 0),
        ("/grip.force[1]", "", 2),
    ):
        assert (told[name], by[name][0].tolist()) == (unit, [value])
    assert "/odom.pose.covariance[0]" in set(found.channels) - set(found.usual)
    assert not [name for name in found.channels if "header" in name or "layout" in name]
    assert found.findings == ()


def point(version, seconds, *positions):
    after = made(
        version, "builtin_interfaces/Duration", sec=int(seconds), nanosec=round(seconds % 1 * 1e9)
    )
    return made(
        version, "trajectory_msgs/JointTrajectoryPoint", positions=positions, time_from_start=after
    )


def trajectory(*points):
    return lambda v: made(
        v,
        "trajectory_msgs/JointTrajectory",
        joint_names=["a", "b"],
        points=[point(v, *p) for p in points],
    )


def test_one_message_with_a_whole_trajectory_is_laid_out_over_its_times(tmp_path):
    path = trajectory((0.5, 1, 2), (1.0, 3, 4), (1.5, 5, 6))
    found, by = one(tmp_path, [("/plan", "trajectory_msgs/JointTrajectory", 0, path)], "ros1")

    assert found.channels == ("/plan.positions.a", "/plan.positions.b")
    assert by["/plan.positions.b"][0].tolist() == [2, 4, 6]
    assert (found.rate_hz, found.findings) == (2.0, ())
    np.testing.assert_allclose(found.episodes[0].times, [0, 0.5, 1])


def test_of_many_trajectories_the_first_points_are_taken_and_this_is_told(tmp_path):
    paths = [trajectory((0.1, i, 2), (0.2, 3, 4)) for i in range(3)] + [trajectory()]
    messages = [("/plan", "trajectory_msgs/JointTrajectory", i, p) for i, p in enumerate(paths)]
    found, by = one(tmp_path, messages)

    assert by["/plan.positions.a"][0].tolist() == [0, 1, 2]
    assert "the first point alone is taken (3 times)" in found.findings[0].sentence


def test_pictures_and_logs_are_left_out_and_told_in_one(tmp_path):
    aside = [
        ("/eye", "sensor_msgs/Image", 0, {"data": [1, 2]}),
        ("/eye2", "sensor_msgs/Image", 0, {"data": [1, 2]}),
        ("/cloud", "sensor_msgs/PointCloud2", 0, {}),
        ("/note", "std_msgs/String", 0, {"data": "go"}),
        ("/diagnostics", "diagnostic_msgs/DiagnosticArray", 0, {}),
    ]
    path = write(tmp_path / "bag", "mcap", [*states(), *aside])
    found = read(path)

    assert len(found.channels) == 2
    (finding,) = found.findings
    assert "/eye, /eye2 (sensor_msgs/msg/Image); /cloud (sensor_msgs" in finding.sentence
    assert "/note (std_msgs/msg/String)" in finding.sentence
    assert read(path, topics=["/joint*"]).findings == ()
    with pytest.raises(RecordingError, match=r"no numbers .* topics: .*/eye \(sensor_msgs"):
        read(path, topics=["/eye"])


def test_transforms_are_read_where_they_are_asked_for_by_their_frames(tmp_path):
    def transforms(*frames):
        return lambda v: made(
            v,
            "tf2_msgs/TFMessage",
            transforms=[
                made(
                    v,
                    "geometry_msgs/TransformStamped",
                    child_frame_id=f,
                    transform__translation__x=float(i),
                )
                for i, f in enumerate(frames)
            ],
        )

    messages = [
        ("/tf", "tf2_msgs/TFMessage", 0, transforms("hand", "eye")),
        ("/tf", "tf2_msgs/TFMessage", 1, transforms("eye")),
    ]
    path = write(tmp_path / "bag", "db3", [*states(), *messages])

    assert "/tf (tf2_msgs/msg/TFMessage)" in read(path).findings[0].sentence
    found = read(path, topics=["tf"])
    x = found.channels.index("/tf.transforms.eye.transform.translation.x")
    assert (found.units[x], found.episodes[0].values[:, x].tolist()) == ("m", [1, 0])


def test_lists_that_are_too_wide_are_left_out_and_told(tmp_path):
    wide = [("/all", "std_msgs/Int32MultiArray", 0, {"data": range(600)})]
    found, _ = one(tmp_path, [*states(), *wide])
    assert "are left out: /all (std_msgs/msg/Int32MultiArray)" in found.findings[0].sentence

    shutil.rmtree(tmp_path / "bag")
    messages = [("/mixed", "my_msgs/Mixed", i, {"x": i, "cloud": range(600 + i)}) for i in range(3)]
    found, by = one(tmp_path, messages)
    assert by["/mixed.x"][0].tolist() == [0, 1, 2]
    assert found.findings[0].sentence.endswith("of more than 512 numbers are left out: .cloud")


# --- types ---


def test_a_line_break_in_a_name_is_none_in_the_sentence(tmp_path):
    path = write(tmp_path / "bag", "db3", [("/grip\nper", "my_msgs/Grip", 0, {})])
    forget(path)
    with pytest.raises(RecordingError) as refusal:
        read(path)

    assert "topic /grip per is of type" in str(refusal.value)


def test_a_type_that_is_defined_nowhere_is_named(tmp_path):
    messages = [("/grip", "my_msgs/Grip", 0, {}), ("/grip", "my_msgs/Grip", 1, {})]
    path = write(tmp_path / "bag", "db3", messages)
    forget(path)
    with pytest.raises(RecordingError, match=r"topic /grip is of type my_msgs/msg/Grip, which"):
        read(path)
    shutil.rmtree(path)
    path = write(tmp_path / "bag", "db3", [*messages, *states()])
    forget(path)

    found = read(path)
    assert len(found.channels) == 2  # that of a JointState is standard
    assert "/grip (my_msgs/msg/Grip, defined nowhere)" in found.findings[0].sentence


def forget(path):
    """Take the definitions of types out of a bag, as older recorders left them out."""
    (file,) = path.glob("*.db3")
    with sqlite3.connect(file) as base:
        base.execute("UPDATE message_definitions SET encoded_message_definition = ''")
    base.close()


def test_ros_1_in_mcap_is_read(tmp_path):
    messages = [joints(1, {"a": i}, i / 10) for i in range(5)]
    definition, _ = bags.STORES[1].generate_msgdef("sensor_msgs/msg/JointState")
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = mcap.writer.Writer(file)
        writer.start("ros1")
        schema = writer.register_schema(JOINTS, "ros1msg", definition.encode())
        topic = writer.register_channel("/j", "ros1", schema)
        for message in messages:
            data = bytes(bags.STORES[1].serialize_ros1(message, "sensor_msgs/msg/JointState"))
            writer.add_message(topic, bags.START, data, bags.START)
        writer.finish()
    found = read(tmp_path / "a.mcap")

    assert (found.channels, found.rate_hz) == (("/j.position.a",), 10.0)


# --- time ---


@pytest.mark.parametrize("kind", ["ros1", "db3"])
def test_without_stamps_the_times_of_recording_are_taken(tmp_path, kind):
    messages = [("/j", JOINTS, i / 8, lambda v, i=i: joints(v, {"a": i})) for i in range(9)]
    found, _ = one(tmp_path, messages, kind)

    np.testing.assert_allclose(found.episodes[0].times, np.arange(9) / 8)
    assert found.findings == ()


def test_stamps_that_do_not_rise_are_not_taken_and_this_is_told(tmp_path):
    stamps = [0, 0.1, 0.1, 0.3]
    messages = [
        ("/j", JOINTS, i / 10, lambda v, t=t: joints(v, {"a": 0}, t)) for i, t in enumerate(stamps)
    ]
    found, _ = one(tmp_path, messages)

    np.testing.assert_allclose(found.episodes[0].times, [0, 0.1, 0.2, 0.3])
    assert "topic /j: the stamps in its headers are not all there" in found.findings[0].sentence


def test_stamps_of_another_clock_are_taken_only_if_all_topics_have_them(tmp_path):
    simulated = [
        ("/j", JOINTS, i / 10, lambda v, i=i: joints(v, {"a": i}, i / 20 - 1e9)) for i in range(9)
    ]
    found, _ = one(tmp_path, simulated)
    assert found.rate_hz == 20.0
    assert "of /j are not of the clock by which" in found.findings[0].sentence
    assert found.findings[0].sentence.endswith("the stamps are taken")

    shutil.rmtree(tmp_path / "bag")
    bare = [("/go", "std_msgs/Float64", i / 10, {"data": i}) for i in range(9)]
    found, _ = one(tmp_path, sorted([*simulated, *bare], key=lambda m: m[2]))
    assert (found.rate_hz, len(found.episodes[0].values)) == (10.0, 9)
    assert found.findings[0].sentence.endswith("the times at which they were recorded are taken")


def test_messages_at_one_time_are_told(tmp_path):
    messages = [("/go", "std_msgs/Float64", t, {"data": i}) for i, t in enumerate([0, 1, 1, 2])]
    found, by = one(tmp_path, messages)

    assert by["/go.data"][0].tolist() == [0, 2, 3]
    assert "1 messages are at the time of another of their topic" in found.findings[0].sentence


@pytest.mark.parametrize(("slow", "fast"), [(10, 50), (100, 1000)])
@pytest.mark.parametrize("jitter", [0.0, 0.1])
def test_a_slower_topic_is_filled_in_on_one_grid(tmp_path, slow, fast, jitter):
    rng = np.random.default_rng(0)
    times = {
        rate: (np.arange(200 * rate // fast) + jitter * rng.random(200 * rate // fast)) / rate
        for rate in (slow, fast)
    }
    messages = [
        (f"/at_{rate}", "std_msgs/Float64", t, {"data": 3 * round(t, 9)})
        for rate, each in times.items()
        for t in each
    ]
    path = write(tmp_path / "bag", "db3", sorted(messages, key=lambda m: m[2]))
    motions = Motions.read(path)

    assert motions.rate_hz == pytest.approx(fast, rel=0.01)
    # Before the slower topic's first message and after its last nothing is known of it.
    start = max(each[0] for each in times.values())
    first = min(each[0] for each in times.values())
    at = first + np.arange(len(motions.values[0])) / motions.rate_hz
    inside = (at >= start) & (at <= times[slow][-1])
    assert motions.observed[0][inside].all()
    np.testing.assert_allclose(motions.values[0][inside], 3 * np.stack([at, at], 1)[inside])


# --- several bags, takes ---


def test_a_folder_of_bags_is_read_in_natural_order(tmp_path):
    for i, kind in ((10, "db3"), (9, "mcap"), (1, "ros1")):
        write(tmp_path / f"take_{i}", kind, states(count=i + 2))
    (tmp_path / "notes.txt").write_text("hello")
    found = read(tmp_path)
    assert [e.name for e in found.episodes] == ["take_1", "take_9", "take_10"]
    assert [len(e.values) for e in found.episodes] == [3, 11, 12]

    (tmp_path / "take_11.bag.active").write_bytes(b"")
    assert "take_11.bag.active: it is left out, as its" in read(tmp_path).findings[0].sentence


def test_a_bag_in_several_files_is_one_episode(tmp_path):
    messages = list(states(count=20))
    path = write(tmp_path / "whole", "mcap", messages[:11])
    other = write(tmp_path / "more", "mcap", messages[11:])
    shutil.copy(other / "more.mcap", path / "whole_1.mcap")
    told = path / "metadata.yaml"
    line = re.compile(r"^( *- )whole\.mcap\n", re.MULTILINE)
    told.write_text(line.sub(r"\g<0>\1whole_1.mcap\n", told.read_text(), count=1))

    (episode,) = read(path).episodes
    assert (episode.name, len(episode.values)) == ("whole", 20)
    (path / "whole_1.mcap").unlink()
    with pytest.raises(RecordingError, match=r"whole_1\.mcap is missing, of which metadata"):
        read(path)
    told.write_text("rosbag2_bagfile_information: 3")
    with pytest.raises(RecordingError, match=r"metadata\.yaml: not what `ros2 bag record` writes"):
        read(path)


def test_a_folder_without_metadata_inside_another_is_one_bag_of_all_its_files(tmp_path):
    for i, part in enumerate((list(states(count=20))[:11], list(states(count=20))[11:])):
        path = write(tmp_path / f"part_{i}", "mcap", part)
        (tmp_path / "all" / "take").mkdir(parents=True, exist_ok=True)
        shutil.copy(path / f"part_{i}.mcap", tmp_path / "all" / "take" / f"take_{i}.mcap")

    assert [(e.name, len(e.values)) for e in read(tmp_path / "all").episodes] == [("take", 20)]
    assert [len(e.values) for e in read(tmp_path / "all" / "take").episodes] == [11, 9]


def test_metadata_beside_tables_make_no_bag_of_them(tmp_path):
    (tmp_path / "metadata.yaml").write_text("by: me")
    (tmp_path / "a.csv").write_text("time,x\n0,1\n1,2\n")

    assert read(tmp_path).channels == ("x",)


def test_topics_are_chosen_by_patterns_and_what_is_there_is_told(tmp_path):
    bare = [("/go", "std_msgs/Float64", 0.3, {"data": 1})]
    path = write(tmp_path / "bag", "db3", [*states(), *bare])

    assert read(path, topics=["g?"]).channels == ("/go.data",)
    assert len(read(path, topics=["/j*", "/go"]).channels) == 3
    with pytest.raises(SettingError, match=r"'/joint';.* there are: /joint_states, /go$"):
        read(path, topics=["/go", "/joint"])
    with pytest.raises(SettingError, match="unknown topic '/jnt'; did you mean '/joint_states'"):
        read(path, topics=["/jnt"])
    with pytest.raises(SettingError, match="topics is the topics that are read, of mcap, rosbag"):
        (tmp_path / "a.csv").write_text("a\n1\n")
        read(tmp_path / "a.csv", topics=["a"])


def test_a_silence_cuts_a_bag_into_takes(tmp_path):
    messages = [m for i, m in enumerate(states(count=40)) if i // 10 % 2 == 0]
    path = write(tmp_path / "bag", "ros1", messages)

    found = read(path, pause=0.3)
    assert [(e.name, len(e.values)) for e in found.episodes] == [("bag_0", 10), ("bag_1", 10)]
    np.testing.assert_allclose(found.episodes[1].times, np.arange(10) / 20, atol=1e-9)
    assert [e.name for e in read(path, pause=0.6).episodes] == ["bag"]
    with pytest.raises(SettingError, match=r"--pause is a time > 0 \[s\], got 0"):
        read(path, pause=0)


@pytest.mark.parametrize(
    ("kind", "said", "takes", "outside"),
    [
        ("std_msgs/Empty", [(0.24, {}), (0.49, {})], {"bag_0": 5, "bag_1": 10}, 5),
        ("std_msgs/Bool", [(0.1, False), (0.24, True), (0.49, False)], {"bag": 5}, 15),
        ("std_msgs/String", [(0, "reach"), (0.49, "push")], {"reach": 10, "push": 10}, 0),
        ("std_msgs/String", [(0, "a"), (0.24, "b"), (0.49, "a")], {"a_0": 5, "b": 5, "a_1": 10}, 0),
    ],
)
def test_a_topic_marks_the_takes(tmp_path, kind, said, takes, outside):
    marks = [("/take", kind, t, s if s == {} else {"data": s}) for t, s in said]
    messages = sorted([*marks, *states(count=20)], key=lambda m: m[2])
    found = read(write(tmp_path / "bag", "mcap", messages), marker="/take")

    assert {e.name: len(e.values) for e in found.episodes} == takes
    assert len(found.channels) == 2
    told = [f.sentence for f in found.findings]
    assert told == [] if not outside else f"{outside} of 20 rows are in no take" in told[0]


def test_a_marker_that_is_not_there_is_refused(tmp_path):
    path = write(tmp_path / "bag", "db3", states())
    with pytest.raises(SettingError, match=r"unknown topic '/take'.* there are: /joint_states"):
        read(path, marker="/take")


def test_topics_silences_and_marks_are_options_of_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    marks = [("/take", "std_msgs/String", 0.7, {"data": "push"})]
    messages = sorted([*marks, *states(count=40)], key=lambda m: m[2])
    write("bag", "mcap", [m for m in messages if not 0.4 < m[2] < 0.6])

    for options, told in (
        (("--topic", "/joint*", "/take", "--pause", "0.1"), "2 motions of 8 to 28 rows at 20 Hz"),
        (("--marker", "/take"), "1 motion of 26 rows at 20 Hz, 2 channels"),
    ):
        status, output, _ = typed("import", "bag", "--out", "x.npz", *options)
        assert (status, told in output) == (0, True), output
    assert "unknown topic '/jnt'; did you mean" in refused("inspect", "bag", "--topic", "/jnt")


# --- what cannot be read ---


def test_bags_that_were_not_closed_are_refused_with_what_helps(tmp_path):
    path = write(tmp_path / "bag", "db3", states()) / "bag.db3"
    path.with_name("bag.db3-wal").write_bytes(b"x")
    with pytest.raises(RecordingError, match=r"recorder has not closed it: what bag\.db3-wal"):
        read(path)
    (tmp_path / "a.bag.active").write_bytes(b"#ROSBAG V2.0\n")
    with pytest.raises(RecordingError, match=r"a\.bag\.active: its recorder did not close it"):
        read(tmp_path / "a.bag.active")
    open_bag = write(tmp_path / "b", "ros1", states())
    content = open_bag.read_bytes()
    open_bag.write_bytes(content.replace(b"index_pos=", b"index_pos=" + bytes(8) + b"x", 1)[:-9])
    with pytest.raises(RecordingError, match="not a bag of ROS 1, not closed by its recorder, or"):
        read(open_bag)


def test_empty_bags_are_refused(tmp_path):
    with pytest.raises(RecordingError, match="holds no messages"):
        read(write(tmp_path / "a", "db3", []))
    with pytest.raises(RecordingError, match="holds no messages"):
        read(write(tmp_path / "b", "mcap", []))
    for name in ("c.bag", "c.db3", "c.mcap", "c.db3.zstd"):
        (tmp_path / name).write_bytes(b"")
        with pytest.raises(RecordingError, match=f"{name}: "):
            read(tmp_path / name)
    nothing = [("/j", JOINTS, 0, {})]
    with pytest.raises(RecordingError, match=r"no numbers of a motion .*: /j \(sensor_msgs"):
        read(write(tmp_path / "d", "db3", nothing))


def test_a_missing_package_is_told_with_its_extra(tmp_path, monkeypatch):
    path = write(tmp_path / "bag", "db3 file", states())
    monkeypatch.setitem(sys.modules, "zstandard", None)
    with pytest.raises(MissingPackageError, match=r"'zstandard'.*pip install 'motionese\[ros\]'"):
        read(path)
    monkeypatch.setitem(sys.modules, "rosbags.rosbag1", None)
    with pytest.raises(MissingPackageError, match=r"'rosbags'.*motionese\[ros\]"):
        read(write(tmp_path / "a", "ros1", states()))


def test_ros_in_mcap_needs_the_package_for_ros(tmp_path, monkeypatch):
    (file,) = write(tmp_path / "bag", "mcap", states()).glob("*.mcap")
    monkeypatch.setitem(sys.modules, "rosbags.typesys", None)
    with pytest.raises(MissingPackageError, match=r"'rosbags'.*motionese\[ros\]"):
        read(file)


def test_a_missing_decompressor_of_mcap_is_told(tmp_path, monkeypatch):
    path = write(tmp_path / "bag", "mcap storage", states())
    monkeypatch.setattr("mcap.stream_reader.zstandard", None)
    with pytest.raises(MissingPackageError, match="needs the package 'zstandard'"):
        read(path)


def test_a_bag_is_not_written(tmp_path):
    with pytest.raises(
        RecordingError, match="a ROS bag or a folder of them is read, not written; --to is"
    ):
        write_recording(tmp_path / "a.bag", read(write(tmp_path / "b", "ros1", states())))


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The bytes of a bag of every kind, in its file."""
    folder = tmp_path_factory.mktemp("whole")
    found = {}
    for kind in KINDS:
        path = write(folder / kind, kind, [*states(count=4), ("/go", "std_msgs/Int8", 1, {})])
        files = [p for p in path.iterdir() if p.suffix != ".yaml"] if path.is_dir() else [path]
        found[kind] = files[0].name, files[0].read_bytes()
    return found


def tried(path):
    """Read a bag as a user would; only sentences may come out."""
    try:
        survey(read(path))
        Motions.read(path, nan="gap", ranges={"*": (-1e6, 1e6)})
    except MotioneseError as error:
        assert "\n" not in str(error)
        assert "Type-check" not in str(error)


def tried_when_damaged(whole, tmp_path, kind, data):
    name, content = whole[kind]
    damaged = bytearray(content)
    for _ in range(data.draw(st.integers(0, 4))):
        damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    if data.draw(st.booleans()):
        del damaged[data.draw(st.integers(0, len(damaged))) :]
    path = tmp_path / name
    path.write_bytes(damaged)
    tried(path)


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=15)
@given(data=st.data())
def test_a_damaged_bag_gives_a_recording_or_one_sentence(whole, tmp_path, kind, data):
    tried_when_damaged(whole, tmp_path, kind, data)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=2000)
@given(data=st.data())
def test_many_damaged_bags(whole, tmp_path, kind, data):
    tried_when_damaged(whole, tmp_path, kind, data)


BASES = ("bool", "int8", "uint8", "int32", "uint64", "float32", "float64", "string")
ENDINGS = ("", "", "[]", "[2]", "[<=3]")
NAMES = ("name", "position", "data", "header", "stamp", "joint_names", "child_frame_id", "class")


def made_up(version, data, kind):
    """A message of a type that somebody made up, with lists of a few items."""
    store = bags.STORES[version]
    message = made(version, kind)
    for name, (shape, inner) in store.fielddefs[kind][1]:
        attribute = name if hasattr(message, name) else f"{name}_"
        if shape > 2:
            (of, base), _ = inner
            count = 2 if shape == 3 else data.draw(st.integers(0, 3))
            if of == 2:
                items = [made_up(version, data, base) for _ in range(count)]
            elif base[0] == "string":
                items = [data.draw(st.sampled_from(["a", "b", "", "é"])) for _ in range(count)]
            else:
                items = np.resize(np.arange(2, dtype=getattr(message, attribute).dtype), count)
            setattr(message, attribute, items)
        elif shape == 2 and inner.startswith("my_msgs"):
            setattr(message, attribute, made_up(version, data, inner))
    return message


def tried_with_made_up_types(folder, kind, data):
    fields = st.lists(
        st.tuples(
            st.sampled_from((*BASES, "std_msgs/Header", "{inner}")),
            st.sampled_from(ENDINGS),
            st.sampled_from(NAMES),
        ),
        min_size=1,
        max_size=5,
        unique_by=lambda field: field[2],
    )
    count = next(COUNT)
    outer, inner = (f"{part}{count}" for part in ("Outer", "Inner"))
    for name, bases in ((inner, "float64"), (outer, f"my_msgs/{inner}")):
        told = data.draw(fields)
        bags.define(
            **{
                name: "\n".join(
                    f"{base.format(inner=bases)}{ending} {field}" for base, ending, field in told
                )
            }
        )
    messages = [
        ("/made", f"my_msgs/{outer}", i / 10, lambda v: made_up(v, data, f"my_msgs/msg/{outer}"))
        for i in range(3)
    ]
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    tried(write(folder / "bag", kind, messages))


COUNT = itertools.count()


@pytest.mark.parametrize("kind", ["ros1", "mcap"])
@settings(max_examples=15)
@given(data=st.data())
def test_types_that_somebody_made_up_give_a_recording_or_one_sentence(tmp_path, kind, data):
    tried_with_made_up_types(tmp_path / "made", kind, data)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["ros1", "mcap"])
@settings(max_examples=2000)
@given(data=st.data())
def test_many_types_that_somebody_made_up(tmp_path, kind, data):
    tried_with_made_up_types(tmp_path / "made", kind, data)


# --- large bags ---


@pytest.mark.slow
def test_a_large_bag_takes_little_more_than_its_library_does():
    benchmark = Path(__file__).parents[2] / "benchmarks" / "reading_bags.py"
    # In a process of its own, in which no annotations are checked.
    ran = subprocess.run([sys.executable, benchmark, "1000"], capture_output=True, text=True)

    assert ran.returncode == 0, ran.stderr
    assert ran.stdout.count("met") == 12
