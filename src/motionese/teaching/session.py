"""A teaching session: what a person does with the robot, and what becomes of both."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import SOMETHING_ELSE, Demonstration, hypotheses, segmented
from motionese.imitation import (
    Learner,
    Performance,
    Scene,
    Settled,
    Watched,
    generator_for,
    key_for,
    path_error_cm,
    watch,
)
from motionese.teaching.claim import claim_on
from motionese.teaching.notebook import Entry, Learning, Notebook, Source
from motionese.teaching.practice import Report, practised
from motionese.teaching.recogniser import Interpretation, Recogniser, start_of
from motionese.teaching.result import Result, result_of
from motionese.teaching.verdict import Verdict, seen_in_words, sequence_called

OWN = "your motion"
"""A motion that is no sequence of the task is called this, and a number."""
PRACTICE = 5
"""Imitation loops of one learning: imitate, and train on what the own body did, so many times."""


@dataclass(frozen=True)
class Observation:
    """A demonstration that the robot has watched, and what it makes of it."""

    entry: Entry
    watched: Watched
    interpretation: Interpretation
    verdict: Verdict


@dataclass(frozen=True)
class Trial:
    """A performance of what was shown, the initial state it began from, and what it came to."""

    performance: Performance
    state: Float[ndarray, " N"]
    result: Result

    @property
    def error_cm(self) -> float:
        """Its error [cm]."""
        return self.result.error_cm


@dataclass(frozen=True)
class Change:
    """Errors [cm] of an imitation before and after the network changed."""

    motion: str
    before_cm: float
    after_cm: float


@dataclass(frozen=True)
class Standing:
    """Where a session stands; it can be returned to.

    No two learners of a session have the same number; `observed` is what was shown last, `tried`
    what this learner's last try of a motion came to.
    """

    learner: Learner
    number: int
    notebook: Notebook
    observed: Observation | None = None
    tried: Mapping[str, Result] = field(default_factory=dict)


class Teaching:
    """One session; its methods may take a second, and are stopped by what `report` raises.

    Attributes:
        standing: Where the session stands.
        numbers: How many learners were numbered so far.
        recogniser: Recognises with what the robot knows now.
    """

    def __init__(
        self,
        scene: Scene,
        learner: Learner,
        notebook: Notebook | None = None,
        *,
        number: int = 1,
        numbers: int = 1,
    ) -> None:
        """Begin, or go on with a learner of a number, when so many numbers were given."""
        self.scene, self.numbers = scene, numbers
        self.standing = Standing(learner, number, notebook or Notebook())
        self.recogniser = Recogniser(scene, learner)

    @property
    def learner(self) -> Learner:
        """What the robot has become."""
        return self.standing.learner

    @property
    def notebook(self) -> Notebook:
        """What it was shown."""
        return self.standing.notebook

    @property
    def observed(self) -> Observation | None:
        """What it was shown last, if anything."""
        return self.standing.observed

    @property
    def can_grow(self) -> bool:
        """Whether a level of the settings is not open yet."""
        return len(self.learner.network.levels) < len(self.scene.settings.network.levels)

    @property
    def should_grow(self) -> bool:
        """Whether learning has settled since the last change of the network."""
        learned = self.notebook.learned
        grown = [i for i, each in enumerate(learned) if not each.entry]
        since = learned[grown[-1] + 1 if grown else 0 :]
        errors = [each.error_cm for each in since if each.error_cm is not None]
        return self.can_grow and Settled().by(errors)

    def watch(self, demonstration: Demonstration) -> Watched:
        """Let the robot watch a demonstration."""
        return watch(self.scene.body, demonstration, generator_for(self.scene.seed, "drawing"))

    def show(
        self,
        path: Float[ndarray, "T 3"],
        source: Source,
        drawn: Float[ndarray, "R 3"] | None = None,
    ) -> Observation:
        """Show a motion: it is recognised, judged, and noted in the notebook.

        Args:
            path: The hand's path [m, world] at the robot's tempo.
            drawn: The hand's path as it was drawn in time, where that differs.
        """
        notebook, seen = self.notebook, self.seen(path)
        motion = next(iter(seen))
        if motion == SOMETHING_ELSE:
            motion = self._own_name()
        sequence = sequence_called(motion, self.scene.task)
        demonstration = segmented(path, sequence, self.scene.task)
        watched = self.watch(demonstration)
        interpretation = self.recogniser.at_the_end(watched)
        verdict = self._verdict(seen, motion, watched, interpretation)
        drawn = path if drawn is None else drawn
        entry = Entry(notebook.next, motion, source, drawn, demonstration)
        observed = Observation(entry, watched, interpretation, verdict)
        notebook = notebook.with_entry(entry)
        self.standing = replace(self.standing, notebook=notebook, observed=observed)
        return observed

    def seen(self, path: Float[ndarray, "T 3"], *, whole: bool = True) -> dict[str, float]:
        """Return how likely a hand's path [m, world] shows each motion, the likeliest first.

        Known are the task's sequences and the person's own motions, as they were last shown.
        """
        task = self.scene.task
        latest = {entry.motion: entry for entry in self.notebook.latest()}
        own = {n: e.demonstration.path for n, e in latest.items() if not sequence_called(n, task)}
        return hypotheses(path, task, own, whole=whole)

    def imitate(self) -> Trial:
        """Perform what was shown last, and note the error."""
        observed = self._observed()
        trial = self._trial(observed.watched, observed.interpretation, observed.entry.motion)
        entry = self.notebook.entry(observed.entry.number) or observed.entry
        entry = replace(entry, errors_cm=(*entry.errors_cm, trial.error_cm))
        observed = replace(observed, entry=entry)
        notebook = self.notebook.with_entry(entry)
        tried = {**self.standing.tried, entry.motion: trial.result}
        self.standing = replace(self.standing, notebook=notebook, observed=observed, tried=tried)
        return trial

    def learn(self, report: Report) -> Change:
        """Learn what was shown last by imitating it, as in the experiment's loop, a few times.

        The network of the practice after which the imitation was best is kept: one motion alone
        is little to learn from, and a further practice may lead away again. It is then what the
        robot does last, and what the notebook ends with.
        """
        began, entry, loop = self.standing.number, self._observed().entry, self._last_loop()
        copied = self.scene.settings.imitation.efference_copy
        before = trial = self.imitate()
        outcomes: list[tuple[float, Standing]] = []
        for practice in range(PRACTICE):
            loop += 1
            values = trial.performance.experience(copied)
            learner = self.learner.experiencing(
                loop, entry.motion, values, trial.state, self.learner.begins_with(entry.motion)
            )
            self._become(practised(self.scene, learner, loop, report, (practice, PRACTICE)))
            self._look_again()
            trial = self.imitate()
            outcomes.append((trial.error_cm, self.standing))
        error, best = min(outcomes, key=lambda each: each[0])
        self.return_to(replace(best, notebook=self.notebook))
        if error < trial.error_cm:
            self.imitate()
        self._note(Learning(entry.number, loop, began, error))
        return Change(entry.motion, before.error_cm, error)

    def forget(self, number: int, kept: Callable[[int], Learner]) -> str:
        """Take an entry out of the notebook, and what was learned of it back.

        If nothing else was learned since, the network is again what it was; else the experience is
        no longer rehearsed, and what the weights have taken from it fades.

        Args:
            number: The entry's number.
            kept: Returns the learner of a number.

        Returns:
            What was done, in a sentence; empty if there is no such entry.
        """
        entry, learned = self.notebook.entry(number), self.notebook.learned
        if entry is None:
            return ""
        places = [i for i, each in enumerate(learned) if each.entry == number]
        since = learned[places[0] :] if places else ()
        observed = self.observed
        if observed is not None and observed.entry.number == number:
            observed = None
        notebook = self.notebook.without(number)
        self.standing = replace(self.standing, notebook=notebook, observed=observed)
        if not places:
            return f"{entry.motion} is out of the notebook."
        if all(each.entry == number for each in since):
            earlier = since[0].before
            learner = kept(earlier)
            self.return_to(replace(self.standing, learner=learner, number=earlier, tried={}))
            return f"{entry.motion} is forgotten: the network is again what it was before."
        loops = {each.loop - i for each in since if each.entry == number for i in range(PRACTICE)}
        left = tuple(e for e in self.learner.experiences if e.loop not in loops)
        self._become(replace(self.learner, experiences=left))
        return (
            f"{entry.motion} is no longer rehearsed; others were learned since, so what the "
            "network has of it fades as you teach on."
        )

    def grow(self, report: Report) -> list[Change]:
        """Open the next level, let it learn with the others, and compare the same imitations."""
        entries, began, loop = self.notebook.latest(), self.standing.number, self._last_loop()
        before = [self._error_of(entry) for entry in entries]
        # The network's own key, as in the experiment: see `experiment.run`.
        key = key_for(self.scene.seed, "network")
        learner = self.learner.grown(self.scene.settings.network, key)
        if learner.experiences:
            learner = practised(self.scene, learner, loop, report)
        self._become(learner)
        self._look_again()
        after = [self._error_of(entry) for entry in entries]
        self._note(Learning(0, loop, began, None))
        motions = [entry.motion for entry in entries]
        return [Change(*each) for each in zip(motions, before, after, strict=True)]

    def return_to(self, standing: Standing) -> None:
        """Take everything back that has changed since."""
        if standing.learner is not self.learner:
            self.recogniser = Recogniser(self.scene, standing.learner)
        self.standing = standing

    def warm_up(self) -> None:
        """Let everything be compiled that a drawing asks for, by what nobody sees."""
        sequence, rng = self.scene.task.sequences(1)[0], generator_for(0, "warming")
        watched = self.watch(self.scene.caregiver().demonstrate(sequence, rng))
        interpretation = self.recogniser.at_the_end(watched)
        claim_on(watched, sequence, self.recogniser, interpretation)
        self.seen(watched.path)
        if (online := self.recogniser.online()) is not None:
            online.observe(watched)
        state = interpretation.state
        self.scene.perform(self.learner.network, state, sequence, 3, "warming")

    def _verdict(
        self,
        seen: Mapping[str, float],
        motion: str,
        watched: Watched,
        interpretation: Interpretation,
    ) -> Verdict:
        task, tried = self.scene.task, self.standing.tried.get(motion)
        sequence = sequence_called(motion, task)
        claim = claim_on(watched, sequence, self.recogniser, interpretation, tried)
        learned = {e.motion for e in self.learner.experiences}
        return Verdict(
            seen=seen,
            motion=motion,
            sequence=sequence,
            error_cm=path_error_cm(interpretation.path, watched.path),
            claim=claim,
            sentence=f"{seen_in_words(seen, motion, task, learned)} {claim.sentence}",
        )

    def _own_name(self) -> str:
        """Return a name that no motion has had."""
        named = [entry.motion for entry in self.notebook.entries]
        named += [experience.motion for experience in self.learner.experiences]
        numbers = [int(n[1]) for name in named if (n := re.fullmatch(rf"{OWN} (\d+)", name))]
        return f"{OWN} {max(numbers, default=0) + 1}"

    def _become(self, learner: Learner) -> None:
        self.numbers += 1
        self.return_to(replace(self.standing, learner=learner, number=self.numbers, tried={}))

    def _note(self, learning: Learning) -> None:
        notebook = replace(self.notebook, learned=(*self.notebook.learned, learning))
        self.standing = replace(self.standing, notebook=notebook)

    def _look_again(self) -> None:
        """Recognise what was shown last with the network as it is now."""
        if (observed := self.observed) is not None:
            interpretation = self.recogniser.at_the_end(observed.watched)
            observed = replace(observed, interpretation=interpretation)
            self.standing = replace(self.standing, observed=observed)

    def _observed(self) -> Observation:
        assert self.observed is not None, "something must be shown before it is imitated"
        return self.observed

    def _last_loop(self) -> int:
        return max([self.notebook.last_loop, *(e.loop for e in self.learner.experiences)])

    def _trial(self, watched: Watched, interpretation: Interpretation, motion: str) -> Trial:
        task, state = self.scene.task, interpretation.state
        start, rows = start_of(watched.path, task), len(watched.path)
        done = self.scene.perform(self.learner.network, state, start, rows, "teaching")
        return Trial(done, state, result_of(done, watched, sequence_called(motion, task), task))

    def _error_of(self, entry: Entry) -> float:
        watched = self.watch(entry.demonstration)
        understood = self.recogniser.at_the_end(watched)
        return self._trial(watched, understood, entry.motion).error_cm
