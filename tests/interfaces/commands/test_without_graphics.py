"""A graphics library that is asked for and not there stops pictures alone, never a command."""

import os
import subprocess
import sys

import pytest

NONE = ("osmesa", "no such library")
"""The first is there on few machines, the second on none."""
LINES = (
    "inspect demos.csv",
    "import demos.csv --out new.npz",
    "export new.npz --out eipl --to eipl",
    "generate arm.safetensors --like wave --out new.svg",
    "presets",
    "presets order",
)
LONGER = (
    "train data.npz --out new.safetensors --levels 4:3 --epochs 1",
    "recognise arm.safetensors demos.csv",
    "recognise arm.safetensors demos.csv --online",
    "export arm.safetensors --onnx arm.onnx",
    "reproduce --quick --seeds 1 --workers 1 --conditions TD/MD --out run",
)
RUN = """
import sys
from motionese.interfaces.commands.command_line import main
for line in sys.argv[1:]:
    sys.argv = ["motionese", *line.split()]
    try:
        main()
    except SystemExit as left:
        if left.code:
            sys.exit(left.code)
print("all done")
"""


def run_asking_for(library, lines):
    environment = {**os.environ, "MUJOCO_GL": library}
    command = [sys.executable, "-c", RUN, *lines]
    return subprocess.run(command, capture_output=True, text=True, env=environment)


@pytest.mark.parametrize("library", NONE)
def test_commands_that_draw_with_no_graphics_library_need_none(arm, library):
    ran = run_asking_for(library, LINES)

    assert (ran.returncode, ran.stderr) == (0, "")
    assert ran.stdout.endswith("all done\n")


@pytest.mark.slow
def test_training_and_the_experiment_need_no_graphics_library(arm):
    ran = run_asking_for(NONE[1], LONGER)
    assert ran.returncode == 0, ran.stderr

    again = run_asking_for(NONE[1], ["report run"])
    assert again.returncode == 2 and "test over seeds" in again.stderr
    assert (arm / "run" / "report.html").is_file()


def test_a_rendered_view_is_refused_with_a_sentence(arm):
    ran = run_asking_for(NONE[1], ["reproduce --quick --vision rendered --out run"])

    assert ran.returncode == 2
    assert "unset MUJOCO_GL (it asks for 'no such library')" in ran.stderr
    assert not (arm / "run").exists()
