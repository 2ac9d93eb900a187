"""`motionese reproduce --caregiver`: a person's demonstrations in the experiment."""

import json

import pytest

from motionese.caregiver import DEMONSTRATIONS, intended_way, recording_of
from motionese.recordings import write


@pytest.fixture
def shown(small_settings, here):
    """A folder in which a person's demonstrations lie."""
    task = small_settings.task.task()
    paths = [(name, intended_way(task.sequence(name), task)) for name in ("UR ↓", "UR ←")]
    (here / "taught").mkdir()
    write(here / "taught" / DEMONSTRATIONS, recording_of(paths, rate_hz=20.0))
    return "recordings:taught"


def test_recorded_demonstrations_are_shown_and_noted(command, shown, here, monkeypatch):
    asked = {}

    def go_through_all(jobs, workers, **told):
        asked.update(jobs=jobs)
        return ["not gone through"]

    monkeypatch.setattr("motionese.interfaces.commands.reproduce.go_through_all", go_through_all)
    arguments = ("reproduce", "--quick", "--seeds", "1", "--out", "run")
    status, output, errors = command(*arguments, "--caregiver", shown)
    assert status == 2 and "not gone through" in errors and "UR ↓, UR ←" in output
    assert {tuple(job.recordings) for job in asked["jobs"]} == {("UR ↓", "UR ←")}
    digest = json.loads((here / "run" / "settings.json").read_text())["demonstrations"]
    assert {job.run.shown for job in asked["jobs"]} == {digest}
    status, _, errors = command(*arguments)
    assert status == 2 and "other demonstrations" in errors


@pytest.mark.parametrize(
    ("caregiver", "said"),
    [
        ("recordings:nowhere", "nowhere"),
        ("recordings:", "recordings:FOLDER"),
        ("me", "recordings:FOLDER"),
    ],
)
def test_a_caregiver_that_is_not_there_is_refused(command, here, caregiver, said):
    status, _, errors = command("reproduce", "--quick", "--out", "run", "--caregiver", caregiver)
    assert status == 2 and said in errors and errors.count("\n") == 1
    assert not (here / "run").exists()
