"""Sweeps: their points, and what is refused."""

import pytest

from motionese.errors import RunFolderError, SettingError
from motionese.experiment import read_settings
from motionese.experiment.sweeps import (
    SWEEPS,
    SWEPT,
    Sweep,
    read_sweep,
    read_varied,
    sweep_in,
    titles,
)


@pytest.mark.parametrize("name", SWEEPS)
def test_every_sweep_that_comes_with_motionese_can_be_run_and_has_its_preset_among_its_points(name):
    sweep = read_sweep(name)
    plain = read_settings(sweep.preset)
    assert [read_settings(sweep.preset, p.overrides) for p in sweep.points].count(plain) == 1
    assert dict(titles())[name]


def test_several_settings_make_a_grid_whose_names_are_as_short_as_can_be():
    sweep = Sweep(vary={"network.levels.cf.tau": [5, 8], "network.levels.cs.tau": [70.0, 9]})
    assert [point.label for point in sweep.points] == [
        *("cf.tau=5,cs.tau=70.0", "cf.tau=5,cs.tau=9"),
        *("cf.tau=8,cs.tau=70.0", "cf.tau=8,cs.tau=9"),
    ]
    assert sweep.points[1].overrides == ("network.levels.cf.tau=5", "network.levels.cs.tau=9")


def test_names_that_end_the_same_are_longer():
    sweep = Sweep(vary={"training.bound.cs": [1], "recognition.bound.cs": [1, 2]})
    assert sweep.points[0].label == "training.bound.cs=1,recognition.bound.cs=1"


def test_a_file_may_list_any_settings_with_names(tmp_path):
    file = tmp_path / "attention.toml"
    file.write_text(
        'preset = "free"\nconditions = ["TD/MD"]\n[[settings]]\nname = "to rests"\n'
        '"training.attention.strength" = 3\n[[settings]]\n"training.attention.strength" = 3\n'
        '"training.attention.to" = "movement"\n'
    )
    first, second = read_sweep(str(file)).points
    assert first.label == "to rests"
    assert second.label == "attention.strength=3,attention.to=movement"
    settings = read_settings("free", second.overrides)
    assert (settings.training.attention.to, settings.training.attention.strength) == ("movement", 3)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[vary]\n"a.b" = ["x", 2]', "a.b is to be varied over numbers, got 'x'; other values"),
        ('[vary]\n"a.b" = [true, 2]', "a.b is to be varied over numbers, got True"),
        ('[vary]\n"a.b" = [2, 2]', r"a.b needs numbers, each of them once; got \[2, 2\]"),
        ('[vary]\n"a.b" = [2]', "a sweep has 2 to 200 points, got 1"),
        (f'[vary]\n"a.b" = {list(range(201))}', "a sweep has 2 to 200 points, got 201"),
        ("", r"a sweep has either \[vary\] or \[\[settings\]\]"),
        ('[[settings]]\nname = "a/b"\n[[settings]]\nx = 1', "point 'a/b' needs a name of letters"),
        ('[[settings]]\nname = "a"\n[[settings]]\nname = "a"', "several points are called 'a'"),
        ("varied = 1", "unknown setting 'varied'"),
        ("varied", "not a TOML file"),
    ],
)
def test_a_sweep_that_cannot_be_is_refused_in_a_sentence(tmp_path, text, told):
    file = tmp_path / "mine.toml"
    file.write_text(text)
    with pytest.raises(SettingError, match=f"^{file}: .*{told}"):
        read_sweep(str(file))


def test_a_sweep_that_does_not_exist_is_told_with_those_that_do():
    with pytest.raises(SettingError, match=r"unknown sweep 'slow-tau'.*slow_tau.*a TOML file"):
        read_sweep("slow-tau")


def test_what_is_varied_can_be_said_in_a_line():
    assert read_varied(["a.b=1,2.5", "c=-1,1e3"]) == {"a.b": [1, 2.5], "c": [-1, 1000.0]}


@pytest.mark.parametrize("text", ["a", "a=", "a=x,1", "a=1,,2"])
def test_a_line_that_says_no_numbers_is_refused(text):
    with pytest.raises(SettingError, match=r"^--vary .*a sweep is over numbers"):
        read_varied([text])


def test_a_sweep_is_read_back_from_its_folder(tmp_path):
    assert sweep_in(tmp_path) is None
    sweep = read_sweep("pauses")
    (tmp_path / SWEPT).write_text(sweep.model_dump_json())
    assert sweep_in(tmp_path) == sweep
    (tmp_path / SWEPT).write_text("{")
    with pytest.raises(RunFolderError, match="remove it, and the same `motionese sweep` command"):
        sweep_in(tmp_path)
