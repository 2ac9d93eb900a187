"""Train and recall: three motions are learned, and each is generated again from its initial state.

Two rhythms and a reach, of different lengths, over two channels. What a network has learned it
generates in closed loop: nothing but the initial state tells the motions apart.
"""

import jax
import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

t = np.linspace(0, 2 * np.pi, 60)[:, None]
shown = {
    "circle": np.hstack([np.cos(t), np.sin(t)]),
    "eight": np.hstack([np.sin(t), np.sin(2 * t)]),
    "reach": np.hstack([1 - t[:40] / 4, np.tanh(t[:40] - 2)]),
}
data = mo.Motions.from_arrays(
    list(shown.values()), channels=["x", "y"], rate_hz=10.0, names=list(shown)
)
net = mo.MTRNN.draw([mo.Level(2, tau=2.0), mo.Level(30, tau=5.0)], key=jax.random.key(0), gain=2.0)
fit = mo.train(net, data, epochs=3000)
print(fit.status)

figure, panels = plt.subplots(1, 3, figsize=(9, 3.2), sharex=True, sharey=True, layout="tight")
for panel, name, state, steps in zip(
    panels, fit.names, fit.initial_states, fit.lengths, strict=True
):
    recalled = mo.generate(fit.network, state, steps)
    panel.plot(*shown[name].T, color="0.7", linewidth=5, label="shown")
    panel.plot(*recalled.T, color="#0072b2", label="generated in closed loop")
    panel.set(title=name, xlabel="x", aspect="equal")
panels[0].set_ylabel("y")
panels[0].legend(loc="lower left", fontsize=8)
figure.savefig("train_and_recall.png", dpi=120)
