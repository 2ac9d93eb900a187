"""The command line answers at once, and every mistake with one clear sentence and status 2."""

import pytest

from motionese.interfaces.commands.command_line import spread


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        (["report", "runs/a"], ["report", "runs/a"]),
        (["--set", "a=1", "b=2"], ["--set", "a=1", "--set", "b=2"]),
        (
            ["--conditions", "TD/MD", "TND/MD", "--seeds", "3", "--set", "a=-1"],
            ["--conditions", "TD/MD", "--conditions", "TND/MD", "--seeds", "3", "--set", "a=-1"],
        ),
        (["--seeds", "3", "4"], ["--seeds", "3", "4"]),
        (["--quick", "x"], ["--quick", "x"]),
    ],
)
def test_several_values_may_follow_an_option(written, meant):
    assert spread(written) == meant


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--help"], "reproduce"),
        ([], "reproduce"),
        (["reproduce", "--help"], "10 means seeds 0 to 9"),
        (["--version"], "motionese 0."),
        (["presets"], "paper: The paper to the letter"),
        (["presets"], "  stage 1, TND/MD, TND/MND: taught pairs (UR ↓↑, LR ↑←, UR ←↓, UL ↓↑)\n"),
        (["presets"], "  stage 3, all conditions: UR ↓↑←, LR ↑←↓, UR ←↓↑\n"),
        (["presets"], "    this lesson asks for no memory of order (D_corner 1.07, D_last 0.29, "),
        (["presets", "default"], "until = { loops = 15 }"),
    ],
)
def test_what_is_asked_for_is_printed(command, arguments, told):
    status, output, errors = command(*arguments)
    assert status == (0 if arguments else 2)
    assert told in output
    assert errors == ""


IMPOSSIBLE = '[[stages]]\nlesson = ["UR ↓↓"]\nlevels = ["io", "cf"]\nuntil = {loops = 1}\n'
NARROW = (
    "[network.levels]\nio = {size = 5, tau = 2}\ncf = {size = 9, tau = 5}\ncs = {size = 2, tau = 9}"
)
WRONG = {
    "condition": (["--conditions", "TD/MX"], "unknown condition 'TD/MX'; did you mean 'TD/MD'?"),
    "no seeds": (["--seeds", "0"], "--seeds 0: there are no such seeds"),
    "preset": (["--preset", "papper"], "unknown preset 'papper'; did you mean 'paper'?"),
    "no TOML": (["--preset", "wrong.toml"], "wrong.toml: not a TOML file"),
    "setting": (["--set", "training.epoch=5"], "did you mean 'training.epochs'?"),
    "level": (["--set", "training.noise.cx=1"], "unknown level in training.noise 'cx'"),
    "place": (["--set", "task.places.UX=[0,0,0]"], "unknown place 'UX'; did you mean 'U"),
    "task": (["--set", "task.name='shape'"], "unknown task 'shape'; did you mean 'shapes'?"),
    "body": (["--set", "body.name='desk'"], "body.name = 'desk': "),
    "tau": (["--set", "network.levels.cs.tau=0.5"], "network.levels.cs.tau = 0.5: "),
    "size": (["--set", "network.levels.cf.size=0"], "network.levels.cf.size = 0: "),
    "IO": (["--preset", "narrow.toml"], "one unit per channel (6), got 5"),
    "loops": (["--set", "stages.0.until.loops=0"], "stages.0.until.loops = 0: "),
    "stage": (["--set", "stages.2.until.loops=5"], "unknown setting 'stages.2'"),
    "no level": (["--set", "stages.1.levels=['io', 'cx']"], "unknown level in stages.1.levels"),
    "closed": (["--set", "stages.1.levels=['io', 'cf']"], "closes a level that stage 0 has opened"),
    "before": (["--set", "phases.loops=5"], "it is now [[stages]], each with until = { loops"),
    "no value": (["--set", "training.epochs"], "--set takes name=value, got 'training.epochs'"),
    "vision": (["--vision", "magic"], "body.vision = 'magic': "),
    "sequence": (["--preset", "impossible.toml"], "impossible sequence 'UR ↓↓'"),
    "reach": (["--set", "task.places.UR=[9,9,9]"], "place UR"),
    "file": (["--out", "wrong.toml"], "wrong.toml is a file"),
    "foreign": (["--out", "."], ". is not empty and no run folder"),
    "nowhere": (["--out", "wrong.toml/runs"], "wrong.toml/runs cannot be written to"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence_and_leaves_nothing_behind(
    command, here, arguments, told
):
    (here / "wrong.toml").write_text("no [TOML")
    (here / "impossible.toml").write_text(IMPOSSIBLE)
    (here / "narrow.toml").write_text(NARROW)
    status, output, errors = command("reproduce", "--quick", *arguments)
    assert status == 2
    assert output == ""
    assert errors.startswith("motionese: ")
    assert errors.count("\n") == 1
    assert told in errors
    assert {p.name for p in here.iterdir()} == {"impossible.toml", "narrow.toml", "wrong.toml"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["presets", "defualt"], "unknown preset 'defualt'; did you mean 'default'?"),
        (["report", "nowhere"], "nowhere is no run folder: there is no such folder"),
        (["report", "."], ". is no run folder: it has no settings.json"),
    ],
)
def test_the_other_commands_answer_a_mistake_so_too(command, arguments, told):
    status, output, errors = command(*arguments)
    assert (status, output) == (2, "")
    assert errors.startswith(f"motionese: {told}")


@pytest.mark.parametrize(
    "arguments", [["reproduse"], ["reproduce", "--seed", "3"], ["reproduce", "--workers", "0"]]
)
def test_what_is_no_command_or_option_ends_with_status_2(command, arguments):
    status, _, errors = command(*arguments)
    assert status == 2
    assert "Traceback" not in errors
