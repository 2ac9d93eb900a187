"""What is wrong with the description that a file holds, as pydantic finds it."""

from pydantic import ValidationError


def fault(error: ValidationError) -> str:
    """Return the first fault on one line: where it is, and what."""
    first = error.errors(include_url=False)[0]
    where = ".".join(str(part) for part in first["loc"])
    what = first["msg"].removeprefix("Value error, ")
    return f"{where}: {what}" if where else what
