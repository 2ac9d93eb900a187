"""Recognition of what is being drawn while the pen moves, row by row.

A drawing is played at the robot's tempo, and how fast a person moves shows only as they go on: rows
that were seen already are left as they were, but for the last one, in which the pen still moves.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Scene, Watched
from motionese.runtime import OnlineRecognition, OnlineResult, RuntimeModel
from motionese.runtime.belief import NONE
from motionese.teaching.view import hand_seen


@dataclass(frozen=True)
class Understanding:
    """What the robot makes of a motion so far.

    Attributes:
        result: What online recognition knows after the row; its motions are experiences.
        belief: How likely every learned motion is being shown, by the sequence's name, and `NONE`,
            which comes last; the sum is 1.
        path: The hand's path as recognised [m, world], from row 0 of the demonstration. [T, 3]
        next: How the network would go on, for one stroke. [S, 3]
    """

    result: OnlineResult
    belief: Mapping[str, float]
    path: Float[ndarray, "T 3"]
    next: Float[ndarray, "S 3"]

    @property
    def likeliest(self) -> str:
        """The motion that is believed in most, or `NONE`."""
        return max(self.belief, key=self.belief.__getitem__)


class OnlineRecogniser:
    """Recognises one motion while a scene's robot watches it."""

    def __init__(self, scene: Scene, model: RuntimeModel, motions: Mapping[str, str]) -> None:
        """Begin with nothing seen.

        Args:
            scene: Robot and caregiver.
            model: What the robot has learned.
            motions: The sequence's name by every learned motion's.
        """
        body = scene.body
        self._body, self._motions = body, motions
        self._online = OnlineRecognition(
            model,
            observed=[name for name in body.channels.names if name not in body.joints],
            ahead=scene.settings.caregiver.primitive_rows,
        )
        self._rows, self._path = 0, np.zeros((0, 3))

    def observe(self, watched: Watched) -> list[Understanding]:
        """Take in a demonstration so far; return what is understood in every row that is looked at.

        These are the rows that were not seen before, after the last that was. There is none where
        a demonstration has become shorter.
        """
        understood = []
        for row in range(max(self._rows - 1, 0), len(watched.sensed)):
            understood.append(self._understanding(self._online.observe(watched.sensed[row], row)))
            self._rows = row + 1
        return understood

    def _understanding(self, result: OnlineResult) -> Understanding:
        begin = result.row + 1 - len(result.path)
        hand = hand_seen(self._body, np.concatenate([result.path, result.ahead]))
        path, ahead = np.split(hand, [len(result.path)])
        self._path = np.concatenate([self._path[:begin], path])
        belief = dict.fromkeys([*self._motions.values(), NONE], 0.0)
        for name, share in result.belief.items():
            belief[self._motions.get(name, NONE)] += share
        return Understanding(result, belief, self._path, ahead)
