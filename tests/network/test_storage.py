"""A network on disk: the same bits come back, and what is no network is refused in a sentence."""

import json
import os
from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import safetensors
import safetensors.numpy

from motionese.channels import Channel, Channels
from motionese.errors import StorageError
from motionese.network import MTRNN, Level, read_network, write_network

LEVELS = [Level(2, tau=2.3), Level(5, tau=(4.1, 5.0, 6.0, 7.0, 8.0), name="fast"), Level(1, 70.0)]
CHANNELS = Channels([Channel("pan", "rad", -1.25, 1.0), Channel("u", "", 0.0, 1.0)])
FACTS = {"loop": 3, "names": ["UR ↓"]}
EXTRA = {"states": np.arange(16.0, dtype=np.float32).reshape(2, 8), "empty": np.zeros((0,))}


def network(**settings):
    drawn = MTRNN.draw(LEVELS, key=jax.random.key(0), channels=CHANNELS, **settings)
    return replace(drawn, bias=jnp.linspace(-1.0, 1.0, 8))


@pytest.fixture
def path(tmp_path):
    target = tmp_path / "robot.safetensors"
    write_network(target, network(), EXTRA, FACTS)
    return target


def rewrite(path, structure=None, tensors=None):
    """Write the file anew with some of its description or of its tensors changed."""
    with safetensors.safe_open(path, framework="numpy") as file:
        described = json.loads(file.metadata()["motionese"])
        held = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    described.update(structure or {})
    held.update(tensors or {})
    held = {name: value for name, value in held.items() if value is not None}
    safetensors.numpy.save_file(held, path, {"motionese": json.dumps(described)})


def refused(path, match):
    """The file is refused in one sentence that begins with its name."""
    with pytest.raises(StorageError, match=match) as refusal:
        read_network(path)
    sentence = str(refusal.value)
    assert sentence.startswith(str(path))
    assert "\n" not in sentence


@pytest.mark.parametrize(
    "settings", [{}, {"learned_bias": False, "initial_io": "zero"}, {"variance": True}]
)
def test_the_same_bits_come_back(tmp_path, settings):
    written = network(**settings)
    write_network(tmp_path / "n", written, EXTRA, FACTS)

    read, arrays, facts = read_network(tmp_path / "n")

    assert bool(eqx.tree_equal(read, written))
    assert read.channels == CHANNELS
    assert facts == FACTS
    assert set(arrays) == set(EXTRA)
    for name, value in EXTRA.items():
        np.testing.assert_array_equal(arrays[name], value)


def test_double_precision_comes_back_where_it_is_on(tmp_path, float64):
    written = network()
    write_network(tmp_path / "n", written, {}, {})

    assert bool(eqx.tree_equal(read_network(tmp_path / "n")[0], written))


def test_a_network_without_channels_comes_back_without(tmp_path):
    bare = MTRNN.draw(LEVELS, key=jax.random.key(0))
    write_network(tmp_path / "n", bare, {}, {})

    assert read_network(tmp_path / "n")[0].channels is None


def test_the_time_constants_are_those_of_the_array(path):
    """What the description says of τ is for people; a network has one τ."""
    rewrite(path, {"levels": [{"name": "io", "size": 2, "tau": 9.0}, {"name": "cf", "size": 6}]})

    read = read_network(path)[0]

    assert bool(eqx.tree_equal(read.tau, network().tau))
    assert read.levels[0].tau == pytest.approx(2.3)
    assert read.levels[1].tau == pytest.approx((4.1, 5.0, 6.0, 7.0, 8.0, 70.0))


@pytest.mark.parametrize("failing", ["fsync", "replace"])
def test_a_write_that_fails_leaves_the_old_file_and_no_other(path, monkeypatch, failing):
    before = path.read_bytes()

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr(os if failing == "fsync" else type(path), failing, fail)
    with pytest.raises(OSError, match="disk full"):
        write_network(path, network(learned_bias=False), {}, {})

    assert path.read_bytes() == before
    assert [p.name for p in path.parent.iterdir()] == [path.name]


def test_a_file_cut_short_anywhere_is_refused(path):
    whole = path.read_bytes()
    for kept in (0, 1, 7, 8, 9, 100, len(whole) // 2, len(whole) - 8, len(whole) - 1):
        path.write_bytes(whole[:kept])
        refused(path, "not a readable model file, perhaps cut short")


def test_a_file_that_is_not_there_is_refused(tmp_path):
    refused(tmp_path / "none.safetensors", "no such model file")
    refused(tmp_path, "no such model file")


def test_foreign_files_are_refused(tmp_path):
    text, tensors = tmp_path / "notes.txt", tmp_path / "other.safetensors"
    text.write_text("a shopping list " * 40)
    refused(text, "not a readable model file")
    safetensors.numpy.save_file({"weights": np.eye(8, dtype=np.float32)}, tensors)
    refused(tensors, "not a model of motionese")
    for described in ("[1]", '{"format": "another"}', "null"):
        safetensors.numpy.save_file({"w": np.eye(2)}, tensors, {"motionese": described})
        refused(tensors, "not a model of motionese")


def test_a_newer_format_is_refused_and_says_what_to_do(path):
    rewrite(path, {"version": 2})

    refused(path, "model format 2, this version reads 1; install a newer motionese")


@pytest.mark.parametrize(
    ("tensors", "match"),
    [
        ({"weights": np.ones((8, 7), np.float32)}, r"weights must have shape \(8, 8\), got shape"),
        ({"weights": None}, r"weights must have shape \(8, 8\), got nothing"),
        ({"bias": np.ones((1, 8), np.float32)}, r"bias must have shape \(8,\), got shape \(1, 8\)"),
        ({"tau": np.full(8, 0.5, np.float32)}, r"tau must be ≥ 1 step, got 0\.5"),
        ({"tau": np.full(8, np.nan, np.float32)}, "tau holds values that are not finite"),
        ({"weights": np.full((8, 8), np.nan)}, "weights holds values that are not finite"),
        ({"bias": np.full(8, -np.inf)}, "bias holds values that are not finite"),
    ],
)
def test_tensors_that_no_network_can_have_are_refused(path, tensors, match):
    rewrite(path, tensors=tensors)

    refused(path, match)


@pytest.mark.parametrize("part", ["levels", "channels", "learned_bias", "initial_io", "facts"])
def test_an_incomplete_description_is_refused(path, part):
    with safetensors.safe_open(path, framework="numpy") as file:
        described = json.loads(file.metadata()["motionese"])
        held = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    del described[part]
    safetensors.numpy.save_file(held, path, {"motionese": json.dumps(described)})

    refused(path, "its description of the network is incomplete")


@pytest.mark.parametrize(
    "structure",
    [
        {"levels": [{"name": "io", "size": 2, "tau": 2}, {"name": "io", "size": 6, "tau": 2}]},
        {"levels": [{"name": "io", "size": 8, "tau": 2}, {"name": "cf", "size": 0, "tau": 2}]},
        {"levels": [{"name": "io", "size": 8, "tau": 2}]},
        {"levels": [{"name": "io", "size": 4}, {"name": "cf", "size": 4}]},
        {"levels": 3},
        {"channels": [{"name": "pan", "unit": "rad", "low": 1.0, "high": 0.0}] * 2},
        {"channels": [{"name": "pan", "unit": "rad"}]},
        {"initial_io": "guessed"},
    ],
)
def test_a_description_of_no_network_is_refused(unchecked, path, structure):
    rewrite(path, structure)

    refused(path, "no valid network|description of the network is incomplete")
