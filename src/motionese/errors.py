"""The package's exceptions: each carries one clear sentence for the person who meets it.

The command line prints the sentence of a `MotioneseError` and leaves with exit status 2; any other
exception that reaches it is a defect of the package.
"""

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any


class MotioneseError(Exception):
    """Something the user can put right; its text says what was got and what would be right."""

    def __str__(self) -> str:
        """Return the text on one line, whatever the names from a file that it tells."""
        return " ".join(super().__str__().splitlines())


class SettingError(MotioneseError):
    """A setting that does not exist, or a value outside its allowed range."""


class ChannelError(MotioneseError):
    """A channel that does not exist, or values that do not fit the channels."""


class MotionError(MotioneseError):
    """Recorded motions that cannot be learned from: empty, not finite, of the wrong shape."""


class RecordingError(MotioneseError):
    """A file of recordings that cannot be read as what it is said to be, or not be written."""


class MissingPackageError(MotioneseError):
    """What was asked for needs a package that is not installed; the text says which extra."""


class ControlError(MotioneseError):
    """A control loop that cannot be run as it is set, or readings that do not fit its model."""


class TaskError(MotioneseError):
    """A motion that the task does not allow, or a corner that the arm does not reach."""


class StorageError(MotioneseError):
    """A file that is not a model of this package, is cut short, or belongs to other settings."""


class RunFolderError(MotioneseError):
    """A run folder that is in use, not ours, not writable, or of other settings."""


class RenderingError(MotioneseError):
    """Pictures cannot be rendered on this machine; the text names what to install."""


class TooFewSeedsError(MotioneseError):
    """A statistical test was asked for with fewer seeds than it needs."""


LONGEST_TOLD = 60
"""Characters of what was given, beyond which only its type is told."""
NO_MOTION = "the model has learned no motion yet; train it on motions first"
HELD_OUT = (
    "was held out of the training, so the model has no initial states of it: recognise finds them "
    "(--initial FILE writes them there), and generate --initial FILE goes on from them"
)
CHECKPOINT_BEFORE = (
    "a checkpoint of an experiment made by motionese 0.1 before checkpoints were models: "
    "run the experiment again"
)


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """Return the sentence for a name that does not exist, with the nearest one that does."""
    names, name = [str(k) for k in known], str(name)
    folded = {k.casefold(): k for k in names}
    near = get_close_matches(name.casefold(), list(folded), n=1, cutoff=0.4)
    hint = f"; did you mean '{folded[near[0]]}'?" if near else ";"
    return f"unknown {kind} '{name}'{hint} there are: {', '.join(names)}"


def kind_of(given: Any) -> str:
    """Return what something is, in a few words, for the sentence that refuses it."""
    kind = type(given)
    text = repr(given) if kind.__module__ == "builtins" else ""
    if text and len(text) <= LONGEST_TOLD and not text.startswith("<"):
        return text
    if (shape := getattr(given, "shape", None)) is not None:
        return f"{kind.__name__} of shape {shape}"
    size = f" of {len(given)}" if isinstance(given, list | tuple | dict | set) else ""
    return f"{kind.__name__}{size}"


def needs(package: str, extra: str, what: str) -> MissingPackageError:
    """Return the error that says how to install an extra, for raising where its import failed."""
    return MissingPackageError(
        f"{what} needs the package '{package}', which is not installed: "
        f"pip install 'motionese[{extra}]'"
    )
