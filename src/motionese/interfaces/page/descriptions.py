"""What the page is told: the messages of the robot's process, made of what it knows."""

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import Geometry
from motionese.caregiver import intended_way
from motionese.imitation import Scene
from motionese.interfaces.page.messages import Answer, Tell
from motionese.learning import Progress
from motionese.network import MTRNN
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.chapters import TITLES, Chapter, chapter_of
from motionese.teaching.claim import Claim
from motionese.teaching.emergence import CLEAR, Emergence
from motionese.teaching.frames import Film
from motionese.teaching.interactive_map import InteractiveMap, Strokes
from motionese.teaching.lesson import Lesson, growth_in_words
from motionese.teaching.notebook import Change, Entry, Notebook
from motionese.teaching.online_recogniser import Understanding
from motionese.teaching.result import Result
from motionese.teaching.session import Observation, Teaching
from motionese.teaching.trial import Trial
from motionese.teaching.verdict import sequence_called
from motionese.teaching.view import ASPECT, View

DIGITS = 4
PART_S = 0.2
"""Frames are sent in parts of so many seconds, each when it is due."""
MANNER = ("pace", "roundness", "pause_count", "pause")
"""The measures that are told of how a motion was shown."""
BARS = 3
"""So many hypotheses about what was shown are told."""


def scene_message(scene: Scene, view: View, geometry: Geometry) -> Answer:
    """Return what does not change in a session: the view, the robot's shapes, the task."""
    task, body = scene.task, scene.body
    camera = {
        "position": listed(body.eye_position),
        **dict(zip(("right", "up", "ahead"), listed(view.axes), strict=True)),
        "fov_y_deg": round(float(np.degrees(view.height)), 2),
    }
    return {
        "type": "scene",
        "view": {"aspect": ASPECT, "camera": camera},
        "robot": {
            "bodies": geometry.bodies,
            "geoms": geometry.shapes,
            "pose": listed(geometry.placed(body.pose()[None]).ravel()),
            "joints": body.joints,
        },
        "channels": [{"name": c.name, "unit": c.unit} for c in body.channels],
        "task": _task(task, view),
        "levels": [
            {"name": level.name, "size": level.size, "tau": level.tau}
            for level in scene.settings.network.drawn_levels(body.channels)
        ],
        "rate_hz": body.rate_hz,
    }


def _task(task: Task, view: View) -> Answer:
    """Return places in the view, primitives, effects and where they come about, sequences."""
    return {
        "places": {
            name: {"at": listed(view.of_points(task.position(name))), "title": place.title}
            for name, place in task.places.items()
        },
        "primitives": [
            {
                "sign": primitive.sign,
                "start": primitive.start,
                "end": primitive.end,
                "words": primitive.words,
                "way": listed(view.of_points(intended_way(PrimitiveSequence((primitive,)), task))),
            }
            for primitive in task.primitives
        ],
        "effects": [
            {
                "name": effect,
                "title": ", ".join(p.end for p in task.primitives if p.effect == effect),
                "places": [p.end for p in task.primitives if p.effect == effect],
            }
            for effect in task.effects
        ],
        "motions": [s.name for length in (1, 2, 3) for s in task.sequences(length)],
    }


def session_message(teaching: Teaching, view: View, name: str, began: str, busy: str) -> Answer:
    """Return where the session stands, in which what was shown last is seen as in a view."""
    notebook, levels = teaching.notebook, teaching.learner.network.levels
    learned = {each.entry for each in notebook.learned if each.kept}
    observed = teaching.observed
    entries = [
        {
            "entry": entry.number,
            "motion": entry.motion,
            "source": entry.source,
            "errors": [round(error, 2) for error in entry.errors_cm],
            "learned": entry.number in learned,
            "own": sequence_called(entry.motion, teaching.scene.task) is None,
        }
        for entry in notebook.entries
    ]
    suggestion = ""
    if teaching.should_grow:
        suggestion = (
            f"Learning has settled (the last error was {_last_error(notebook):.1f} cm): let the "
            "network grow a slow level, and show sequences."
        )
    return {
        "type": "session",
        "id": name,
        "began": began,
        "phase": len(levels) - 1,
        "levels": [level.name for level in levels],
        "notebook": entries,
        **_curves(teaching),
        "can_grow": teaching.can_grow,
        "shown": observed.entry.number if observed else None,
        "watched": listed(view.of_points(observed.watched.path)) if observed else [],
        "manner": _manner(observed) if observed else None,
        "suggest": suggestion,
        "chapter": _chapter(chapter_of(teaching)),
        "busy": busy,
    }


def _manner(observed: Observation) -> Answer:
    """Return how a motion was shown, by who shows it; None for what is undefined, and why."""
    return {
        "motion": observed.entry.motion,
        "measures": {
            who: {
                **{name: _known(getattr(measures, name)) for name in MANNER},
                "undefined": {n: why for n, why in measures.undefined.items() if n in MANNER},
            }
            for who, measures in observed.manner.measures.items()
        },
    }


