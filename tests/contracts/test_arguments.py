"""What every public function is given: what stands for what it takes, or a sentence of ours."""

from pathlib import Path

import jax
import numpy as np
import pandas as pd
import pytest

import motionese as mo
from motionese import runtime
from motionese.errors import MotioneseError, SettingError

CHANNELS = ("a", "b")
T = np.linspace(0, 1, 12)[:, None]
ARRAYS = [np.hstack([np.sin(3 * T + i), np.cos(4 * T)]) for i in range(3)]
DATA = mo.Motions.from_arrays(ARRAYS, channels=CHANNELS, rate_hz=10.0)
LEVELS = [mo.Level(2, tau=2.0), mo.Level(5, tau=5.0)]
KEY = jax.random.key(0)
NETWORK = mo.MTRNN.draw(LEVELS, key=KEY)
FIT = mo.train(NETWORK, DATA, epochs=1)
FRAME = pd.DataFrame(ARRAYS[0], columns=list(CHANNELS))

WRONG = {
    "nothing": None,
    "a text": "wave",
    "a path": Path("wave"),
    "texts in lists": [["a", "b"], ["c", "d"]],
    "a table": FRAME,
    "arrays by name": {"a": ARRAYS[0]},
    "a number": 1.5,
    "a whole number": 3,
    "True": True,
    "an empty list": [],
    "any object": object(),
    "a fit": FIT,
    "motions": DATA,
}


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("model") / "model.safetensors"
    mo.save(path, FIT)
    return runtime.load(path)


def loop(model, **given):
    still = {"sense": lambda: dict.fromkeys(CHANNELS, 0.0), "act": lambda command: None}
    return runtime.ControlLoop(**{"model": model, "watchdog_s": 60.0, **still, **given})


def functions(model, folder):
    """Every public function with arguments that it takes; each is replaced by what is wrong."""
    state = FIT.initial_states[0]
    online = runtime.OnlineRecognition(model)
    return {
        mo.Level: {"size": 2, "tau": 2.0, "name": "cf"},
        mo.Channel: {"name": "a", "unit": "m", "low": 0.0, "high": 1.0},
        mo.Channels: {"channels": list(DATA.channels)},
        mo.MTRNN.draw: {"levels": LEVELS, "key": KEY, "gain": 2.0, "scale": "one"},
        mo.Motions.from_arrays: {
            **{"arrays": ARRAYS, "channels": CHANNELS, "rate_hz": 10.0, "names": list("abc")},
            **{"observed": None, "units": {"a": "m"}, "ranges": {"a": (-3.0, 3.0)}},
        },
        mo.Motions.read: {"path": folder / "data.npz", "format": None, "rate_hz": None},
        DATA.write: {"path": folder / "new.npz", "format": None},
        DATA.chosen: {"which": [0]},
        DATA.showing: {"channels": [0]},
        DATA.scaled_by: {"channels": DATA.channels},
        DATA.batch: {"length": None, "capacity": None},
        mo.split: {"motions": DATA, "held_out": [1], "seed": 0},
        mo.train: {
            **{"network": NETWORK, "motions": DATA, "epochs": 1, "settings": None, "key": None},
            **{"initial_states": None, "validation": None, "checkpoint": None, "progress": None},
        },
        mo.recognise: {
            **{"model": FIT, "motion": ARRAYS[0], "observed": [0], "rows": None},
            **{"settings": None, "key": None},
        },
        mo.recognise_online: {"fit": FIT, "observed": ["a"], "window": 5, "ahead": 2},
        mo.generate: {"network": FIT, "initial_state": state, "steps": 3, "duration": 1.0},
        mo.generate_sequence: {
            **{"network": FIT, "initial_states": [state, state], "steps": [5, 5]},
            **{"blend": 2, "here": {"a": 0.0}},
        },
        mo.placed: {"network": FIT, "initial_state": state, "here": {"a": 0.0}},
        mo.grow: {"network": FIT, "level": mo.Level(1, tau=9.0), "key": KEY, "influence": 0.1},
        mo.save: {"path": folder / "new.safetensors", "fit": FIT},
        mo.load: {"path": folder / "fit.safetensors"},
        mo.read_for: {"fit": FIT, "path": folder / "data.npz", "needed": ["a"]},
        mo.Training: {"epochs": 1, "optimiser": "adam"},
        mo.Recognition: {"iterations": 1},
        FIT.index: {"motion": "1"},
        FIT.share: {"errors": FIT.closed_loop_error},
        runtime.load: {"path": folder / "fit.safetensors"},
        runtime.ControlLoop: {
            **{"model": model, "sense": dict, "act": print, "rate_hz": 10.0, "share": 0.0},
            **{"limits": runtime.Limits(), "watchdog_s": 0.5, "stop": None},
        },
        runtime.Limits: {"ranges": {"a": (0.0, 1.0)}, "speeds": {"a": 1.0}},
        runtime.Part: {"start": "0", "steps": 1, "blend": None},
        loop(model).follow: {"recognition": online, "steps": 0, "lag": 2},
        runtime.OnlineRecognition: {
            **{"model": model, "observed": [0], "window": 5, "steps": 1, "ahead": 1},
            **{"budget_ms": None, "accuracy": 0.1},
        },
        online.observe: {"reading": None, "row": None},
        model.begin: {"start": "0", "here": None},
        model.initial: {"motion": 1},
        model.with_duration: {"scale": 1.5},
        model.with_rate: {"rate_hz": 15.0},
        runtime.Player: {"model": model, "state": model.begin("0"), "share": 0.5},
        runtime.Player(model, model.begin("0")).blend_to: {"start": "1", "steps": 2},
        runtime.Stepper: {"model": model},
    }


