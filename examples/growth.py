"""Growth: a trained network opens a slow level, keeps what it knows, and learns more.

Besides the two motions that it knows it is to learn two sequences of them. A network of the same
levels that is drawn anew has to learn all four.
"""

import jax
import matplotlib.pyplot as plt
import numpy as np

import motionese as mo

t = np.linspace(0, 2 * np.pi, 50)[:, None]
known = [np.hstack([np.sin(a * t), np.cos(b * t)]) for a, b in ((1, 1), (2, 1))]
longer = [np.vstack([known[0], known[1]]), np.vstack([known[1], known[0]])]

first = mo.Motions.from_arrays(known, channels=["x", "y"], rate_hz=10.0)
both = mo.Motions.from_arrays(known + longer, channels=["x", "y"], rate_hz=10.0)
low = [mo.Level(2, tau=2.0), mo.Level(30, tau=5.0)]
slow = mo.Level(4, tau=70.0)
born = mo.MTRNN.draw(low, key=jax.random.key(0), gain=2.0)
before = mo.train(born, first, epochs=1500)
taller = mo.grow(before.network, slow, key=jax.random.key(1), influence=0.25)
grown = mo.train(taller, both, epochs=1500)
whole = mo.train(mo.MTRNN.draw([*low, slow], key=jax.random.key(0), gain=2.0), both, epochs=1500)

figure, panel = plt.subplots(figsize=(7, 3.5), layout="tight")
panel.semilogy(before.losses, color="0.5", label="IO–Cf on two motions")
epochs = 1500 + np.arange(1500)
panel.semilogy(epochs, grown.losses, color="#0072b2", label="grown to IO–Cf–Cs, on four")
panel.semilogy(epochs, whole.losses, "--", color="#e69f00", label="IO–Cf–Cs drawn anew, on four")
panel.set(xlabel="epoch", ylabel="error E, equation (3)")
panel.legend(fontsize=8)
figure.savefig("growth.png", dpi=120)
