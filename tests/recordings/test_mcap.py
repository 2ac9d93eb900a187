"""MCAP: JSON messages of any shape become channels, and ours come back as they were."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from motionese.errors import MotioneseError, RecordingError
from motionese.recordings import read, write
from motionese.recordings.formats.json_messages import numbers

START = 1_700_000_000_000_000_000
"""A log time of today [ns], which a float does not hold exactly."""


def tape(path, messages, encoding="json", **options):
    """Write (topic, time [s], message) as a recorder does."""
    with path.open("wb") as file:
        writer = Writer(file, **options)
        writer.start()
        schema = writer.register_schema("any", "jsonschema", b"{}")
        topics = {}
        for topic, time, message in messages:
            if topic not in topics:
                topics[topic] = writer.register_channel(topic, encoding, schema)
            content = message if isinstance(message, bytes) else json.dumps(message).encode()
            stamp = START + round(time * 1e9)
            writer.add_message(topics[topic], stamp, content, stamp)
        writer.finish()
    return path


def joint_state(row, **more):
    position = [row + 0.5, -row]
    return {"header": {"seq": row}, "name": ["elbow", "wrist"], "position": position, **more}


def test_what_was_written_reads_the_same(recording, tmp_path):
    write(tmp_path / "out", recording, "mcap")
    found = read(tmp_path / "out")

    assert (found.channels, found.units) == (recording.channels, recording.units)
    assert (found.rate_hz, found.usual) == (25.0, recording.channels)
    assert [e.times for e in found.episodes] == [None, None]
    for was, now in zip(recording.episodes, found.episodes, strict=True):
        assert now.name == was.name
        np.testing.assert_array_equal(now.observed, was.observed)
        np.testing.assert_array_equal(now.values[now.observed], was.values[was.observed])


def test_rows_in_which_nothing_was_observed_are_kept(recording, tmp_path):
    first = recording.episodes[0]
    blind = replace(first, observed=np.zeros_like(first.observed))
    write(tmp_path / "out.mcap", replace(recording, episodes=(blind,)))
    found = read(tmp_path / "out.mcap")

    assert found.channels == recording.channels
    assert not found.episodes[0].observed.any()
    assert found.episodes[0].observed.shape == (7, 3)


def test_uneven_times_are_kept_from_the_first_on(recording, tmp_path):
    times = np.array([3, 3.1, 3.15, 4, 5, 6, 8.5])
    timed = replace(recording.episodes[0], times=times)
    write(tmp_path / "out.mcap", replace(recording, episodes=(timed,), rate_hz=None))

    np.testing.assert_allclose(read(tmp_path / "out.mcap").episodes[0].times, times - 3, atol=1e-9)


def test_our_messages_are_plain_json_for_others(recording, tmp_path):
    write(tmp_path / "out", recording, "mcap")
    files = sorted(f.name for f in (tmp_path / "out").iterdir())
    assert files == ["0000_UR_.mcap", "0001_wave_left_.mcap"]
    with (tmp_path / "out" / files[0]).open("rb") as file:
        schema, topic, message = next(make_reader(file).iter_messages())

    assert (topic.topic, topic.message_encoding, schema.encoding) == (
        "/motion",
        "json",
        "jsonschema",
    )
    assert list(json.loads(schema.data)["properties"]) == list(recording.channels)
    first = recording.episodes[0]
    expected = {
        name: value
        for name, value, seen in zip(
            recording.channels, first.values[0], first.observed[0], strict=True
        )
        if seen
    }
    assert json.loads(message.data) == expected


def test_what_an_mcap_file_cannot_hold_is_refused(recording, tmp_path):
    one = replace(recording, episodes=recording.episodes[1:])
    with_nan = recording.episodes[1].values.copy()
    with_nan[2, 1] = np.nan
    nan = replace(one.episodes[0], values=with_nan)
    back = replace(one.episodes[0], times=np.array([0.0, 1, 1, 2]))
    for bad, sentence in (
        (recording, "holds one episode, the recording has 2: give the name of a folder"),
        (replace(one, episodes=(nan,)), "row 2, channel 'hand, x': JSON cannot hold nan"),
        (replace(one, rate_hz=None), "has no times, and the recording no known rate"),
        (replace(one, episodes=(back,)), "its times do not rise"),
    ):
        with pytest.raises(RecordingError, match=sentence):
            write(tmp_path / "out.mcap", bad)
    assert not list(tmp_path.iterdir())


def test_topics_that_speak_at_their_own_times_are_put_side_by_side(tmp_path):
    messages = [("/joints", 0.01 * i, joint_state(i)) for i in range(9)]
    messages += [("/gaze", 0.025 * i + 0.002, {"pan": i, "on": True, "by": "me"}) for i in range(4)]
    messages += [("/notes", 0.001, {"text": "go"})]
    found = read(tape(tmp_path / "wave.mcap", messages))

    assert found.channels == (
        "/joints.header.seq",
        "/joints.position.elbow",
        "/joints.position.wrist",
        "/gaze.pan",
    )
    assert found.usual == found.channels[1:]
    assert found.rate_hz == 100.0
    (episode,) = found.episodes
    assert episode.name == "wave"
    expected = sorted([0.01 * i for i in range(9)] + [0.025 * i + 0.002 for i in range(4)])
    np.testing.assert_allclose(episode.times, expected, atol=1e-9)
    assert episode.observed[:, 1].sum() == 9
    assert episode.values[episode.observed[:, 3], 3].tolist() == [0, 1, 2, 3]
    assert not (episode.observed[:, 1] & episode.observed[:, 3]).any()


def test_a_folder_is_read_in_natural_order_and_a_missing_channel_is_a_gap(tmp_path):
    for i in (10, 9, 1):
        more = {"velocity": [1, 2]} if i == 9 else {}
        tape(tmp_path / f"take_{i}.mcap", [("/j", t, joint_state(t, **more)) for t in range(3)])
    found = read(tmp_path)

    assert [e.name for e in found.episodes] == ["take_1", "take_9", "take_10"]
    column = found.channels.index("/j.velocity.wrist")
    assert [e.observed[:, column].all() for e in found.episodes] == [False, True, False]


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        (1.5, {"": 1.5}),
        ({"a": {"b": 2}, "c": [3, [4]]}, {".a.b": 2, ".c[0]": 3, ".c[1][0]": 4}),
        ({"ok": True, "n": None, "s": "3", "long": [0] * 600}, {}),
        ({"name": ["x", "y"], "p": [1, 2], "q": [3]}, {".p.x": 1, ".p.y": 2, ".q[0]": 3}),
        ({"name": ["x", "x"], "p": [1, 2]}, {".p[0]": 1, ".p[1]": 2}),
        ({"name": "x", "p": [1]}, {".p[0]": 1}),
    ],
)
def test_numbers_are_found_where_they_stand(message, expected):
    assert dict(numbers(message)) == expected


def test_messages_in_other_encodings_are_named(tmp_path):
    path = tape(tmp_path / "a.mcap", [("/joints", 0, b"\x00\x01")], encoding="protobuf")
    with pytest.raises(RecordingError, match=r"a\.mcap: no numbers of .*: /joints \(any\)"):
        read(path)


def test_a_message_that_is_no_json_is_refused(tmp_path):
    path = tape(tmp_path / "a.mcap", [("/j", 0, {"a": 1}), ("/j", 0.5, b"{'a': 1}")])
    with pytest.raises(
        RecordingError, match=r"topic /j: the message at 17000000005\d* ns is not JSON"
    ):
        read(path)
    tape(path, [("/j", 0, b"1" + b"0" * 400)])
    with pytest.raises(RecordingError, match="is not JSON"):
        read(path)
    tape(path, [("/j", 0, b"[" * 100_000)])
    with pytest.raises(RecordingError, match="is not JSON"):
        read(path)


def test_metadata_of_another_version_are_refused(recording, tmp_path):
    one = replace(recording, episodes=recording.episodes[1:])
    path = tmp_path / "out.mcap"
    write(path, one)
    with path.open("rb") as file:
        _, topic, message = next(make_reader(file).iter_messages())
    told = json.loads(topic.metadata["motionese"])
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        metadata = {"motionese": json.dumps({**told, "version": 2})}
        channel = writer.register_channel("/motion", "json", 0, metadata)
        writer.add_message(channel, 0, message.data, 0)
        writer.finish()
    with pytest.raises(RecordingError, match="is not what this version writes: version: Input"):
        read(path)


def test_a_file_that_is_cut_short_is_refused_with_what_would_save_it(recording, tmp_path):
    path = tape(
        tmp_path / "a.mcap",
        [("/j", 0.1 * i, joint_state(i)) for i in range(50)],
        use_chunking=False,
    )
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(RecordingError, match=r"damaged after \d+ messages .*`mcap recover` saves"):
        read(path)


def test_a_changed_byte_is_noticed_by_its_checksum(tmp_path):
    messages = [("/j", 0.1 * i, {"a": i}) for i in range(9)]
    path = tape(tmp_path / "a.mcap", messages, compression=CompressionType.NONE)
    path.write_bytes(path.read_bytes().replace(b'{"a": 7}', b'{"a": 9}'))
    with pytest.raises(RecordingError, match=r"damaged after 0 messages .crc validation failed"):
        read(path)


def test_topics_silences_and_marks_are_those_of_bags(tmp_path):
    messages = [("/joints", 0.1 * i, joint_state(i)) for i in range(20) if not 8 <= i < 14]
    messages += [("/gaze", 0.1 * i, {"pan": i}) for i in range(8)]
    messages += [("/take", 0.35, {"data": "reach"}), ("/take", 0.65, {"data": False})]
    path = tape(tmp_path / "a.mcap", sorted(messages, key=lambda m: m[1]))

    found = read(path, topics=["/ga*"])
    assert (found.channels, found.findings) == (("/gaze.pan",), ())
    assert [(e.name, len(e.values)) for e in read(path, pause=0.5).episodes] == [
        ("a_0", 8),
        ("a_1", 6),
    ]
    (reach,) = read(path, topics="/ga*", marker="/take").episodes
    assert (reach.name, reach.values.ravel().tolist()) == ("reach", [4, 5, 6])


def test_of_other_encodings_it_is_told_that_they_are_left_out(tmp_path):
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start()
        topics = {e: writer.register_channel(f"/{e}", e, 0) for e in ("json", "protobuf", "quiet")}
        for encoding in ("json", "protobuf"):
            writer.add_message(topics[encoding], START, b'{"a": 1}', START)
        writer.finish()
    (finding,) = read(tmp_path / "a.mcap").findings

    assert "left out: /protobuf (as protobuf)" in finding.sentence


def tried_when_damaged(tmp_path, data, chunked):
    messages = [("/j", 0.1 * i, joint_state(i)) for i in range(4)]
    path = tape(tmp_path / "a.mcap", messages, use_chunking=chunked, enable_crcs=chunked)
    damaged = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        damaged[data.draw(st.integers(0, len(damaged) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(damaged[: data.draw(st.integers(0, len(damaged)))] if chunked else damaged)
    try:
        read(path)
    except MotioneseError as error:
        assert "\n" not in str(error)


@settings(max_examples=60)
@given(data=st.data(), chunked=st.booleans())
def test_a_damaged_file_gives_a_recording_or_one_sentence(tmp_path, data, chunked):
    tried_when_damaged(tmp_path, data, chunked)


@pytest.mark.slow
@settings(max_examples=2000)
@given(data=st.data(), chunked=st.booleans())
def test_many_damaged_files_do_too(tmp_path, data, chunked):
    tried_when_damaged(tmp_path, data, chunked)
