"""The script that keeps the results of confirming runs: tables, figures, and the page of them."""

import runpy
from pathlib import Path

import pytest
from invented_results import measures_table, write_reported

from motionese.analysis import kept_results
from motionese.analysis.beside_kept import TITLES

SCRIPT = Path(__file__).parents[2] / "docs" / "results" / "keep.py"


@pytest.fixture
def keep(tmp_path, monkeypatch):
    """The script's main function, which writes into a folder of the test."""
    monkeypatch.setattr("motionese.analysis.kept.RESULTS", tmp_path / "tables")
    page, script = tmp_path / "page", runpy.run_path(str(SCRIPT))
    page.mkdir()

    def kept(*folders):
        script["main"](folders, tmp_path / "tables", page)
        return page

    return kept


def test_tables_figures_and_a_page_of_them_are_kept(keep, tmp_path):
    measured = measures_table(range(1000, 1009), without=["symbols_right"])
    measured.loc[measured["condition"] == "TND/MD", "separation"] = float("nan")
    order = write_reported(tmp_path / "runs" / "order", measured)
    (order / "figures").mkdir()
    for name in ("learning_curves.png", "learning_curves.svg", "film.png"):
        (order / "figures" / name).write_text(name)
    page = keep(order)
    assert list(kept_results()) == ["order"]
    assert {p.relative_to(page).as_posix() for p in page.rglob("*") if p.is_file()} == {
        *("README.md", "order/learning_curves.png", "order/learning_curves.svg")
    }
    lines = (page / "README.md").read_text().splitlines()
    assert "`make results`" in "".join(lines)
    assert "9 seeds, 1000–1008; motionese 0.7. Medians [95 %]." in lines
    assert "| measure | TD/MD | TD/MND | TND/MD | TND/MND |" in lines
    (row,) = [line for line in lines if line.startswith(f"| {TITLES['separation']} |")]
    assert row.split(" | ")[1].startswith("0.54 [0.5") and row.split(" | ")[3] == "–"
    assert not [line for line in lines if line.startswith("| sequences read out right |")]
    assert "![order: learning curves](order/learning_curves.png)" in lines


def test_the_page_in_the_docs_is_of_what_comes_with_the_package():
    told = SCRIPT.with_name("README.md").read_text().splitlines()
    kept = list(kept_results())
    assert [line for line in told if line.startswith("## ")] == [
        *(["## Findings"] if kept else []),
        *(f"## {preset}" for preset in kept),
    ]
