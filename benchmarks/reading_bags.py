"""Reading a ROS bag, beside what its library takes to pass over and decode the same messages.

Two bags of each kind: JointStates (7 joints at 500 Hz, with velocities and efforts), wrenches at
100 Hz and pictures at 30 Hz, which make up most of the bytes; and the same without pictures, of a
twentieth of the size. In turns, in one process: all messages passed over and those decoded that are
used, with the library alone; the bag read as a recording; and looked at as `motionese inspect`
does. The memory is the most that this allocates at once, beside the recording's own arrays.

    python benchmarks/reading_bags.py [MEGABYTES]
"""

import sys
import tempfile
import tracemalloc
from collections.abc import Callable
from itertools import product
from pathlib import Path
from time import process_time

import numpy as np
from rich.console import Console
from rich.table import Table
from rosbags import rosbag1, rosbag2
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin
from rosbags.typesys import Stores, get_typestore

from motionese.recordings import read, survey

MEGABYTES = 1000
PICTURES = {300_000: 1.0, 0: 0.05}
"""Bytes of a picture, and the share of the megabytes of a bag with such pictures."""
TURNS = 3
TIMES, MEMORY = 2.0, 4.0
"""The targets."""
KINDS = ("ROS 1", "ROS 2, SQLite", "ROS 2, MCAP")


def write_bag(folder: Path, kind: str, megabytes: float, picture: int) -> Path:
    """Write a bag of about this size, and return what is to be read."""
    is_first = kind == "ROS 1"
    store = get_typestore(Stores.ROS1_NOETIC if is_first else Stores.LATEST)
    serialize = store.serialize_ros1 if is_first else store.serialize_cdr
    plugin = StoragePlugin.MCAP if "MCAP" in kind else StoragePlugin.SQLITE3
    writer = (
        rosbag1.Writer(folder / "large.bag")
        if is_first
        else rosbag2.Writer(folder / f"large {plugin.name}", version=9, storage_plugin=plugin)
    )
    types = store.types
    rng, names = np.random.default_rng(0), [f"joint_{i}" for i in range(7)]
    told = {"/joint_states": JOINTS, "/wrench": WRENCH, "/image": IMAGE}
    with writer:
        topics = {t: writer.add_connection(t, k, typestore=store) for t, k in told.items()}

        def header(at: int) -> object:
            time = types["builtin_interfaces/msg/Time"](sec=at // 10**9, nanosec=at % 10**9)
            first = {"seq": 0} if is_first else {}
            return types["std_msgs/msg/Header"](**first, stamp=time, frame_id="base")

        def put(topic: str, at: int, **fields: object) -> None:
            message = types[told[topic]](header=header(at), **fields)
            writer.write(topics[topic], at + 200_000, serialize(message, told[topic]))

        pixels = rng.integers(0, 256, picture, np.uint8)
        image = {"height": 1, "width": 1, "encoding": "", "is_bigendian": 0, "step": 1}
        vector = types["geometry_msgs/msg/Vector3"]
        for i in range(int(megabytes * 1e6 / (picture * 0.06 + 350))):
            at = 1_700_000_000_000_000_000 + i * 2_000_000
            lists = {k: rng.normal(size=7) for k in ("position", "velocity", "effort")}
            put("/joint_states", at, name=names, **lists)
            if i % 5 == 0:
                force, torque = (vector(*rng.normal(size=3)) for _ in range(2))
                wrench = types["geometry_msgs/msg/Wrench"](force=force, torque=torque)
                put("/wrench", at, wrench=wrench)
            if picture and i % 50 < 3:
                put("/image", at, data=pixels, **image)
    return writer.path


JOINTS, WRENCH = "sensor_msgs/msg/JointState", "geometry_msgs/msg/WrenchStamped"
IMAGE = "sensor_msgs/msg/Image"


def library(path: Path) -> int:
    """Pass over all messages and decode those that are used, with the library for bags alone."""
    count = 0
    with AnyReader([path]) as reader:
        for connection, _, data in reader.messages():
            if connection.msgtype != IMAGE:
                reader.deserialize(data, connection.msgtype)
                count += 1
    return count


def seconds(work: Callable[[Path], object], path: Path) -> float:
    """Return the time of the processor that some work on a bag takes [s]."""
    before = process_time()
    work(path)
    return process_time() - before


def memory(path: Path) -> tuple[float, float]:
    """Return the most that was allocated at once, and the recording's own arrays [MB]."""
    tracemalloc.start()
    found = read(path)
    survey(found)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return most / 1e6, sum(e.values.nbytes + e.observed.nbytes for e in found.episodes) / 1e6


def main() -> None:
    """Write the bags, read them in turns, and print a table."""
    megabytes = float(sys.argv[1]) if len(sys.argv) > 1 else MEGABYTES
    table = Table(title=f"Bags of {megabytes:g} MB: seconds of the processor, medians of {TURNS}")
    times = ("library", "read", "inspect", "×", f"≤ {TIMES:g}")
    for heading in ("", *times, "MB", "× kept", f"≤ {MEMORY:g}"):
        table.add_column(heading, justify="right" if table.columns else "left")
    for kind, picture in product(KINDS, PICTURES):
        with tempfile.TemporaryDirectory() as folder:
            path = write_bag(Path(folder), kind, megabytes * PICTURES[picture], picture)
            ways = (library, read, lambda p: survey(read(p)))
            each = [[seconds(way, path) for way in ways] for _ in range(TURNS)]
            most, kept = memory(path)
        ratio = float(np.median([turn[2] / turn[0] for turn in each]))
        figures = (*(f"{t:.2f}" for t in np.median(each, axis=0)), f"{ratio:.2f}")
        verdicts = ["met" if good else "missed" for good in (ratio <= TIMES, most <= MEMORY * kept)]
        name = kind if picture else f"{kind}, no pictures"
        table.add_row(name, *figures, verdicts[0], f"{most:.0f}", f"{most / kept:.1f}", verdicts[1])
    Console(width=100).print(table)


if __name__ == "__main__":
    main()
