"""Messages of ROS 1 and 2: which numbers are in them, under which names, in which units.

Numbers are named by the fields in which they stand, as in JSON: `.pose.position.x`, `.data[0]`;
those of lists that go with the names of joints by these: `.position.elbow`; transforms by their
frames. Truth values are 0 and 1. Units are told where REP 103 and the type tell them; the
positions of a JointState may be rad or m, so they have none.
"""

import re
from collections.abc import Sequence
from operator import attrgetter
from typing import Any

from motionese.recordings.formats.conventions import WIDEST, is_bookkeeping, strings
from motionese.recordings.formats.json_messages import numbers
from motionese.recordings.formats.message_log import Topic
from motionese.recordings.formats.ros_types import Field, Types

JOINT_STATE = "sensor_msgs/msg/JointState"
TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
LABELS = ("name", "joint_names", "interface_names")
"""Lists of names that go with the other lists of a message, and with those inside it."""
FRAME = "child_frame_id"
UNITS = {
    **dict.fromkeys(("geometry_msgs/msg/Point", "geometry_msgs/msg/Point32"), "m"),
    "geometry_msgs/msg/Transform.translation": "m",
    "geometry_msgs/msg/Twist.linear": "m/s",
    "geometry_msgs/msg/Twist.angular": "rad/s",
    "geometry_msgs/msg/Accel.linear": "m/s²",
    "geometry_msgs/msg/Accel.angular": "rad/s²",
    "geometry_msgs/msg/Wrench.force": "N",
    "geometry_msgs/msg/Wrench.torque": "Nm",
    "geometry_msgs/msg/Pose2D.x": "m",
    "geometry_msgs/msg/Pose2D.y": "m",
    "geometry_msgs/msg/Pose2D.theta": "rad",
    "sensor_msgs/msg/Imu.angular_velocity": "rad/s",
    "sensor_msgs/msg/Imu.linear_acceleration": "m/s²",
    "sensor_msgs/msg/Range.range": "m",
}
"""By type, or type and field; what stands inside has the unit too."""
_NO_MOTION = re.compile(
    r"sensor_msgs/msg/(CameraInfo|PointCloud|(MultiEcho)?LaserScan)$"
    r"|nav_msgs/msg/(OccupancyGrid|Path|GridCells)$"
    r"|(action|actionlib|bond|diagnostic|lifecycle|map|rosgraph|shape|statistics|stereo|tf|tf2"
    r"|visualization)_msgs/|tf/|bond/|dynamic_reconfigure/"
    r"|(rcl|rosbag2|service|type_description)_(interfaces|msgs)/"
)
"""Types of clouds and logs, and of what follows from other topics, such as /tf."""
_BYTES = ("uint8", "byte", "char", "octet")
"""What pictures and clouds of points are made of."""
_SECONDARY = re.compile(r"covariance|\.(velocities|accelerations)\b")
"""Paths of what is not usual: derived, or how sure something is."""


