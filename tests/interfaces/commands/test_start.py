"""The command line answers at once: nothing heavy is imported before it is needed."""

import subprocess
import sys

HEAVY = ("jax", "mujoco", "pandas", "matplotlib", "distributed", "numpy")
HELP = """
import sys
from motionese.interfaces.commands.command_line import main
try:
    main()
finally:
    print(sorted(sys.modules))
"""


def modules_after(*arguments):
    """Run a command; returns its output and the names of all modules that it imported."""
    command = [sys.executable, "-c", HELP, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def test_help_imports_nothing_heavy():
    output = modules_after("reproduce", "--help")
    assert "--conditions" in output
    assert [name for name in HEAVY if f"'{name}'" in output] == []


def test_inspecting_imports_nothing_that_learns(tmp_path):
    table = tmp_path / "demo.csv"
    table.write_text("x,y\n0,1\n1,0\n2,1\n")
    output = modules_after("inspect", str(table), "--rate", "10", "--plot", str(tmp_path / "a.svg"))
    assert "1 episode" in output
    assert [name for name in ("jax", "motionese.learning") if f"'{name}'" in output] == []
