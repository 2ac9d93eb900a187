"""The five chapters of a first visit: each is ended by what a person does, and stays ended.

A push is shown, tried, and practised until what it brings about comes about; a pair is shown and a
slow level opened for it; the map of the slow level is explored. Nobody has to follow: who does
something else ends a chapter with it, or none. Where a task has nothing to push, any of its
sequences is a push, and a good try is the light.
"""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from motionese.task import PrimitiveSequence
from motionese.teaching.notebook import Entry
from motionese.teaching.session import Teaching
from motionese.teaching.verdict import sequence_called

Act = Literal["show", "imitate", "learn", "grow", "map"]
PUSH, TRY, LIGHT, GROW, MAP = "push", "try", "light", "grow", "map"
TITLES = {
    PUSH: "Show it a push",
    TRY: "Watch it fail",
    LIGHT: "Practise until the light goes on",
    GROW: "Show a pair, and let it grow",
    MAP: "Explore the map",
}
LESSONS = 4
"""After so many lessons without the light it is another push's turn."""


@dataclass(frozen=True)
class Chapter:
    """A chapter, and what is to be done in it now; `motion` is what is to be shown, or empty."""

    name: str
    act: Act
    motion: str = ""

    @property
    def number(self) -> int:
        """Counted from 1."""
        return [*TITLES].index(self.name) + 1


def end_chapters(teaching: Teaching, *names: str) -> bool:
    """Note which chapters have ended by what was done, these among them; return if any did now."""
    notebook = teaching.notebook
    ended = notebook.ended | _ended(teaching) | frozenset(names)
    teaching.standing = replace(teaching.standing, notebook=replace(notebook, ended=ended))
    return ended != notebook.ended


def chapter_of(teaching: Teaching) -> Chapter | None:
    """Return the first chapter that has not ended; None after the last."""
    name = next((name for name in TITLES if name not in teaching.notebook.ended), None)
    if name is None:
        return None
    ways: dict[str, Callable[[Teaching], tuple[Act, str]]] = {
        PUSH: lambda teaching: _with_a_push(teaching, "show"),
        TRY: lambda teaching: _with_a_push(teaching, "imitate"),
        LIGHT: lambda teaching: _with_a_push(teaching, "learn"),
        GROW: _to_grow,
        MAP: lambda teaching: ("grow", "") if teaching.can_grow else ("map", ""),
    }
    return Chapter(name, *ways[name](teaching))


def _ended(teaching: Teaching) -> frozenset[str]:
    """Return the chapters that have ended by what the notebook tells."""
    shown = [(_sequence(teaching, e.motion), e) for e in teaching.notebook.entries]
    pushes = [entry for sequence, entry in shown if sequence and _is_push(teaching, sequence)]
    pairs = [entry for sequence, entry in shown if sequence and len(sequence.primitives) > 1]
    done = {
        PUSH: bool(pushes),
        TRY: any(entry.tried for entry in pushes),
        LIGHT: any(map(_lit, pushes)),
        GROW: bool(pairs) and not teaching.can_grow,
    }
    return frozenset(name for name, is_so in done.items() if is_so)


def _lit(entry: Entry) -> bool:
    """Whether the last try has brought about all that is due."""
    if entry.tried is None:
        return False
    result = entry.tried.result
    return not result.missed if result.pushes else result.good


def _sequence(teaching: Teaching, motion: str) -> PrimitiveSequence | None:
    return sequence_called(motion, teaching.scene.task)


def _is_push(teaching: Teaching, sequence: PrimitiveSequence) -> bool:
    return not teaching.scene.task.effects or any(p.effect for p in sequence.primitives)


def _pushes(teaching: Teaching) -> list[str]:
    """Return the pushes of one stroke, the one that comes easiest first.

    That is the one straight before the body: of twelve newborns (seeds 0 to 11) all had lit LL
    within four lessons, and not all LR.
    """
    task = teaching.scene.task
    pushes = [s for s in task.sequences(1) if _is_push(teaching, s)]
    aside = {s.name: abs(float(task.position(s.places[-1])[1])) for s in pushes}
    return sorted(aside, key=aside.__getitem__)


def _with_a_push(teaching: Teaching, act: Act) -> tuple[Act, str]:
    """Return an act with the push that was shown last, or what leads to a push."""
    notebook, observed = teaching.notebook, teaching.observed
    practised = Counter(each.entry for each in notebook.learned)

    def lessons(motion: str) -> int:
        return sum(practised[e.number] for e in notebook.entries if e.motion == motion)

    push = min(_pushes(teaching), key=lambda motion: lessons(motion) // LESSONS)
    wanted: tuple[Act, str] = "show", push
    if observed is None:
        return wanted
    shown = observed.entry.motion
    sequence = _sequence(teaching, shown)
    if sequence and _is_push(teaching, sequence):
        is_its_turn = shown == push or not lessons(shown) or lessons(shown) % LESSONS
        return (act, "") if is_its_turn else wanted
    result = teaching.standing.results.get(shown)
    if result is None:
        return "imitate", ""
    return wanted if result.good else ("learn", "")


def _to_grow(teaching: Teaching) -> tuple[Act, str]:
    """Return what leads to a slow level that has a pair to hold."""
    entries, learned = teaching.notebook.entries, teaching.learner.experiences
    known = {entry.motion for entry in entries}
    pairs = teaching.scene.task.sequences(2)
    if not known & {pair.name for pair in pairs}:
        lit = {entry.motion for entry in entries if _lit(entry)}
        began = [pair.name for pair in pairs if pair.name[:-1] in lit]
        return "show", (began or [pair.name for pair in pairs])[0]
    taught = teaching.notebook.taught() or any(_sequence(teaching, e.motion) for e in learned)
    return ("grow", "") if taught else ("learn", "")
