"""Recognition while it happens, with a model that was trained here."""

from typing import Any

import numpy as np

from motionese.arguments import refusing
from motionese.errors import NO_MOTION, SettingError
from motionese.learning.fit import Fit
from motionese.runtime import OnlineRecognition, RuntimeModel


@refusing()
def recognise_online(fit: Fit, **settings: Any) -> OnlineRecognition:
    """Return what recognises motions while they happen, reading by reading.

    It is that of `motionese.runtime`, which needs NumPy alone.

    Args:
        fit: What training left; every motion it learned is a hypothesis.
        settings: Of `OnlineRecognition`: the observed channels, window, steps, ahead, budget_ms.

    Raises:
        SettingError: The fit holds no motion.
    """
    return OnlineRecognition(runtime_model(fit), **settings)


def runtime_model(fit: Fit) -> RuntimeModel:
    """Return a fit as a robot holds it, as `motionese.runtime.load` reads it from its file."""
    network, channels = fit.network, fit.network.channels
    if not fit.names or channels is None:
        raise SettingError(NO_MOTION)
    single = {
        name: np.ascontiguousarray(value, np.float32)
        for name, value in (
            ("weights", network.wired_weights()),
            ("bias", network.bias),
            ("tau", network.tau),
        )
    }
    states = np.asarray(fit.initial_states, np.float32)
    return RuntimeModel(
        **single,
        channels=channels.names,
        units=tuple(channel.unit for channel in channels),
        low=np.array([channel.low for channel in channels]),
        high=np.array([channel.high for channel in channels]),
        rate_hz=fit.rate_hz,
        initial_states=dict(zip(fit.names, states, strict=True)),
        lengths=dict(zip(fit.names, fit.lengths, strict=True)),
        senses_first=network.initial_io == "sensed",
        binary=np.array([channel.binary or (np.nan, np.nan) for channel in channels]),
    )
