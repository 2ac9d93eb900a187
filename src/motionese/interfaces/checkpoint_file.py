"""The file beside a model in which its training is kept until it ends."""

from pathlib import Path


def checkpoint_of(model: Path) -> Path:
    """Return where the training of a model is kept."""
    return model.with_suffix(".checkpoint")


def stopped(model: Path) -> str:
    """Return what to say when the training of a model was stopped."""
    if checkpoint_of(model).exists():
        return "stopped; the same command with --resume goes on"
    return "stopped; there is no training to go on with"
