"""What the robot does with its body: watch a demonstration, perform a motion, babble."""

from dataclasses import dataclass

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.body import COMMAND_RANGE, Actroid
from motionese.experiment.settings import Imitation
from motionese.minimum_jerk import minimum_jerk
from motionese.network import MTRNN, rollout

ARM = slice(0, 2)
"""The arm's channels among the body's."""


@dataclass(frozen=True)
class Watched:
    """A demonstration as the robot saw it.

    Attributes:
        sensed: The channels' values; the arm's are those of the hanging arm. [T, 6]
        path: True positions of the caregiver's marker [m, world]. [T, 3]
    """

    sensed: Float[ndarray, "T 6"]
    path: Float[ndarray, "T 3"]


@dataclass(frozen=True)
class Performance:
    """A motion as the robot performed it.

    Attributes:
        sensed: What its own body did, in the channels' units; the arm as sensed. [T, 6]
        commanded: Commanded arm angles [rad] in force when the row was sensed. [T, 2]
        predicted: What the network predicted, in the channels' units. [T, 6]
        path: True positions of its own marker [m, world]. [T, 3]
        depths: How deep the buttons were pressed [mm], right and left. [T, 2]
        poses: What a picture of each row needs, see `body.pictures`. [T, P]
    """

    sensed: Float[ndarray, "T 6"]
    commanded: Float[ndarray, "T 2"]
    predicted: Float[ndarray, "T 6"]
    path: Float[ndarray, "T 3"]
    depths: Float[ndarray, "T 2"]
    poses: Float[ndarray, "T P"]

    def experience(self, efference_copy: bool) -> Float[ndarray, "T 6"]:
        """Return what is learned from: sensed, the arm as commanded if there is a copy of it."""
        values = self.sensed.copy()
        if efference_copy:
            values[:, ARM] = self.commanded
        return values


def watch(body: Actroid, path: Float[ndarray, "T 3"], rng: np.random.Generator) -> Watched:
    """Let the caregiver's hand run along a path [m, world] before the robot's eye."""
    body.watch(path[0], rng)
    sensed, seen = [body.sense()], [body.caregiver_position()]
    for position in path[1:]:
        body.move_caregiver(position)
        body.step()
        sensed.append(body.sense())
        seen.append(body.caregiver_position())
    return Watched(np.array(sensed), np.array(seen))


def perform(
    body: Actroid,
    network: MTRNN,
    initial_state: Float[ndarray, " N"],
    posture: Float[ndarray, "2"],
    steps: int,
    imitation: Imitation,
    rng: np.random.Generator,
) -> Performance:
    """Perform a motion: the network's predicted arm angles are commanded, step by step.

    Args:
        body: The robot.
        network: Its network.
        initial_state: u_0 of the motion; where it starts from the first sensed row, that of the
            own body replaces the demonstration's.
        posture: Commanded arm angles [rad] the body starts from.
        steps: Rows T of the performance.
        imitation: Efference copy, sensor feedback, exploration noise.
        rng: Noise of the sensors and of exploration.
    """
    body.reset(posture, rng)
    record = _Record(body, posture)
    now = body.channels.to_unit(record.latest(imitation.efference_copy))
    state = np.array(initial_state)
    if network.initial_io == "sensed":
        state[: len(now)] = np.log(now / (1 - now))
    record.predicted.append(body.channels.from_unit(now))
    share = 1.0
    for _ in range(steps - 1):
        state = np.asarray(
            _advance(network, jnp.asarray(state), jnp.asarray(now), jnp.asarray(share))
        )
        prediction = body.channels.from_unit(1 / (1 + np.exp(-state[: len(now)])))
        explored = imitation.exploration * rng.standard_normal(2) if imitation.exploration else 0.0
        record.step(body, prediction[ARM] + explored, prediction)
        now = body.channels.to_unit(record.latest(imitation.efference_copy))
        share = imitation.feedback
    return record.performance()


def babble(body: Actroid, steps: int, stroke_steps: int, rng: np.random.Generator) -> Performance:
    """Move the arm from one random posture to another, in a minimum-jerk command."""
    low, high = body.channels.from_unit(np.array([[0.1] * 6, [0.9] * 6]))[:, ARM]
    start, end = rng.uniform(low, high, (2, 2))
    body.reset(start, rng)
    record = _Record(body, start)
    record.predicted.append(record.sensed[0])
    for row in range(1, steps):
        share = float(minimum_jerk(np.array(min(row / stroke_steps, 1.0))))
        record.step(body, start + share * (end - start), record.sensed[-1])
    return record.performance()


class _Record:
    """The rows of a trial, from its posture on."""

    def __init__(self, body: Actroid, posture: Float[ndarray, "2"]) -> None:
        self.sensed = [body.sense()]
        self.commanded = [np.clip(posture, *COMMAND_RANGE)]
        self.predicted: list[ndarray] = []
        self.path = [body.hand_position()]
        self.depths = [body.button_depths()]
        self.poses = [body.pose()]

    def step(self, body: Actroid, command: Float[ndarray, "2"], prediction: ndarray) -> None:
        """Command, let a control period pass, and note what came of it."""
        body.command(command)
        body.step()
        self.sensed.append(body.sense())
        self.commanded.append(np.clip(command, *COMMAND_RANGE))
        self.predicted.append(prediction)
        self.path.append(body.hand_position())
        self.depths.append(body.button_depths())
        self.poses.append(body.pose())

    def latest(self, efference_copy: bool) -> Float[ndarray, "6"]:
        """Return the last row as the network takes it."""
        row = self.sensed[-1].copy()
        if efference_copy:
            row[ARM] = self.commanded[-1]
        return row

    def performance(self) -> Performance:
        """Return what was recorded."""
        columns = (
            self.sensed,
            self.commanded,
            self.predicted,
            self.path,
            self.depths,
            self.poses,
        )
        return Performance(*(np.array(column) for column in columns))


@eqx.filter_jit
def _advance(
    network: MTRNN, state: Float[Array, " N"], sensed: Float[Array, " D"], share: Float[Array, ""]
) -> Float[Array, " N"]:
    """Take one step of equations (1) and (2)."""
    rows = jnp.stack([sensed, sensed])[None].astype(state.dtype)
    return rollout(network, state[None], rows, jnp.full_like(rows, share))[0, 1]
