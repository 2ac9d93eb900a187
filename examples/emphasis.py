"""Motionese: the same two strokes shown to an adult, and with one thing emphasised at a time."""

import matplotlib.pyplot as plt
import numpy as np

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.caregiver import Manner, ScriptedCaregiver
from motionese.kinematics import measure
from motionese.task import PUSHING_BUTTONS

EMPHASES = ["as to an adult", "pauses", "exaggeration", "slowness", "roundness"]

body = open_body(ActroidSettings(), PUSHING_BUTTONS)
sequence = PUSHING_BUTTONS.sequence("UR ←↓")
figure, panels = plt.subplots(2, 5, figsize=(14, 5), layout="tight", sharex="row", sharey="row")
for name, (way, course) in zip(EMPHASES, panels.T, strict=True):
    motionese = {} if name == EMPHASES[0] else {name: {"strength": 1.0}}
    manner = Manner(
        stroke_steps=12, rest_steps=2, variability_mm=1.0, persistence=0.9, motionese=motionese
    )
    caregiver = ScriptedCaregiver(PUSHING_BUTTONS, manner, body)
    shown = caregiver.demonstrate(sequence, np.random.default_rng(0))
    found, right, up = measure(shown.path, body.rate_hz), -shown.path[:, 1], shown.path[:, 2]
    way.plot(100 * right, 100 * up, ".-", color="#0072b2", linewidth=1)
    way.plot(100 * right[[*shown.begins]], 100 * up[[*shown.begins]], "o", color="#d55e00")
    way.set(title=name, xlabel="to the robot's right [cm]", aspect="equal")
    for pause in found.pauses:
        course.axvspan(pause.start_s, pause.end_s, color="#e69f00", alpha=0.4, linewidth=0)
    for track in found.tracks:
        course.plot(track.times, 100 * track.speeds, color="#0072b2")
    for row in shown.begins:
        course.axvline(row / body.rate_hz, color="#d55e00", linestyle="--", linewidth=0.9)
    length = 100 * sum(movement.length for movement in found.movements)
    course.set(xlabel="time [s]", title=f"{length:.0f} cm in {found.duration:.1f} s")
panels[0, 0].set(ylabel="height [cm]")
panels[1, 0].set(ylabel="speed of the hand [cm/s]")
figure.savefig("emphasis.png", dpi=120)
