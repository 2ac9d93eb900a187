"""Rows of plain numbers read fast, as JSON reads them; anything else is left to the careful way.

A row of a table is a JSON array without its brackets, and the reader of JSON that pydantic brings
is several times faster than Python's `csv` and `float`. What JSON and a table do not read alike
(quotes, decimal commas, words for a missing value, rows of another width) is not read here.
"""

import re
from collections.abc import Iterator, Sequence
from io import BufferedIOBase

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray
from pydantic_core import from_json

CHUNK = 1 << 16
"""Bytes read at a time: few enough to stay near the processor."""
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
    parts: list[tuple[Float[ndarray, " _"], Bool[ndarray, " _"]]] = []
    narrow = width - len(textual)
    if not narrow:
        return None
    try:
        for lines in _chunks(file):
            plain = _without_text(_with_commas(lines, separator), width, textual, words)
            parts.append(_parsed(plain, narrow))
    except (ValueError, TypeError, OverflowError, IndexError):
        return None
    if not parts:
        return None
    values, seen = (np.concatenate(kind).reshape(-1, narrow) for kind in zip(*parts, strict=True))
    rows = len(values)
    # Spreadsheets end a table with lines of nothing but separators.
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
        for column, found in zip(textual, words, strict=True):
            found.append(cells[column].decode().strip())
        rows.append(b",".join([cells[i] for i in kept]))
    return b"\n".join(rows)


def _parsed(lines: bytes, width: int) -> tuple[Float[ndarray, " _"], Bool[ndarray, " _"]]:
    """Return the numbers of rows, one after another, and what of them was observed.

    `ValueError` where they are not as many in every row, or no numbers.
    """
    # A text between two rows shows whether all rows are as wide: it is no number elsewhere.
    text = b"[" + lines.replace(b"\n", b',"",') + b"]"
    whole = b"null" not in lines
    try:
        found = from_json(text)
    except ValueError:
        whole = False
        text = NAN.sub(b"NaN", INFINITE.sub(b"Infinity", EMPTY.sub(b"null", text)))
        found = from_json(text)
    between = slice(width, None, width + 1)
    if (len(found) + 1) % (width + 1) or {*found[between]} - {""}:
        raise ValueError("rows of another width")
    del found[between]
    seen = np.ones(len(found), dtype=bool)
    if not whole:
        seen[:] = [cell is not None for cell in found]
    return np.fromiter(found, np.float64, len(found)), seen
