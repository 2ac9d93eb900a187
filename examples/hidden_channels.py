"""Hidden channels: a motion is recognised from two of its three channels, the third is recalled.

Recognition finds the initial state from which the network generates what can be seen; what cannot
be seen then follows from what was learned. The third channel is never shown to recognition.
"""

import jax
import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

t = np.linspace(0, 2 * np.pi, 60)[:, None]


def arm(size: float) -> np.ndarray:
    """Return a motion whose height, the third channel, goes with its size."""
    return np.hstack([size * np.cos(t), size * np.sin(t), size * np.sin(2 * t)])


data = mo.Motions.from_arrays(
    [arm(size) for size in (0.2, 0.5, 0.8)], channels=["x", "y", "height"], rate_hz=10.0
)
net = mo.MTRNN.draw([mo.Level(3, tau=2.0), mo.Level(30, tau=5.0)], key=jax.random.key(1), gain=2.0)
fit = mo.train(net, data, epochs=3000)

figure, panel = plt.subplots(figsize=(7, 3.5), layout="tight")
for size, colour in ((0.2, "#0072b2"), (0.5, "#e69f00"), (0.8, "#009e73")):
    rng = np.random.default_rng(round(10 * size))
    seen = arm(size) + 0.02 * rng.standard_normal((60, 3))
    found = mo.recognise(fit, seen, observed=["x", "y"])
    recalled = mo.generate(fit.network, found.initial_state, steps=60)
    panel.plot(t / 2 / np.pi * 6, seen[:, 2], ".", color=colour, markersize=3)
    panel.plot(t / 2 / np.pi * 6, recalled[:, 2], color=colour, label=f"size {size:g}")
panel.set(
    xlabel="time [s]", ylabel="height", title="dots: hidden from recognition; lines: recalled"
)
panel.legend(fontsize=8)
figure.savefig("hidden_channels.png", dpi=120)
