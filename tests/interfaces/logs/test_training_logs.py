"""Logs of training: what is written is read back, a resumed training goes on where it stood."""

import json
import math
import struct
import sys
import time

import pytest
from rerun.chunk import RrdReader
from tensorboardX.proto.event_pb2 import Event

from motionese.errors import MissingPackageError, SettingError, StorageError
from motionese.interfaces.logs.training_logs import open_logs

KINDS = ("jsonl", "tensorboard", "rerun")


def read_jsonl(folder):
    lines = (folder / "robot.log.jsonl").read_text().splitlines()
    told = [json.loads(line) for line in lines]
    return {
        (line["epoch"], name): number
        for line in told
        for name, number in line.items()
        if name != "epoch" and number is not None
    }


def read_tensorboard(folder):
    """Read the event files as TensorBoard does: a start forgets what came before at its step."""
    scalars = {}
    for path in sorted((folder / "robot.tensorboard").iterdir()):
        content, at = path.read_bytes(), 0
        while at + 12 < len(content):
            (length,) = struct.unpack_from("<Q", content, at)
            event = Event.FromString(content[at + 12 : at + 12 + length])
            at += 12 + length + 4
            if event.session_log.status == event.session_log.START:
                scalars = {key: value for key, value in scalars.items() if key[0] < event.step}
            for value in event.summary.value:
                if math.isfinite(value.simple_value):
                    scalars[event.step, value.tag] = value.simple_value
    return scalars


def read_rerun(folder):
    scalars = {}
    for chunk in RrdReader(folder / "robot.rrd").stream():
        if "epoch" in chunk.timeline_names:
            rows = chunk.to_record_batch().to_pydict()
            for epoch, (number,) in zip(rows["epoch"], rows["Scalars:scalars"], strict=True):
                if math.isfinite(number):
                    scalars[epoch, chunk.entity_path.removeprefix("/")] = number
    return scalars


READERS = {"jsonl": read_jsonl, "tensorboard": read_tensorboard, "rerun": read_rerun}


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_written_is_read_back(kind, tmp_path):
    with open_logs([kind], tmp_path / "robot.safetensors") as logs:
        logs.write(100, {"loss": 2.5, "closed_loop_error": 0.125})
        logs.write(200, {"loss": 0.5, "closed_loop_error": math.nan})

    expected = {(100, "loss"): 2.5, (100, "closed_loop_error"): 0.125, (200, "loss"): 0.5}
    assert READERS[kind](tmp_path) == expected


def test_another_timeline_and_names_that_no_path_could_hold_are_taken(tmp_path, capfd):
    with open_logs(["jsonl", "rerun"], tmp_path / "robot.csv", timeline="row") as logs:
        logs.write(3, {"a b/c [m]": 1.5})

    assert (tmp_path / "robot.log.jsonl").read_text() == '{"row": 3, "a b/c [m]": 1.5}\n'
    chunks = [c for c in RrdReader(tmp_path / "robot.rrd").stream() if "row" in c.timeline_names]
    assert [chunk.entity_path.replace("\\", "") for chunk in chunks] == ["/a b/c [m]"]
    assert chunks[0].to_record_batch().to_pydict()["row"] == [3]
    assert capfd.readouterr() == ("", "")


def test_rows_that_come_fast_are_written_together(tmp_path):
    with open_logs(["rerun"], tmp_path / "robot.csv", timeline="row") as logs:
        for row in range(1000):
            logs.write(row, {"error": 0.5})

    assert (tmp_path / "robot.rrd").stat().st_size < 200_000


@pytest.mark.parametrize("kind", KINDS)
def test_a_resumed_training_goes_on_where_it_stood(kind, tmp_path):
    with open_logs([kind], tmp_path / "robot.safetensors") as logs:
        for epoch in (100, 200, 300, 400):
            logs.write(epoch, {"loss": 1.0})
    with open_logs([kind], tmp_path / "robot.safetensors", after=200) as logs:
        logs.write(300, {"loss": 0.5})

    expected = {(100, "loss"): 1.0, (200, "loss"): 1.0, (300, "loss"): 0.5}
    assert READERS[kind](tmp_path) == expected


@pytest.mark.parametrize("kind", KINDS)
def test_a_training_from_the_start_begins_its_log_anew(kind, tmp_path):
    for epochs in ((100, 200), (100,)):
        with open_logs([kind], tmp_path / "robot.safetensors") as logs:
            for epoch in epochs:
                logs.write(epoch, {"loss": 0.5})

    assert READERS[kind](tmp_path) == {(100, "loss"): 0.5}


@pytest.mark.filterwarnings("ignore:RRD file has no footer")
@pytest.mark.parametrize("kind", KINDS)
def test_what_was_told_is_on_disk_before_the_log_is_closed(kind, tmp_path):
    logs = open_logs([kind], tmp_path / "robot.safetensors")
    logs.write(100, {"loss": 0.5})

    told, until = {}, time.monotonic() + (10 if kind == "tensorboard" else 0)
    while not told:
        told = READERS[kind](tmp_path)
        if time.monotonic() > until:
            break
    logs.close()
    assert told == {(100, "loss"): 0.5}


def test_a_line_that_a_kill_cut_short_is_left_out(tmp_path):
    (tmp_path / "robot.log.jsonl").write_text('{"epoch": 100, "loss": 1.0}\n{"epoch": 20')
    with open_logs(["jsonl"], tmp_path / "robot.safetensors", after=100) as logs:
        logs.write(200, {"loss": 0.5})

    assert read_jsonl(tmp_path) == {(100, "loss"): 1.0, (200, "loss"): 0.5}


def test_several_logs_are_written_side_by_side(tmp_path):
    with open_logs([*KINDS, "jsonl"], tmp_path / "robot.safetensors") as logs:
        logs.write(100, {"loss": 0.5})

    assert [read(tmp_path) for read in READERS.values()] == [{(100, "loss"): 0.5}] * 3


def test_a_recording_that_is_not_one_is_told(tmp_path):
    (tmp_path / "robot.rrd").write_bytes(b"not a recording")

    logs = open_logs(["rerun"], tmp_path / "robot.safetensors", after=100)
    with pytest.raises(StorageError, match=r"robot\.rrd.*move it away"):
        logs.write(200, {"loss": 0.5})


def test_an_unknown_log_is_told(tmp_path):
    with pytest.raises(SettingError, match="unknown log 'tensorbord'; did you mean 'tensorboard'"):
        open_logs(["tensorbord"], tmp_path / "robot.safetensors")


def test_a_missing_package_is_told_before_anything_is_written(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)

    with pytest.raises(MissingPackageError, match=r"'rerun-sdk'.*motionese\[rerun\]"):
        open_logs(["jsonl", "rerun"], tmp_path / "robot.safetensors")
    assert not list(tmp_path.iterdir())
