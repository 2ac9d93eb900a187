"""A teaching session: what a person does with the robot, and what becomes of both."""

import re
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import SOMETHING_ELSE, Demonstration, hypotheses, segmented
from motionese.errors import MotioneseError
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
from motionese.teaching.corners import Corner, pauses_in_words, wish_in_words
from motionese.teaching.emergence import Emergence, emergence_of
from motionese.teaching.lesson import Lesson, kept_practice
from motionese.teaching.notebook import Change, Entry, Learning, Notebook, Source
from motionese.teaching.practice import Report, practised
from motionese.teaching.recogniser import Interpretation, Recogniser, start_of
from motionese.teaching.result import Result, result_of
from motionese.teaching.shown_manner import ShownManner, shown_manner
from motionese.teaching.trial import Trial
from motionese.teaching.verdict import Verdict, seen_in_words, sequence_called

OWN = "your motion"
"""A motion that is no sequence of the task is called this, and a number."""
PRACTICE = 5
"""Imitation loops of one learning: imitate, and train on what the own body did, so many times."""

Tried = Callable[[Trial], None]
"""Called with every try of a lesson, as it comes."""
Between = Callable[[], None]
"""Called before every motion that is measured; what it raises ends the lesson."""


class GrowthError(MotioneseError):
    """There is nothing yet that a slow level could learn from."""


@dataclass(frozen=True)
class Observation:
    """A demonstration that the robot has watched, and what it makes of it."""

    entry: Entry
    watched: Watched
    interpretation: Interpretation
    manner: ShownManner
    verdict: Verdict


@dataclass(frozen=True)
class Standing:
    """Where a session stands; it can be returned to.

    No two learners of a session have the same number; `observed` is what was shown last, `results`
    what this learner's last try of every motion came to: those of others, as the notebook keeps
    them, say nothing of what it can do. `emerged` is what had emerged in its learners, see
    `Teaching.measured`.
    """

    learner: Learner
    number: int
    notebook: Notebook
    observed: Observation | None = None
    results: Mapping[str, Result] = field(default_factory=dict)
    emerged: tuple[Emergence, ...] = ()


