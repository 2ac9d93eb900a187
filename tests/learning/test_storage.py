"""A fit on disk: the same bits come back, and generate the same motions."""

import equinox as eqx
import numpy as np
import pytest
from small_models import nothing_learned

from motionese import generate, load, save
from motionese.errors import SettingError, StorageError
from motionese.learning import read_fit, recognise, write_fit
from motionese.network import read_network, write_network

PARTS = (
    "initial_states",
    "losses",
    "validation_losses",
    "teacher_forced_error",
    "closed_loop_error",
    "validation_error",
)
FACTS = ("names", "lengths", "rate_hz", "validation_names", "status")


@pytest.fixture
def path(tmp_path, fit):
    save(tmp_path / "robot.safetensors", fit)
    return tmp_path / "robot.safetensors"


def test_the_same_bits_come_back(path, fit):
    loaded = load(str(path))

    assert bool(eqx.tree_equal(loaded.network, fit.network))
    for fact in FACTS:
        assert getattr(loaded, fact) == getattr(fit, fact)
    for part in PARTS:
        np.testing.assert_array_equal(getattr(loaded, part), getattr(fit, part))
        assert getattr(loaded, part).dtype == getattr(fit, part).dtype
    before, after = (generate(f.network, f.initial_states, 20) for f in (fit, loaded))
    np.testing.assert_array_equal(after, before)


def test_saving_again_writes_the_same_bytes(path, tmp_path):
    save(tmp_path / "again", load(path))

    assert (tmp_path / "again").read_bytes() == path.read_bytes()


def test_a_fit_cut_short_is_refused(path):
    whole = path.read_bytes()
    for share in (0.1, 0.5, 0.99):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(StorageError, match="perhaps cut short"):
            load(path)


@pytest.mark.parametrize("part", [*PARTS, *FACTS, "sentence"])
def test_a_network_without_a_whole_fit_is_refused(path, part):
    network, arrays, facts = read_network(path)
    arrays.pop(part, None)
    facts.pop(part, None)
    write_network(path, network, arrays, facts)

    with pytest.raises(StorageError, match=f"a network without a fit; {part} missing"):
        load(path)


def test_states_and_status_of_no_fit_are_refused(path):
    network, arrays, facts = read_network(path)
    write_network(path, network, arrays | {"initial_states": np.zeros((3, 16))}, facts)
    with pytest.raises(StorageError, match=r"must have shape \(3, 17\), got \(3, 16\)"):
        load(path)

    write_network(path, network, arrays, facts | {"status": "stoped"})
    with pytest.raises(StorageError, match=r"unknown status 'stoped'; did you mean 'stopped'\?"):
        load(path)


def test_further_arrays_and_facts_go_with_a_fit_and_are_in_nobody_s_way(path, fit):
    arrays = {"losses": np.arange(3.0), "values.0": np.ones((2, 3), np.float32)}
    facts = {"names": ["other"], "loop": 3, "rows": [{"error": 0.1}]}
    plain = path.read_bytes()

    write_fit(path, fit, arrays, facts)
    read, got_arrays, got_facts = read_fit(path)

    assert got_facts == facts
    assert set(got_arrays) == set(arrays)
    for name, value in arrays.items():
        np.testing.assert_array_equal(got_arrays[name], value)
        assert got_arrays[name].dtype == value.dtype
    np.testing.assert_array_equal(read.losses, fit.losses)
    save(path, load(path))
    assert path.read_bytes() == plain


def test_a_robot_that_has_learned_nothing_yet_is_written_and_read(path, fit, motions):
    write_fit(path, nothing_learned(fit), {}, {"loop": 0})
    read, _, facts = read_fit(path)

    assert (read.names, read.lengths, facts) == ((), (), {"loop": 0})
    assert read.initial_states.shape == (0, fit.network.size)
    assert bool(eqx.tree_equal(read.network, fit.network))
    with pytest.raises(SettingError, match="the model has learned no motion yet"):
        read.index("a")
    found, alone = (recognise(m, motions[0]) for m in (read, read.network))
    np.testing.assert_array_equal(found.initial_state, alone.initial_state)


def test_a_checkpoint_of_an_experiment_before_is_refused_by_name(path, fit):
    write_network(path, fit.network, {"values.0": np.ones((4, 3))}, {"experiences": [], "loop": 1})

    with pytest.raises(StorageError, match="a checkpoint of an experiment made by"):
        load(path)