@pytest.mark.slow
def test_what_is_not_taken_is_refused_by_a_sentence(model, tmp_path, unchecked, monkeypatch):
    monkeypatch.chdir(tmp_path)
    mo.save(tmp_path / "fit.safetensors", FIT)
    DATA.write(tmp_path / "data.npz")
    answered = {}
    for function, right in functions(model, tmp_path).items():
        function(**right)
        for argument in right:
            for name, wrong in WRONG.items():
                place = f"{function.__qualname__}({argument}={name})"
                try:
                    answered[place] = function(**{**right, argument: wrong})
                except MotioneseError as refusal:
                    answered[place] = refusal
                    assert str(refusal).count("\n") == 0, place
    refused = [place for place, answer in answered.items() if isinstance(answer, Exception)]

    assert len(refused) > 0.7 * len(answered)
    # A mistake that is seen where it is made, not where it would come out.
    for late in (
        "Motions.scaled_by(channels=a text)",
        "Channel(unit=nothing)",
        "save(fit=motions)",
    ):
        assert late in refused


def test_a_sentence_says_what_was_got_and_what_is_taken(unchecked):
    for call, told in (
        (lambda: mo.generate(FIT, None, steps=5), "initial_state must be an array of numbers, got"),
        (lambda: mo.generate("m.safetensors", [0.0], 5), "network must be a network or a Trained"),
        (lambda: mo.train(NETWORK, ARRAYS), "train: motions must be a Motions, got list of 3"),
        (lambda: mo.MTRNN.draw(LEVELS, key=0), "key must be a JAX random key such as jax"),
        (lambda: mo.recognise(FIT, "wave"), "motion must be a Motions or an array of numbers"),
        (
            lambda: mo.generate(FIT, step=5),
            "generate: missing a required argument: 'initial_state'",
        ),
        (lambda: mo.MTRNN(LEVELS), "draw: key must be a JAX random key such as jax"),
        (lambda: mo.MTRNN(weights=np.eye(2)), "is drawn from levels and a key, MTRNN.draw(levels,"),
        (lambda: mo.Training(epoch=5), "unknown setting 'epoch'; did you mean 'epochs'?"),
        (lambda: mo.Training(epochs="many"), "setting epochs = 'many': input should be a valid"),
    ):
        with pytest.raises(SettingError) as refusal:
            call()
        assert told in str(refusal.value)


def test_a_fit_is_taken_where_a_network_is(model):
    state = FIT.initial_states[1]
    np.testing.assert_array_equal(
        mo.generate(FIT, state, steps=5), mo.generate(FIT.network, state, steps=5)
    )
    taller = mo.grow(FIT, mo.Level(1, tau=9.0), key=KEY)
    assert taller.sizes == (2, 5, 1)
    assert mo.placed(FIT, state, {"a": 0.0}).shape == state.shape


def test_numbers_are_taken_where_names_are(model, unchecked):
    one = np.int64(1)
    assert DATA.showing([one]).observed[0].tolist() == DATA.showing(["b"]).observed[0].tolist()
    assert DATA.showing("b").observed[0].tolist() == DATA.showing(["b"]).observed[0].tolist()
    assert FIT.index(one) == FIT.index("1") == 1
    np.testing.assert_array_equal(model.begin(one).u, model.begin("1").u)
    assert mo.split(DATA, held_out=[one])[1].names == ("1",)
    assert loop(model).run(0, runtime.Part(one, steps=2)).steps == 11 + 2
    path, *rest = (
        mo.recognise(FIT, ARRAYS[0], observed=seen).path for seen in ([0], ["a"], "a", 0)
    )
    assert all(np.array_equal(path, other) for other in rest)
    assert mo.Level(np.int32(3), tau=np.float32(2)) == mo.Level(3, tau=2.0)
    assert mo.Level(2, tau=[2.0, 3.0]) == mo.Level(2, tau=(2.0, 3.0))


def test_a_number_that_might_mean_two_motions_is_refused(unchecked):
    learned, _ = mo.split(DATA, held_out=["0"])
    fit = mo.train(NETWORK, learned, epochs=1)
    assert fit.names == ("1", "2")

    with pytest.raises(SettingError, match="motion 1 may be the one called '1', or '2'"):
        fit.index(1)
    assert fit.index(2) == 1  # no other is called so, and there is no third
    with pytest.raises(SettingError, match="unknown motion 5; there are 2, counted from 0"):
        fit.index(5)
    with pytest.raises(MotioneseError, match="held_out must be a number or a list"):
        mo.split(DATA, held_out=[True])


def test_a_network_is_drawn_by_its_own_name_too():
    for one, other in zip(
        jax.tree.leaves(mo.MTRNN(LEVELS, key=KEY, variance=True)),
        jax.tree.leaves(mo.MTRNN.draw(LEVELS, key=KEY, variance=True)),
        strict=True,
    ):
        np.testing.assert_array_equal(one, other)
