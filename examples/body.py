"""A body: the simulated Actroid presses a button with its compliant arm, and lags as it does so."""

import matplotlib.pyplot as plt
import numpy as np

from motionese.body import BODIES, open_body
from motionese.minimum_jerk import minimum_jerk
from motionese.task import PUSHING_BUTTONS

settings, _ = BODIES["actroid"]
robot = open_body(settings(), PUSHING_BUTTONS)
start, end = (robot.command_reaching(PUSHING_BUTTONS.position(place)) for place in ("UR", "LR"))

robot.reset(start, np.random.default_rng(0))
commanded, sensed, depth = [], [], []
for share in minimum_jerk(np.clip(np.arange(25) / 12, 0, 1)):
    robot.command(start + share * (end - start))
    robot.step()
    commanded.append((start + share * (end - start))[0])
    sensed.append(robot.sense()[0])
    depth.append(robot.effects()["right_button"])

seconds = np.arange(1, 26) / robot.rate_hz
figure, panel = plt.subplots(figsize=(7, 3.4), layout="tight")
panel.plot(seconds, commanded, "--", color="#0072b2", label="shoulder, commanded")
panel.plot(seconds, sensed, color="#0072b2", label="shoulder, sensed")
panel.set(xlabel="time [s]", ylabel="angle [rad]")
panel.legend(loc="upper left", fontsize=8)
right = panel.twinx()
right.plot(seconds, depth, color="#d55e00")
right.set_ylabel("depth of the right button [mm]", color="#d55e00")
figure.savefig("body.png", dpi=120)
