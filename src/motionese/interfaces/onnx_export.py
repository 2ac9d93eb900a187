"""One step of a network as an ONNX model, checked against the network as it is written.

The model computes equations (1) and (2) in single precision: of the input row x and all potentials
u it makes the next potentials and the next row. Fed with its own y it generates in closed loop.
"""
# ruff: noqa: PLC0415

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import ChannelError, StorageError, needs
from motionese.files import write_whole
from motionese.learning import Fit
from motionese.network import MTRNN, step
from motionese.unit_interval import CLIP_HIGH, CLIP_LOW, INNER_HIGH, INNER_LOW, sigmoid

OPSET, IR_VERSION = 17, 8
"""Of 2022: what runtimes on robots know."""
TRIALS, TOLERANCE = 256, 1e-6
"""How many random steps are compared, and how far they may differ."""
NODES: tuple[tuple[str, list[str], str, dict[str, int]], ...] = (
    ("Slice", ["u", "context", "end", "last_axis"], "context_u", {}),
    ("Sigmoid", ["context_u"], "context_y", {}),
    ("Concat", ["x", "context_y"], "inputs", {"axis": -1}),
    ("MatMul", ["inputs", "scaled_weights"], "weighted", {}),
    ("Mul", ["kept", "u"], "kept_u", {}),
    ("Add", ["kept_u", "weighted"], "moved_u", {}),
    ("Add", ["moved_u", "scaled_bias"], "u_next", {}),
    ("Slice", ["u_next", "first", "context", "last_axis"], "io_u", {}),
    ("Sigmoid", ["io_u"], "y", {}),
)
"""Equations (1) and (2): operator, what it takes, what it gives, its attributes. All of them work
along the last axis, whether there is one before it or not."""
MEANING = """One step of a multiple-timescale recurrent network (MTRNN).
x [D]: the present row in the unit interval: what is sensed, the y of the step before, or a mixture.
u [N]: the potentials of all units, at first one of the initial states.
y [D]: the prediction of the next row in the unit interval.
u_next [N]: the potentials of the next step.
Several states are stepped at once with x [B, D], u [B, N], which give y [B, D], u_next [B, N]:
no shape is declared, so that onnxruntime takes both.
A channel's range low to high lies at 0.1 to 0.9 of the unit interval; x is clipped to 0.02 to 0.98.
The metadata entry 'motionese' (JSON) holds channels, rate, levels and initial states."""


@refusing()
def export_onnx(path: str | Path, trained: Fit | MTRNN) -> float:
    """Write one step of a network as an ONNX model, if it agrees with the network.

    Args:
        path: The file to write.
        trained: A fit, whose initial states go with it, or a network that carries channels.

    Returns:
        The largest difference between the model, run by onnxruntime, and the network in double
        precision over random inputs: of y as it is, of u_next as a share of what it is the sum of
        (or of 1, where that is more), since that is what single precision rounds.

    Raises:
        MissingPackageError: onnx or onnxruntime is not installed.
        StorageError: The two differ by more than 1e-6; nothing is written.
    """
    fit = trained if isinstance(trained, Fit) else None
    network = trained if isinstance(trained, MTRNN) else trained.network
    content = _model(network, _facts(network, fit))
    difference = _difference(content, network)
    if not difference <= TOLERANCE:
        raise StorageError(
            f"{path}: not written: the ONNX model differs from the network by {difference:.1e}, "
            f"allowed {TOLERANCE:g}"
        )
    write_whole(Path(path), content)
    return difference


def _facts(network: MTRNN, fit: Fit | None) -> dict[str, Any]:
    """Return what a user of the ONNX model has to know, for JSON."""
    if network.channels is None:
        raise ChannelError("the network carries no channels; train it on motions first")
    states = {} if fit is None else dict(zip(fit.names, fit.initial_states.tolist(), strict=True))
    return {
        "format": "motionese-step",
        "version": 1,
        "channels": [vars(channel) for channel in network.channels],
        "range_lies_at": [INNER_LOW, INNER_HIGH],
        "clipped_to": [CLIP_LOW, CLIP_HIGH],
        "rate_hz": None if fit is None else fit.rate_hz,
        "levels": [{"name": level.name, "size": level.size} for level in network.levels],
        "initial_io": network.initial_io,
        "initial_states": states,
    }


