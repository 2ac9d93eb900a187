"""What a robot expects of its imitations, and whether that is right."""

import numpy as np
import pytest
from hands import straying

from motionese.experiment import condition_named, go_through, read_settings
from motionese.experiment.learned_robot import robot_of
from motionese.experiment.run_folder import open_run_folder
from motionese.imitation import Scene, Watched, babbled, newborn
from motionese.learning import generate
from motionese.teaching.claim import claim_on
from motionese.teaching.forward_model import ForwardModel
from motionese.teaching.recogniser import Recogniser
from motionese.teaching.session import Teaching
from motionese.teaching.view import hand_seen

SEEDS = (20, 21)
SHORT = ("stages.0.until.loops=12", "stages.1.until.loops=3")


def test_the_own_hand_is_expected_where_commands_have_brought_it(scene, fresh):
    lived = [scene.babble(index) for index in range(12)]
    learner, start = fresh, np.zeros(fresh.network.size)
    for done in lived[:-2]:
        learner = learner.experiencing(0, "babbling", done.experience(True), start)
    model = ForwardModel(scene, learner.experiences)
    for done in lived:
        apart = 100 * np.linalg.norm(model.hand(done.commanded) - done.path, axis=1)
        assert apart.mean() < 3, "cm, of movements through all that the arm reaches"


def test_what_was_not_seen_is_not_learned_from(scene, fresh):
    values, start = scene.babble(0).experience(True), np.zeros(fresh.network.size)
    blind = values.copy()
    blind[3:6] = np.nan
    for each in (values, blind):
        learner = fresh.experiencing(0, "babbling", each, start)
        hand = ForwardModel(scene, learner.experiences).hand(values[:, scene.joints])
        assert np.isfinite(hand).all()


def test_the_rest_of_what_was_learned_is_foretold(scene, fresh):
    rng, learner = np.random.default_rng(3), fresh
    for motion in ("UR ↓", "UR ←", "UL ↓"):
        state = rng.normal(0, 3, fresh.network.size)
        learner = learner.experiencing(1, motion, generate(fresh.network, state, 28), state)
    recogniser = Recogniser(scene, learner)
    for each in learner.experiences:
        watched = Watched(each.values, hand_seen(scene.body, each.values), (0,))
        claim = claim_on(watched, None, recogniser, recogniser.at_the_end(watched))
        assert claim.foretold_cm < 2 and np.isfinite(claim.expected_cm)
        rest = recogniser.foretold(watched, 14)[14:]
        assert 100 * np.linalg.norm(rest - watched.path[14:], axis=1).mean() < 2
        assert claim.like and claim.apart >= 0


def asked(scene, learner):
    """Whether the robot claims to be able to do a motion, and whether it can, for each."""
    rng, caregiver = np.random.default_rng(scene.seed), scene.caregiver()
    for sequence in (s for length in (1, 2) for s in scene.task.sequences(length)):
        way = caregiver.demonstrate(sequence, rng).path
        teaching = Teaching(scene, learner)
        shown = teaching.show(scene.body.reachable(straying(way, rng, 1.0)), "drawn")
        yield shown.verdict.claim.made, teaching.imitate().result.good


@pytest.mark.slow
def test_a_newborn_claims_nothing_and_a_trained_robot_is_right(tmp_path):
    settings, found = read_settings("order", SHORT), []
    with open_run_folder(tmp_path, settings, "order") as folder:
        for seed in SEEDS:
            run = folder.run(condition_named("TD/MD", settings.factors), seed)
            go_through(run, settings, lambda *told: None)
            scene = Scene(settings, seed)
            assert not any(made for made, _ in asked(scene, babbled(scene, newborn(scene, 2))))
            found += asked(scene, robot_of(run.folder).learner)
    right = [can for made, can in found if made]
    # How many of many claims are right is measured by benchmarks/claims.py; these are a dozen.
    assert right and right.count(True) >= 0.75 * len(right)
