"""The page of a sweep: which findings hold where, and what the settings change."""

import numpy as np
import pandas as pd
import pytest
from invented_results import measures_table, write_reported
from report_page import Page

from motionese.analysis import write_sweep
from motionese.analysis.sweep.effects import swept_effects
from motionese.analysis.sweep.findings import swept_findings
from motionese.analysis.sweep.points import points_of, reference_of
from motionese.errors import RunFolderError
from motionese.experiment import read_settings
from motionese.experiment.sweeps import Sweep

SEEDS = range(8)
SWEEP = Sweep(preset="order", vary={"network.levels.cs.tau": [35, 70, 140]})
LOW, REFERENCE, HIGH = (point.label for point in SWEEP.points)


def point(root, label, separation, seeds=SEEDS, ends=()):
    """A point where only TD/MD separates, so much; everything else is the same everywhere."""
    measures = measures_table(seeds, 0.1)
    noise = np.random.default_rng(len(label)).normal(0, 0.01, len(measures))
    phased = measures["condition"] == "TD/MD"
    measures["separation"] = np.where(phased, separation, 0.1) + noise
    settings = {p.label: p.overrides for p in SWEEP.points}[label]
    return write_reported(root / label, measures, read_settings("order", settings), ends=ends)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    root = tmp_path_factory.mktemp("sweep")
    return [
        point(root, LOW, 0.1),
        point(root, REFERENCE, 0.95),
        point(root, HIGH, 0.6, ends={("TD/MND", 1): "diverged"}),
    ]


@pytest.fixture(scope="module")
def points(folders):
    return points_of(SWEEP, folders)


@pytest.fixture(scope="module")
def page(folders):
    path = folders[0].parent / "report.html"
    write_sweep(SWEEP, folders, path)
    return Page(path.read_text())


def test_the_reference_is_the_point_that_changes_nothing(points):
    assert list(points) == [LOW, REFERENCE, HIGH]
    assert reference_of(SWEEP, points) == REFERENCE
    assert reference_of(SWEEP, {HIGH: points[HIGH]}) == HIGH


def test_the_plan_is_tested_anew_at_every_point(points):
    found = swept_findings("order", points)
    main = found[found["main"]].set_index("point")["verdict"]
    assert main[REFERENCE] == "holds"
    assert main[LOW] != "holds"
    assert main[HIGH] == "does not hold"  # separated from the others, but not by enough
    better = found[found["text"] == "TD/MD separates the roles more than TD/MND"]
    assert dict(zip(better["point"], better["verdict"], strict=True))[HIGH] == "holds"


def test_conditions_that_were_left_out_leave_findings_out(tmp_path):
    folder = point(tmp_path, REFERENCE, 0.95)
    measures = pd.read_csv(folder / "measures.csv")
    alone = tmp_path / "alone"
    write_reported(alone / REFERENCE, measures[measures["condition"] == "TD/MD"])
    assert swept_findings("order", points_of(SWEEP, [alone / REFERENCE])).empty


def test_differences_are_paired_with_the_reference_and_corrected(points):
    table = swept_effects(points, REFERENCE).set_index(["measure", "condition", "point"])
    row = table.loc[("separation", "TD/MD", HIGH)]
    assert row["verdict"] == "less"
    assert row["difference"] == pytest.approx(-0.35, abs=0.02)
    assert row["difference_low"] < row["difference"] < row["difference_high"]
    assert row["p"] == pytest.approx(2 / 2**8)
    assert row["p_corrected"] == pytest.approx(4 / 2**8)
    assert table.loc[("separation", "TND/MD", HIGH), "verdict"] == "undecided with 8 seeds"
    assert pd.isna(table.loc[("separation", "TD/MD", REFERENCE), "difference"])
    assert table.loc[("separation", "TD/MD", REFERENCE), "median"] == pytest.approx(0.95, abs=0.02)


def test_the_page_tells_all_of_it(page, folders):
    assert "A sweep over network.levels.cs.tau" in page.text
    assert f"Reference: {REFERENCE} ." in page.text
    assert "Separation: Only TD/MD separates the roles" in page.text
    assert "cs.tau=140: 1 diverged of 32 runs." in page.text
    assert "decide nothing" not in page.text
    leading = [each for each in page.resources if not each.startswith(("#", "data:"))]
    assert leading == [f"cs.tau%3D{value}/report.html" for value in (35, 70, 140)]
    assert len(set(page.ids)) == len(page.ids)
    beside = folders[0].parent
    assert len(pd.read_csv(beside / "sweep_effects.csv")) % 3 == 0
    assert (beside / "figures" / "sweep.png").stat().st_size > 10_000


def test_points_that_are_missing_and_few_seeds_are_told(tmp_path):
    folder = point(tmp_path, REFERENCE, 0.95, seeds=range(3))
    write_sweep(SWEEP, [folder], tmp_path / "report.html")
    text = Page((tmp_path / "report.html").read_text()).text
    assert "Fewer than 6 seeds decide nothing" in text
    assert f"No run has ended yet at {LOW}; {HIGH}." in text


def test_folders_that_are_no_points_are_refused(tmp_path):
    with pytest.raises(RunFolderError, match="no run folder of the sweep's points: other"):
        points_of(SWEEP, [tmp_path / "other"])
