"""A model in the runtime: the same as the library reads, or one sentence; without its packages."""

import json
import subprocess
import sys

import jax
import numpy as np
import pytest
import safetensors
import safetensors.numpy
from hypothesis import given
from hypothesis import strategies as st
from small_models import CHANNELS, written

from motionese import Motions, Training, load, train
from motionese.errors import StorageError
from motionese.learning import write_fit
from motionese.network import MTRNN, Level, storage, write_network
from motionese.runtime import load as load_here
from motionese.runtime import loading
from motionese.runtime.loading import parse

ALONE = """
import sys

class Refuses:
    ours = ("motionese", "motionese.runtime", "motionese.errors", "motionese.unit_interval",
            "motionese.minimum_jerk", "motionese.files", "motionese.time_constants",
            "motionese.arguments")

    def find_spec(self, name, path=None, target=None):
        first = name.partition(".")[0]
        ours = name in self.ours or name.startswith("motionese.runtime.")
        if first not in sys.stdlib_module_names and first != "numpy" and not ours:
            raise ImportError(f"{name} must not be needed")

sys.meta_path.insert(0, Refuses())
from motionese.runtime import ControlLoop, load

sent = []
loop = ControlLoop(load(sys.argv[1]), lambda: {"lift": 0.5}, sent.append, watchdog_s=5.0)
print(loop.run("reach").ending, len(sent))
"""


def rewrite(path, target, structure=None, tensors=None):
    """Write the file anew with some of its description or of its tensors changed."""
    with safetensors.safe_open(path, framework="numpy") as file:
        described = json.loads(file.metadata()["motionese"])
        held = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    described.update(structure or {})
    held = {n: v for n, v in {**held, **(tensors or {})}.items() if v is not None}
    safetensors.numpy.save_file(held, target, {"motionese": json.dumps(described)})
    return target


def refused(path, match):
    """The file is refused in one sentence that begins with its name."""
    with pytest.raises(StorageError, match=match) as refusal:
        load_here(path)
    assert str(refusal.value).startswith(str(path))
    assert "\n" not in str(refusal.value)


def test_everything_comes_as_it_was_written(saved, model):
    _, network, states = saved

    np.testing.assert_array_equal(model.weights, network.wired_weights())
    np.testing.assert_array_equal(model.bias, network.bias)
    np.testing.assert_array_equal(model.tau, network.tau)
    assert model.channels == CHANNELS.names
    assert model.units == tuple(channel.unit for channel in CHANNELS)
    assert model.low.tolist() == [channel.low for channel in CHANNELS]
    assert model.high.tolist() == [channel.high for channel in CHANNELS]
    assert list(model.initial_states) == ["reach", "wave"]
    np.testing.assert_array_equal(list(model.initial_states.values()), states)
    assert (model.rate_hz, dict(model.lengths)) == (20.0, {"reach": 41, "wave": 31})
    assert model.senses_first


@pytest.mark.slow
def test_a_trained_fit_is_read(tmp_path):
    t = np.linspace(0.0, 3.0, 20)[:, None]
    motions = Motions.from_arrays([np.hstack([np.sin(t), t])], ["x", "y"], 10.0, names=["a"])
    fit = train(
        MTRNN.draw([Level(2, 2.0), Level(4, 5.0)], key=jax.random.key(0)),
        motions,
        settings=Training(epochs=1),
    )
    write_fit(tmp_path / "m", fit, {"initial_states": np.ones(2)}, {"names": []})

    model = load_here(tmp_path / "m")

    np.testing.assert_array_equal(model.initial("a"), load(tmp_path / "m").initial_states[0])
    assert (model.rate_hz, dict(model.lengths)) == (10.0, {"a": 20})


def test_what_older_files_do_not_tell_is_not_known(tmp_path):
    written(tmp_path / "m", initial_io="zero")
    model = load_here(tmp_path / "m")

    assert model.rate_hz is None
    assert model.lengths == {}
    assert not model.senses_first


def test_double_precision_is_read(saved, tmp_path, model):
    weights = np.asarray(saved[1].weights, dtype=np.float64)
    path = rewrite(saved[0], tmp_path / "m", tensors={"weights": weights})

    np.testing.assert_array_equal(load_here(path).weights, model.weights)


def test_the_loop_runs_without_any_package_but_numpy(saved):
    command = [sys.executable, "-c", ALONE, str(saved[0])]
    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert (done.stderr, done.stdout) == ("", "done 40\n")


def test_the_format_is_that_of_the_library():
    assert (loading.FORMAT, loading.VERSION) == (storage.FORMAT, storage.VERSION)


