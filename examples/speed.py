"""Speed: one learned motion at half, single and double its duration, by its time constants."""

import jax
import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

t = np.linspace(0, 2 * np.pi, 60)[:, None]
shown = np.hstack([np.sin(t), np.sin(2 * t)])
data = mo.Motions.from_arrays([shown], channels=["x", "y"], rate_hz=10.0)
net = mo.MTRNN.draw([mo.Level(2, tau=4.0), mo.Level(40, tau=8.0)], key=jax.random.key(0), gain=2.0)
fit = mo.train(net, data, epochs=3000)

figure, panels = plt.subplots(1, 2, figsize=(9, 3.4), layout="tight")
for duration, colour in ((0.5, "#d55e00"), (1.0, "#0072b2"), (2.0, "#009e73")):
    steps = round(60 * duration)
    path = mo.generate(fit.network, fit.initial_states[0], steps, duration=duration)
    panels[0].plot(np.arange(steps) / 10, path[:, 0], color=colour, label=f"× {duration:g}")
    panels[1].plot(*path.T, color=colour)
panels[0].set(xlabel="time [s]", ylabel="x")
panels[0].legend(title="duration", fontsize=8)
panels[1].set(xlabel="x", ylabel="y", aspect="equal", title="the way stays the same")
figure.savefig("speed.png", dpi=120)
