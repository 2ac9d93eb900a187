"""The exported step: what onnxruntime computes with it alone, and when nothing is written."""

import json
import sys
from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import onnx
import onnxruntime
import pytest
from by_hand import network as by_hand
from small_models import CHANNELS, SIZES, written

from motionese import MTRNN, Level, Motions, Training, generate, train
from motionese.errors import ChannelError, MissingPackageError, StorageError
from motionese.interfaces import onnx_export
from motionese.interfaces.onnx_export import export_onnx


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    return written(tmp_path_factory.mktemp("model") / "m")[0]


def session_of(path):
    return onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])


def test_a_step_is_the_equations_step(network, tmp_path):
    difference = export_onnx(tmp_path / "step.onnx", network)
    session = session_of(tmp_path / "step.onnx")
    rng = np.random.default_rng(1)

    assert 0 < difference <= 1e-6
    for _ in range(20):
        x = rng.uniform(0.02, 0.98, 3).astype(np.float32)
        u = rng.normal(0.0, 2.0, 12).astype(np.float32)
        y, following = session.run(["y", "u_next"], {"x": x, "u": u})

        parameters = (network.weights.tolist(), network.bias.tolist(), network.tau.tolist())
        by_rows = by_hand.rollout(*parameters, SIZES, u.tolist(), [x.tolist()] * 2, np.ones((2, 3)))
        np.testing.assert_allclose(following, by_rows[1], atol=3e-6)
        np.testing.assert_allclose(y, 1 / (1 + np.exp(-by_rows[1, :3])), atol=1e-6)


@pytest.mark.parametrize("batch", [1, 7])
def test_several_states_are_stepped_as_one_is(network, tmp_path, batch):
    export_onnx(tmp_path / "step.onnx", network)
    session = session_of(tmp_path / "step.onnx")
    rng = np.random.default_rng(2)
    x = rng.uniform(0.02, 0.98, (batch, 3)).astype(np.float32)
    u = rng.normal(0.0, 2.0, (batch, 12)).astype(np.float32)

    y, following = session.run(["y", "u_next"], {"x": x, "u": u})

    assert (y.shape, following.shape) == ((batch, 3), (batch, 12))
    for i in range(batch):
        one = session.run(["y", "u_next"], {"x": x[i], "u": u[i]})
        np.testing.assert_allclose(y[i], one[0], atol=1e-6)
        np.testing.assert_allclose(following[i], one[1], rtol=1e-6, atol=1e-6)


def test_a_fit_moves_from_what_its_file_alone_tells(tmp_path):
    t = np.linspace(0.0, 3.0, 20)[:, None]
    motions = Motions.from_arrays([np.hstack([np.sin(t), t])], ["x", "y"], 10.0, names=["bow"])
    net = MTRNN.draw([Level(2, 2.0), Level(4, 5.0)], key=jax.random.key(0))
    fit = train(net, motions, settings=Training(epochs=1))
    export_onnx(tmp_path / "step.onnx", fit)

    session = session_of(tmp_path / "step.onnx")
    told = json.loads(session.get_modelmeta().custom_metadata_map["motionese"])
    assert told["rate_hz"] == 10.0
    u = np.array(told["initial_states"]["bow"], np.float32)
    y = 1 / (1 + np.exp(-u[:2]))
    path = [y]
    for _ in range(19):
        y, u = session.run(["y", "u_next"], {"x": y, "u": u})
        path.append(y)

    low, high = (np.array([c[end] for c in told["channels"]]) for end in ("low", "high"))
    inner_low, inner_high = told["range_lies_at"]
    values = low + (high - low) * (np.array(path) - inner_low) / (inner_high - inner_low)
    np.testing.assert_allclose(values, generate(fit.network, fit.initial_states[0], 20), atol=1e-5)


def test_the_file_tells_what_it_is(network, tmp_path):
    export_onnx(tmp_path / "step.onnx", network)
    model = onnx.load(tmp_path / "step.onnx")

    (told,) = model.metadata_props
    facts = json.loads(told.value)
    assert (told.key, facts["format"], facts["version"]) == ("motionese", "motionese-step", 1)
    assert facts["channels"] == [vars(channel) for channel in CHANNELS]
    assert [level["size"] for level in facts["levels"]] == list(SIZES)
    assert facts["initial_states"] == {}
    assert [opset.version for opset in model.opset_import] == [17]
    assert len(model.graph.node) == 9
    values = [*model.graph.input, *model.graph.output]
    assert [value.name for value in values] == ["x", "u", "y", "u_next"]
    assert not any(value.type.tensor_type.HasField("shape") for value in values)
    assert "u_next [N]: the potentials of the next step" in model.doc_string


def test_large_weights_are_no_reason_to_refuse(network, tmp_path):
    larger = replace(network, weights=20 * network.weights, bias=20 * network.bias)

    assert export_onnx(tmp_path / "step.onnx", larger) <= 1e-6


@pytest.mark.parametrize("wrong", ["kept", "scaled_bias", "scaled_weights"])
def test_a_step_that_differs_is_not_written(network, tmp_path, monkeypatch, wrong):
    held = onnx_export._constants

    def off(network):
        constants = held(network)
        (tensor,) = (t for t in constants if t.name == wrong)
        value = onnx.numpy_helper.to_array(tensor) * np.float32(1 + 1e-4)
        tensor.CopyFrom(onnx.numpy_helper.from_array(value, wrong))
        return constants

    monkeypatch.setattr(onnx_export, "_constants", off)
    with pytest.raises(StorageError, match=r"not written: the ONNX model differs .* allowed 1e-06"):
        export_onnx(tmp_path / "step.onnx", network)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("package", ["onnx", "onnxruntime"])
def test_a_missing_package_is_told_and_nothing_is_written(network, tmp_path, monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(MissingPackageError, match=rf"'{package}'.*pip install 'motionese\[onnx\]'"):
        export_onnx(tmp_path / "step.onnx", network)
    assert list(tmp_path.iterdir()) == []


def test_networks_that_cannot_be_used_are_refused(network, tmp_path):
    bare = MTRNN.draw([Level(2, 2.0), Level(4, 5.0)], key=jax.random.key(0))
    with pytest.raises(ChannelError, match="carries no channels; train it on motions first"):
        export_onnx(tmp_path / "step.onnx", bare)
    broken = replace(network, bias=jnp.full(12, jnp.nan))
    with pytest.raises(StorageError, match="differs from the network by nan"):
        export_onnx(tmp_path / "step.onnx", broken)
    assert list(tmp_path.iterdir()) == []
