"""One robot that imitates a learned motion, observation by observation; needs NumPy alone."""

import logging
from collections.abc import Sequence

import numpy as np
from numpy import ndarray

from motionese.errors import ControlError, unknown
from motionese.runtime import NONE, Limits, OnlineRecognition, Part, Player, RuntimeModel
from motionese.runtime.limits import Limiter
from motionese.runtime.player import shares
from motionese.runtime.schedule import schedule

HALF = 0.5
"""Belief in none of the learned motions from which on the robot rather keeps still."""

logger = logging.getLogger(__name__)


class Imitator:
    """Recognises which learned motion is to be played, plays it once, and keeps still after it.

    A column of the action whose channel is also sensed is where the robot is to be next; one whose
    channel is not was recorded as the command in that row, and is the present row's.
    """

    def __init__(
        self,
        model: RuntimeModel,
        state: Sequence[str],
        action: Sequence[str],
        *,
        motion: str | None = None,
        share: float = 0.0,
        watch: int = 1,
    ) -> None:
        """Keep still until something is observed.

        Args:
            model: The model, at the rate that it is run at.
            state: The channel in every column of what is observed; one that the model does not
                know is passed over. [S]
            action: The model's channel in every column of the action. [A]
            motion: The learned motion that is played; otherwise the task names one, or it is
                recognised.
            share: How much of the network's input is sensed, see `motionese.runtime.Player`.
            watch: Observations that are looked at before a motion is recognised.

        Raises:
            ControlError: A motion or channel that the model does not know, a number out of range.
        """
        for name in action:
            model.per_channel("action", {name: True}, False)
        if watch < 1:
            raise ControlError(f"watch must be 1 or more, got {watch}")
        shares(model, share)
        if motion is not None and motion not in model.initial_states:
            raise ControlError(unknown("motion", motion, model.initial_states))
        places = {name: place for place, name in enumerate(model.channels)}
        known = [(column, places[name]) for column, name in enumerate(state) if name in places]
        self._columns, self._sensed = np.array(known, dtype=np.intp).reshape(-1, 2).T
        self._acted = np.array([places[name] for name in action], dtype=np.intp)
        self._next = np.isin(self._acted, self._sensed)
        # Where no channel tells what keeps a command still, it is the place behind all: a NaN.
        self._stays = np.array([places.get(sensed_as(n), len(places)) for n in action], np.intp)
        self._model, self._state, self._action = model, tuple(state), tuple(action)
        self._motion, self._share, self._watch = motion, share, watch
        self._recognition = OnlineRecognition(
            model, observed=[model.channels[place] for place in self._sensed], ahead=0
        )
        # No speeds are limited, and with them no rate counts.
        self._limiter = Limiter(model, Limits(), rate_hz=1.0)
        self._player: Player | None = None
        self._left, self._said = 0, ""

    def act(self, observed: ndarray, task: str = "") -> ndarray:
        """Take in an observation [S] and return the action [A], both in the channels' units.

        Args:
            observed: NaN where nothing was read.
            task: A learned motion by its name; any other text leaves it to recognition.

        Raises:
            ControlError: Another number of columns; a motion is to begin far outside the channels'
                ranges; a prediction is not finite; nothing is recognised, and no telling what
                keeps the robot still.
        """
        if np.shape(observed) != (len(self._state),):
            raise ControlError(
                f"observation.state must have {len(self._state)} columns "
                f"({', '.join(self._state)}), got shape {np.shape(observed)}: write the policy's "
                "folder anew with --dataset, which tells the columns of this robot"
            )
        reading = np.full(len(self._model.channels), np.nan)
        reading[self._sensed] = np.asarray(observed, dtype=np.float64)[self._columns]
        if self._player is None:
            self._begin(reading, task)
        return self._still(reading) if self._player is None else self._moved(self._player, reading)

    def _begin(self, reading: ndarray, task: str) -> None:
        """Begin the motion that is named, or that is recognised."""
        named = self._motion or task
        if named in self._model.initial_states:
            self._play(Part(named), reading, f"plays motion '{named}'")
            return
        known = self._recognition.observe(reading)
        if known.row + 1 < self._watch:
            return
        untold = f"task '{task}' is no learned motion's name; " if task else ""
        name, row = known.learned
        left = self._model.lengths[name] - 1 - row
        if known.belief[NONE] >= HALF:
            self._say(
                logging.WARNING,
                f"{untold}keeps still: what is observed is none of the learned motions; name one "
                f"of {', '.join(self._model.initial_states)} as the task or by --policy.motion",
            )
        elif left < 1:
            self._say(logging.WARNING, f"keeps still: it is where motion '{name}' ends")
        else:
            self._play(
                Part(known.potentials, steps=left),
                reading,
                f"{untold}recognised motion '{name}' in its row {row} "
                f"(belief {known.belief[name]:.2f}) and plays it from there",
            )

    def _play(self, part: Part, reading: ndarray, sentence: str) -> None:
        self._limiter.check_start(reading)
        [scheduled] = schedule(self._model, (part,))
        self._player = Player(self._model, self._model.begin(part.start, reading), self._share)
        self._player.set_out(scheduled.blend)
        self._left = scheduled.steps
        rate = self._model.rate_hz
        at = "" if rate is None else f" at {rate:g} Hz"
        self._say(logging.INFO, f"{sentence}, {self._left} steps{at}")

    def _moved(self, player: Player, reading: ndarray) -> ndarray:
        present = player.row
        if self._left:
            player.step(reading)
            self._left -= 1
            if not player.finite:
                raise ControlError("the prediction is not finite, and not sent: train it longer")
        else:
            self._say(logging.INFO, "has played the motion and keeps still")
        present, following = (self._limiter.limit(row, row) for row in (present, player.row))
        return np.where(self._next, following[self._acted], present[self._acted])

    def _still(self, reading: ndarray) -> ndarray:
        action = np.append(reading, np.nan)[self._stays]
        for name in (n for n, value in zip(self._action, action, strict=True) if np.isnan(value)):
            raise ControlError(
                f"no motion is recognised, and channel '{sensed_as(name)}' does not tell what "
                f"keeps '{name}' still: name the motion as the task or by --policy.motion"
            )
        return action

    def _say(self, level: int, sentence: str) -> None:
        """Log what the robot does, once."""
        if sentence != self._said:
            self._said = sentence
            logger.log(level, "motionese: %s", sentence)


def is_command(channel: str) -> bool:
    """Return whether a channel's name is that of a recorded action."""
    return channel == "action" or channel.startswith(("action.", "action_"))


def sensed_as(channel: str) -> str:
    """Return the name that an action's channel has as a column of the state."""
    if channel.startswith("action."):
        return channel.removeprefix("action.")
    return "state" + channel.removeprefix("action") if is_command(channel) else channel
