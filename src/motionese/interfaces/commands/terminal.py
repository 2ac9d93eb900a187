"""What is told in the terminal of whatever it is: tables of numbers, and findings."""

from collections.abc import Sequence

from rich.console import Console
from rich.table import Table

from motionese.recordings import Finding


def number_table(*headings: str) -> Table:
    """Return a table whose first column holds names and whose others hold numbers."""
    table = Table(*headings)
    for column in table.columns:
        # Where there is no room a cell goes on in the next line: no digit is ever left out.
        column.overflow = "fold"
    table.columns[0].no_wrap = True
    for column in table.columns[1:]:
        column.justify = "right"
    return table


def tell_findings(console: Console, findings: Sequence[Finding]) -> None:
    """Print what was found in a recording, a line each."""
    for finding in findings:
        console.print(f"! {finding.sentence}", soft_wrap=True)