def _model(network: MTRNN, facts: Mapping[str, Any]) -> bytes:
    """Build and check the ONNX model."""
    try:
        from onnx import TensorProto, checker, helper
    except ImportError as error:
        raise needs("onnx", "onnx", "the export to ONNX") from error
    nodes = [helper.make_node(kind, takes, [gives], **how) for kind, takes, gives, how in NODES]
    sizes = {"x": network.io_size, "u": network.size, "y": network.io_size, "u_next": network.size}
    for leading in ((), ("B",)):
        values = [
            helper.make_tensor_value_info(name, TensorProto.FLOAT, [*leading, size])
            for name, size in sizes.items()
        ]
        model = helper.make_model(
            helper.make_graph(
                nodes,
                "motionese_step",
                inputs=values[:2],
                outputs=values[2:],
                initializer=_constants(network),
                doc_string=MEANING,
            ),
            opset_imports=[helper.make_opsetid("", OPSET)],
            ir_version=IR_VERSION,
            producer_name="motionese",
            doc_string=MEANING,
        )
        helper.set_model_props(model, {"motionese": json.dumps(facts)})
        checker.check_model(model, full_check=True)
    # It holds for one state and for several; a shape that is declared, onnxruntime insists on.
    for value in [*model.graph.input, *model.graph.output]:
        value.type.tensor_type.ClearField("shape")
    return bytes(model.SerializeToString())


def _constants(network: MTRNN) -> list[Any]:
    """Return the network's parameters as ONNX tensors, and where its units lie."""
    from onnx import numpy_helper

    rate = 1 / np.asarray(network.tau, dtype=np.float64)
    parameters = {
        "scaled_weights": (rate[:, None] * np.asarray(network.wired_weights())).T,
        "scaled_bias": rate * np.asarray(network.bias),
        "kept": 1 - rate,
    }
    places = {"first": 0, "context": network.io_size, "end": network.size, "last_axis": -1}
    arrays = {name: value.astype(np.float32) for name, value in parameters.items()}
    arrays |= {name: np.array([place], np.int64) for name, place in places.items()}
    return [numpy_helper.from_array(value, name) for name, value in arrays.items()]


def _difference(content: bytes, network: MTRNN) -> float:
    """Compare steps from random inputs and potentials, one by one and all at once."""
    try:
        import onnxruntime
    except ImportError as error:
        raise needs("onnxruntime", "onnx", "the check of an exported ONNX model") from error
    session = onnxruntime.InferenceSession(content, providers=["CPUExecutionProvider"])
    rng = np.random.default_rng(0)
    x = rng.uniform(CLIP_LOW, CLIP_HIGH, (TRIALS, network.io_size)).astype(np.float32)
    u = rng.normal(0.0, 3.0, (TRIALS, network.size)).astype(np.float32)
    steps = [session.run(["y", "u_next"], {"x": x[i], "u": u[i]}) for i in range(TRIALS)]
    each = (np.stack(outputs) for outputs in zip(*steps, strict=True))
    y, following = map(np.stack, zip(each, session.run(None, {"x": x, "u": u}), strict=True))
    with jax.enable_x64(True):
        double = jax.tree.map(lambda array: array.astype(jnp.float64), network)
        exact = np.asarray(step(double, jnp.asarray(u, jnp.float64), jnp.asarray(x), 1.0))
    off_y = np.abs(y - sigmoid(exact[:, : network.io_size]))
    off_u = np.abs(following - exact) / np.maximum(1, _summands(network, u))
    return float(np.max([off_y.max(), off_u.max()]))


def _summands(network: MTRNN, u: Float[ndarray, "B N"]) -> Float[ndarray, "B N"]:
    """Return how large the summands of equation (1) are together: what rounding is relative to."""
    rate = 1 / np.asarray(network.tau)
    driven = np.abs(network.wired_weights()).sum(1) + np.abs(network.bias)
    return np.asarray((1 - rate) * np.abs(u) + rate * driven)
