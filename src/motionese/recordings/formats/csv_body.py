"""Rows of plain numbers read fast, as JSON reads them; anything else is left to the careful way.

A row of a table is a JSON array without its brackets, and the reader of JSON that pydantic brings
is several times faster than Python's `csv` and `float`. What JSON and a table do not read alike
(quotes, decimal commas, words for a missing value, rows of another width) is not read here.
"""

import re
from collections.abc import Iterator, Sequence
from io import SEEK_END, BufferedIOBase

import numpy as np
from jaxtyping import Bool, Float, Int
from numpy import ndarray
from pydantic_core import from_json

CHUNK, SPARE = 1 << 16, 1.02
"""Bytes read at a time, few enough to stay near the processor; how much room is left for more."""
EMPTY = re.compile(rb"(?<=[\[,])[ \t]*(?=[\],])")
NAN, INFINITE = re.compile(rb"(?i)\bnan\b"), re.compile(rb"(?i)\binf(inity)?\b")

Body = tuple[Float[ndarray, "T K"], Bool[ndarray, "T K"], tuple[tuple[str, ...], ...]]


def read_body(
    file: BufferedIOBase, separator: str, width: int, textual: Sequence[int]
) -> Body | None:
    """Return the numbers of a table's rows, what was observed of them, and columns of text.

    Args:
        file: UTF-8, at the beginning of the first row.
        separator: What stands between two cells.
        width: How many cells every row has.
        textual: The columns that are text, in their order.

    Returns:
        None where any row is not plain.
    """
    words: list[list[str]] = [[] for _ in textual]
    narrow, cells = width - len(textual), 0
    if not narrow:
        return None
    begin, whole = file.tell(), file.seek(0, SEEK_END)
    file.seek(begin)
    values, gaps = np.empty(0), np.empty(0, dtype=int)
    try:
        for lines in _chunks(file):
            plain = _without_text(_with_commas(lines, separator), width, textual, words)
            found, empty = _parsed(plain, narrow)
            if cells + len(found) > len(values):
                # What was read so far tells how much there is, give or take.
                share = (file.tell() - begin) / (whole - begin)
                longer = np.empty(int((cells + len(found)) / share * SPARE) + narrow)
                longer[:cells] = values[:cells]
                values = longer
            values[cells : cells + len(found)] = found
            gaps = np.append(gaps, cells + empty) if len(empty) else gaps
            cells += len(found)
    except (ValueError, TypeError, OverflowError, IndexError):
        return None
    seen = np.ones(cells, dtype=bool)
    seen[gaps] = False
    return without_end(values[:cells].reshape(-1, narrow), seen.reshape(-1, narrow), words)


def without_end(
    values: Float[ndarray, "N K"], seen: Bool[ndarray, "N K"], words: list[list[str]]
) -> Body | None:
    """Return rows without those at the end that are empty: spreadsheets write such lines."""
    rows = len(values)
    while rows and not (seen[rows - 1].any() or any(column[rows - 1] for column in words)):
        rows -= 1
    return (values[:rows], seen[:rows], tuple(tuple(w[:rows]) for w in words)) if rows else None


def _chunks(file: BufferedIOBase) -> Iterator[bytes]:
    """Yield whole lines, some at a time, without the last line break."""
    rest = b""
    while read := file.read(CHUNK):
        end = read.rfind(b"\n")
        if end < 0:
            rest += read
            continue
        whole, rest = rest + read[:end], read[end + 1 :]
        yield whole if len(read) == CHUNK else whole.rstrip(b"\r\n")
    if rest := rest.rstrip(b"\r\n"):
        yield rest


def _with_commas(lines: bytes, separator: str) -> bytes:
    if b'"' in lines:
        raise ValueError("quotes")
    if b"\r" in lines:
        lines = lines.replace(b"\r\n", b"\n").removesuffix(b"\r")
        if b"\r" in lines:
            raise ValueError("lines that end otherwise")
    if separator != ",":
        if b"," in lines:
            raise ValueError("decimal commas")
        padded = b"  " in lines or b"\n " in lines or b" \n" in lines
        if separator == " " and (padded or lines[:1] == b" " or lines[-1:] == b" "):
            raise ValueError("any number of blanks")
        lines = lines.replace(separator.encode(), b",")
    return lines


def _without_text(
    lines: bytes, width: int, textual: Sequence[int], words: list[list[str]]
) -> bytes:
    """Return the lines without the columns of text, whose cells are added to `words`."""
    if not textual:
        return lines
    last = textual[-1] + 1
    kept = [i for i in range(min(last + 1, width)) if i not in textual]
    rows = []
    for line in lines.split(b"\n"):
        cells = line.split(b",", last)
        if len(cells) != min(last + 1, width):
            raise ValueError("rows of another width")
        for column, found in zip(textual, words, strict=True):
            found.append(cells[column].decode().strip())
        rows.append(b",".join([cells[i] for i in kept]))
    return b"\n".join(rows)


def _parsed(lines: bytes, width: int) -> tuple[Float[ndarray, " _"], Int[ndarray, " _"]]:
    """Return the numbers of rows, one after another, and which of them are empty cells.

    `ValueError` where they are not as many in every row, or no numbers.
    """
    # A text between two rows shows whether all rows are as wide: it is no number elsewhere.
    text = b"[" + lines.replace(b"\n", b',"",') + b"]"
    whole = b"null" not in lines
    try:
        found = from_json(text)
    except ValueError:
        # An empty line is no row with an empty cell.
        if width == 1:
            raise
        whole = False
        text = NAN.sub(b"NaN", INFINITE.sub(b"Infinity", EMPTY.sub(b"null", text)))
        found = from_json(text)
    between = slice(width, None, width + 1)
    if (len(found) + 1) % (width + 1) or {*found[between]} - {""}:
        raise ValueError("rows of another width")
    del found[between]
    empty = [] if whole else [i for i, cell in enumerate(found) if cell is None]
    return np.fromiter(found, np.float64, len(found)), np.array(empty, dtype=int)
