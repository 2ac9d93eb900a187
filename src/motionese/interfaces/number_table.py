"""Tables of numbers for the terminal: names kept whole, numbers to the right."""

from rich.table import Table


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
