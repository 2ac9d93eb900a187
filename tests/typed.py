"""Commands as they are typed, in this process, and recordings of a small arm to type them on."""

import csv
import os
import sys
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from motionese.interfaces.commands.command_line import main

CHANNELS = ("shoulder [rad]", "elbow [rad]", "x [m]", "y [m]")
NAMES = ("lift", "reach", "wave", "push", "pull")
RATE_HZ = 20.0
COLUMNS = "200"
SMALL = ("--levels", "10:3,3:15", "--epochs", "300")


def typed(*arguments: str) -> tuple[int, str, str]:
    """Run a command; returns status, output and errors."""
    output, errors = StringIO(), StringIO()
    with (
        patch.object(sys, "argv", ["motionese", *arguments]),
        patch.dict(os.environ, {"COLUMNS": COLUMNS}),
        redirect_stdout(output),
        redirect_stderr(errors),
        pytest.raises(SystemExit) as left,
    ):
        main()
    return left.value.code, output.getvalue(), errors.getvalue()


def refused(*arguments: str) -> str:
    """Run a command that must be refused with one sentence and leave every file as it was."""
    before = listing()
    status, _, errors = typed(*arguments)
    assert status == 2, errors
    assert errors.startswith("motionese: ")
    assert errors.count("\n") == 1
    assert listing() == before
    return errors.removeprefix("motionese: ").strip()


def listing() -> dict[str, bytes | None]:
    """Return every file below this folder with what it holds."""
    return {str(path): path.read_bytes() if path.is_file() else None for path in Path().rglob("*")}


def arm_motions() -> dict[str, np.ndarray]:
    """Return reaching motions of different lengths by name: two joints and where the hand is."""
    motions = {}
    for i, name in enumerate(NAMES):
        s = np.linspace(0, 1, 20 + i)
        shoulder = (0.4 + 0.2 * i) * s**3 * (10 - 15 * s + 6 * s**2)
        elbow = (1.4 - 0.2 * i) * np.sin(np.pi * s) ** 2
        x = 0.3 * np.cos(shoulder) + 0.25 * np.cos(shoulder + elbow)
        y = 0.3 * np.sin(shoulder) + 0.25 * np.sin(shoulder + elbow)
        motions[name] = np.stack([shoulder, elbow, x, y], axis=1)
    return motions


def write_csv(path, motions=None, *, channels=CHANNELS, rate_hz=RATE_HZ, cell=None):
    """Write motions as a table; `cell` = (motion, row, column, text) puts something else there."""
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["episode", *([] if rate_hz is None else ["time [s]"]), *channels])
        for name, rows in (arm_motions() if motions is None else motions).items():
            for i, row in enumerate(rows):
                cells = [repr(float(v)) for v in row]
                if cell is not None and cell[:2] == (name, i):
                    cells[cell[2]] = cell[3]
                table.writerow([name, *([] if rate_hz is None else [repr(i / rate_hz)]), *cells])
