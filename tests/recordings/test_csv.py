"""Tables of text, as people have them."""

import numpy as np
import pytest

from motionese.errors import RecordingError
from motionese.recordings import read, write


def test_an_episode_column_a_time_column_and_units_are_found(table):
    found = table(
        "Episode,time [ms],shoulder [rad],position[0],frame\n"
        "a,0,0.5,1,0\na,40,,2,1\nb,0,1e-3,-3,0\n"
    )

    assert found.channels == ("shoulder", "position[0]", "frame")
    assert found.units == ("rad", "", "")
    assert found.usual == ("shoulder", "position[0]")
    assert found.rate_hz is None
    assert [e.name for e in found.episodes] == ["a", "b"]
    np.testing.assert_allclose(found.episodes[0].times, [0, 0.04])
    np.testing.assert_array_equal(found.episodes[0].observed[:, 0], [True, False])
    np.testing.assert_array_equal(found.episodes[0].values[:, 1], [1, 2])
    np.testing.assert_array_equal(found.episodes[1].values, [[1e-3, -3, 0]])


@pytest.mark.parametrize("name", ["demonstration", "TRIAL", "episode_index"])
def test_columns_that_name_the_episode(table, name):
    assert [e.name for e in table(f"x,{name}\n1,7\n2,7\n3,8\n").episodes] == ["7", "8"]


@pytest.mark.parametrize(
    ("name", "unit"),
    [("t", 1), ("time_s", 1), ("timestamp", 1), ("time_ms", 1e-3), ("Stamp [us]", 1e-6)],
)
def test_columns_that_tell_the_time(table, name, unit):
    (episode,) = table(f"{name},x\n0,1\n2,2\n").episodes

    np.testing.assert_allclose(episode.times, [0, 2 * unit])


def test_named_columns_come_before_those_that_are_found(table):
    found = table("id,when_ms,episode,time\nu,0,1,5\nu,10,2,5\n", episode="id", time="when_ms")

    assert found.channels == ("episode", "time")
    np.testing.assert_allclose(found.episodes[0].times, [0, 0.01])


def test_a_table_without_episodes_is_one_named_after_the_file(table):
    (episode,) = table("x,y\n1,2\n3,4\n", name="reach.csv").episodes

    assert episode.name == "reach"
    assert episode.times is None
    assert episode.observed.all()


def test_a_folder_is_one_episode_a_file_in_natural_order(table, tmp_path):
    for i in (10, 9):
        table(f"x,y\n{i},2\n", name=f"folder/demo_{i}.csv")
    table("y,x\n2,11\n", name="folder/demo_11.CSV")
    (tmp_path / "folder" / "._demo_9.csv").write_bytes(b"\x00\x05\x16")

    found = read(tmp_path / "folder")

    assert [e.name for e in found.episodes] == ["demo_9", "demo_10", "demo_11"]
    assert [e.values[0].tolist() for e in found.episodes] == [[9, 2], [10, 2], [11, 2]]


def test_a_file_of_a_folder_with_other_channels_is_refused(table, tmp_path):
    table("x,y\n1,2\n", name="folder/a.csv")
    table("x,z\n1,2\n", name="folder/b.csv")

    with pytest.raises(RecordingError, match=r"b\.csv: its columns are x, z, in a\.csv and"):
        read(tmp_path / "folder")


@pytest.mark.parametrize("separator", [";", "\t"])
def test_decimal_commas_where_commas_do_not_separate(table, separator):
    text = "x;y\n0,5;1\n-1,25e-1;2\n".replace(";", separator)

    np.testing.assert_array_equal(table(text).episodes[0].values, [[0.5, 1], [-0.125, 2]])


def test_what_spreadsheets_and_pandas_leave_behind(table):
    found = table(b"\xef\xbb\xbf,x\r\n0,1\r\n1,2\r\n,\r\n,\r\n")

    assert found.channels == ("x",)
    assert found.episodes[0].values.tolist() == [[1], [2]]
    assert table(",0,1\n0,5,7\n1,6,8\n").channels == ("0", "1")
    assert table('"arm\n [rad]",x\n1,2\n').units == ("rad", "")
    assert table("demo,0,1,2\n0,5,7,9\n").channels == ("0", "1", "2")


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("%time,a.header.seq,pos\n1609459200000000000,7,5\n1609459200250000000,8,6\n", 0.25),
        ("__time,pos\n1609459200.5,5\n1609459200.75,6\n", 0.25),
        ("timestamp,pos\n1609459200500,5\n1609459200750,6\n", 0.25),
        ("timestamp,pos\n1609459200500000,5\n1609459200750000,6\n", 0.25),
        ("Time (ms),pos\n500,5\n750,6\n", 0.25),
        ("timestamp_us,pos\n500,5\n750,6\n", 0.00025),
        ("stamp,pos\n2024-02-28 23:59:59.9,5\n2024-02-29 00:00:00.15,6\n", 0.25),
        ("# UR5\n# 4 Hz\n\ntime,pos\n0,5\n# pause\n0.25,6\n", 0.25),
        ("# time pos\n0.00e+00 5e+00\n2.50e-01 6e+00\n", 0.25),
        ("  time   pos\n   0.0     5\n  0.25     6\n", 0.25),
        ("sep=;\ntime;pos\n0,0;5\n0,25;6\n", 0.25),
        ("#,time,pos\n0,0,5\n1,0.25,6\n", 0.25),
        ("time,pos\n0,5,\n0.25,6,,\n", 0.25),
        ("Time,header.stamp.secs,frame_id,pos\n0,3,base,5\n.25,3,base,6\n", 0.25),
        ("Unnamed: 0,time,header.frame_id,pos\n0,0,,5\n1,0.25,,6\n", 0.25),
    ],
)
def test_what_robots_and_laboratories_write(table, text, seconds):
    found = table(text)
    (episode,) = found.episodes

    assert found.usual == ("pos",)
    assert episode.values[:, found.channels.index("pos")].tolist() == [5, 6]
    assert episode.times[1] - episode.times[0] == pytest.approx(seconds, rel=1e-5)


