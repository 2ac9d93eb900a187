"""A training that was interrupted goes on to the same bits, and only where it was begun."""

from dataclasses import replace
from importlib import import_module
from itertools import count

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, save, train
from motionese.errors import StorageError
from motionese.learning import Ending
from motionese.learning.training import trainer

LEVELS = [Level(3, 2.0), Level(5, 5.0), Level(2, 70.0)]
CHOSEN = Training(epochs=400)
training = import_module("motionese.learning.training.train")
ARRAYS = (
    "initial_states",
    "losses",
    "validation_losses",
    "teacher_forced_error",
    "closed_loop_error",
    "validation_error",
)


@pytest.fixture(scope="module")
def small():
    return MTRNN.draw(LEVELS, key=jax.random.key(0))


def same(one, other):
    """Whether two fits are equal bit by bit."""
    return (
        all(np.array_equal(getattr(one, name), getattr(other, name)) for name in ARRAYS)
        and np.array_equal(one.network.weights, other.network.weights)
        and np.array_equal(one.network.bias, other.network.bias)
        and one.status == other.status
    )


def interrupting(after):
    """What is called between chunks: Ctrl-C comes after so many."""
    calls = count(1)

    def progress(_):
        if next(calls) == after:
            raise KeyboardInterrupt

    return progress


def interrupted(path, *arguments, after=2, **given):
    """Train until Ctrl-C; the checkpoint is left."""
    with pytest.raises(KeyboardInterrupt):
        train(*arguments, progress=interrupting(after), checkpoint=path, **given)
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("settings", "held_out"),
    [
        ({"noise": {"cf": 0.2}, "optimiser": "momentum", "weight_rate": 0.01}, False),
        ({"patience": 200, "tolerance": 0.01, "schedule": "constant"}, True),
    ],
)
def test_an_interrupted_training_ends_with_the_same_bits(
    small, motions, tmp_path, settings, held_out
):
    unlike = Motions.from_arrays([motions.values[0] * (1, 1, -1)], motions.channels, 10.0)
    given = {
        "settings": CHOSEN.model_copy(update=settings),
        "key": jax.random.key(3),
        "validation": unlike if held_out else None,
    }
    learned, path = motions.chosen([0, 1]), tmp_path / "checkpoint"
    whole = train(small, learned, **given)
    assert len(whole.losses) == 400
    assert not held_out or whole.validation_losses.argmin() == 1, "the best came before the break"

    interrupted(path, small, learned, after=1, **given)
    interrupted(path, small, learned, after=2, **given)
    calls = []
    resumed = train(small, learned, checkpoint=path, progress=calls.append, **given)

    assert same(resumed, whole)
    assert calls[0].epoch == 400, "three chunks were done before"

    def told(now):
        raise AssertionError("nothing is left to do")

    assert same(train(small, learned, checkpoint=path, progress=told, **given), whole)


def test_a_training_interrupted_after_its_last_epoch_has_nothing_left_to_do(
    small, motions, tmp_path
):
    path = interrupted(
        tmp_path / "checkpoint", small, motions.chosen([0, 1]), after=4, settings=CHOSEN
    )
    calls = []

    resumed = train(
        small, motions.chosen([0, 1]), settings=CHOSEN, checkpoint=path, progress=calls.append
    )

    assert calls == []
    assert same(resumed, train(small, motions.chosen([0, 1]), settings=CHOSEN))


