"""A teaching session: what a person does with the robot, and what becomes of both."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from jaxtyping import Float
from numpy import ndarray

from motionese.experiment import Experience, Learner, Scene
from motionese.experiment.keys import generator_for, key_for
from motionese.experiment.measures import path_error_cm
from motionese.experiment.perform import Performance, Watched, watch
from motionese.teaching.drawing import Demonstration
from motionese.teaching.notebook import Entry, Learned, Notebook, Source, has_settled
from motionese.teaching.recognising import Recogniser, Understood
from motionese.teaching.training import Told, trained
from motionese.teaching.verdict import Verdict, judged

PRACTICE = 5
"""Imitation loops of one learning: imitate, and train on what the own body did, so many times."""


@dataclass(frozen=True)
class Shown:
    """A demonstration that was watched and understood."""

    entry: Entry
    watched: Watched
    understood: Understood
    verdict: Verdict


@dataclass(frozen=True)
class Imitation:
    """A performance and its error [cm]."""

    performance: Performance
    state: Float[ndarray, " N"]
    error_cm: float


@dataclass(frozen=True)
class Change:
    """Errors [cm] of an imitation before and after the network changed."""

    motion: str
    before_cm: float
    after_cm: float


class Teaching:
    """One session; its methods may take a second, and are stopped by what `told` raises.

    Attributes:
        scene: The robot.
        learner: What it has become.
        notebook: What it was shown.
        shown: What it was shown last, if anything.
        kept: The number of the learner as it is kept (see `saving`).
    """

    def __init__(self, scene: Scene, learner: Learner, notebook: Notebook, kept: int = 0) -> None:
        """Begin, or go on."""
        self.scene, self.notebook, self.kept = scene, notebook, kept
        self.shown: Shown | None = None
        self._become(learner)

    @property
    def can_grow(self) -> bool:
        """Whether a level of the settings is not open yet."""
        return len(self.learner.network.levels) < len(self.scene.settings.network.levels)

    @property
    def should_grow(self) -> bool:
        """Whether learning has settled since the last change of the network."""
        grown = [i for i, each in enumerate(self.notebook.learned) if not each.entry]
        since = self.notebook.learned[grown[-1] + 1 if grown else 0 :]
        return self.can_grow and has_settled(
            each.error_cm for each in since if each.error_cm is not None
        )

    def watch(self, path: Float[ndarray, "T 3"]) -> Watched:
        """Let the robot watch a hand's path [m, world]."""
        return watch(self.scene.body, path, generator_for(self.scene.seed, "drawing"))

    def show(
        self, demonstration: Demonstration, source: Source, before: Understood | None = None
    ) -> Shown:
        """Show a motion: it is recognised, judged, and noted in the notebook.

        Args:
            demonstration: What is shown.
            source: Who shows it.
            before: What was understood while it was drawn.
        """
        watched = self.watch(demonstration.path)
        understood = self.recogniser.at_the_end(watched, before)
        known = {e.motion for e in self.learner.experiences}
        verdict = judged(watched, understood, self.scene.settings.caregiver, known)
        motion = verdict.shown or verdict.motion
        name = motion.name if motion else f"{self.recogniser.starts_at(watched).start} ?"
        entry = Entry(self.notebook.next, name, source, demonstration.drawn, demonstration.path)
        self.notebook = self.notebook.with_entry(entry)
        self.shown = Shown(entry, watched, understood, verdict)
        return self.shown

    def imitate(self) -> Imitation:
        """Perform what was shown last, and note the error."""
        shown = self._shown()
        imitation = self._performed(shown.watched, shown.understood)
        entry = self.notebook.entry(shown.entry.number) or shown.entry
        entry = replace(entry, errors_cm=(*entry.errors_cm, imitation.error_cm))
        self.notebook = self.notebook.with_entry(entry)
        self.shown = replace(shown, entry=entry)
        return imitation

    def learn(self, told: Told) -> Change:
        """Learn what was shown last by imitating it, as in the experiment's loop, a few times.

        The network of the practice after which the imitation was best is kept: one motion alone
        is little to learn from, and a further practice may lead away again. It is then what the
        robot does last, and what the notebook ends with.
        """
        shown, began = self._shown(), self.kept
        loop = max([self.notebook.last_loop, *(e.loop for e in self.learner.experiences)])
        copied = self.scene.settings.imitation.efference_copy
        before = imitation = self.imitate()
        practised: list[tuple[float, Learner, Understood]] = []
        for practice in range(PRACTICE):
            loop += 1
            values = imitation.performance.experience(copied)
            experience = Experience(loop, shown.entry.motion, values, imitation.state)
            learner = replace(self.learner, experiences=(*self.learner.experiences, experience))
            self._become(trained(self.scene, learner, loop, told, (practice, PRACTICE)))
            self._look_again()
            imitation = self.imitate()
            practised.append((imitation.error_cm, self.learner, self._shown().understood))
        error, learner, understood = min(practised, key=lambda each: each[0])
        self._become(learner)
        self.shown = replace(self._shown(), understood=understood)
        if error < imitation.error_cm:
            self.imitate()
        learned = Learned(shown.entry.number, loop, began, error)
        self.notebook = replace(self.notebook, learned=(*self.notebook.learned, learned))
        return Change(shown.entry.motion, before.error_cm, error)

    def forget(self, number: int, kept: Callable[[int], Learner]) -> str:
        """Take an entry out of the notebook, and what was learned of it back.

        If nothing else was learned since, the network is again what it was; else the experience is
        no longer rehearsed, and what the weights have taken from it fades.

        Args:
            number: The entry's number.
            kept: Returns a learner that was kept.

        Returns:
            What was done, in a sentence; empty if there is no such entry.
        """
        entry = self.notebook.entry(number)
        if entry is None:
            return ""
        places = [i for i, each in enumerate(self.notebook.learned) if each.entry == number]
        since = self.notebook.learned[places[0] :] if places else ()
        self.notebook = self.notebook.without(number)
        if self.shown is not None and self.shown.entry.number == number:
            self.shown = None
        if not places:
            return f"{entry.motion} is out of the notebook."
        if all(each.entry == number for each in since):
            self._become(kept(since[0].before))
            return f"{entry.motion} is forgotten: the network is again what it was before."
        loops = {each.loop - i for each in since if each.entry == number for i in range(PRACTICE)}
        left = tuple(e for e in self.learner.experiences if e.loop not in loops)
        self._become(replace(self.learner, experiences=left))
        return (
            f"{entry.motion} is no longer rehearsed; others were learned since, so what the "
            "network has of it fades as you teach on."
        )

    def grow(self, told: Told) -> list[Change]:
        """Open the next level, let it learn with the others, and compare the same imitations."""
        entries, began = self.notebook.latest(), self.kept
        before = [self._error_of(entry) for entry in entries]
        loop = max([self.notebook.last_loop, *(e.loop for e in self.learner.experiences)])
        # The network's own key, as in the experiment: see `experiment.run`.
        key = key_for(self.scene.seed, "network")
        learner = self.learner.grown(self.scene.settings.network, key)
        if learner.experiences:
            learner = trained(self.scene, learner, loop, told)
        self._become(learner)
        self._look_again()
        after = [self._error_of(entry) for entry in entries]
        learned = (*self.notebook.learned, Learned(0, loop, began, None))
        self.notebook = replace(self.notebook, learned=learned)
        motions = [entry.motion for entry in entries]
        return [Change(*each) for each in zip(motions, before, after, strict=True)]

    def return_to(self, learner: Learner, notebook: Notebook, shown: Shown | None) -> None:
        """Take everything back that has changed since."""
        self.notebook, self.shown = notebook, shown
        if learner is not self.learner:
            self._become(learner)

    def _become(self, learner: Learner) -> None:
        self.learner = learner
        self.recogniser = Recogniser(self.scene, learner)

    def _look_again(self) -> None:
        """Recognise what was shown last with the network as it is now."""
        if self.shown is not None:
            understood = self.recogniser.at_the_end(self.shown.watched, None)
            self.shown = replace(self.shown, understood=understood)

    def _shown(self) -> Shown:
        assert self.shown is not None, "something must be shown before it is imitated"
        return self.shown

    def _performed(self, watched: Watched, understood: Understood) -> Imitation:
        done = self.scene.perform(
            self.learner.network,
            understood.state,
            self.recogniser.starts_at(watched),
            len(watched.path),
            "teaching",
        )
        return Imitation(done, understood.state, path_error_cm(done.path, watched.path))

    def _error_of(self, entry: Entry) -> float:
        watched = self.watch(entry.path)
        return self._performed(watched, self.recogniser.at_the_end(watched, None)).error_cm
