"""What a training's numbers show, on motions and losses of which the truth is known."""

from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import MTRNN, Level, Motions, Training, split, train
from motionese.learning import Diagnosis, diagnose
from motionese.learning.diagnosis import error_left
from motionese.learning.predictability import forks, row_noise
from motionese.minimum_jerk import minimum_jerk


def motions_of(paths):
    names = [f"c{i}" for i in range(paths[0].shape[1])]
    return Motions.from_arrays(paths, names, rate_hz=20.0)


def moved(start, end, rows):
    share = minimum_jerk(np.arange(1, rows + 1) / rows)[:, None]
    return start + (end - start) * share


def switching(seed, count=12, switches=7, postures=4, rows=8):
    """Arms that hold a posture for some time and go on to another, drawn at random."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-1, 1, (postures, 3))
    paths = []
    for _ in range(count):
        now, parts = rng.integers(postures), []
        for _ in range(switches):
            following = rng.choice([p for p in range(postures) if p != now])
            parts += [np.repeat(places[now][None], rng.integers(2, 14), axis=0)]
            parts += [moved(places[now], places[following], rows)]
            now = following
        paths.append(np.concatenate(parts))
    return motions_of(paths)


def curves(count=10, rows=60, noise=0.0, seed=0):
    """Closed curves that are each another from their beginning on."""
    rng, t = np.random.default_rng(seed), np.linspace(0, 2 * np.pi, rows)
    paths = [
        np.stack([np.sin((1 + i % 3) * t + i), np.cos((1 + i % 2) * t), np.sin(2 * t + i / 2)], 1)
        for i in range(count)
    ]
    return motions_of([path + noise * rng.normal(size=path.shape) for path in paths])


def reaches(count=8, rows=50, hold=0):
    """Ways from one place to others, each of its own length, perhaps after a rest of its own."""
    home, paths = np.zeros(3), []
    for i in range(count):
        end = np.array([np.cos(i), np.sin(i), 0.5 * np.sin(2 * i)])
        rest = np.repeat(home[None], 2 + hold * i, axis=0)
        paths.append(np.concatenate([rest, moved(home, end, rows + i)]))
    return motions_of(paths)


def family(count=8, rows=50):
    """One motion in many sizes."""
    s, paths = np.linspace(0, 1, rows), []
    for reach in np.linspace(0.4, 1, count):
        turned, bent = reach * minimum_jerk(s), (1.4 - reach) * np.sin(np.pi * s) ** 2
        paths.append(np.stack([turned, bent, np.cos(turned + bent)], axis=1))
    return motions_of(paths)


def resampled(motions, factor):
    """The same motions at another rate."""
    paths = []
    for path in motions.values:
        at = np.linspace(0, len(path) - 1, round(factor * (len(path) - 1)) + 1)
        paths.append(np.stack([np.interp(at, np.arange(len(path)), c) for c in path.T], 1))
    return motions_of(paths)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("switches", [4, 7])
def test_every_switch_is_a_fork(seed, switches):
    # The first and the last way may be met by no other; two postures may lie near one another.
    assert switches - 2 <= forks(switching(seed, switches=switches)) <= switches + 1


def test_ways_of_their_own_hardly_fork():
    assert forks(curves()) < 0.5
    assert forks(reaches()) <= 1.5  # where all begin
    assert forks(reaches(hold=3)) <= 1.5  # however long they rest there
    assert forks(family()) <= 1.5
    assert forks(curves(count=1)) == 0


def test_an_order_of_two_forks_once_more():
    places = {"left": (1, 0, 0.3), "right": (-1, 0.2, 0), "up": (0, 1, 0.5), "home": (0, 0, 0)}
    at = {name: np.array(place, float) for name, place in places.items()}
    paths = [
        np.concatenate([
            part
            for there in (at[first], at[second])
            for part in (moved(at["home"], there, 15), moved(there, at["home"], 15))
        ])
        for first in ("left", "right", "up")
        for second in ("left", "right", "up")
        if first != second
    ]  # fmt: skip
    assert forks(motions_of(paths)) == pytest.approx(2, abs=0.25)


@pytest.mark.parametrize("factor", [0.5, 4])
@pytest.mark.parametrize("motions", [switching(0), curves(), reaches()], ids=["switch", "c", "r"])
def test_forks_do_not_depend_on_the_rate(motions, factor):
    assert forks(resampled(motions, factor)) == pytest.approx(forks(motions), abs=0.5)


def test_rows_that_are_not_observed_count_for_nothing():
    motions = switching(0)
    gaps = tuple(np.arange(len(v))[:, None] % 40 > 0 for v in motions.values)
    gone = replace(motions, observed=tuple(np.broadcast_to(g, (len(g), 3)) for g in gaps))
    assert forks(gone) == pytest.approx(forks(motions), abs=1.5)
    never = replace(motions, observed=tuple(np.zeros(v.shape, bool) for v in motions.values))
    assert forks(never) == 0
    assert np.isnan(row_noise(never))


@pytest.mark.parametrize("noise", [0.02, 0.1])
def test_noise_is_told_from_motion(noise):
    spans = curves(noise=noise).channels.spans
    expected = noise * np.sqrt((spans**-2.0).mean())
    assert row_noise(curves(noise=noise)) == pytest.approx(expected, rel=0.15)
    assert row_noise(curves()) < 0.002


def test_what_is_left_follows_from_the_course_of_the_loss():
    epochs = np.arange(1.0, 401)
    assert error_left(7 / epochs**2) == pytest.approx(0.5)
    assert error_left(3 + 0 * epochs) == pytest.approx(1)
    leaping = 7 / epochs**2
    leaping[350] *= 5
    assert error_left(leaping) == pytest.approx(0.5, abs=0.05)
    assert np.isnan(error_left(epochs[:20]))
    assert np.isnan(error_left(np.where(epochs == 399, np.nan, 1.0)))


def diagnosed(motions, levels, epochs, seed=0, **settings):
    learned, unseen = split(motions, seed=seed)
    io = Level(len(motions.channels), tau=2.0)
    network = MTRNN.draw([io, *levels], key=jax.random.key(seed))
    settings = Training(epochs=epochs, **settings)
    fit = train(network, learned, settings=settings, validation=unseen)
    return diagnose(fit, learned, settings.teacher_forcing)


ENOUGH, TWO = [Level(20, tau=5.0), Level(4, tau=40.0)], [Level(2, tau=5.0)]
TRUE = {
    "chance": (switching(3), ENOUGH, 200, {}, "From the same state motions go on differently"),
    "noise": (curves(noise=0.12), ENOUGH, 600, {}, "The rows themselves scatter by "),
    "forcing": (curves(), TWO, 400, {"teacher_forcing": 1.0}, "train with less teacher forcing"),
    "epochs": (family(), ENOUGH, 50, {}, "The loss still falls"),
    "units": (curves(), TWO, 600, {}, "The loss has levelled off"),
}
"""Motions, levels, epochs, further settings, and what is wrong with such a training."""


# That forks are found is tested above.
@pytest.mark.parametrize(
    "why", [pytest.param(w, marks=pytest.mark.slow) if w == "chance" else w for w in TRUE]
)
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_the_reason_is_told(why, seed):
    motions, levels, epochs, settings, told = TRUE[why]
    found = diagnosed(motions, levels, epochs, seed, **settings)

    assert told in " ".join(found.sentences()), found


def test_of_a_good_model_nothing_is_told():
    found = diagnosed(family(), ENOUGH, 600)
    assert found.sentences() == [], found


GOOD = Diagnosis(0.01, 0.01, 0.012, 0.001, 1.0, 0.5, 0.05, 1000)
TOLD = {
    "good": ({}, []),
    "seen": ({"closed": 0.05}, ["Closed-loop errors above 3%", "The loss still falls"]),
    "poor": (
        {"closed": 0.2},
        ["On a robot", "about 50% of the error: train longer, --epochs 2500"],
    ),
    "level": ({"closed": 0.2, "left": 0.95}, ["On a robot", "The loss has levelled off"]),
    "early": ({"closed": 0.2, "left": 0.95, "epochs": 100}, ["On a robot", "do not tell why"]),
    "between": ({"closed": 0.2, "left": 0.8}, ["On a robot", "The numbers do not tell why"]),
    "short": ({"closed": 0.2, "left": np.nan, "epochs": 9}, ["On a robot", "do not tell why"]),
    "held out": ({"unseen": 0.2}, ["Held-out motions are 20.0 times as far off as learned"]),
    "by heart": ({"unseen": 0.2, "forks": 7.0}, ["at best, and no others"]),
    "drift": ({"closed": 0.2, "forcing": 0.5}, ["On a robot", "less teacher forcing"]),
    "no drift": ({"closed": 0.2, "forcing": 0.1}, ["On a robot", "still falls"]),
    "noise": ({"closed": 0.05, "noise": 0.05}, ["Closed-loop errors", "scatter by 5.0%"]),
    "unknown": ({"noise": np.nan, "unseen": np.nan, "closed": 0.2}, ["On a robot", "still falls"]),
}


@pytest.mark.parametrize("case", TOLD)
def test_what_is_told_follows_from_the_numbers(case):
    numbers, told = TOLD[case]
    sentences = replace(GOOD, **numbers).sentences(before=500)

    assert len(sentences) == len(told), sentences
    assert all(part in sentence for part, sentence in zip(told, sentences, strict=True)), sentences