def _chapter(chapter: Chapter | None) -> Answer | None:
    if chapter is None:
        return None
    told = {"name": chapter.name, "number": chapter.number, "of": len(TITLES)}
    return {**told, "title": TITLES[chapter.name], "act": chapter.act, "motion": chapter.motion}


def _last_error(notebook: Notebook) -> float:
    """Return the error of the last lesson [cm]."""
    return next(e.changes[0].after_cm for e in reversed(notebook.learned) if e.entry)


def _curves(teaching: Teaching) -> Answer:
    """Return the curve of every motion that is known, and after how much learning levels opened."""
    notebook = teaching.notebook
    known = {*notebook.taught(), *(e.motion for e in teaching.learner.experiences)}
    return {
        "curves": [
            {
                "motion": motion,
                "points": [
                    {"n": p.after, "error_cm": round(p.error_cm, 2), "practised": p.practised}
                    for p in points
                ],
            }
            for motion, points in notebook.curves.items()
            if motion in known
        ],
        "grown": [n for n, each in enumerate(notebook.learned, 1) if not each.entry],
    }


def verdict_message(observed: Observation, view: View, seconds: float) -> Answer:
    """Return the verdict on a demonstration, `seconds` after it had ended."""
    verdict = observed.verdict
    return {
        "type": "verdict",
        "entry": observed.entry.number,
        "motion": verdict.motion,
        "shown": verdict.sequence.name if verdict.sequence else "",
        "seen": _likeliest(verdict.seen),
        "claim": _claim(verdict.claim),
        "path": listed(view.of_points(observed.interpretation.path)),
        "drawn": listed(view.of_points(observed.watched.path)),
        "next": listed(view.of_points(observed.interpretation.next)),
        "error_cm": round(verdict.error_cm, 2),
        "sentence": verdict.sentence,
        "line": verdict.line,
        "advice": verdict.advice,
        "ms": round(1000 * seconds),
    }


def saw_message(seen: Mapping[str, float]) -> Answer:
    """Return what was seen of a demonstration; the verdict follows when it has been thought of."""
    return {"type": "saw", "seen": _likeliest(seen)}


def understanding_message(
    understood: Understanding, seen: Mapping[str, float], view: View, milliseconds: int
) -> Answer:
    """Return what was seen, and what is understood of it, so late in a drawing."""
    return {
        "type": "understanding",
        "t_ms": milliseconds,
        "seen": _likeliest(seen),
        "belief": [
            {"motion": motion, "share": round(share, DIGITS)}
            for motion, share in understood.belief.items()
        ],
        "path": listed(view.of_points(understood.path)),
        "next": listed(view.of_points(understood.next)),
    }


def _claim(claim: Claim) -> Answer:
    return {
        "made": claim.made,
        "sentence": claim.sentence,
        "foretold_cm": round(claim.foretold_cm, 2),
        "expected_cm": _known(claim.expected_cm),
        "missed": list(claim.missed),
        "like": claim.like,
        "apart": _known(claim.apart),
    }


def _likeliest(seen: Mapping[str, float]) -> list[Answer]:
    """Return the likeliest of what may have been shown."""
    return [{"motion": m, "share": round(s, DIGITS)} for m, s in [*seen.items()][:BARS]]


def _known(value: float) -> float | None:
    return round(value, 2) if np.isfinite(value) else None


def shown_message(motion: str, seen: Float[ndarray, "T 2"], step_ms: float) -> Answer:
    """Return how the scripted caregiver shows a motion, seen in the view."""
    path = [[round(step_ms * row), *place] for row, place in enumerate(listed(seen))]
    return {"type": "shown", "motion": motion, "path": path}


def performed_message(
    entry: Entry, trial: Trial, seen: Float[ndarray, "T 2"], rate_hz: float
) -> Answer:
    """Return how a performance went, its hand seen in the view."""
    effects = trial.performance.effects.items()
    return {
        "type": "performed",
        "entry": entry.number,
        "effects": {name: round(float(values.max()), 1) for name, values in effects},
        **_came_to(trial.result),
        "attempt": len(entry.errors_cm),
        "path": listed(seen),
        "begins": _begins(entry, rate_hz),
    }


def _came_to(result: Result) -> Answer:
    return {
        "error_cm": round(result.error_cm, 2),
        "pushes": [
            {
                "effect": push.effect,
                "place": push.place,
                "depth_mm": round(push.depth_mm, 1),
                "needed_mm": push.needed_mm,
                "made": push.made,
            }
            for push in result.pushes
        ],
        "good": result.good,
        "sentence": result.sentence,
        "advice": result.advice,
    }


