"""The map of a robot that is being taught: the same Cf, another Cs, and which way does it go?

It is the paper's Fig. 10 but for this: the state that is held is not sought. It is what comes
nearest to the primitive of all that was learned. A free initial state lets any network trace a
stroke, one that has learned nothing too; what it recalls is its own.

Where no slow level is open, it is a map of the fast one, over the plane of what was learned.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import BABBLING, Learner, Scene, strokes_from
from motionese.imitation.strokes import WITHIN, stroke
from motionese.learning import generate
from motionese.task import PrimitiveSequence
from motionese.teaching.drawing import most_rows
from motionese.teaching.notebook import Notebook
from motionese.teaching.state_plane import plane_of
from motionese.teaching.view import hand_seen

DIGITS = 3
ELSEWHERE, HARDLY = "elsewhere", "hardly"
"""Ways of a stroke that goes in no direction of the task, and of one that is too short."""
HALF = 0.5
"""A stroke that is shorter than this share of the task's hardly moves."""


@dataclass(frozen=True)
class Strokes:
    """One stroke from every point of a map, the first axis changing slowest.

    Attributes:
        directions: Where the hand is seen to go [rad]: 0 to the robot's right, π/2 upwards. [G]
        lengths: How far, as a share of how far the task's stroke goes. [G]
        known: The primitives that may be meant.
        ways: The primitive of the task that every stroke follows; or elsewhere, or hardly any.
    """

    directions: Float[ndarray, " G"]
    lengths: Float[ndarray, " G"]
    known: tuple[str, ...]
    ways: tuple[str, ...]

    def share(self, way: str) -> float:
        """Return the share of the map that goes a way."""
        return self.ways.count(way) / len(self.ways)


class InteractiveMap:
    """The map, and the motion of every point of it.

    Attributes:
        plane: Which initial states it is drawn over.
        below: The name of the level below.
        axis: Their values along both directions.
        strokes: By primitive the first stroke, and the one that follows it.
        points: Where the learned motions lie: name, and place in the plane.
        true: Direction and extent [rad] of every primitive, as it is shown.
    """

    def __init__(self, scene: Scene, learner: Learner) -> None:
        """Draw the map of what a scene's robot has become."""
        self._scene, self._network, memory = scene, learner.network, learner.memory
        settings = scene.settings.evaluation
        self.plane = plane_of(learner, settings.map_range)
        self.below = self._network.names[-2]
        reach = self.plane.reach
        self.axis: list[float] = np.round(
            np.linspace(-reach, reach, settings.map_points), DIGITS
        ).tolist()
        primitives = scene.task.sequences(1)
        shown = {p.name: scene.show(p, "map") for p in primitives}
        seen = {name: scene.body.bearing(watched.sensed) for name, watched in shown.items()}
        self.true: Mapping[str, Float[ndarray, " 2"]] = {
            name: stroke(bearing[0], bearing[-1]) for name, bearing in seen.items()
        }
        # By primitive: the recalled initial state, and a demonstration's first row as sensed.
        self._origins: dict[str, tuple[Float[ndarray, " N"], Float[ndarray, " D"]]] = {}
        self.strokes: dict[str, tuple[Strokes, Strokes]] = {}
        for primitive in primitives:
            values = scene.as_own(primitive.start, shown[primitive.name])
            batch = scene.to_recognise([values]).batch(len(values), 1)
            state = memory.nearest(self._network, batch, 1).starts[0, 0]
            self._origins[primitive.name] = state, values[0]
            self.strokes[primitive.name] = self._strokes(primitive)
        self.points = [
            (e.motion, np.round(self.plane.coordinates(e.initial_state), DIGITS).tolist())
            for e in learner.experiences
            if e.motion != BABBLING
        ]

    def share(self, primitive: str) -> float:
        """Return the share of the slow states from which a primitive goes its way.

        Where no slow level is open there is one state to be asked, the recalled one.
        """
        first, _ = self.strokes[primitive]
        if not self.plane.slow:
            at = self.plane.coordinates(self._origins[primitive][0])[None]
            first = self._strokes(self._scene.task.sequence(primitive), at)[0]
        return first.share(primitive)

    def named_as(self, notebook: Notebook) -> None:
        """Call the learned motions as they are called now."""
        self.points = [(notebook.called_now(motion), at) for motion, at in self.points]

    def motion(self, primitive: str, at: tuple[float, float]) -> Float[ndarray, "T 3"] | None:
        """Return the hand's path [m, world] from a point, for two strokes; None if unknown."""
        if primitive not in self._origins:
            return None
        held, first = self._origins[primitive]
        manner = self._scene.manner
        state = self.plane.moved(held, np.array(at))
        values = generate(self._network, state, most_rows(manner), first=first)
        return hand_seen(self._scene.body, values[: 2 * manner.primitive_rows])

    def _strokes(
        self, primitive: PrimitiveSequence, at: Float[ndarray, "G 2"] | None = None
    ) -> tuple[Strokes, Strokes]:
        """Return the two strokes from points of the plane; from all of the map if not told."""
        if at is None:
            at = np.stack(np.meshgrid(self.axis, self.axis, indexing="ij"), axis=-1).reshape(-1, 2)
        held, first = self._origins[primitive.name]
        states = self.plane.moved(held, at)
        made = strokes_from(self._scene, self._network, primitive, states, first)
        places = primitive.start, primitive.places[-1]
        one, other = (self._told(each, place) for each, place in zip(made, places, strict=True))
        return one, other

    def _told(self, made: Float[ndarray, "G 2"], start: str) -> Strokes:
        """Return strokes from a place of the task, and which of its primitives they follow."""
        known = tuple(s.name for s in self._scene.task.sequences(1) if s.start == start)
        directions, extents = made.T
        if not known:  # all end there
            return Strokes(directions, np.ones(len(made)), known, (ELSEWHERE,) * len(made))
        true, far = np.array([self.true[name] for name in known]).T
        off = np.abs(np.angle(np.exp(1j * (directions[:, None] - true))))
        nearest, near = off.argmin(axis=1), off.min(axis=1) <= WITHIN
        names = np.where(near, np.array(known)[nearest], ELSEWHERE)
        lengths = extents / far[nearest]
        ways = np.where(lengths < HALF, HARDLY, names).tolist()
        return Strokes(directions, lengths, known, tuple(ways))