def test_cells_in_which_nothing_was_observed(table):
    (episode,) = table("t,x,y\n0,NA,1\n1,null,2\n2,3\n3,4,nan\n").episodes

    np.testing.assert_array_equal(episode.observed[:, 0], [False, False, True, True])
    np.testing.assert_array_equal(episode.observed[:, 1], [True, True, False, True])
    np.testing.assert_array_equal(episode.values[:, 1], [1, 2, np.nan, np.nan])


def test_truth_values_are_numbers(table):
    assert table("x,grip\n1,False\n2,TRUE\n").episodes[0].values[:, 1].tolist() == [0, 1]


@pytest.mark.parametrize(
    ("header", "name", "unit"),
    [
        ("arm (rad)", "arm", "rad"),
        ("arm(deg/s)", "arm", "deg/s"),
        ("acc (m/s^2)", "acc", "m/s^2"),
        ("arm (left)", "arm (left)", ""),
        ("f(x)", "f(x)", ""),
        ("arm (rad) [m]", "arm (rad)", "m"),
        ("(rad)", "(rad)", ""),
    ],
)
def test_units_in_brackets(table, tmp_path, header, name, unit):
    found = table(f"{header},b\n1,2\n3,4\n")
    assert (found.channels[0], found.units[0]) == (name, unit)

    write(tmp_path / "again.csv", found)
    again = read(tmp_path / "again.csv")
    assert (again.channels[0], again.units[0]) == (name, unit)


def test_columns_of_text_beside_an_episode_column_are_no_channels(table):
    assert table("episode,task,x\na,wave,1\na,wave,2\n").channels == ("x",)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("", r"table\.csv: the file is empty"),
        ("x,y\n", r"table\.csv: holds no rows below its header"),
        (",\n,\n", r"table\.csv: the file is empty"),
        ("x,y,x\n1,2,3\n", "columns must be unique; doubled: x"),
        ("x [rad],x [cm]\n1,2\n", "channel names must be unique; doubled: x"),
        ("x,y\n1,2,3\n", r"table\.csv, line 2: 3 cells, the header has 2"),
        ("x,y\n1,2\n3", r"line 3: the file is cut short inside a row \(1 cells, the header has 2"),
        ("x,y\n1,2\n3,four\n", r"line 3, column 'y': expected a number, got 'four'"),
        ("x;y\n1.5;2\n3,5;4\n", r"line 3, column 'x': expected a number, got '3,5'"),
        ('x,y\n"0,5",1\n"1,5",2\n', r"line 2, column 'x': expected a number, got '0,5'"),
        ("time,x\nnoon,2\n", r"line 2: column 'time' holds text.* 12:00:00\.25, got 'noon'$"),
        ("time,x\n2024-01-31,1\n2024-02-01T00:00Z,1\n", "column 'time' holds text"),
        ("episode,x\na,1\n,2\n", r"line 3: the episode's name is missing"),
        ("episode,t,x\na,0,1\na,2,1\na,1,2\n", r"line 4: time must rise inside episode 'a', got"),
        ("t,x\n1,1\n1,1\n2,2\n2,2\n", r"line 3: time stands still in 2 of 4 rows .*; --time"),
        ("t,x\n0,1\n,1\n", r"line 3: episode 'table' has a row without a time"),
        ("episode\na\n", "no column holds numbers"),
        ('x,y\n1,"2\n', "not a csv file"),
        ("x\n1\n".encode("utf-16")[:-1], r"not a text file \(byte 8\)"),
        (b"x,y\n\xff\x01,2\n", r"not a text file \(byte 4\)"),
    ],
)
def test_a_table_that_is_wrong_is_refused_in_one_sentence(table, text, match):
    with pytest.raises(RecordingError, match=match) as caught:
        table(text)

    assert "\n" not in str(caught.value)


def test_a_column_cannot_be_episode_and_time(table):
    with pytest.raises(RecordingError, match="column 't' cannot be episode and time at once"):
        table("t,x\n1,2\n", episode="t")


def test_a_column_that_is_not_there_is_refused(table):
    with pytest.raises(RecordingError, match=r"unknown column 'trail'; did you mean 'trial'\?"):
        table("trial,x\n1,2\n", episode="trail")


def test_a_recording_is_written_as_it_reads(recording, tmp_path):
    path = tmp_path / "out.csv"
    write(path, recording)
    found = read(path)

    lines = path.read_bytes().split(b"\n")
    assert lines[0] == b'episode,time [s],shoulder [rad],"hand, x [cm]",a[0]'
    assert len(lines) == 1 + 7 + 4 + 1
    assert (found.channels, found.units) == (recording.channels, recording.units)
    for was, now in zip(recording.episodes, found.episodes, strict=True):
        assert now.name == was.name
        np.testing.assert_array_equal(now.times, np.arange(len(was.values)) / 25)
        np.testing.assert_array_equal(now.observed, was.observed)
        np.testing.assert_array_equal(now.values[was.observed], was.values[was.observed])


def test_a_channel_called_as_a_column_of_the_table_is_refused(recording, tmp_path):
    named = type(recording)(**{**vars(recording), "channels": ("time", "b", "c")})
    with pytest.raises(RecordingError, match="a csv file has its own column 'time'; rename it"):
        write(tmp_path / "out.csv", named)

    assert not list(tmp_path.iterdir())
