"""Names that a person gives to motions of their own, which are known by them from then on."""

from collections.abc import Iterable
from dataclasses import replace

from motionese.caregiver import SOMETHING_ELSE
from motionese.errors import MotioneseError
from motionese.imitation import BABBLING
from motionese.runtime.belief import NONE
from motionese.task import Task
from motionese.teaching.session import Teaching
from motionese.teaching.verdict import sequence_called

LONGEST = 24
"""A name has at most so many characters."""


class NamingError(MotioneseError):
    """A motion cannot be called so; the text says why in a sentence."""


def rename(teaching: Teaching, motion: str, name: str) -> None:
    """Call a motion of the person's own by another name, everywhere.

    What is kept of it elsewhere, such as networks that can be returned to, is renamed when it is
    read; so no other motion may take a name that it had.

    Raises:
        NamingError: There is no such motion, or it cannot be called so.
    """
    standing, notebook = teaching.standing, teaching.notebook
    known = {e.motion for e in notebook.entries}
    known |= {e.motion for e in standing.learner.experiences}
    if motion not in known - {BABBLING} or sequence_called(motion, teaching.scene.task):
        raise NamingError("Only motions of your own can be given a name.")
    had = {name for pair in notebook.renamed for name in pair}
    others = {each for each in known | had if notebook.called_now(each) != motion}
    name = _allowed(name, teaching.scene.task, others)
    if name == motion:
        return
    results = {name if m == motion else m: result for m, result in standing.results.items()}
    teaching.numbers += 1
    renamed = replace(
        standing,
        learner=standing.learner.renamed([(motion, name)]),
        number=teaching.numbers,
        notebook=notebook.with_name(motion, name),
        observed=None,
        results=results,
    )
    teaching.return_to(renamed)
    if standing.observed is not None:
        teaching.look_back(standing.observed.entry.number)


def _allowed(text: str, task: Task, others: Iterable[str]) -> str:
    """Return a name as it is written; `NamingError` where it may not be given."""
    name = " ".join(text.split())
    first = name.partition(" ")[0].upper()
    if first in task.places or sequence_called(name.upper(), task):
        raise NamingError(f"The task's own motions are written like “{name}”: choose another name.")
    if not name or not all(sign.isalnum() or sign == " " for sign in name):
        raise NamingError("A name is made of letters, digits and spaces.")
    if len(name) > LONGEST:
        raise NamingError(f"A name has at most {LONGEST} letters.")
    reserved = (SOMETHING_ELSE, NONE, BABBLING)
    if name.casefold() in {each.casefold() for each in (*others, *reserved)}:
        raise NamingError(f"“{name}” is the name of something else: choose another.")
    return name
