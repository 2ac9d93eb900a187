"""A study: two loops of imitation, in two conditions, read from the tables that they leave.

A trial of everything: a network that learned so little imitates badly.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

from motionese.experiment import Run, go_through, read_settings

settings = read_settings("default", ["training.epochs=150", "babbling.epochs=300"], quick=True)
figure, panel = plt.subplots(figsize=(7, 3.4), layout="tight")
looks = {"TD/MD": ("#0072b2", "-"), "TND/MD": ("#d55e00", "-")}
for condition in settings.conditions:
    if condition.name in looks:
        run = Run(condition, 0, Path("study") / condition.folder)
        print(run.name, go_through(run, settings, lambda loop: print("  loop", loop))["status"])
        errors = pd.read_csv(run.folder / "loops.csv").groupby("loop")["imitation_error_cm"]
        colour, line = looks[condition.name]
        panel.plot(errors.median(), line, marker="o", color=colour, label=condition.name)
panel.set(xlabel="loop", ylabel="imitation error, median over motions [cm]", ylim=(0, None))
panel.xaxis.get_major_locator().set_params(integer=True)
panel.legend()
figure.savefig("study.png", dpi=120)
