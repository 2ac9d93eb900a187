"""What the page is told: the messages of the robot's process, made of what it knows."""

import time
from collections.abc import Iterator, Mapping, Sequence
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
from motionese.teaching.frames import Film
from motionese.teaching.interactive_map import InteractiveMap
from motionese.teaching.notebook import Entry
from motionese.teaching.online_recogniser import Understanding
from motionese.teaching.session import Change, Observation, Teaching, Trial
from motionese.teaching.view import ASPECT, View

DIGITS = 4
PART_S = 0.2
"""Frames are sent in parts of so many seconds, each when it is due."""
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
                "title": effect.replace("_", " "),
                "places": [p.end for p in task.primitives if p.effect == effect],
            }
            for effect in task.effects
        ],
        "motions": [s.name for length in (1, 2, 3) for s in task.sequences(length)],
    }


def session_message(teaching: Teaching, name: str, began: str, busy: str) -> Answer:
    """Return where the session stands."""
    notebook, levels = teaching.notebook, teaching.learner.network.levels
    learned = {each.entry for each in notebook.learned}
    entries = [
        {
            "entry": entry.number,
            "motion": entry.motion,
            "source": entry.source,
            "errors": [round(error, 2) for error in entry.errors_cm],
            "learned": entry.number in learned,
        }
        for entry in notebook.entries
    ]
    suggestion = ""
    if teaching.should_grow:
        suggestion = (
            f"Learning has settled (the last error was {notebook.curve[-1]:.1f} cm): let the "
            "network grow a slow level, and show sequences."
        )
    return {
        "type": "session",
        "id": name,
        "began": began,
        "phase": len(levels) - 1,
        "levels": [level.name for level in levels],
        "notebook": entries,
        "curve": [{"n": n, "error_cm": round(e, 2)} for n, e in enumerate(notebook.curve, 1)],
        "can_grow": teaching.can_grow,
        "can_map": InteractiveMap.possible(teaching),
        "shown": teaching.observed.entry.number if teaching.observed else None,
        "suggest": suggestion,
        "busy": busy,
    }


def verdict_message(observed: Observation, view: View, seconds: float) -> Answer:
    """Return the verdict on a demonstration, `seconds` after it had ended."""
    verdict, claim = observed.verdict, observed.verdict.claim
    return {
        "type": "verdict",
        "entry": observed.entry.number,
        "motion": verdict.motion,
        "shown": verdict.sequence.name if verdict.sequence else "",
        "seen": _likeliest(verdict.seen),
        "claim": {
            "made": claim.made,
            "sentence": claim.sentence,
            "foretold_cm": round(claim.foretold_cm, 2),
            "expected_cm": _known(claim.expected_cm),
            "missed": list(claim.missed),
            "like": claim.like,
            "apart": _known(claim.apart),
        },
        "path": listed(view.of_points(observed.interpretation.path)),
        "drawn": listed(view.of_points(observed.watched.path)),
        "next": listed(view.of_points(observed.interpretation.next)),
        "error_cm": round(verdict.error_cm, 2),
        "sentence": verdict.sentence,
        "advice": verdict.advice,
        "ms": round(1000 * seconds),
    }


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


def _likeliest(seen: Mapping[str, float]) -> list[Answer]:
    """Return the likeliest of what may have been shown."""
    return [{"motion": m, "share": round(s, DIGITS)} for m, s in [*seen.items()][:BARS]]


def _known(value: float) -> float | None:
    return round(value, 2) if np.isfinite(value) else None


def shown_message(motion: str, seen: Float[ndarray, "T 2"], step_ms: float) -> Answer:
    """Return how the scripted caregiver shows a motion, seen in the view."""
    path = [[round(step_ms * row), *place] for row, place in enumerate(listed(seen))]
    return {"type": "shown", "motion": motion, "path": path}


def performed_message(entry: Entry, trial: Trial, seen: Float[ndarray, "T 2"]) -> Answer:
    """Return how a performance went, its hand seen in the view."""
    effects, result = trial.performance.effects.items(), trial.result
    return {
        "type": "performed",
        "entry": entry.number,
        "error_cm": round(trial.error_cm, 2),
        "effects": {name: round(float(values.max()), 1) for name, values in effects},
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
        "attempt": len(entry.errors_cm),
        "path": listed(seen),
    }


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


def learned_message(entry: int, change: Change, curve: Sequence[float]) -> Answer:
    """Return what a learning has brought."""
    return {
        "type": "learned",
        "entry": entry,
        "before_cm": round(change.before_cm, 2),
        "after_cm": round(change.after_cm, 2),
        "curve": {"n": len(curve), "error_cm": round(curve[-1], 2)},
    }


def grown_message(changes: Sequence[Change], network: MTRNN) -> Answer:
    """Return what growth has brought: the same imitations before and after."""
    return {
        "type": "grown",
        "before": [{"motion": c.motion, "cm": round(c.before_cm, 2)} for c in changes],
        "after": [{"motion": c.motion, "cm": round(c.after_cm, 2)} for c in changes],
        "levels": [level.name for level in network.levels],
    }


def progress_message(what: str, done: int, of: int, now: Progress) -> Answer:
    """Return how far something is."""
    good = {"loss": round(now.loss, DIGITS), "error_share": round(now.closed_loop_error, 5)}
    return {"type": "progress", "what": what, "done": done, "of": of, **good}


def map_message(drawn: InteractiveMap) -> Answer:
    """Return the map of the slow initial states."""
    points = [{"motion": motion, "slow": slow} for motion, slow in drawn.points]
    places = {"axis": drawn.axis, "primitives": drawn.grids, "points": points}
    return {"type": "map", "level": drawn.level, **places}


def listed(values: Float[ndarray, "*shape"]) -> list[Any]:
    """Return an array as lists of rounded numbers."""
    return list(np.round(values, DIGITS).tolist())
