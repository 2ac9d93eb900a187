"""What the robot does with its body: watch a demonstration, perform a sequence, babble."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import SimulatedRobot
from motionese.caregiver import Demonstration
from motionese.imitation.settings import Acting
from motionese.minimum_jerk import minimum_jerk
from motionese.network import MTRNN, stepper
from motionese.unit_interval import INNER_HIGH, INNER_LOW, logit, sigmoid


@dataclass(frozen=True)
class Watched:
    """A demonstration as the robot saw it.

    Attributes:
        sensed: The channels' values; the joints' are those of the arm at rest. [T, D]
        path: True positions of the caregiver's marker [m, world]. [T, 3]
        begins: The rows at which the primitives begin.
    """

    sensed: Float[ndarray, "T D"]
    path: Float[ndarray, "T 3"]
    begins: tuple[int, ...]


@dataclass(frozen=True)
class Performance:
    """A sequence as the robot performed it.

    Attributes:
        sensed: What its own body did, in the channels' units; the joints as sensed. [T, D]
        commanded: Commanded joint angles [rad] in force when the row was sensed. [T, J]
        predicted: What the network predicted, in the channels' units. [T, D]
        potentials: The network's potentials u; without columns where none acted. [T, N]
        path: True positions of its own marker [m, world]. [T, 3]
        effects: What the task's things told, by the effect's name. [T] each
        poses: What a picture of each row needs, see `body.pictures`. [T, P]
        joints: Which channels the commanded joints are.
    """

    sensed: Float[ndarray, "T D"]
    commanded: Float[ndarray, "T J"]
    predicted: Float[ndarray, "T D"]
    potentials: Float[ndarray, "T N"]
    path: Float[ndarray, "T 3"]
    effects: Mapping[str, Float[ndarray, " T"]]
    poses: Float[ndarray, "T P"]
    joints: tuple[int, ...]

    def experience(self, efference_copy: bool) -> Float[ndarray, "T D"]:
        """Return what is learned from: sensed, joints as commanded if there is a copy of it."""
        values = self.sensed.copy()
        if efference_copy:
            values[:, self.joints] = self.commanded
        return values

    @property
    def activity(self) -> Float[ndarray, "T N"]:
        """The output y of every unit while it was performed."""
        return sigmoid(self.potentials)


def watch(body: SimulatedRobot, demonstration: Demonstration, rng: np.random.Generator) -> Watched:
    """Let the caregiver's hand run along its path before the robot's eye."""
    path = demonstration.path
    body.watch(path[0], rng)
    sensed, seen = [body.sense()], [body.caregiver_position()]
    for position in path[1:]:
        body.move_caregiver(position)
        body.step()
        sensed.append(body.sense())
        seen.append(body.caregiver_position())
    return Watched(np.array(sensed), np.array(seen), demonstration.begins)


def mean_of(shown: Sequence[Watched]) -> Watched:
    """Return the mean of what was seen, row by row, of a motion that was shown several times.

    As many rows as the shortest has, and as begun as the first.
    """
    if len(shown) == 1:
        return shown[0]
    rows = min(len(each.path) for each in shown)
    sensed = np.mean([each.sensed[:rows] for each in shown], axis=0)
    path = np.mean([each.path[:rows] for each in shown], axis=0)
    return Watched(sensed, path, shown[0].begins)


def perform(
    body: SimulatedRobot,
    network: MTRNN,
    initial_state: Float[ndarray, " N"],
    posture: Float[ndarray, " J"],
    steps: int,
    acting: Acting,
    rng: np.random.Generator,
) -> Performance:
    """Perform a sequence: the network's predicted joint angles are commanded, step by step.

    Args:
        body: The robot.
        network: Its network.
        initial_state: u_0 of the sequence; where it starts from the first sensed row, that of the
            own body replaces the demonstration's.
        posture: Commanded joint angles [rad] the body starts from.
        steps: Rows T of the performance.
        acting: Efference copy, sensor feedback, exploration noise.
        rng: Noise of the sensors and of exploration.
    """
    body.reset(posture, rng)
    trial = Trial(body, posture)
    now = trial.latest(acting.efference_copy, np.full(len(body.channels), 0.5))
    state = np.array(initial_state)
    if network.initial_io == "sensed":
        state[: len(now)] = logit(now)
    trial.think(body.channels.from_unit(now), state)
    step, share = stepper(network), 1.0
    for _ in range(steps - 1):
        state = step(state, now, share)
        predicted = sigmoid(state[: len(now)])
        prediction = body.channels.from_unit(predicted)
        trial.think(prediction, state)
        command = prediction[list(trial.joints)]
        if acting.exploration:
            command = command + acting.exploration * rng.standard_normal(len(command))
        trial.step(command)
        now = trial.latest(acting.efference_copy, predicted)
        share = acting.feedback
    return trial.performance()


def babble(
    body: SimulatedRobot, steps: int, stroke_steps: int, rng: np.random.Generator
) -> Performance:
    """Move the arm from one random posture to another, in a minimum-jerk command."""
    ends = np.repeat([[INNER_LOW], [INNER_HIGH]], len(body.channels), axis=1)
    low, high = body.channels.from_unit(ends)[:, body.channels.indices(body.joints)]
    start, end = rng.uniform(low, high, (2, len(body.joints)))
    body.reset(start, rng)
    trial = Trial(body, start)
    trial.think(trial.sensed[0], np.zeros(0))
    for row in range(1, steps):
        share = float(minimum_jerk(np.array(min(row / stroke_steps, 1.0))))
        trial.think(trial.sensed[-1], np.zeros(0))
        trial.step(start + share * (end - start))
    return trial.performance()


class Trial:
    """The rows of a trial, from its posture on."""

    def __init__(self, body: SimulatedRobot, posture: Float[ndarray, " J"]) -> None:
        self.body = body
        self.joints = tuple(int(i) for i in body.channels.indices(body.joints))
        self.sensed = [body.sense()]
        self.commanded = [np.clip(posture, *body.command_range)]
        self.predicted: list[ndarray] = []
        self.potentials: list[ndarray] = []
        self.path = [body.hand_position()]
        self.effects = [body.effects()]
        self.poses = [body.pose()]

    def think(self, prediction: ndarray, potentials: ndarray) -> None:
        """Note what the network predicts of the row, and its state."""
        self.predicted.append(prediction)
        self.potentials.append(potentials)

    def step(self, command: Float[ndarray, " J"]) -> None:
        """Command, let a control period pass, and note what came of it."""
        self.body.command(command)
        self.body.step()
        self.sensed.append(self.body.sense())
        self.commanded.append(np.clip(command, *self.body.command_range))
        self.path.append(self.body.hand_position())
        self.effects.append(self.body.effects())
        self.poses.append(self.body.pose())

    def latest(self, efference_copy: bool, predicted: Float[ndarray, " D"]) -> Float[ndarray, " D"]:
        """Return the last row in the unit interval; as predicted where nothing was observed."""
        row = self.sensed[-1].copy()
        if efference_copy:
            row[list(self.joints)] = self.commanded[-1]
        unit = self.body.channels.to_unit(row)
        return np.where(np.isfinite(unit), unit, predicted)

    def performance(self) -> Performance:
        """Return what was recorded."""
        return Performance(
            sensed=np.array(self.sensed),
            commanded=np.array(self.commanded),
            predicted=np.array(self.predicted),
            potentials=np.array(self.potentials),
            path=np.array(self.path),
            effects={n: np.array([row[n] for row in self.effects]) for n in self.effects[0]},
            poses=np.array(self.poses),
            joints=self.joints,
        )
