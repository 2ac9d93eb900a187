"""`motionese train`: recordings in, a model out, told how good it is before a robot moves."""

import json
import re
import signal
from dataclasses import replace

import numpy as np
import pytest
from typed import CHANNELS, NAMES, arm_motions, refused, typed, write_csv

from motionese import Motions, Training, load, save
from motionese.interfaces.commands.display import TrainingDisplay
from motionese.interfaces.commands.train import read_held_out, read_training

SHORT = ("--levels", "10:3,3:15", "--epochs", "100", "--held-out", "0")
HELD_OUT = ("--levels", "10:3,3:15", "--held-out", "wave,lift", "--set", "noise=cf:0.01")
LONGER = (*HELD_OUT, "--epochs", "300")


def trained_model(*arguments):
    """Train on the demonstrations; return the fit and what was told."""
    status, output, errors = typed("train", "data.npz", "--out", "new.safetensors", *arguments)
    assert (status, errors) == (0, ""), errors
    return load("new.safetensors"), output


def test_errors_are_told_in_closed_loop_and_teacher_forced(trained):
    told, fit = (trained / "train.txt").read_text(), load(trained / "arm.safetensors")

    assert "data.npz: 5 motions of 20 to 24 rows at 20 Hz, 4 channels" in told
    assert "Levels io 4:2, 10:3,3:15; 5 motions to learn, 0 held out" in told
    forced, closed = fit.teacher_forced_error, fit.closed_loop_error
    assert fit.share(closed) < 0.1
    for i, channel in enumerate(fit.network.channels):
        errors = [np.sqrt((e[:, i] ** 2).mean()) for e in (forced, closed)]
        cells = [f"{e:.3g} ({e / (channel.high - channel.low):.1%})" for e in errors]
        row = next(line for line in told.splitlines() if f"│ {channel.name} " in line)
        assert [c.strip() for c in row.split("│")[2:-1]] == [channel.unit, *cells]
    assert f"teacher-forced {fit.share(forced):.1%}, closed loop {fit.share(closed):.1%}" in told
    assert told.endswith("stopped: all 300 epochs done. The model is arm.safetensors\n")
    assert fit.names == NAMES


def test_a_model_that_would_not_move_is_called_so_and_training_it_stops_early(arm):
    fit, told = trained_model(
        *("--levels", "10:3,3:15", "--io-tau", "3", "--epochs", "900", "--held-out", "0"),
        *("--patience", "50", "--set", "weight_rate=0", "initial_rate=0"),
    )

    assert "Levels io 4:3, 10:3,3:15" in told
    assert len(fit.losses) == 100
    assert "converged: the loss fell by less than 0.001 of itself in 50 epochs" in told
    assert "On a robot these motions would not be recognisable" in told


def test_motions_left_in_the_file_are_learned_in_batches(arm):
    short = (*SHORT, "--batch", "2", "--epochs", "10")

    whole, _ = trained_model(*short)
    stored, told = trained_model(*short, "--stored")

    assert "data.npz: 5 motions of 20 to 24 rows at 20 Hz, 4 channels" in told
    np.testing.assert_array_equal(stored.losses, whole.losses)
    np.testing.assert_array_equal(stored.network.weights, whole.network.weights)


def test_batches_threads_and_stored_motions_that_cannot_be_are_refused(arm):
    given = ("train", "data.npz", "--out", "new.safetensors", *SHORT)
    for options, sentence in {
        ("--batch", "6"): "batch must be at most the number of motions to learn, 5, got 6",
        ("--threads", "9"): "--threads 9: there are",
        ("--stored",): "--stored reads one batch of motions after another; give --batch",
        (
            "--stored",
            "--batch",
            "2",
            "--begin",
            "arm.safetensors",
        ): "--stored: with --begin motions are read whole",
        ("--stored", "--batch", "2", "--trim", "0.1"): "trim looks at all episodes together",
    }.items():
        assert sentence in refused(*given, *options)


@pytest.mark.slow
def test_errors_of_held_out_motions_are_told_and_logged(arm):
    fit, told = trained_model(*HELD_OUT, "--epochs", "100", "--log", "jsonl")

    assert (fit.names, fit.validation_names) == (("reach", "push", "pull"), ("lift", "wave"))
    assert "3 motions to learn, 2 held out" in told
    assert f"held-out motions {fit.share(fit.validation_error):.1%}, recognised" in told
    (line,) = map(json.loads, (arm / "new.log.jsonl").read_text().splitlines())
    assert set(line) == {
        *("epoch", "loss", "closed_loop_error"),
        *("validation_loss", "validation_error"),
    }
    assert (line["epoch"], line["loss"]) == (100, fit.losses[-1])


