"""Progress on a terminal and elsewhere."""

import io
from types import SimpleNamespace

import pytest
from rich.console import Console

from motionese.experiment import Condition
from motionese.experiment.digests import list_files
from motionese.experiment.many_runs import Job
from motionese.experiment.run import Run
from motionese.interfaces.commands import display as module
from motionese.interfaces.commands.display import Display


@pytest.fixture
def runs(tmp_path):
    runs = [Run(Condition(("TD", "MD")), seed, tmp_path / str(seed)) for seed in (0, 1, 2)]
    for run in runs[1:]:
        run.folder.mkdir()
    (runs[1].folder / "loop-01.safetensors").touch()
    (runs[2].folder / "ended.json").write_text('{"status": "diverged"}')
    list_files(runs[1].folder, ["loop-01.safetensors"])
    list_files(runs[2].folder, ["ended.json"])
    return runs


def of_loops(runs, loops, series=""):
    """The runs with settings of so many loops."""
    return [Job(run, SimpleNamespace(most_loops=lambda: loops), series=series) for run in runs]


def console(terminal):
    return Console(file=io.StringIO(), force_terminal=terminal, width=100)


def test_elsewhere_a_line_for_every_run_that_ends(runs):
    runs = of_loops(runs, 4)
    out = console(terminal=False)
    with Display(out, runs) as display:
        display.loop_done(runs[0], 0)
        display.loop_done(runs[1], 1)
        display.loop_done(runs[0], 1)
        assert out.file.getvalue() == ""
        display.run_ended(runs[0], "")
        display.run_ended(runs[1], "its checkpoint is cut short")
    first, second = out.file.getvalue().splitlines()
    assert first.startswith("TD/MD seed 0 ended; 1 run to go, 9 of 12 loops")
    assert second.startswith("TD/MD seed 1 cannot go on; 0 runs to go, 12 of 12 loops")


def test_elsewhere_a_line_now_and_then(runs, monkeypatch):
    runs = of_loops(runs, 4)
    monkeypatch.setattr(module, "LINE_EVERY_S", 0.0)
    out = console(terminal=False)
    with Display(out, runs) as display:
        display.loop_done(runs[0], 2)
    assert out.file.getvalue().startswith("going on; 2 runs to go, 7 of 12 loops")


def test_a_run_that_is_begun_again_is_not_counted_twice(runs, monkeypatch):
    runs = of_loops(runs, 4)
    monkeypatch.setattr(module, "LINE_EVERY_S", 0.0)
    out = console(terminal=False)
    with Display(out, runs) as display:
        for loop in (2, 1, 2, 3):
            display.loop_done(runs[0], loop)
    assert "8 of 12 loops" in out.file.getvalue().splitlines()[-1]


def test_on_a_terminal_one_bar_for_all_and_one_for_each_under_way(runs):
    runs = of_loops(runs, 4)
    out = console(terminal=True)
    with Display(out, runs) as display:
        display.loop_done(runs[0], 1)
        display.loop_done(runs[1], 4)
        display._bars.refresh()
        shown = out.file.getvalue()
    assert "all runs" in shown
    assert "TD/MD seed 0" in shown
    assert "TD/MD seed 1, evaluation" in shown
    assert "TD/MD seed 2" not in shown
    assert "9/12" in shown.replace(" ", "")


def test_runs_of_several_presets_are_counted_together_each_with_its_own_loops(runs, monkeypatch):
    monkeypatch.setattr(module, "LINE_EVERY_S", 0.0)
    out = console(terminal=False)
    short, long = of_loops(runs[:1], 4, "brief"), of_loops(runs[:1], 30, "order")
    with Display(out, [*short, *long]) as display:
        display.loop_done(short[0], 2)
        display.loop_done(long[0], 3)
        display.run_ended(short[0], "")
    told = out.file.getvalue().splitlines()
    assert told[-2].startswith("going on; 2 runs to go, 5 of 34 loops")
    assert told[-1].startswith("brief TD/MD seed 0 ended; 1 run to go, 7 of 34 loops")


@pytest.mark.parametrize(
    ("loops", "seconds_a_loop", "told"),
    [(1, 9, ""), (2, 1, "about 18 s left"), (4, 60, "about 16 min left")],
)
def test_time_left_is_told_once_a_tenth_is_done(runs, monkeypatch, loops, seconds_a_loop, told):
    monkeypatch.setattr(module, "LINE_EVERY_S", -1.0)
    now = [0.0]
    out = console(terminal=False)
    runs = of_loops(runs[:1], 20)
    display = Display(out, runs)
    display._bars.get_time = lambda: now[0]
    display._bars.reset(display._all)
    for loop in range(loops + 1):
        display.loop_done(runs[0], loop)
        now[0] += seconds_a_loop
    line = out.file.getvalue().splitlines()[-1]
    assert line == ", ".join(filter(None, [f"going on; 1 run to go, {loops} of 20 loops", told]))
