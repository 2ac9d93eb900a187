"""A task: places, ways between them, and every sequence of strokes that they allow."""

import matplotlib.pyplot as plt
import numpy as np

from motionese.task import SHAPES

figure, panels = plt.subplots(1, 3, figsize=(9, 3.4), sharex=True, sharey=True, layout="tight")
share = np.linspace(0, 1, 50)
for panel, sequence in zip(panels, SHAPES.lesson("shapes"), strict=True):
    for primitive in sequence.primitives:
        ends = SHAPES.position(primitive.start), SHAPES.position(primitive.end)
        _, y, z = 100 * primitive.way(share, *ends).T
        panel.plot(-y, z, color="#0072b2")
        panel.annotate(primitive.sign, (-y[25], z[25]), fontsize=14, ha="center", va="center")
    for name, place in SHAPES.places.items():
        panel.plot(-100 * place.position[1], 100 * place.position[2], "o", color="0.7", zorder=0)
        panel.annotate(name, (-100 * place.position[1] + 0.6, 100 * place.position[2] + 0.6))
    panel.set(title=sequence.name, xlabel="to the robot's right [cm]", aspect="equal")
panels[0].set_ylabel("height [cm]")
print(len(SHAPES.sequences(3)), "sequences of three strokes are possible")
figure.savefig("task.png", dpi=120)