@pytest.mark.slow
def test_what_the_file_sets_apart_is_held_out(arm):
    replace(Motions.read("data.npz"), held_out=("push",)).write("apart.npz")
    status, told, errors = typed("train", "apart.npz", "--epochs", "1", "--out", "new.safetensors")
    fit = load("new.safetensors")

    assert (status, errors) == (0, "")
    assert fit.validation_names == ("push",)
    assert "4 motions to learn, 1 held out, as the file says; Ctrl-C" in told


def test_a_number_is_a_motion_where_one_has_that_name_and_below_one_a_share(arm):
    write_csv("demos.csv", dict(zip("0123", arm_motions().values(), strict=False)))
    motions = Motions.read("demos.csv")

    assert read_held_out(None, motions) is None
    assert [read_held_out(text, motions) for text in ("0", "0.5", "5")] == [0, 0.5, 5]
    assert read_held_out("1", motions) == ["1"]
    assert read_held_out("2, 0", motions) == ["2", "0"]


def test_settings_are_given_by_name_and_by_level():
    settings = read_training(7, 3, ["teacher_forcing=0.5", "bound=cf:2,cs:0.25", "clip=2"])

    assert settings == Training(
        epochs=7, patience=3, teacher_forcing=0.5, bound={"cf": 2, "cs": 0.25}, clip=2
    )
    assert read_training(None, None, ["bound=3"]) == Training(bound=3)


def test_gaps_are_trained_around(arm):
    write_csv("demos.csv", cell=("wave", 3, 1, ""))
    status, output, _ = typed("train", "demos.csv", "--out", "new.safetensors", *SHORT)

    assert status == 0
    assert "0.2% not observed" in output
    assert np.isfinite(load("new.safetensors").closed_loop_error).all()


@pytest.fixture
def stopped_at(monkeypatch):
    """Let Ctrl-C come after so many epochs."""

    def at(epochs):
        def show(self, progress):
            if progress.epoch == epochs:
                raise KeyboardInterrupt

        monkeypatch.setattr(TrainingDisplay, "show", show)

    return at


@pytest.mark.slow
def test_a_training_that_was_stopped_ends_as_one_that_was_not(arm, stopped_at):
    trained_model(*LONGER, "--log", "jsonl")
    whole, log = (arm / "new.safetensors").read_bytes(), (arm / "new.log.jsonl").read_bytes()
    (arm / "new.safetensors").unlink()

    command = ("train", "data.npz", "--out", "new.safetensors", *LONGER, "--log", "jsonl")
    stopped_at(200)
    status, _, errors = typed(*command)
    assert status == 130
    assert errors == "\nmotionese: stopped; the same command with --resume goes on\n"
    assert not (arm / "new.safetensors").exists()
    assert "a training of this model was stopped; go on with it with --resume" in refused(*command)

    stopped_at(None)
    status, _, errors = typed(*command, "--resume")
    assert (status, errors) == (0, "")
    assert (arm / "new.safetensors").read_bytes() == whole
    assert not (arm / "new.checkpoint").exists()
    epochs = [json.loads(line)["epoch"] for line in (arm / "new.log.jsonl").open()]
    assert epochs == [100, 300]
    assert set((arm / "new.log.jsonl").read_bytes().splitlines()) < set(log.splitlines())


