"""Tables as programs and people write them: what is understood, and what is told of it."""

import re

import numpy as np
import pytest

from motionese.errors import ChannelError, RecordingError, SettingError
from motionese.recordings import choose, chosen, read

T = np.round(np.arange(24) * 0.05, 5)
A, B = np.round(np.sin(2 * T), 5), np.round(np.cos(3 * T), 5)
SINCE_1970 = 1_700_000_000


def text(header, *columns, separator=","):
    rows = (separator.join(str(cell) for cell in row) for row in zip(*columns, strict=True))
    return "\n".join([*([header] if header else []), *rows]) + "\n"


PLAIN = text("time,a,b", T, A, B)


def told(recording):
    return [finding.sentence for finding in recording.findings]


def steps(recording):
    return [np.diff(e.times) for e in recording.episodes]


@pytest.mark.parametrize(
    "content",
    [
        PLAIN,
        PLAIN.encode("utf-16"),
        b"\xfe\xff" + PLAIN.encode("utf-16-be"),
        PLAIN.encode("utf-32"),
        "# time a b\n" + text("", *(np.char.mod("%.18e", x) for x in (T, A, B)), separator=" "),
        text("time\ta\tb", T, A, B, separator="\t"),
        "# by hand\n" + text("time a b", T, A, B, separator="  "),
        text(
            "time;a;b", *([str(x).replace(".", ",") for x in c] for c in (T, A, B)), separator=";"
        ),
        "time,a,b\ns,-,-\n" + text("", T, A, B),
        text(
            "header.stamp.sec,header.stamp.nanosec,a,b",
            [SINCE_1970 + i // 20 for i in range(24)],
            [i % 20 * 50_000_000 for i in range(24)],
            A,
            B,
        ),
        text("s,us,a,b", [i // 20 for i in range(24)], [i % 20 * 50_000 for i in range(24)], A, B),
        text("time,a,b", [f"12:00:{t:06.3f}" for t in T], A, B),
    ],
)
def test_what_is_clear_is_read_without_a_word(table, content):
    found = table(content)

    assert found.channels == ("a", "b")
    assert not told(found)
    np.testing.assert_allclose(steps(found)[0], 0.05, atol=1e-6)
    np.testing.assert_array_equal(found.episodes[0].values, np.stack([A, B], axis=1))


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (PLAIN.encode("utf-16-le"), "read as UTF-16-LE, though no mark"),
        ("Program: Lab v2\nDate: 2024-01-31\n\n" + PLAIN, "'Program: Lab v2' and 1 more above"),
        ("Subject,7\nDate,2024-01-31\nRate,20,Hz\n" + PLAIN, "'Subject,7' and 2 more above"),
        ("Lab;v2\n" + PLAIN.replace(",", ";"), "the line 'Lab;v2' above the table"),
        (text("time,a,b", (1000 * T).astype(int), A, B), "read as ms, .* call it 'time \\[s\\]'"),
        (text("time,a,b", (1e6 * T).astype(int), A, B), "read as µs"),
        (
            text("wall,a,b", [f"{SINCE_1970 + t:.2f}" for t in T], A, B),
            "'wall': rises .*--time wall",
        ),
        (text("w,a,b", [int(1000 * (SINCE_1970 + t)) for t in T], A, B), "'w': rises as a clock"),
        (text("Zeit,a,b", [f"2024-01-31 12:00:{t:06.3f}" for t in T], A, B), "'Zeit': rises as"),
        (text("elapsed_time,a,b", T, A, B), "'elapsed_time': rises as a clock"),
        (
            text("time,a,b", [*T[:9], T[8], *T[9:]], [*A[:9], 7, *A[9:]], [*B[:9], 7, *B[9:]]),
            "row 9: time 0.4 s is that of the row before",
        ),
    ],
)
def test_what_is_judged_is_told(table, content, what):
    found = table(content)

    assert found.channels == ("a", "b")
    assert len(told(found)) == 1
    assert found.findings[0].kind in {"converted", "left out", "time", "column"}
    assert re.search(what, told(found)[0])
    np.testing.assert_allclose(steps(found)[0], 0.05, atol=1e-6)
    np.testing.assert_array_equal(found.episodes[0].values[:24], np.stack([A, B], axis=1))


def test_western_letters_are_read_and_told(table):
    found = table(text("time [s],Höhe [m]", T, A).encode("cp1252"))

    assert found.channels == ("Höhe",)
    assert "read as Western text" in told(found)[0]


def test_a_row_of_units_gives_units_to_channels_and_time(table):
    found = table(
        "time;a;b\n[ms];(rad);deg/s\n" + text("", (1000 * T).astype(int), A, B, separator=";")
    )

    assert found.units == ("rad", "deg/s")
    np.testing.assert_allclose(steps(found)[0], 0.05)
    assert not told(found)


def test_a_table_without_header_has_numbered_or_given_names(table):
    bare = text("", T, A, B)
    found = table(bare)
    named = table(bare, columns=("time [s]", "a", "b [rad]"))
    single = table(text("", A, B, separator=" "), name="bare.txt")

    assert found.channels == ("column_1", "column_2")
    assert "--columns a,b,c names them" in " ".join(told(found))
    assert "'column_0': rises as a clock does and is taken for the time" in told(found)[0]
    assert (named.channels, named.units, told(named)) == (("a", "b"), ("", "rad"), [])
    assert single.channels == ("column_0", "column_1")
    for given in (("a",), ("a", "b", "c", "d")):
        with pytest.raises(
            SettingError, match=f"has 3 columns, --columns gives {len(given)} names"
        ):
            table(bare, columns=given)
    with pytest.raises(SettingError, match="its columns have names"):
        table(PLAIN, columns=("x", "y", "z"))


@pytest.mark.parametrize("suffix", ["txt", "tsv", "dat"])
def test_folders_of_any_text(table, tmp_path, suffix):
    for i in range(3):
        table(text("time\ta\tb", T, A + i, B, separator="\t"), name=f"folder/take_{i}.{suffix}")
    found = read(tmp_path / "folder")
    assert [e.name for e in found.episodes] == ["take_0", "take_1", "take_2"]
    assert not told(found)

    (tmp_path / "folder" / "notes.txt").write_text(
        "Recorded on Monday.\nTake 2 is bad, see p. 3.\n"
    )
    assert "notes.txt holds no table" in told(read(tmp_path / "folder"))[0]


def test_the_file_that_does_not_fit_is_the_one_of_the_few(table, tmp_path):
    table("take,success\n0,1\n1,1\n", name="folder/a_summary.csv")
    for i in range(3):
        table(PLAIN, name=f"folder/take_{i}.csv")
    with pytest.raises(
        RecordingError, match=r"a_summary\.csv: its columns are .*; take the file ou"
    ):
        read(tmp_path / "folder")
    (tmp_path / "folder" / "a_summary.csv").write_text(PLAIN.replace("a,b", "a [deg],b"))
    with pytest.raises(
        RecordingError, match=r"a_summary\.csv: column 'a' is in \[deg\], in take_0"
    ):
        read(tmp_path / "folder")


@pytest.mark.parametrize("name", ["run", "take", "rep", "trial_no", "ep", "rollout_id", "number"])
def test_numbers_of_episodes_are_taken_for_episodes(table, name):
    found = table(text(f"{name},a,b", np.repeat([0, 1, 2], 8), A, B))

    assert [e.name for e in found.episodes] == ["0", "1", "2"]
    assert found.channels == ("a", "b")
    assert f"--episode {name} says so" in told(found)[0]
    assert not told(table(text(f"{name},a,b", np.repeat([0, 1, 2], 8), A, B), episode=name))


def test_phases_and_grippers_stay_channels(table):
    phases = np.tile(np.repeat([0, 1, 2], 4), 2)
    inside = table(text("episode,phase,a", np.repeat([0, 1], 12), phases, A))
    on = table(text("time,phase,a", T, np.repeat([0, 1, 2], 8), A))
    gripper = table(text("time,grip,a", T, np.repeat([0, 1, 0], 8), A))

    assert inside.usual == on.usual == ("phase", "a")
    assert gripper.usual == ("grip", "a")
    assert not told(inside) + told(gripper)
    assert "--episode phase, if it names them" in told(on)[0]


def test_time_that_begins_again_begins_an_episode(table):
    twice = np.tile(T[:12], 2)
    found = table(text("time,a", twice, A))
    named = table(text("time,object,a", twice, np.repeat([7, 3], 12), A))
    inside = table(text("episode,time,a", ["x"] * 24, twice, A))

    assert [e.name for e in found.episodes] == ["0", "1"]
    assert [e.name for e in named.episodes] == ["7", "3"]
    assert [e.name for e in inside.episodes] == ["x/0", "x/1"]
    assert "time begins again at line 14" in told(found)[0]
    assert "'object': is taken for what names the episodes" in told(named)[0]


def test_rows_of_interleaved_episodes_are_put_together(table):
    found = table(text("episode,time,a", [0, 1] * 12, np.repeat(T[:12], 2), A))

    np.testing.assert_array_equal(found.episodes[1].values[:, 0], A[1::2])
    assert "rows go on at line 4 after those of others" in told(found)[0]


@pytest.mark.parametrize(
    ("words", "low", "high"),
    [
        (("open", "closed"), "closed", "open"),
        (("ON", "off"), "off", "ON"),
        (("yes", "no"), "no", "yes"),
        (("grip", "carry"), "carry", "grip"),
    ],
)
def test_two_words_are_a_binary_channel(table, words, low, high):
    found = table(text("time,a,hand", T, A, words * 12))

    assert found.binary == {"hand": (0.0, 1.0)}
    assert f"'{low}' is read as 0, '{high}' as 1" in told(found)[0]
    np.testing.assert_array_equal(found.episodes[0].values[:2, 1], [w == high for w in words])


def test_words_are_those_of_all_files(table, tmp_path):
    table(text("time,a,hand", T, A, ["open"] * 24), name="folder/a.csv")
    table(text("time,a,hand", T, A, ["open", "closed"] * 12), name="folder/b.csv")
    found = read(tmp_path / "folder")

    np.testing.assert_array_equal(found.episodes[0].values[:, 1], 1)
    np.testing.assert_array_equal(found.episodes[1].values[:2, 1], [1, 0])


def test_more_words_are_left_out_and_said_to_be_no_channel(table):
    found = table(text("time,a,phase", T, A, np.repeat(["reach", "grasp", "lift"], 8)))

    assert found.channels == ("a",)
    assert told(found)[0].endswith("--episode phase, if it names the episodes")
    for pattern in ("phase", "pha*"):
        with pytest.raises(ChannelError, match="'phase': holds words, not numbers"):
            chosen(found, choose(channels=("a", pattern)))
    with pytest.raises(ChannelError, match="unknown channel 'phrase'"):
        chosen(found, choose(channels=("phrase",)))


def test_a_column_without_a_name_is_told_unless_it_numbers_the_rows(table):
    assert not told(table(text(",a", range(24), A)))
    assert "column 1 has no name" in told(table(text(",a", B, A)))[0]
