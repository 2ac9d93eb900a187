"""What NumPy raises where a file is none of its own."""

import zipfile
import zlib
from tokenize import TokenError

UNREADABLE = (
    *(OSError, EOFError, MemoryError, zipfile.BadZipFile, zlib.error),
    # Headers are parsed as Python literals, archives as whatever their entries say.
    *(ValueError, SyntaxError, TokenError, TypeError, KeyError, AttributeError, OverflowError),
    *(NotImplementedError, RuntimeError),
)


def why(error: BaseException) -> str:
    """Return an error's own words on one line."""
    return " ".join(str(error).split()) or type(error).__name__
