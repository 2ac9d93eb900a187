"""Messages about the robot's process itself, for both sides; nothing heavy is imported here."""

from typing import Any, Literal

Told = dict[str, Any]
"""A message to the page."""
State = Literal["starting", "ready", "restarted", "failed"]


def worker_told(state: State, sentence: str) -> Told:
    """Return how the robot's process is."""
    return {"type": "worker", "state": state, "sentence": sentence}
