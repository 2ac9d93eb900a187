"""Tables of numbers for the terminal: names kept whole, numbers to the right."""

from rich.table import Table


def number_table(*headings: str) -> Table:
    """Return a table whose first column keeps its names whole and whose others hold numbers."""
    table = Table(*headings)
    table.columns[0].no_wrap = True
    table.columns[0].overflow = "fold"
    for column in table.columns[1:]:
        column.justify = "right"
    return table
