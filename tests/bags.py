"""ROS bags of both versions, written by the library that reads them, of messages made by hand."""

from pathlib import Path

import numpy as np
from rosbags import rosbag1, rosbag2
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

START = 1_700_000_000_000_000_000
"""A time of today [ns]."""
KINDS = (
    *("ros1", "ros1 bz2", "db3", "db3 file", "db3 message"),
    *("mcap", "mcap file", "mcap message", "mcap storage"),
)
"""Of bags: version or storage, and what is compressed."""
STORES = {
    version: get_typestore(store)
    for version, store in ((1, Stores.ROS1_NOETIC), (2, Stores.LATEST))
}


def define(**types):
    """Add types such as Grip="float64 width", of the package my_msgs, to what can be written."""
    for name, definition in types.items():
        for store in STORES.values():
            store.register(get_types_from_msg(definition, f"my_msgs/msg/{name}"))


def made(version, kind, **fields):
    """Return a message with these fields, by path (pose__x for pose.x); others are 0 or empty."""
    store = STORES[version]
    message = _empty(store, _full(kind))
    for path, value in fields.items():
        *inside, last = path.split("__")
        part = message
        for name in inside:
            part = getattr(part, name)
        is_numbers = isinstance(getattr(part, last), np.ndarray)
        setattr(part, last, np.array(value, getattr(part, last).dtype) if is_numbers else value)
    return message


def stamp(version, seconds):
    """Return a header's stamp, counted from START."""
    at = START + round(seconds * 1e9) if seconds is not None else 0
    return made(version, "builtin_interfaces/Time", sec=at // 10**9, nanosec=at % 10**9)


def joints(version, positions, seconds=None, **more):
    """Return a JointState of positions by name, with the stamp `seconds` if there is one."""
    return made(
        version,
        "sensor_msgs/JointState",
        name=list(positions),
        position=list(positions.values()),
        header__stamp=stamp(version, seconds),
        **more,
    )


def write(path, kind, messages):
    """Write (topic, type, time [s], fields or a function of the version); return what to read."""
    version = 1 if kind.startswith("ros1") else 2
    store, path = STORES[version], Path(path)
    if version == 1:
        writer = rosbag1.Writer(path.with_suffix(".bag"))
        if "bz2" in kind:
            writer.set_compression(rosbag1.Writer.CompressionFormat.BZ2)
    else:
        storage = StoragePlugin.MCAP if "mcap" in kind else StoragePlugin.SQLITE3
        writer = rosbag2.Writer(path, version=9, storage_plugin=storage)
        _, _, what = kind.partition(" ")
        if what:
            writer.set_compression(CompressionMode[what.upper()], CompressionFormat.ZSTD)
    connections = {}
    with writer:
        for topic, name, seconds, told in messages:
            full = _full(name)
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, full, typestore=store)
            message = told(version) if callable(told) else made(version, full, **told)
            serialize = store.serialize_ros1 if version == 1 else store.serialize_cdr
            at = START + round(seconds * 1e9)
            writer.write(connections[topic], at, serialize(message, full))
    return writer.path


def _full(kind):
    package, name = kind.split("/") if kind.count("/") == 1 else kind.split("/msg/")
    return f"{package}/msg/{name}"


def _empty(store, kind):
    values = {}
    for name, (shape, inner) in store.fielddefs[kind][1]:
        if shape == 2:
            values[name] = _empty(store, inner)
        elif shape == 1:
            values[name] = "" if inner[0] == "string" else 0
        else:
            (shape_of, base), length = inner
            length = length if shape == 3 else 0
            if shape_of == 1 and base[0] != "string":
                kind_of = {"byte": "uint8", "char": "uint8", "octet": "uint8", "bool": "bool"}
                values[name] = np.zeros(length, kind_of.get(base[0], base[0]))
            else:
                values[name] = []
    # By position: a field may be called as a word of Python is.
    return store.types[kind](*values.values())