def test_a_training_interrupted_while_it_is_judged_has_nothing_left_to_do(
    small, motions, tmp_path, monkeypatch
):
    path, learned = tmp_path / "checkpoint", motions.chosen([0, 1])

    def pressed(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(trainer.Trainer, "fit", pressed)
        with pytest.raises(KeyboardInterrupt):
            train(small, learned, settings=CHOSEN, checkpoint=path)
    calls = []
    resumed = train(small, learned, settings=CHOSEN, checkpoint=path, progress=calls.append)

    assert calls == []
    assert same(resumed, train(small, learned, settings=CHOSEN))


def test_a_checkpoint_is_written_meanwhile_for_those_who_are_killed(
    small, motions, tmp_path, monkeypatch
):
    monkeypatch.setattr(training, "CHECKPOINT_EVERY_S", 0.0)
    path, told = tmp_path / "checkpoint", []

    def progress(now):
        told.append(path.exists())
        if now.epoch == 300:
            raise SystemExit

    with pytest.raises(SystemExit):
        train(small, motions.chosen([0, 1]), settings=CHOSEN, checkpoint=path, progress=progress)
    resumed = train(small, motions.chosen([0, 1]), settings=CHOSEN, checkpoint=path)

    assert told == [False, True, True]
    assert same(resumed, train(small, motions.chosen([0, 1]), settings=CHOSEN))


def test_what_diverged_is_never_gone_on_from(tmp_path, monkeypatch):
    monkeypatch.setattr(training, "CHECKPOINT_EVERY_S", 0.0)
    written = []
    monkeypatch.setattr(trainer.TrainingState, "write", lambda *_: written.append(1))
    net = MTRNN.draw([Level(1, 2.0), Level(1, 1.0)], key=jax.random.key(0))
    net = replace(net, weights=jnp.array([[0.0, 1.0], [0.0, 1e6]]), bias=jnp.array([0.0, -5e5]))
    path = np.linspace(0.0, 1.0, 12)[:, None]
    motions = Motions.from_arrays([path], Channels([Channel("x", "", 0.0, 1.0)]), 10.0)

    fit = train(
        net,
        motions,
        settings=Training(epochs=5, weight_rate=10.0, clip=0.0),
        checkpoint=tmp_path / "checkpoint",
    )

    assert fit.status.ending is Ending.DIVERGED
    assert not written


@pytest.fixture(scope="module")
def left(small, motions, tmp_path_factory):
    """The bytes of a checkpoint."""
    path = tmp_path_factory.mktemp("left") / "checkpoint"
    given = {"settings": CHOSEN, "validation": motions[2]}
    return interrupted(path, small, motions.chosen([0, 1]), **given).read_bytes()


def shifted(motions):
    """The same motions, one value of one of them a little elsewhere."""
    values = [v.copy() for v in motions.values]
    values[0][5, 1] += 0.01
    return replace(motions, values=tuple(values))


def masked(motions):
    """The same motions, one value not observed."""
    observed = [m.copy() for m in motions.observed]
    observed[1][7, 2] = False
    return replace(motions, observed=tuple(observed))


OTHERS = {
    "epochs": ("settings", {"epochs": 500}),
    "rate": ("settings", {"settings": CHOSEN.model_copy(update={"weight_rate": 0.04})}),
    "key": ("settings", {"key": jax.random.key(8)}),
    "values": ("motions", {"motions": lambda motions: shifted(motions.chosen([0, 1]))}),
    "mask": ("motions", {"motions": lambda motions: masked(motions.chosen([0, 1]))}),
    "order": ("motions", {"motions": lambda motions: motions.chosen([1, 0])}),
    "one more": ("motions", {"motions": lambda motions: motions}),
    "held out": ("motions", {"validation": lambda motions: motions[0]}),
    "none held out": ("motions", {"validation": lambda motions: None}),
    "weights": ("networks", {"network": MTRNN.draw(LEVELS, key=jax.random.key(1))}),
    "time constants": (
        "networks",
        {"network": MTRNN.draw([LEVELS[0], Level(5, 6.0), LEVELS[2]], key=jax.random.key(0))},
    ),
    "initial_io": (
        "networks",
        {"network": MTRNN.draw(LEVELS, key=jax.random.key(0), initial_io="zero")},
    ),
    "bias": (
        "networks",
        {"network": MTRNN.draw(LEVELS, key=jax.random.key(0), learned_bias=False)},
    ),
    "begin": ("networks", {"initial_states": np.ones((2, 10))}),
    "groups": ("shared initial states", {"shared": {"cf": "aa"}}),
}


@pytest.mark.parametrize("other", OTHERS)
def test_a_checkpoint_of_another_training_is_refused(small, motions, tmp_path, left, other):
    (tmp_path / "checkpoint").write_bytes(left)
    part, changes = OTHERS[other]
    given = {
        "network": small,
        "motions": lambda motions: motions.chosen([0, 1]),
        "validation": lambda motions: motions[2],
        "settings": CHOSEN,
        **changes,
    }
    for name in ("motions", "validation"):
        given[name] = given[name](motions)

    with pytest.raises(
        StorageError, match=f"checkpoint: this training was begun with other {part};"
    ):
        train(**given, checkpoint=tmp_path / "checkpoint")
    assert (tmp_path / "checkpoint").read_bytes() == left, "nothing is lost"


def test_a_damaged_or_foreign_checkpoint_is_refused(small, motions, fit, tmp_path, left):
    path = tmp_path / "checkpoint"
    given = {"settings": CHOSEN, "validation": motions[2], "checkpoint": path}
    for share in (0.0, 0.1, 0.5, 0.99):
        path.write_bytes(left[: int(share * len(left))])
        with pytest.raises(StorageError, match="not a readable checkpoint, perhaps cut short"):
            train(small, motions.chosen([0, 1]), **given)
    path.write_text("epoch,loss\n1,2.0\n")
    with pytest.raises(StorageError, match="not a readable checkpoint"):
        train(small, motions.chosen([0, 1]), **given)
    save(path, fit)
    with pytest.raises(StorageError, match="not a checkpoint of training that this version reads"):
        train(small, motions.chosen([0, 1]), **given)


def test_a_checkpoint_of_a_newer_version_is_refused(small, motions, tmp_path, left, monkeypatch):
    (tmp_path / "checkpoint").write_bytes(left)
    monkeypatch.setattr("motionese.learning.training.training_state.VERSION", "0")

    with pytest.raises(StorageError, match="not a checkpoint of training that this version reads"):
        train(
            small,
            motions.chosen([0, 1]),
            settings=CHOSEN,
            validation=motions[2],
            checkpoint=tmp_path / "checkpoint",
        )