class RosMessages:
    """The messages of one topic."""

    def __init__(self, topic: Topic, distribution: str) -> None:
        self.further: list[tuple[int, list[float]]] = []
        self.shortened = 0
        self.wide: dict[str, None] = {}
        self._kind = topic.kind
        self._types = Types(topic, distribution)
        store = self._types.store
        self._decode = store.deserialize_ros1 if topic.encoding == "ros1" else store.deserialize_cdr
        self._numbers = _Numbers(self._types, topic.kind)
        self._stamp = _stamp(self._types, topic.kind)
        self._last: Any = None

    @property
    def hold_numbers(self) -> bool:
        """Tell whether there are numbers in them, other than bytes of something else."""
        fields = self._types.fields(self._kind)
        is_binary = any(f.several and f.base in _BYTES for f in fields)
        return self._numbers.any and (not is_binary or self._kind.startswith("std_msgs/"))

    @property
    def hold_motion(self) -> bool:
        """Tell whether these numbers are of a motion, as far as the type tells."""
        return self.hold_numbers and _NO_MOTION.match(self._kind) is None

    def value(self, data: bytes) -> Any:
        """Return what a message says."""
        return self._decode(data, self._kind)

    def numbers(self, data: bytes) -> tuple[tuple[Any, ...], int, list[float]]:
        """Return names and lengths of lists of a message, its stamp [ns], and the numbers."""
        message, found, stamp = self._decode(data, self._kind), list[float](), 0
        if self._stamp is not None:
            seconds, nanoseconds = self._stamp(message)
            stamp = seconds * 1_000_000_000 + nanoseconds
        if self._kind == TRAJECTORY:
            self._take_points(message)
        self._last = message
        return self._numbers.into(found, message), stamp, found

    def columns(self) -> list[tuple[str, str, bool]]:
        """Return path, unit and whether it is usual, of every number of the last message."""
        units: list[str] = []
        plain = self._plain(self._kind, self._last, "", (), "", units)
        paths = (path for path, _ in numbers(plain))
        if self._kind == TRAJECTORY:
            paths = (path.removeprefix(".points[0]") for path in paths)
        return [(p, u, self._is_usual(p)) for p, u in zip(paths, units, strict=True)]

    def _is_usual(self, path: str) -> bool:
        aside = {JOINT_STATE: (".velocity", ".effort"), TRAJECTORY: (".effort",)}
        secondary = path.startswith(aside.get(self._kind, ())) or _SECONDARY.search(path)
        return not secondary and not is_bookkeeping(path)

    def _take_points(self, trajectory: Any) -> None:
        """Leave a trajectory its first point; note those of the first, if it is the only one."""
        points = trajectory.points
        self.shortened += len(points) > 1
        if self._last is None:
            for point in points:
                after, row, trajectory.points = point.time_from_start, list[float](), [point]
                self._numbers.into(row, trajectory)
                self.further.append((after.sec * 1_000_000_000 + after.nanosec, row))
            if len({len(row) for _, row in self.further}) > 1:
                self.further = []
        trajectory.points = points[:1]

    def _plain(
        self,
        kind: str,
        message: Any,
        path: str,
        labels: tuple[str, ...],
        unit: str,
        units: list[str],
    ) -> dict[str, Any]:
        """Return a message as JSON would hold it, and add the unit of every number to `units`."""
        fields = self._types.numbered(kind)
        own = (_labels(getattr(message, f.attribute)) for f in fields if _names_others(f))
        labels = next((found for found in own if found), labels)
        plain: dict[str, Any] = {}
        for field in fields:
            value, here = getattr(message, field.attribute), f"{path}.{field.name}"
            told = UNITS.get(f"{kind}.{field.name}", UNITS.get(kind, unit))
            if field.several and len(value) > WIDEST and (field.kind or field.is_number):
                self.wide[here] = None
            elif field.kind and field.several:
                frames = _labels([getattr(item, FRAME, "") for item in value])
                inside = () if len(labels) == len(value) else labels
                parts = [self._plain(field.kind, v, here, inside, told, units) for v in value]
                plain[field.name] = _labelled(parts, frames or labels)
            elif field.kind:
                plain[field.name] = self._plain(field.kind, value, here, labels, told, units)
            elif field.is_number:
                items = [float(v) for v in (value if field.several else [value])]
                units += [told] * len(items)
                plain[field.name] = _labelled(items, labels) if field.several else items[0]
        return plain


class _Numbers:
    """Takes the numbers out of messages of a type, in the order of their fields, at little cost."""

    def __init__(self, types: Types, kind: str) -> None:
        self._steps: list[tuple[str, Any, _Numbers | None]] = []
        alone: list[str] = []
        for path, field in types.leaves(kind):
            if field.is_number and not field.several:
                alone.append(path)
                continue
            self._add(alone)
            if field.kind:
                self._steps.append(("messages", attrgetter(path), _Numbers(types, field.kind)))
            elif field.is_number:
                self._steps.append(("list", attrgetter(path), None))
            elif field.name == FRAME or _names_others(field):
                self._steps.append(("names", attrgetter(path), None))
        self._add(alone)

    def _add(self, alone: list[str]) -> None:
        if alone:
            # Of a single path, attrgetter would return no tuple.
            self._steps.append(("alone", attrgetter(*alone, alone[-1]), None))
            alone.clear()

    @property
    def any(self) -> bool:
        """Tell whether there are any."""
        inner = [inside.any for _, _, inside in self._steps if inside is not None]
        return any(inner) or any(what in ("alone", "list") for what, _, _ in self._steps)

    def into(self, found: list[float], message: Any) -> tuple[Any, ...]:
        """Add a message's numbers to those found; return what tells which ones they are."""
        alike: list[Any] = []
        for what, get, inner in self._steps:
            value = get(message)
            if what == "alone":
                found += value[:-1]
            elif what == "names":
                alike.append(value if isinstance(value, str) else tuple(value))
            elif len(value) > WIDEST:
                alike.append(None)
            elif inner is not None:
                alike.append(tuple([inner.into(found, item) for item in value]))
            else:
                alike.append(len(value))
                found += value.tolist()
        return tuple(alike)


def _stamp(types: Types, kind: str) -> Any:
    """Return what gets seconds and nanoseconds of a message's stamp; None where it has none."""
    for field in types.fields(kind):
        inside = {"std_msgs/msg/Header": ".stamp", "builtin_interfaces/msg/Time": ""}
        if field.name in ("header", "stamp") and not field.several and field.kind in inside:
            path = field.attribute + inside[field.kind]
            return attrgetter(f"{path}.sec", f"{path}.nanosec")
    return None


def _names_others(field: Field) -> bool:
    return field.several and field.name in LABELS and field.base == "string"


def _labels(names: Sequence[Any]) -> tuple[str, ...]:
    labels = strings(list(names)) or ()
    return labels if all(labels) and len(set(labels)) == len(labels) else ()


def _labelled(items: list[Any], labels: tuple[str, ...]) -> Any:
    return dict(zip(labels, items, strict=True)) if len(items) == len(labels) else items
