"""The robot of a run folder, to be taught on."""

import numpy as np
import pytest
from invented_runs import condition, write_run

from motionese.errors import RunFolderError
from motionese.experiment import condition_named, go_through
from motionese.experiment.learned_robot import robot_of
from motionese.experiment.run_folder import open_run_folder
from motionese.imitation import read_learner


@pytest.fixture(scope="module")
def folder(tmp_path_factory, small_settings):
    """A run folder with two runs that have gone through a loop."""
    path = tmp_path_factory.mktemp("runs")

    def stop(loop):
        raise KeyboardInterrupt

    with open_run_folder(path, small_settings, "default") as opened:
        for name, seed in (("TD/MD", 5), ("TND/MD", 7)):
            run = opened.run(condition_named(name, small_settings.factors), seed)
            with pytest.raises(KeyboardInterrupt):
                go_through(run, small_settings, stop)
    return path


@pytest.mark.slow
@pytest.mark.parametrize("asked", ["TD-MD/seed-5", "TD-MD/5", "TD/MD/5", "td-md", "TD-MD"])
def test_a_run_is_asked_for_by_condition_and_seed(folder, small_settings, asked):
    robot = robot_of(folder / asked)
    assert robot.seed == 5 and robot.settings == small_settings
    written = read_learner(folder / "TD-MD" / "seed-5" / "loop-01.safetensors")[0]
    np.testing.assert_array_equal(robot.learner.network.weights, written.network.weights)
    assert [e.name for e in robot.learner.experiences] == [e.name for e in written.experiences]


@pytest.mark.slow
def test_of_a_whole_folder_the_latest_robot_is_taken(folder):
    assert robot_of(folder).seed == 7


@pytest.mark.parametrize(
    ("asked", "said"),
    [("TD-MD/seed-6", "no run of this name"), ("../nowhere", "no run folder")],
)
def test_what_is_not_there_is_told(tmp_path, asked, said):
    write_run(tmp_path, condition("TD/MD"), 5, end="unfinished")
    with pytest.raises(RunFolderError, match=said):
        robot_of(tmp_path / asked)