class Teaching:
    """One session; its methods may take a second, and are stopped by what `report` raises.

    Attributes:
        standing: Where the session stands.
        numbers: How many learners were numbered so far.
        grows: Whether it may open a level.
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
        grows: bool = True,
        emerged: tuple[Emergence, ...] = (),
    ) -> None:
        """Begin, or go on with a learner of a number, when so many numbers were given."""
        self.scene, self.numbers, self.grows = scene, numbers, grows
        self.standing = Standing(learner, number, notebook or Notebook(), emerged=emerged)
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
    def emerged(self) -> tuple[Emergence, ...]:
        """What has emerged so far, the latest last; not of learners that were taken back."""
        return tuple(e for e in self.standing.emerged if e.learner <= self.standing.number)

    @property
    def can_grow(self) -> bool:
        """Whether it may open a level of the settings that is not open yet."""
        return self.grows and len(self.learner.network.levels) < len(
            self.scene.settings.network.levels
        )

    @property
    def should_grow(self) -> bool:
        """Whether learning has settled since the last change of the network."""
        learned = self.notebook.learned
        grown = [i for i, each in enumerate(learned) if not each.entry]
        since = learned[grown[-1] + 1 if grown else 0 :]
        return self.can_grow and Settled().by([each.changes[0].after_cm for each in since])

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
        demonstration = segmented(path, sequence_called(motion, self.scene.task), self.scene.task)
        drawn = path if drawn is None else drawn
        entry = Entry(notebook.next, motion, source, drawn, demonstration)
        observed = self._understood(entry, seen)
        notebook = notebook.with_entry(entry)
        self.standing = replace(self.standing, notebook=notebook, observed=observed)
        return observed

    def seen(self, path: Float[ndarray, "T 3"], *, whole: bool = True) -> dict[str, float]:
        """Return how likely a hand's path [m, world] shows each motion, the likeliest first.

        Known are the task's sequences and the person's own motions, as they were last shown.
        """
        task, entries = self.scene.task, self.notebook.entries
        own = {
            e.motion: e.demonstration.path for e in entries if not sequence_called(e.motion, task)
        }
        return hypotheses(path, task, own, whole=whole)

    def demonstrations(self) -> dict[str, Demonstration]:
        """Return the latest demonstration of every motion that was shown, or learned elsewhere."""
        return {**self._taught(), **{e.motion: e.demonstration for e in self.notebook.entries}}

    def result_at(self, motion: str, shown: Demonstration) -> Result:
        """Return what an imitation of a demonstration comes to now; nothing is noted."""
        task, watched = self.scene.task, self.watch(shown)
        done = self._performed(watched, self.recogniser.at_the_end(watched))
        return result_of(done, watched, sequence_called(motion, task), task)

    def look_back(self, number: int) -> Observation | None:
        """Watch an entry of the notebook again: it is what is imitated and learned next."""
        entry = self.notebook.entry(number)
        if entry is None:
            return None
        observed = self._understood(entry, self.seen(entry.demonstration.path))
        self.standing = replace(self.standing, observed=observed)
        return observed

    def imitate(self) -> Trial:
        """Perform what was shown last, and note the error."""
        observed = self._observed()
        trial = self._trial(observed)
        entry = (self.notebook.entry(observed.entry.number) or observed.entry).with_trial(trial)
        observed = replace(observed, entry=entry)
        notebook = self.notebook.with_entry(entry)
        results = {**self.standing.results, entry.motion: trial.result}
        self.standing = replace(
            self.standing, notebook=notebook, observed=observed, results=results
        )
        return trial

    def learn(
        self, report: Report, tried: Tried = lambda trial: None, between: Between = lambda: None
    ) -> Lesson:
        """Learn what was shown last by imitating it, as in the experiment's loop, a few times.

        Which network is kept is said in `lesson`; it is what the notebook ends with.
        """
        began, entry, loop = self.standing.number, self._observed().entry, self._last_loop()
        others = {m: shown for m, shown in self._taught().items() if m != entry.motion}
        outcomes: list[tuple[Trial, Standing]] = []
        for practice in range(PRACTICE + 1):
            if practice:
                loop += 1
                self._practise(outcomes[-1][0], loop, report, practice)
            trial = self.imitate()
            tried(trial)
            outcomes.append((trial, self.standing))
        errors = tuple(trial.error_cm for trial, _ in outcomes)
        missed = tuple(trial.result.missed for trial, _ in outcomes)
        measured: dict[int, dict[str, float]] = {}

        def overall(practices: int) -> float:
            self._return_with_notebook(outcomes[practices][1])
            measured[practices] = self._errors_of(others, between)
            return float(np.mean([errors[practices], *measured[practices].values()]))

        kept = kept_practice(errors, overall, missed)
        self._return_with_notebook(outcomes[kept][1])
        if kept < PRACTICE:
            trial = self.imitate()
        taught = Change(entry.motion, errors[0], errors[kept])
        changes = (taught, *(Change(m, measured[0][m], measured[kept][m]) for m in others))
        self._note(Learning(entry.number, loop, began, kept, changes))
        claim = self._judged_again().claim
        return Lesson(entry.number, errors, kept, changes, trial.result, claim, missed)

    def _practise(self, trial: Trial, loop: int, report: Report, practice: int) -> None:
        """Train on what the own body did in a try, and look at what was shown again."""
        motion = self._observed().entry.motion
        values = trial.performance.experience(self.scene.settings.imitation.efference_copy)
        learner = self.learner.experiencing(
            loop, motion, values, trial.state, self.learner.begins_with(motion)
        )
        self._become(practised(self.scene, learner, loop, report, (practice - 1, PRACTICE)))
        self._look_again()

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
            learner = kept(earlier).renamed(notebook.renamed)
            self.return_to(replace(self.standing, learner=learner, number=earlier, results={}))
            return f"{entry.motion} is forgotten: the network is again what it was before."
        loops = {each.loop - i for each in since if each.entry == number for i in range(PRACTICE)}
        left = tuple(e for e in self.learner.experiences if e.loop not in loops)
        self._become(replace(self.learner, experiences=left))
        return (
            f"{entry.motion} is no longer rehearsed; others were learned since, so what the "
            "network has of it fades as you teach on."
        )

    def grow(self, report: Report, between: Between = lambda: None) -> list[Change]:
        """Open the next level, let it learn with the others, and compare the same imitations.

        Raises:
            GrowthError: The robot was taught nothing yet.
        """
        known, began, loop = self._taught(), self.standing.number, self._last_loop()
        if not known:
            raise GrowthError(
                "First show me a motion and press Learn this: a slow level grows on what I have "
                "practised."
            )
        before = self._errors_of(known, between)
        # The network's own key, as in the experiment: see `experiment.run`.
        key = key_for(self.scene.seed, "network")
        learner = self.learner.grown(self.scene.settings.network, key)
        self._become(practised(self.scene, learner, loop, report))
        self._look_again()
        after = self._errors_of(known, between)
        changes = [Change(motion, before[motion], after[motion]) for motion in known]
        self._note(Learning(0, loop, began, 1, tuple(changes)))
        return changes

    def measured(self) -> Generator[None, None, None]:
        """Measure what has emerged in the network, if that is not known; yields between parts."""
        number, known = self.standing.number, self.emerged
        if not known or known[-1].learner != number:
            found = yield from emergence_of(self.scene, self.learner, number, self.recogniser)
            self.standing = replace(self.standing, emerged=(*known, found))

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

    def _understood(self, entry: Entry, seen: Mapping[str, float]) -> Observation:
        """Watch an entry of the notebook, and say what is understood of it."""
        watched = self.watch(entry.demonstration)
        interpretation = self.recogniser.at_the_end(watched)
        manner = shown_manner(entry, self.scene)
        verdict = self._verdict(seen, entry.motion, watched, interpretation, manner.corners)
        return Observation(entry, watched, interpretation, manner, verdict)

    def _verdict(
        self,
        seen: Mapping[str, float],
        motion: str,
        watched: Watched,
        interpretation: Interpretation,
        corners: Sequence[Corner],
    ) -> Verdict:
        task, tried = self.scene.task, self.standing.results.get(motion)
        sequence = sequence_called(motion, task)
        learned = {e.motion for e in self.learner.experiences}
        saw = (seen_in_words(seen, motion, task, learned), pauses_in_words(corners))
        return Verdict(
            seen=seen,
            motion=motion,
            sequence=sequence,
            error_cm=path_error_cm(interpretation.path, watched.path),
            claim=claim_on(watched, sequence, self.recogniser, interpretation, tried),
            saw=" ".join(filter(None, saw)),
            wish=wish_in_words(corners),
        )

    def _own_name(self) -> str:
        """Return a name that no motion has had."""
        named = [entry.motion for entry in self.notebook.entries]
        named += [experience.motion for experience in self.learner.experiences]
        named += [name for pair in self.notebook.renamed for name in pair]
        numbers = [int(n[1]) for name in named if (n := re.fullmatch(rf"{OWN} (\d+)", name))]
        return f"{OWN} {max(numbers, default=0) + 1}"

    def _become(self, learner: Learner) -> None:
        self.numbers += 1
        self.return_to(replace(self.standing, learner=learner, number=self.numbers, results={}))

    def _return_with_notebook(self, standing: Standing) -> None:
        """Take the network back, and nothing that was noted since."""
        self.return_to(replace(standing, notebook=self.notebook))

    def _note(self, learning: Learning) -> None:
        notebook = replace(self.notebook, learned=(*self.notebook.learned, learning))
        self.standing = replace(self.standing, notebook=notebook)

    def _look_again(self) -> None:
        """Recognise what was shown last with the network as it is now."""
        if (observed := self.observed) is not None:
            interpretation = self.recogniser.at_the_end(observed.watched)
            observed = replace(observed, interpretation=interpretation)
            self.standing = replace(self.standing, observed=observed)

    def _judged_again(self) -> Verdict:
        """Judge what was shown last with the network as it is now."""
        observed = self._observed()
        verdict = self._verdict(
            observed.verdict.seen,
            observed.entry.motion,
            observed.watched,
            observed.interpretation,
            observed.manner.corners,
        )
        self.standing = replace(self.standing, observed=replace(observed, verdict=verdict))
        return verdict

    def _observed(self) -> Observation:
        assert self.observed is not None, "something must be shown before it is imitated"
        return self.observed

    def _last_loop(self) -> int:
        return max([self.notebook.last_loop, *(e.loop for e in self.learner.experiences)])

    def _performed(self, watched: Watched, interpretation: Interpretation) -> Performance:
        start, rows = start_of(watched.path, self.scene.task), len(watched.path)
        network = self.learner.network
        return self.scene.perform(network, interpretation.state, start, rows, "teaching")

    def _trial(self, observed: Observation) -> Trial:
        task, network, watched = self.scene.task, self.learner.network, observed.watched
        done = self._performed(watched, observed.interpretation)
        result = result_of(done, watched, sequence_called(observed.entry.motion, task), task)
        levels = dict(zip(network.names, network.sizes, strict=True))
        return Trial(done, observed.interpretation.state, result, levels)

    def _taught(self) -> dict[str, Demonstration]:
        """Return a demonstration of every motion that the robot was taught.

        The latest that was practised; what it has learned elsewhere the scripted caregiver shows,
        but babbling, and what is no sequence.
        """
        taught = self.notebook.taught()
        for motion in {e.motion: None for e in self.learner.experiences}:
            sequence = sequence_called(motion, self.scene.task)
            if sequence and motion not in taught:
                rng = generator_for(self.scene.seed, "taught", motion)
                taught[motion] = self.scene.caregiver().demonstrate(sequence, rng)
        return taught

    def _errors_of(self, shown: Mapping[str, Demonstration], between: Between) -> dict[str, float]:
        """Return by how much imitations of demonstrations miss now [cm]."""
        errors = {}
        for motion, demonstration in shown.items():
            between()
            watched = self.watch(demonstration)
            done = self._performed(watched, self.recogniser.at_the_end(watched))
            errors[motion] = path_error_cm(done.path, watched.path)
        return errors
