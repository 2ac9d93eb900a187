"""Sequence: learned motions one after another, from where the robot is, without a jump."""

import jax
import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

t = np.linspace(0, 1, 40)[:, None]
motions = {
    "lift": np.hstack([t, 0.2 * np.sin(3 * t)]),
    "turn": np.hstack([1 - 0.5 * t, t]),
    "lower": np.hstack([0.5 - 0.5 * t, 1 - t]),
}
data = mo.Motions.from_arrays(
    list(motions.values()), channels=["height [m]", "angle [rad]"], rate_hz=20.0
)
net = mo.MTRNN.draw([mo.Level(2, tau=2.0), mo.Level(30, tau=5.0)], key=jax.random.key(0), gain=2.0)
fit = mo.train(net, data, epochs=2000)
path = mo.generate_sequence(
    fit.network,
    fit.initial_states,
    steps=fit.lengths,
    here={"height [m]": 0.3, "angle [rad]": 0.6},
)

figure, panel = plt.subplots(figsize=(7, 3.2), layout="tight")
for column, name, colour in zip(path.T, data.channels.names, ("#0072b2", "#d55e00"), strict=True):
    panel.plot(np.arange(len(path)) / 20, column, color=colour, label=name)
for begin in np.cumsum(fit.lengths)[:-1]:
    panel.axvline(begin / 20, color="0.8", zorder=0)
panel.set(xlabel="time [s]", title="lift, turn, lower; begun at 0.3 m and 0.6 rad")
panel.legend(fontsize=8)
figure.savefig("sequence.png", dpi=120)
