"""The results in a few lines, from the tables."""

import io

import pandas as pd
import pytest
from rich.console import Console

from motionese.experiment import read_settings
from motionese.interfaces.commands.results import summary


@pytest.fixture
def folder(tmp_path):
    rows = [
        {
            "condition": condition,
            "seed": seed,
            "loop": loop,
            "phase": 1 if loop <= 2 else 2,
            "imitation_error_cm": error + 10 * seed / loop + spread,
            "buttons_due": 2,
            "buttons_pressed": 1,
        }
        for condition, error in (("TD/MD", 1.0), ("TND/MND", 2.0))
        for seed in (0, 1, 5)
        for loop in (1, 2, 4)
        for spread in (-0.5, 0.5)
    ]
    pd.DataFrame(rows).to_csv(tmp_path / "loops.csv")
    new = [
        {"condition": "TD/MD", "seed": seed, "trained": trained, "imitation_error_cm": error}
        for seed in (0, 1, 5)
        for trained, error in ((True, 90.0), (False, 3.0 + seed))
    ]
    pd.DataFrame(new).to_csv(tmp_path / "triples.csv")
    return tmp_path


def lines(table):
    out = io.StringIO()
    Console(file=out, width=120).print(table)
    return [
        [cell.strip() for cell in line.split("│")[1:-1]] for line in out.getvalue().splitlines()
    ]


def test_medians_over_seeds_of_means_over_motions_and_of_untaught_sequences_alone(folder):
    assert lines(summary(folder, read_settings()))[5:-1] == [
        ["TD/MD", "3", "11.0", "6.0", "3.5", "4.0", "6 of 12"],
        ["TND/MND", "3", "12.0", "7.0", "4.5", "–", "6 of 12"],
    ]


def test_every_stage_of_a_study_has_a_column_and_every_set_of_new_sequences(folder):
    headers = [
        str(column.header) for column in summary(folder, read_settings("three_stages")).columns
    ]
    assert headers[2:-1] == ["loop 1", "stage 1", "stage 2", "stage 3", "new triples"]


def test_without_new_sequences_there_is_no_column_and_without_due_presses_a_dash(folder):
    (folder / "triples.csv").unlink()
    loops = pd.read_csv(folder / "loops.csv").assign(buttons_due=0, buttons_pressed=0)
    loops.to_csv(folder / "loops.csv")
    assert lines(summary(folder, read_settings()))[5] == ["TD/MD", "3", "11.0", "6.0", "3.5", "–"]
