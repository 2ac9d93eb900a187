"""The text of a file, in whichever encoding the program that wrote it chose."""

import re
from pathlib import Path

from motionese.errors import RecordingError

MARKS = {
    b"\xef\xbb\xbf": "utf-8",
    b"\xff\xfe\x00\x00": "utf-32-le",
    b"\x00\x00\xfe\xff": "utf-32-be",
    b"\xff\xfe": "utf-16-le",
    b"\xfe\xff": "utf-16-be",
}
"""The bytes with which a file may begin to tell its encoding."""
HEAD, MOSTLY = 4096, 0.6
"""Bytes by which UTF-16 without a mark is known: so many of every second are 0, no other is."""
NO_TEXT = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")
"""Control characters that no text holds; Ctrl-Z is what old programs end a file with."""
WESTERN = "cp1252"


def decoded(path: Path, content: bytes) -> tuple[str, str]:
    """Return the text, and what was guessed of its encoding, in words; empty where it is plain.

    Raises:
        RecordingError: No text, or damaged text.
    """
    mark = next((mark for mark in MARKS if content.startswith(mark)), b"")
    guess = "" if mark else _wide(content[:HEAD])
    try:
        text = content[len(mark) :].decode(MARKS.get(mark, guess or "utf-8"))
        return text, f"read as {guess.upper()}, though no mark tells its encoding" if guess else ""
    except UnicodeDecodeError as error:
        wrong = error.start + len(mark)
        if mark or guess or NO_TEXT.search(content):
            raise RecordingError(f"{path}: not a text file (byte {wrong})") from error
    # What is left undefined there is what Latin-1 says.
    text = content.decode(WESTERN, errors="surrogateescape").translate(
        {0xDC00 + byte: byte for byte in range(128, 256)}
    )
    return text, f"read as Western text ({WESTERN}, Latin-1), as byte {wrong} is no UTF-8"


def _wide(head: bytes) -> str:
    """Return the encoding of letters of two bytes each; empty where it is none."""
    first, second = head[::2].count(0), head[1::2].count(0)
    if not first and second > MOSTLY * len(head) / 2:
        return "utf-16-le"
    if not second and first > MOSTLY * len(head) / 2:
        return "utf-16-be"
    return ""