def whole_film(played: Film, trial: Trial, entry: Entry, view: View, rate_hz: float) -> Answer:
    """Return a try with its film, to be played at any speed: of `practice` and `replayed`."""
    return {
        "entry": entry.number,
        "motion": entry.motion,
        **_came_to(trial.result),
        "path": listed(view.of_points(trial.performance.path)),
        "drawn": listed(view.of_points(entry.demonstration.path)),
        "begins": _begins(entry, rate_hz),
        "film": {"rate_hz": played.rate_hz, **played.part(0, len(played))},
    }


def _begins(entry: Entry, rate_hz: float) -> list[float]:
    """Return when [s] the primitives of what was shown begin, at the robot's tempo."""
    return [round(row / rate_hz, DIGITS) for row in entry.demonstration.begins]


def frames_message(played: Film, begin: int, end: int, last: bool) -> Answer:
    """Return some frames of a film; `last` says that no more follow."""
    frames = {"from": begin, "rate_hz": played.rate_hz, "last": last}
    return {"type": "frames", **frames, **played.part(begin, end)}


def show_film(played: Film, tell: Tell) -> Iterator[float]:
    """Send a film part by part; yields how long [s] to wait before the next."""
    size = round(PART_S * played.rate_hz)
    began = time.monotonic()
    for row in range(0, len(played), size):
        tell(frames_message(played, row, row + size, row + size >= len(played)))
        yield max(0.0, began + (row + size) / played.rate_hz - time.monotonic())


def learned_message(lesson: Lesson) -> Answer:
    """Return what a lesson has brought."""
    taught = lesson.changes[0]
    return {
        "type": "learned",
        "entry": lesson.entry,
        "motion": taught.motion,
        "before_cm": round(taught.before_cm, 2),
        "after_cm": round(taught.after_cm, 2),
        "tries": [round(error, 2) for error in lesson.errors_cm],
        "kept": lesson.kept,
        "changes": _changes(lesson.changes),
        "sentence": lesson.sentence,
        "advice": lesson.result.advice,
        "claim": _claim(lesson.claim),
    }


def grown_message(changes: Sequence[Change], network: MTRNN) -> Answer:
    """Return what growth has brought: the same imitations before and after."""
    return {
        "type": "grown",
        "changes": _changes(changes),
        "sentence": growth_in_words(changes),
        "levels": [level.name for level in network.levels],
    }


def _changes(changes: Sequence[Change]) -> list[Answer]:
    return [
        {
            "motion": change.motion,
            "before_cm": round(change.before_cm, 2),
            "after_cm": round(change.after_cm, 2),
        }
        for change in changes
    ]


def progress_message(what: str, done: int, of: int, now: Progress) -> Answer:
    """Return how far something is."""
    good = {"loss": round(now.loss, DIGITS), "error_share": round(now.closed_loop_error, 5)}
    return {"type": "progress", "what": what, "done": done, "of": of, **good}


def map_message(drawn: InteractiveMap) -> Answer:
    """Return the map of initial states: by primitive the first stroke, and the one after it."""
    return {
        "type": "map",
        "level": drawn.plane.level,
        "below": drawn.below,
        "slow": drawn.plane.slow,
        "axis": drawn.axis,
        "points": [{"motion": motion, "at": at} for motion, at in drawn.points],
        "primitives": {
            name: [_strokes(each) for each in strokes] for name, strokes in drawn.strokes.items()
        },
    }


def _strokes(strokes: Strokes) -> Answer:
    """Return one stroke from every point: its direction [rad], length as a share, and way."""
    return {
        "known": list(strokes.known),
        "direction": np.round(strokes.directions, 2).tolist(),
        "length": np.round(strokes.lengths, 2).tolist(),
        "way": list(strokes.ways),
    }


def emergence_message(emerged: Sequence[Emergence]) -> Answer:
    """Return what has emerged in the network by now, and how it came to that."""
    now = emerged[-1]
    history = [{d.primitive: round(d.share, DIGITS) for d in e.directions} for e in emerged]
    return {
        "type": "emergence",
        "levels": list(now.levels),
        "slow": now.slow,
        "clear": CLEAR,
        "sentence": now.sentence,
        "directions": [
            {
                "primitive": each.primitive,
                "share": round(each.share, DIGITS),
                "newborn": round(each.newborn, DIGITS),
                "learned": each.learned,
                "clear": each.clear,
                "sentence": each.sentence(now.slow),
                "history": [shares[each.primitive] for shares in history],
            }
            for each in now.directions
        ],
        "first": asdict(now.first),
        "order": asdict(now.order),
        "read": [asdict(each) for each in now.read],
    }


def listed(values: Float[ndarray, "*shape"]) -> list[Any]:
    """Return an array as lists of rounded numbers."""
    return list(np.round(values, DIGITS).tolist())
