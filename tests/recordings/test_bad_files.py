"""Whatever bytes are in a file, a reader gives a recording or one sentence."""

import io

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from motionese import Motions
from motionese.errors import MotioneseError
from motionese.recordings import read, survey, write

CELLS = st.one_of(
    st.sampled_from(["", "nan", "inf", "-1e308", "0", "1.5", "0,5", "wave", '"', "é", "\x00"]),
    st.sampled_from(["NA", "true", "1600000000000", "2024-01-31 12:00:00", "12:00Z", "# x", "%"]),
    st.floats().map(repr),
)
TEXTS = (
    st.text(st.characters(codec="utf-8", exclude_categories=("Cc",)), max_size=5)
    .map(str.strip)
    .filter(lambda name: name and name.casefold() not in ("episode", "time"))
)
NAMES = st.sampled_from(
    (
        *("episode", "time", "t [ms]", "x", "y (rad)", "", "1", "frame", '"', "#", "%t", "run"),
        *("sec", "nsec", "header.stamp.secs", "header.stamp.nsecs", "wall_time", "column_0"),
    )
)


def tried(path):
    """Read a file as a user would; only sentences may come out."""
    for attempt in (
        lambda: survey(read(path)),
        lambda: Motions.read(path, rate_hz=10.0, nan="gap", trim=0.05),
        lambda: Motions.read(path, resample_hz=7.0),
    ):
        try:
            attempt()
        except MotioneseError as error:
            assert "\n" not in str(error)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The bytes of a whole file in each format."""
    rng = np.random.default_rng(0)
    motions = Motions.from_arrays([rng.normal(size=(6, 2)) for _ in range(2)], ["a", "b"], 10.0)
    folder = tmp_path_factory.mktemp("whole")
    for name in ("m.csv", "m.npz"):
        motions.write(folder / name)
    content = {name: (folder / name).read_bytes() for name in ("m.csv", "m.npz")}
    joints, bounds = io.BytesIO(), io.BytesIO()
    np.save(joints, rng.normal(size=(2, 6, 2)))
    np.save(bounds, np.array([[-1.0, -1.0], [1.0, 1.0]]))
    arrays = {"joints.npy": joints.getvalue(), "joint_bounds.npy": bounds.getvalue()}
    return content | arrays | {"alone.npy": joints.getvalue()}


def put(folder, name, content, files):
    """Write one file, those of EIPL with the whole others beside it; return what is to be read."""
    folder.mkdir(exist_ok=True)
    if not name.startswith("joint"):
        (folder / name).write_bytes(content)
        return folder / name
    for other in ("joints.npy", "joint_bounds.npy"):
        (folder / other).write_bytes(files[other])
    (folder / name).write_bytes(content)
    return folder


def tried_when_damaged(files, tmp_path, name, data):
    content = bytearray(files[name])
    if data.draw(st.booleans()):
        del content[data.draw(st.integers(0, len(content))) :]
    for _ in range(data.draw(st.integers(0, 3))):
        if content:
            content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))

    tried(put(tmp_path / "damaged", name, bytes(content), files))


ALL = pytest.mark.parametrize(
    "name", ["m.csv", "m.npz", "alone.npy", "joints.npy", "joint_bounds.npy"]
)


@ALL
@settings(max_examples=60)
@given(data=st.data())
def test_files_that_are_damaged(files, tmp_path, name, data):
    tried_when_damaged(files, tmp_path, name, data)


@pytest.mark.slow
@ALL
@settings(max_examples=2000)
@given(data=st.data())
def test_more_files_that_are_damaged(files, tmp_path, name, data):
    tried_when_damaged(files, tmp_path, name, data)


@pytest.mark.parametrize("name", ["m.csv", "m.npz", "joints.npy"])
@given(content=st.binary(max_size=200))
@example(b"PK\x03\x04")
@example(b"\x93NUMPY\x01\x00\x10\x00{'descr': '<f8'\n")
def test_files_of_anything(files, tmp_path, name, content):
    tried(put(tmp_path / "anything", name, content, files))


def try_a_table(path, data):
    width = data.draw(st.integers(1, 4))
    rows = st.lists(CELLS, min_size=width - 1, max_size=width + 1)
    header = data.draw(st.lists(NAMES, min_size=width, max_size=width, unique=True))
    body = data.draw(st.lists(rows, max_size=6))
    times = data.draw(st.integers(1, 5))
    separator = data.draw(st.sampled_from([",", ";", "\t", " "]))
    above = data.draw(st.sampled_from(["", "# a\n", "# a,b\n\n", "sep=;\n", '#"\n', "Lab\nv: 2\n"]))
    encoding = data.draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "cp1252"]))
    named = data.draw(st.booleans())
    text = "\n".join(separator.join(row) for row in [*([header] if named else []), *body * times])
    path.parent.mkdir(exist_ok=True)
    path.write_bytes((above + text).encode(encoding, errors="replace"))

    tried(path)
    tried(path.parent)


@pytest.mark.slow
@settings(max_examples=150)
@given(st.data())
def test_tables_of_anything(tmp_path, data):
    try_a_table(tmp_path / "tables" / "table.csv", data)


@pytest.mark.slow
@settings(max_examples=2000)
@given(st.data())
def test_more_tables_of_anything(tmp_path, data):
    try_a_table(tmp_path / "tables" / "table.txt", data)


@settings(max_examples=30)
@given(st.data())
def test_what_was_written_reads_the_same(tmp_path, data):
    shape = (data.draw(st.integers(2, 5)), data.draw(st.integers(1, 3)))
    numbers = st.floats(-1e6, 1e6)
    values = np.array(data.draw(st.lists(numbers, min_size=shape[0] * shape[1], max_size=99)))
    values = values[: shape[0] * shape[1]].reshape(shape)
    mask = np.random.default_rng(data.draw(st.integers(0, 99))).random(shape) < 0.7
    names = data.draw(st.lists(TEXTS, min_size=shape[1], max_size=shape[1], unique=True))
    rate = data.draw(st.sampled_from([1.0, 12.5, 30.0, 29.97, 1000.0]))
    motions = Motions.from_arrays(
        [values], names, rate, observed=[mask], ranges=dict.fromkeys(names, (-1e6, 1e6))
    )
    for suffix in ("csv", "npz"):
        path = tmp_path / f"m.{suffix}"
        motions.write(path)
        found = Motions.read(path, channels=names, ranges=dict.fromkeys(names, (-1e6, 1e6)))

        assert found.names == motions.names
        assert found.channels == motions.channels
        assert found.rate_hz == rate
        np.testing.assert_array_equal(found.observed[0], mask)
        np.testing.assert_array_equal(found.values[0][mask], values[mask])


def test_a_reader_leaves_the_file_as_it_was(files, tmp_path):
    path = put(tmp_path / "kept", "m.npz", files["m.npz"], files)
    read(path)
    write(tmp_path / "again.npz", read(path))

    assert path.read_bytes() == (tmp_path / "again.npz").read_bytes()