def test_a_file_cut_short_anywhere_is_refused(saved, tmp_path):
    whole, path = saved[0].read_bytes(), tmp_path / "m"
    for kept in (0, 1, 7, 8, 9, 100, len(whole) // 2, len(whole) - 8, len(whole) - 1):
        path.write_bytes(whole[:kept])
        refused(path, "not a readable model file, perhaps cut short")
    path.write_bytes(whole + b"\0")
    refused(path, "not a readable model file")


def test_foreign_files_are_refused(tmp_path):
    refused(tmp_path / "none", "no such model file")
    refused(tmp_path, "no such model file")
    text, tensors = tmp_path / "notes.txt", tmp_path / "other"
    text.write_text("a shopping list " * 40)
    refused(text, "not a readable model file")
    safetensors.numpy.save_file({"weights": np.eye(8, dtype=np.float32)}, tensors)
    refused(tensors, "not a model of motionese")
    for described in ("[1]", '{"format": "another"}', "null"):
        safetensors.numpy.save_file({"w": np.eye(2)}, tensors, {"motionese": described})
        refused(tensors, "not a model of motionese")


@pytest.mark.parametrize(
    ("tensors", "match"),
    [
        ({"weights": np.ones((12, 7))}, r"weights must have shape \(12, 12\), got shape \(12, 7\)"),
        ({"weights": None}, r"weights must have shape \(12, 12\), got nothing"),
        ({"tau": np.full(12, 0.5)}, r"tau must be ≥ 1 step, got 0\.5"),
        ({"bias": np.full(12, np.nan)}, "bias holds values that are not finite"),
        ({"weights": np.full((12, 12), 1e39)}, "weights holds values that are not finite"),
        ({"initial_states": None}, "a network without a fit; initial states missing"),
        ({"initial_states": np.ones((3, 12))}, r"initial_states must have shape \(2, 12\)"),
        ({"initial_states": np.full((2, 12), np.inf)}, "initial_states holds values that are not"),
    ],
)
def test_tensors_that_no_model_can_have_are_refused(saved, tmp_path, tensors, match):
    refused(rewrite(saved[0], tmp_path / "m", tensors=tensors), match)


@pytest.mark.parametrize(
    ("structure", "match"),
    [
        ({"version": 2}, "model format 2, this version reads 1; install a newer motionese"),
        ({"channels": None}, "carries no channels; train it on motions first"),
        ({"channels": [vars(CHANNELS[0])] * 3}, "3 IO units need as many channels of different"),
        ({"channels": [vars(CHANNELS[0])]}, "3 IO units need as many channels"),
        (
            {"channels": [*map(vars, CHANNELS[:2]), {**vars(CHANNELS[2]), "low": 2.0}]},
            "channel 'grip': its range must be finite with low < high, got 2 to 1",
        ),
        ({"channels": [{"name": "lift"}] * 3}, "description of the network is incomplete"),
        ({"levels": 3}, "description of the network is incomplete"),
        ({"levels": [{"size": 12}]}, r"its levels have \[12\] units"),
        ({"levels": [{"size": 0}, {"size": 12}]}, r"its levels have \[0, 12\] units"),
        ({"facts": {}}, "a network without a fit"),
        ({"facts": {"names": []}}, "the model has learned no motion yet"),
        ({"facts": {"experiences": []}}, r"a checkpoint of an experiment made by motionese 0\.1"),
        ({"facts": {"names": ["reach", "wave"], "rate_hz": -1}}, "finite and > 0 Hz, got -1"),
        ({"facts": {"names": ["reach", "wave"], "lengths": [1]}}, "is incomplete"),
        ({"initial_io": "guessed"}, "description of the network is incomplete"),
    ],
)
def test_descriptions_of_no_model_are_refused(saved, tmp_path, structure, match):
    refused(rewrite(saved[0], tmp_path / "m", structure), match)


@pytest.mark.parametrize("place", [[-8, -4], [4, 12], [6, 2]])
def test_tensors_that_lie_outside_the_file_are_refused(place):
    header = {
        "inside": {"dtype": "F32", "shape": [2], "data_offsets": [0, 8]},
        "outside": {"dtype": "F32", "shape": [1], "data_offsets": place},
    }
    told = json.dumps(header).encode()
    with pytest.raises(ValueError, match="outside the file"):
        parse(len(told).to_bytes(8, "little") + told + bytes(8))


@given(data=st.data())
def test_damage_never_leads_to_anything_but_a_sentence(saved, tmp_path, data):
    whole = bytearray(saved[0].read_bytes())
    for _ in range(data.draw(st.integers(1, 6))):
        place = data.draw(st.integers(0, min(len(whole), 1500) - 1))
        whole[place] = data.draw(st.integers(0, 255))
    (tmp_path / "m").write_bytes(data.draw(st.sampled_from([bytes(whole), bytes(whole[8:])])))

    try:
        load_here(tmp_path / "m")
    except StorageError as error:
        assert "\n" not in str(error).removeprefix(str(tmp_path))


@given(header=st.recursive(st.none() | st.integers() | st.text(), st.lists))
def test_headers_of_any_json_are_refused(tmp_path, header):
    told = json.dumps({"__metadata__": {"motionese": json.dumps(header)}, "w": header}).encode()
    (tmp_path / "m").write_bytes(len(told).to_bytes(8, "little") + told)

    refused(tmp_path / "m", "not a")


def test_a_network_without_a_fit_is_refused(saved, tmp_path):
    write_network(tmp_path / "m", saved[1], {}, {})

    refused(tmp_path / "m", "a network without a fit; initial states missing")
