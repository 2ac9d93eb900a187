"""What a robot has become: its network and the experiences it learns from."""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.caregiver import Motion
from motionese.channels import Channels
from motionese.experiment.settings import NetworkSettings
from motionese.learning import Motions
from motionese.network import MTRNN, grow

BABBLING = "babbling"


@dataclass(frozen=True)
class Experience:
    """One motion of the own body, and the initial states that belong to it.

    Attributes:
        loop: The loop it was made in; 0 for babbling.
        motion: The motion's name.
        values: What was sensed, and commanded, in the channels' units. [T, 6]
        initial_state: u_0 of all levels. [N]
    """

    loop: int
    motion: str
    values: Float[ndarray, "T 6"]
    initial_state: Float[ndarray, " N"]


@dataclass(frozen=True)
class Learner:
    """A network and its experiences, the oldest first."""

    network: MTRNN
    experiences: tuple[Experience, ...] = ()

    def remembering(self, loop: int, memory: int, rehearsed: Collection[str]) -> "Learner":
        """Return the learner with the experiences of its last loops.

        Args:
            loop: The present loop.
            memory: How many loops are remembered, the present one included.
            rehearsed: Motions whose latest experience is kept in any case.
        """
        latest = {e.motion: e for e in self.experiences if e.motion in rehearsed}
        kept = [
            e
            for e in self.experiences
            if e.loop > max(loop - memory, 0) or latest.get(e.motion) is e
        ]
        return replace(self, experiences=tuple(kept))

    def motions(self, channels: Channels, rate_hz: float) -> Motions:
        """Return the experiences as motions to train on."""
        return Motions.from_arrays(
            [e.values for e in self.experiences],
            channels,
            rate_hz,
            names=[f"{e.motion} (loop {e.loop})" for e in self.experiences],
        )

    def start_for(self, motion: Motion) -> Float[ndarray, " N"]:
        """Return where recognition of a motion begins: the latest states of the most similar one.

        The most similar known motion has the longest common beginning; without any, the state
        after babbling, or 0.
        """
        best = np.zeros(self.network.size)
        longest = -1
        for experience in self.experiences:
            common = _common_beginning(experience.motion, motion.name)
            if common >= longest:
                longest, best = common, experience.initial_state
        return best

    def grown(self, settings: NetworkSettings, key: Array) -> "Learner":
        """Return the learner with the next level opened, its initial states at 0."""
        level = settings.drawn_levels()[len(self.network.levels)]
        network = grow(
            self.network,
            level,
            key=key,
            influence=settings.influence,
            gain=settings.gain,
            scale=settings.scale,
        )
        opened = np.zeros(level.size)
        experiences = tuple(
            replace(e, initial_state=np.concatenate([e.initial_state, opened]))
            for e in self.experiences
        )
        return Learner(network, experiences)


def _common_beginning(one: str, other: str) -> int:
    """Return how many primitives two motions' names have in common from their start corner on."""
    (corner_one, _, arrows_one), (corner_other, _, arrows_other) = (
        name.partition(" ") for name in (one, other)
    )
    if corner_one != corner_other:
        return 0
    same = [a == b for a, b in zip(arrows_one, arrows_other, strict=False)]
    return 1 + (same.index(False) if False in same else len(same))