def test_a_kill_before_the_model_is_saved_loses_nothing(arm, monkeypatch):
    command = ("train", "data.npz", "--out", "new.safetensors", *SHORT)

    def killed(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("motionese.interfaces.commands.train.write_fit", killed)
        typed(*command)
    assert not (arm / "new.safetensors").exists()

    status, _, errors = typed(*command, "--resume")

    assert (status, errors) == (0, "")
    assert (arm / "new.safetensors").exists()
    assert not (arm / "new.checkpoint").exists()


@pytest.mark.slow
def test_a_training_is_gone_on_with_only_as_it_was_begun(arm, stopped_at):
    command = ("train", "data.npz", "--out", "new.safetensors", *SHORT, "--log", "jsonl")
    stopped_at(100)
    typed(*command)
    (arm / "new.log.jsonl").write_text('{"epoch": 100}\n')

    for changed, told in (
        (("--set", "weight_rate=0.01"), "begun with other settings"),
        (("--levels", "9:3,3:15"), "begun with other networks"),
        (("--channels", "x"), "begun with other "),
        (("--held-out", "wave"), "begun with other motions"),
    ):
        assert told in refused(*command, "--resume", *changed)

    whole = (arm / "new.checkpoint").read_bytes()
    for content in (whole[: len(whole) // 2], b"", b"{}", (arm / "arm.safetensors").read_bytes()):
        (arm / "new.checkpoint").write_bytes(content)
        assert "new.checkpoint: not a" in refused(*command, "--resume")


def test_a_training_that_diverged_is_told(arm):
    status, _, errors = typed(
        "train", "data.npz", "--out", "new.safetensors", *SHORT, "--set", "noise=cf:1e38"
    )

    assert status == 2
    assert re.fullmatch("motionese: .*no longer finite at epoch .*smaller rates.*\n", errors)


def test_motions_of_which_nothing_is_learned_are_told(arm):
    write_csv("demos.csv", {"a": np.zeros((2, 1)), "b": np.ones((2, 1))}, channels=["x"])
    text = (arm / "demos.csv").read_text()
    (arm / "demos.csv").write_text(re.sub(r"0\.05,[\d.]+", "0.05,", text))
    status, output, errors = typed("train", "demos.csv", "--out", "new.safetensors", *SHORT)

    assert (status, errors) == (0, "")
    assert "No error can be told: nothing was observed after the motions' first rows." in output


WRONG = {
    "no data": (["nothing.csv"], "nothing.csv: there is no such file"),
    "a model": (["arm.safetensors"], "arm.safetensors: not a recording that is read here"),
    "levels": (["data.npz", "--levels", "40"], "levels must be given as SIZE:TAU,SIZE:TAU"),
    "size": (["data.npz", "--levels", "0:5"], "size must be a whole number ≥ 1, got 0"),
    "half": (["data.npz", "--levels", "4.5:5"], "levels must be given as SIZE:TAU"),
    "tau": (
        ["data.npz", "--levels", "4:0.5"],
        "tau must be finite and ≥ 1 step, at most 1e+30, got 0.5",
    ),
    "tau nan": (["data.npz", "--levels", "4:nan"], "tau must be finite"),
    "no levels": (["data.npz", "--levels", ""], "levels must be given as"),
    "units": (["data.npz", "--levels", "1000000000:5"], "levels of 1000000000 units in all"),
    "io huge": (["data.npz", "--io-tau", "1e308"], "at most 1e+30, got 1e+308"),
    "io": (["data.npz", "--io-tau", "0"], "tau must be finite and ≥ 1 step, at most 1e+30, got 0"),
    "share": (["data.npz", "--held-out", "1.5"], "held out 1.5: a share of the motions"),
    "all": (["data.npz", "--held-out", "0.99"], "held out 0.99: leaves no motion to learn"),
    "each": (["data.npz", "--held-out", ",".join(NAMES)], "leaves no motion to learn"),
    "name": (["data.npz", "--held-out", "wve"], "unknown motion 'wve'; did you mean 'wave'?"),
    "empty": (["data.npz", "--held-out", ""], "unknown motion ''"),
    "setting": (["data.npz", "--set", "rate=1"], "unknown setting 'rate'; did you mean"),
    "value": (["data.npz", "--set", "clip=none"], "setting clip = 'none': "),
    "no value": (["data.npz", "--set", "clip"], "setting clip = '': "),
    "nan": (["data.npz", "--set", "weight_rate=nan"], "setting weight_rate = 'nan': "),
    "level": (["data.npz", "--set", "bound=cx:5"], "unknown level 'cx'"),
    "bound": (["data.npz", "--set", "bound=cf:5,cs"], "setting bound"),
    "noise": (["data.npz", "--set", "noise=cf:-1"], "setting noise"),
    "log": (["data.npz", "--log", "json"], "unknown log 'json'; did you mean 'jsonl'?"),
    "resume": (["data.npz", "--resume"], "--resume: there is no training to go on with"),
    "channel": (["data.npz", "--channels", "hip"], "data.npz: unknown channel 'hip'"),
    "suffix": (["data.npz", "--out", "new.npz"], "--out new.npz: its name must end in .safetens"),
    "folder": (["data.npz", "--out", "no/new.safetensors"], "there is no folder no"),
    "a folder": (["data.npz", "--out", "a.safetensors"], "this is a folder"),
    "below a file": (["data.npz", "--out", "data.npz/new.safetensors"], "there is no folder"),
}


@pytest.mark.parametrize(("arguments", "told"), WRONG.values(), ids=WRONG.keys())
def test_a_mistake_is_answered_by_a_sentence_before_anything_is_written(arm, arguments, told):
    (arm / "a.safetensors").mkdir()
    out = [] if "--out" in arguments else ["--out", "new.safetensors"]
    assert told in refused("train", *out, *SHORT, *arguments, "--log", "jsonl")


@pytest.mark.parametrize(
    "wrong", [("--epochs", "0"), ("--patience", "-1"), ("--seed", "4294967296")]
)
def test_numbers_out_of_range_end_with_status_2(arm, wrong):
    status, _, errors = typed("train", "data.npz", "--out", "new.safetensors", *SHORT, *wrong)

    assert status == 2
    assert wrong[0] in errors
    assert not (arm / "new.safetensors").exists()


@pytest.mark.slow
def test_ctrl_c_keeps_what_was_learned(arm, begin):
    command = ("train", "data.npz", "--out", "new.safetensors", "--epochs", "200000")
    process = begin(*command, "--log", "jsonl")
    while not (arm / "new.log.jsonl").exists():
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)

    assert process.returncode == 130
    assert errors == "\nmotionese: stopped; the same command with --resume goes on\n"
    assert (arm / "new.checkpoint").exists()


def test_ctrl_c_before_training_promises_nothing(arm, monkeypatch):
    def pressed(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(Motions, "read", pressed)
    status, _, errors = typed("train", "data.npz", "--out", "new.safetensors")

    assert (status, errors) == (
        130,
        "\nmotionese: stopped; there is no training to go on with\n",
    )


def test_progress_fits_a_terminal_of_80_columns(capsys):
    from rich.console import Console

    from motionese.learning import Progress

    console = Console(force_terminal=True, width=80, color_system=None)
    with TrainingDisplay(console, 30000, 0) as display:
        display.show(Progress(12300, 0.000034567, 0.1234, 1.0, 0.2345))
        display._bars.refresh()
    shown = capsys.readouterr().out

    assert "12300/30000 loss 3.46e-05, closed loop 12.3%, held out 23.4% of range" in shown
    assert (
        max(len(line) for line in re.split(r"[\r\n]", re.sub(r"\x1b\[[\d?]*\w", "", shown))) <= 80
    )


def test_channels_are_those_of_the_recording(trained):
    fit = load(trained / "arm.safetensors")

    assert [f"{c.name} [{c.unit}]" for c in fit.network.channels] == list(CHANNELS)


GOING_ON = ("train", "data.npz", "--out", "new.safetensors", "--levels", "6:3", "--log", "jsonl")


def trained_on(*arguments):
    status, output, errors = typed(*GOING_ON, *arguments)
    assert (status, errors) == (0, ""), errors
    return load("new.safetensors"), output


@pytest.mark.slow
def test_a_training_that_has_ended_goes_on_to_more_epochs(arm):
    first, _ = trained_on("--epochs", "200")
    second, told = trained_on("--epochs", "400", "--resume")

    assert "Goes on from its 200 epochs: 4 motions from their initial states there; the" in told
    assert "all 200 epochs done, after 200 before" in told
    assert len(second.losses) == 400 and len(second.validation_losses) == 4
    np.testing.assert_array_equal(second.losses[:200], first.losses)
    assert second.losses[-1] < first.losses[-1]
    epochs = [json.loads(line)["epoch"] for line in (arm / "new.log.jsonl").open()]
    assert epochs == [100, 200, 300, 400]

    third, _ = trained_on("--epochs", "500", "--resume")
    assert len(third.losses) == 500
    refusal = refused(*GOING_ON, "--epochs", "500", "--resume")
    assert "has had 500 epochs, 500 were asked for in all; to go on give more, such as" in refusal
    assert "--epochs 1000" in refusal


@pytest.mark.slow
def test_going_on_ends_with_the_same_bits_stopped_or_not(arm, stopped_at):
    noisy = ("--set", "noise=cf:0.01")
    trained_on("--epochs", "100", *noisy)
    begun = (arm / "new.safetensors").read_bytes()
    trained_on("--epochs", "400", "--resume", *noisy)
    whole = (arm / "new.safetensors").read_bytes()

    (arm / "new.safetensors").write_bytes(begun)
    stopped_at(300)
    status, _, errors = typed(*GOING_ON, "--epochs", "400", "--resume", *noisy)
    assert (status, errors) == (
        130,
        "\nmotionese: stopped; the same command with --resume goes on\n",
    )
    assert (arm / "new.safetensors").read_bytes() == begun

    stopped_at(None)
    trained_on("--epochs", "400", "--resume", *noisy)
    assert (arm / "new.safetensors").read_bytes() == whole
    assert not (arm / "new.checkpoint").exists()
    assert [json.loads(line)["epoch"] for line in (arm / "new.log.jsonl").open()] == [100, 200, 400]


@pytest.mark.slow
def test_a_model_is_replaced_by_a_training_that_begins_anew_and_is_stopped(arm, stopped_at):
    trained_on("--epochs", "100")
    stopped_at(100)
    assert typed(*GOING_ON, "--epochs", "200", "--seed", "1")[0] == 130
    stopped_at(None)

    fit, told = trained_on("--epochs", "200", "--seed", "1", "--resume")
    assert len(fit.losses) == 200
    assert "Goes on from" not in told


def test_an_ended_training_goes_on_only_as_it_was_begun(arm):
    trained_on("--epochs", "100")
    longer = ("--epochs", "200", "--resume")
    for changed, told in (
        (("--set", "weight_rate=0.01"), "begun with other settings"),
        (("--levels", "7:3"), "begun with other networks"),
        (("--seed", "1"), "begun with other settings"),
        (("--held-out", "0"), "begun with other motions"),
        (("--channels", "x", "y"), "begun with other "),
    ):
        refusal = refused(*GOING_ON, *longer, *changed)
        assert told in refusal and "--begin new.safetensors" in refusal

    save("new.safetensors", load("new.safetensors"))
    refusal = refused(*GOING_ON, *longer)
    assert "does not tell how it was trained; begin from the model with --begin" in refusal


def test_what_diverged_is_not_gone_on_with(arm):
    typed(*GOING_ON, "--epochs", "100", "--set", "noise=cf:1e38")
    again = ("--epochs", "200", "--set", "noise=cf:1e38", "--resume")
    assert "diverged" in refused(*GOING_ON, *again)


@pytest.mark.slow
def test_a_training_begins_from_a_model(arm):
    first, _ = trained_on("--epochs", "300", "--held-out", "0")
    motions = dict(list(arm_motions().items())[:2])
    motions["lift"] = motions["lift"] * 1.1  # also beyond the ranges of the model
    write_csv("more.csv", {**motions, "nod": motions["reach"][::-1]})

    begin = ("train", "more.csv", "--begin", "new.safetensors", "--out", "tuned.safetensors")
    slow = ("--set", "weight_rate=1e-4", "initial_rate=1e-4")
    status, told, errors = typed(*begin, "--epochs", "1", *slow)
    assert (status, errors) == (0, "")
    assert "Goes on from new.safetensors: 2 motions from their initial states there" in told
    fit = load("tuned.safetensors")
    assert fit.names == ("lift", "reach", "nod")
    assert fit.network.channels == first.network.channels
    assert len(fit.losses) == 1
    np.testing.assert_allclose(fit.network.weights, first.network.weights, atol=1e-3)
    io = fit.network.io_size
    assert np.abs(fit.initial_states[:2, io:] - first.initial_states[:2, io:]).max() < 1e-3
    assert np.abs(fit.initial_states[2, io:]).max() < 1e-3

    status, told, errors = typed(*begin, "--epochs", "200", "--resume", *slow)
    assert (status, errors) == (0, "")
    assert "Goes on from its 1 epochs" in told

    for changed, said in (
        (("--levels", "7:3"), "the model's levels are io 4:2, 6:3; with --begin leave --levels"),
        (("--levels", "6:4"), "the model's levels are"),
        (("--levels", "6:3,2:70"), "the model's levels are"),
        (("--io-tau", "3"), "the model's levels are"),
        (("--range", "x=0:1"), "--range: with --begin the ranges are the model's"),
        (("--channels", "x"), "the model's channel 'shoulder' is missing"),
        (("--begin", "none.safetensors"), "none.safetensors: no such model file"),
    ):
        assert said in refused(*begin, "--epochs", "1", *changed)
    assert typed(*begin, "--epochs", "1", "--levels", "6:3", "--io-tau", "2")[0] == 0
