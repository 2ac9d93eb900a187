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


def test_help_imports_nothing_heavy():
    command = [sys.executable, "-c", HELP, "reproduce", "--help"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert "--conditions" in done.stdout
    assert [name for name in HEAVY if f"'{name}'" in done.stdout] == []
