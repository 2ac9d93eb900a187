"""Channels of two values are held at them by whatever generates: the library and the runtime."""

from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import (
    MTRNN,
    Channel,
    Channels,
    Level,
    Motions,
    generate,
    generate_sequence,
    save,
    train,
)
from motionese import load as load_fit
from motionese.errors import ChannelError
from motionese.learning import runtime_model
from motionese.runtime import Player, load


@pytest.fixture(scope="module")
def fit(tmp_path_factory):
    """A network that learned a joint and a gripper of 2 and 5."""
    folder = tmp_path_factory.mktemp("gripper")
    rows = ["episode,time,joint,gripper"]
    for episode in range(3):
        for row in range(20):
            rows.append(f"{episode},{row / 10},{np.sin(row / 6 + episode)},{2 if row < 9 else 5}")
    (folder / "demos.csv").write_text("\n".join(rows))
    motions = Motions.read(folder / "demos.csv", binary=["grip*"])
    motions.write(folder / "demos.npz")
    assert Motions.read(folder / "demos.npz").channels == motions.channels
    network = MTRNN.draw([Level(2, 2.0), Level(12, 4.0)], key=jax.random.key(0))
    save(folder / "model.safetensors", train(network, motions, epochs=200))
    return folder / "model.safetensors"


def test_what_is_generated_is_held_at_the_two_values(fit):
    found = load_fit(fit)
    gripper = found.network.channels[1]
    assert gripper.binary == (2.0, 5.0)

    path = generate(found.network, found.initial_states[0], 20)
    both = generate_sequence(found.network, found.initial_states[:2], [20, 20])

    assert set(path[:, 1]) | set(both[:, 1]) <= {2.0, 5.0}
    free = Channels([replace(c, binary=None) for c in found.network.channels])
    loose = generate(replace(found.network, channels=free), found.initial_states[0], 20)
    np.testing.assert_array_equal(path[:, 1], np.where(loose[:, 1] > 3.5, 5.0, 2.0))
    np.testing.assert_array_equal(path[:, 0], loose[:, 0])


def test_the_runtime_holds_them_as_the_library_does(fit):
    found, model = load_fit(fit), load(fit)
    np.testing.assert_array_equal(model.binary, [[np.nan, np.nan], [2.0, 5.0]])
    np.testing.assert_array_equal(runtime_model(found).binary, model.binary)
    path = generate(found.network, found.initial_states[1], 20)
    player = Player(model, model.begin("1"))

    rows = np.array([player.row, *(player.step() for _ in range(19))])

    np.testing.assert_array_equal(rows[:, 1], path[:, 1])
    np.testing.assert_allclose(rows[:, 0], path[:, 0], atol=1e-5)


@pytest.mark.parametrize("two", [(1.0, 0.0), (0.5, 0.5), (-1.0, 1.0)])
def test_two_values_rise_within_the_range(two):
    with pytest.raises(ChannelError, match="its two values must rise within its range"):
        Channel("gripper", "", -0.1, 1.1, two)
