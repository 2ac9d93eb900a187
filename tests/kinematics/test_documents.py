"""The page of the measures says of every measure what the code does."""

from pathlib import Path

from motionese.kinematics import MEASURES

PAGE = Path(__file__).parents[2] / "docs" / "measures.md"


def test_every_measure_is_on_the_page_with_its_unit_and_source():
    rows = [line.strip("|").split("|") for line in PAGE.read_text().splitlines()]
    told = {
        cells[0].strip(): [cell.strip() for cell in cells[2:]] for cells in rows if len(cells) == 4
    }
    for measure in MEASURES.values():
        assert told[measure.label] == [measure.unit.format("unit"), measure.source]
