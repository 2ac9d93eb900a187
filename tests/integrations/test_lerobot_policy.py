"""The policy for LeRobot, against a stand-in of LeRobot, or against it where it is installed."""

import importlib
import json
import logging
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
import pretended_lerobot
import pytest
from small_models import Clock
from typer.testing import CliRunner

from motionese.channels import Channel, Channels
from motionese.errors import ControlError, MotioneseError
from motionese.network import MTRNN, Level, write_network
from motionese.runtime import ControlLoop, Player, load

PACKAGE = "lerobot_policy_motionese"
SOURCE = Path(__file__).parents[2] / "integrations" / PACKAGE / "src"
STATE, ACTION = "observation.state", "action"
JOINTS = ("lift.pos", "turn.pos", "grip.pos")
COMMANDS = tuple(f"action.{name}" for name in JOINTS)
HERE = np.array([0.2, -10.0, 0.6])
LENGTHS = {"reach": 21, "wave": 16}
PRETENDED = find_spec("lerobot") is None


@pytest.fixture
def part(monkeypatch):
    """Return a module of the plug-in by its name."""
    if PRETENDED:
        for name, module in pretended_lerobot.modules().items():
            monkeypatch.setitem(sys.modules, name, module)
        monkeypatch.syspath_prepend(SOURCE)
        yield lambda name: importlib.import_module(f"{PACKAGE}.{name}")
        for name in [n for n in sys.modules if n.partition(".")[0] == PACKAGE]:
            del sys.modules[name]
    else:
        yield lambda name: importlib.import_module(f"{PACKAGE}.{name}")


@pytest.fixture
def tensor():
    """Return a tensor of single precision."""
    if PRETENDED:
        return pretended_lerobot.Tensor
    torch = importlib.import_module("torch")
    return lambda values: torch.tensor(values, dtype=torch.float32)


@pytest.fixture
def saved(tmp_path):
    """Return a file with a model of some channels; its motions move, apart, within the ranges."""

    def written(*channels, rate_hz=20.0, **facts):
        ends = [(-1.0, 2.0), (-90.0, 45.0), (0.0, 1.0)] * 2
        named = [Channel(n, "", *end) for n, end in zip(channels, ends, strict=False)]
        levels = [Level(len(named), 2.0), Level(12, 4.0), Level(3, 40.0)]
        network = MTRNN.draw(levels, key=jax.random.key(0), channels=Channels(named))
        rng, size = np.random.default_rng(3), network.size
        level = np.repeat([0, 1, 2], [len(named), 12, 3])
        weights = rng.normal(0.0, 0.9, (size, size)) * (abs(level[:, None] - level) <= 1)
        network = replace(
            network,
            weights=jnp.asarray(weights, jnp.float32),
            bias=jnp.asarray(-weights.sum(1) / 2, jnp.float32),
        )
        states = rng.normal(size=(2, size)).astype(np.float32)
        told = {"names": [*LENGTHS], "lengths": [*LENGTHS.values()], "rate_hz": rate_hz, **facts}
        write_network(tmp_path / "model", network, {"initial_states": states}, told)
        return tmp_path / "model"

    return written


@pytest.fixture
def dataset(tmp_path):
    """Return the folder of a LeRobotDataset with these columns, as far as it is looked at."""

    def written(state, action=None):
        def feature(names):
            return {"dtype": "float32", "shape": [len(names)], "names": {"motors": list(names)}}

        features = {} if state is None else {STATE: feature(state)}
        if action is not None:
            features[ACTION] = feature(action)
        meta = tmp_path / "dataset" / "meta"
        meta.mkdir(parents=True)
        info = {"codebase_version": "v3.0", "fps": 20, "features": features}
        (meta / "info.json").write_text(json.dumps(info))
        return meta.parent

    return written


@pytest.fixture
def policy_of(part, tmp_path):
    """Return the policy of a model's folder, with settings as --policy.NAME sets them."""

    def loaded(model, dataset=None, **settings):
        config = part("policy_folder").write(model, tmp_path / "policy", dataset)
        for name, value in settings.items():
            setattr(config, name, value)
        policy = part("modeling_motionese").MotionesePolicy
        return policy.from_pretrained(tmp_path / "policy", config=config, dataset_stats=None)

    return loaded


@pytest.fixture
def actions_of(tensor):
    """Return what a policy gives for one observation after another, [T, B, A]."""

    def given(policy, observed, task=""):
        batches = [{STATE: tensor(np.atleast_2d(row)), "task": task} for row in observed]
        return np.array([policy.select_action(batch).numpy() for batch in batches])

    return given


def generated(model, name):
    player = Player(model, model.begin(name))
    return np.array([player.row, *(player.step() for _ in range(model.lengths[name] - 1))])


def looped(model, name, readings, **settings):
    """What the control loop sends for the same readings."""
    given, sent = iter(readings), []
    loop = ControlLoop(
        model,
        lambda: dict(zip(JOINTS, next(given), strict=True)),
        lambda command: sent.append(list(command.values())),
        clock=Clock(),
        **settings,
    )
    loop.run(name)
    return np.array(sent)


def test_the_folder_holds_what_lerobot_takes(part, saved, tmp_path):
    model = saved(*JOINTS)
    part("policy_folder").write(model, tmp_path / "policy")

    folder = tmp_path / "policy"
    names = ["config.json", "model.safetensors"]
    names += ["policy_postprocessor.json", "policy_preprocessor.json"]
    assert sorted(file.name for file in folder.iterdir()) == names
    assert (folder / "model.safetensors").read_bytes() == model.read_bytes()
    config = json.loads((folder / "config.json").read_text())
    assert config["type"] == "motionese" and config["device"] == "cpu"
    assert config["input_features"] == {STATE: {"type": "STATE", "shape": [3]}}
    assert config["output_features"] == {ACTION: {"type": "ACTION", "shape": [3]}}
    assert config["state_channels"] == config["action_channels"] == list(JOINTS)


def test_nothing_is_normalised_on_the_way(part):
    module = part("processor_motionese")
    config = part("configuration_motionese").MotioneseConfig(device="cpu")
    before, behind = module.make_motionese_pre_post_processors(config, dataset_stats={})
    assert [type(step) for step in before.steps] == [
        module.RenameObservationsProcessorStep,
        module.AddBatchDimensionProcessorStep,
        module.DeviceProcessorStep,
    ]
    assert [type(step) for step in behind.steps] == [module.DeviceProcessorStep]


@pytest.mark.parametrize("share", [0.0, 0.4])
def test_a_named_motion_is_played_as_the_control_loop_plays_it(policy_of, actions_of, saved, share):
    model = load(saved(*JOINTS))
    readings = HERE + np.random.default_rng(0).normal(0, 0.02, (20, 3))
    policy = policy_of(saved(*JOINTS), motion="reach", share=share)

    actions = actions_of(policy, readings, "wave")

    assert actions.shape == (20, 1, 3)
    expected = looped(model, "reach", readings, share=share)
    np.testing.assert_allclose(actions[:, 0], expected, rtol=1e-4, atol=1e-4)
    assert np.ptp(expected, axis=0).min() > 0.01


def test_after_its_end_the_robot_keeps_still_and_reset_begins_anew(policy_of, actions_of, saved):
    policy = policy_of(saved(*JOINTS))
    actions = actions_of(policy, [HERE] * 20, "wave")
    np.testing.assert_array_equal(actions[15:], actions[[14] * 5])
    assert not np.array_equal(actions[13], actions[14])

    policy.reset()
    np.testing.assert_array_equal(actions_of(policy, [HERE] * 20, "wave"), actions)


def test_every_environment_of_a_batch_plays_its_own_motion(policy_of, actions_of, saved):
    policy = policy_of(saved(*JOINTS))
    rows = [[HERE, HERE + 0.1, HERE]] * 20
    together = actions_of(policy, rows, ["wave", "reach", "reach"])
    for place, task in enumerate(["wave", "reach", "reach"]):
        policy.reset()
        alone = actions_of(policy, [row[place] for row in rows], task)
        np.testing.assert_array_equal(together[:, place], alone[:, 0])
    with pytest.raises(ValueError, match="zip"):
        actions_of(policy, rows, ["wave"])


def test_columns_stand_as_the_dataset_has_them(policy_of, actions_of, saved, dataset):
    plain = policy_of(saved(*JOINTS))
    expected = actions_of(plain, [HERE] * 10, "reach")[:, 0]
    state = ("camera.pan", "grip.pos", "lift.pos", "turn.pos")
    folder = dataset(state, ("turn.pos", "grip.pos"))
    (saved(*JOINTS).parent / "policy").rename(folder.parent / "former")

    policy = policy_of(saved(*JOINTS), folder)
    actions = actions_of(policy, [[7.0, *HERE[[2, 0, 1]]]] * 10, "reach")[:, 0]

    assert policy.config.state_channels == list(state)
    np.testing.assert_array_equal(actions, expected[:, [1, 2]])


def test_a_recorded_action_is_that_of_the_present_row(policy_of, actions_of, saved, dataset):
    path = saved(*JOINTS, *COMMANDS)
    model = load(path)
    player = Player(model, model.begin("wave", dict(zip(JOINTS, HERE, strict=True))))
    rows = np.array([player.row, *(player.step() for _ in range(15))])

    policy = policy_of(path, dataset(JOINTS, JOINTS))
    actions = actions_of(policy, [HERE] * 18, "wave")[:, 0]

    assert policy.config.action_channels == list(COMMANDS)
    assert actions.shape == (18, 3)
    # The motion is passed into: its first action is that of its first row, its last of its last.
    np.testing.assert_allclose(actions[0], rows[0, 3:], atol=1e-5)
    np.testing.assert_allclose(actions[15], rows[15, 3:], atol=1e-5)
    np.testing.assert_array_equal(actions[15:], actions[[15] * 3])
    assert not np.array_equal(actions[14], actions[15])


def test_a_motion_is_recognised_by_where_the_robot_is(policy_of, actions_of, saved, caplog):
    path = saved(*JOINTS)
    way = generated(load(path), "wave")
    policy = policy_of(path)
    with caplog.at_level(logging.INFO):
        actions = actions_of(policy, [way[6]] * 12)[:, 0]
    assert (
        "recognised motion 'wave' in its row 6" in caplog.text and "9 steps at 20 Hz" in caplog.text
    )
    np.testing.assert_allclose(actions[8], way[15], atol=0.02 * 135)
    np.testing.assert_array_equal(actions[8:], actions[[8] * 4])


def test_with_more_to_watch_the_robot_keeps_still_for_longer(policy_of, actions_of, saved):
    path = saved(*JOINTS)
    way = generated(load(path), "wave")
    policy = policy_of(path, watch=5)
    actions = actions_of(policy, way[:12])[:, 0]
    np.testing.assert_allclose(actions[:4], way[:4], rtol=1e-5)
    np.testing.assert_allclose(actions[4:11], way[5:12], atol=0.05 * 135)


def test_what_is_none_of_the_motions_keeps_the_robot_still(policy_of, actions_of, saved, caplog):
    policy = policy_of(saved(*JOINTS))
    away = np.array([1.9, -85.0, 0.02])
    actions = actions_of(policy, [away, away + 0.01, away], "make tea")[:, 0]
    np.testing.assert_allclose(actions, [away, away + 0.01, away], rtol=1e-6)
    sentence = "is no learned motion's name; keeps still: what is observed is none of the learned"
    assert caplog.text.count(f"{sentence} motions; name one of reach, wave as") == 1


def test_where_a_motion_ends_the_robot_keeps_still(policy_of, actions_of, saved, caplog):
    path = saved(*JOINTS)
    end = generated(load(path), "wave")[-1]
    actions = actions_of(policy_of(path, watch=9), [end] * 10)[:, 0]
    np.testing.assert_allclose(actions, [end] * 10, rtol=1e-5)
    assert "where motion 'wave' ends" in caplog.text


def test_a_command_without_its_joint_cannot_keep_still(policy_of, actions_of, saved, dataset):
    path = saved(*JOINTS, "action.push")
    policy = policy_of(path, dataset(JOINTS, ("push",)))
    with pytest.raises(ControlError, match=r"'push' does not tell what keeps 'action\.push' still"):
        actions_of(policy, [[1.9, -85.0, 0.02]])
    policy.reset()
    assert actions_of(policy, [[1.9, -85.0, 0.02]], "wave").shape == (1, 1, 1)


def test_unnamed_columns_are_those_of_the_state(policy_of, actions_of, saved):
    policy = policy_of(saved("state_0", "state_1", "action_0", "action_1"))
    assert policy.config.state_channels == ["state_0", "state_1"]
    assert policy.config.action_channels == ["action_0", "action_1"]
    away = [1.9, -85.0]
    np.testing.assert_allclose(actions_of(policy, [away])[0, 0], away, rtol=1e-6)


def test_another_rate_takes_another_number_of_steps(policy_of, actions_of, saved):
    actions = actions_of(policy_of(saved(*JOINTS), rate_hz=40.0), [HERE] * 34, "wave")[:, 0]
    assert not np.array_equal(actions[28], actions[29])
    np.testing.assert_array_equal(actions[29:], actions[[29] * 5])


def test_a_chunk_is_one_action(policy_of, saved, tensor):
    policy = policy_of(saved(*JOINTS))
    batch = {STATE: tensor(np.array([HERE, HERE])), "task": "reach"}
    chunk = policy.predict_action_chunk(batch)
    policy.reset()
    np.testing.assert_array_equal(chunk.numpy()[:, 0], policy.select_action(batch).numpy())
    assert chunk.shape == (2, 1, 3)


def test_actions_stay_within_the_ranges(policy_of, actions_of, saved):
    actions = actions_of(policy_of(saved(*JOINTS)), [[2.5, -120.0, -0.2]] * 16, "wave")[:, 0]
    low, high = [-1.0, -90.0, 0.0], [2.0, 45.0, 1.0]
    np.testing.assert_array_equal(actions[0], [2.0, -90.0, 0.0])
    np.testing.assert_array_equal(actions, np.clip(actions, low, high))


def test_a_robot_in_another_unit_is_not_moved(policy_of, actions_of, saved):
    policy = policy_of(saved(*JOINTS))
    with pytest.raises(ControlError, match=r"channel 'lift\.pos' is at 57, far outside its limits"):
        actions_of(policy, [[57.0, -10.0, 0.6]], "reach")


def test_what_is_loaded_can_be_saved(policy_of, saved, tmp_path):
    policy_of(saved(*JOINTS), motion="wave").save_pretrained(tmp_path / "again")
    again = tmp_path / "again"
    assert (again / "model.safetensors").read_bytes() == saved(*JOINTS).read_bytes()
    assert json.loads((again / "config.json").read_text())["motion"] == "wave"


def test_training_is_refused(part, policy_of, saved):
    policy = policy_of(saved(*JOINTS))
    asked = (policy.get_optim_params, lambda: policy.forward({}))
    for refused in (*asked, policy.config.get_optimizer_preset):
        with pytest.raises(NotImplementedError, match="motionese train"):
            refused()


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"motion": "wafe"}, "unknown motion 'wafe'; did you mean 'wave'?"),
        ({"share": 1.5}, "the share of what is sensed must be 0 to 1"),
        ({"watch": 0}, "watch must be 1 or more, got 0"),
        ({"rate_hz": 5.0}, "can be run at 10 to 40 Hz, got 5 Hz"),
        ({"action_channels": ["lift.pos", "turn.pos", "no"]}, "action: unknown channel 'no'"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_settings_out_of_range_are_refused_when_the_policy_is_loaded(
    policy_of, saved, settings, sentence
):
    with pytest.raises(ControlError, match=sentence.replace("?", r"\?")):
        policy_of(saved(*JOINTS), **settings)


def test_other_columns_are_refused(part, policy_of, actions_of, saved):
    policy = policy_of(saved(*JOINTS))
    with pytest.raises(ControlError, match=r"3 columns.*lift\.pos.*--dataset"):
        actions_of(policy, [[0.0, 0.0]])
    policy.config.output_features[ACTION].shape = (2,)
    with pytest.raises(ValueError, match="action has 2 columns, the policy's model 3"):
        policy.config.validate_features()
    with pytest.raises(ValueError, match=r"without a model.*motionese train"):
        part("configuration_motionese").MotioneseConfig(device="cpu").validate_features()


def test_a_policy_without_its_model_says_so(part, policy_of, saved, actions_of):
    config = policy_of(saved(*JOINTS)).config
    policy = part("modeling_motionese").MotionesePolicy(config)
    policy.reset()
    with pytest.raises(ControlError, match="without a model"):
        actions_of(policy, [HERE])


def test_a_prediction_that_is_not_finite_is_not_sent(policy_of, actions_of, saved, monkeypatch):
    policy = policy_of(saved(*JOINTS))
    monkeypatch.setattr(Player, "finite", False)
    with pytest.raises(ControlError, match="not finite"):
        actions_of(policy, [HERE], "wave")


@pytest.mark.parametrize(
    ("state", "action", "sentence"),
    [
        (("a", "b"), ("a", "b"), r"no column of its observation\.state \(a, b\) is a channel"),
        (None, ("a",), r"no column of its observation\.state \(\)"),
        (JOINTS, ("lift.pos", "wrist"), "no channel for the action's column 'wrist'"),
    ],
)
def test_a_dataset_of_another_robot_is_refused(
    part, saved, dataset, tmp_path, state, action, sentence
):
    model, folder = saved(*JOINTS), dataset(state, action)
    with pytest.raises(MotioneseError, match=sentence):
        part("policy_folder").write(model, tmp_path / "policy", folder)
    assert not (tmp_path / "policy").exists()


def test_the_command_writes_and_tells(part, saved, dataset, tmp_path):
    typer, module = importlib.import_module("typer"), part("__main__")
    app = typer.Typer()
    app.command()(module.command)
    model, folder = str(saved(*JOINTS, "force")), str(tmp_path / "policy")
    told = dataset(("pan", *JOINTS), JOINTS[:2])

    ran = CliRunner().invoke(app, [model, folder, "--dataset", str(told)])

    assert ran.exit_code == 0, ran.output
    for sentence in (
        "observation.state: pan, lift.pos, turn.pos, grip.pos",
        "action: lift.pos, turn.pos",
        "Neither observed nor acted, but predicted: force",
        "Observed, but not known to the model and passed over: pan",
        "--policy.motion or --task: reach, wave",
        "Run it at 20 Hz",
    ):
        assert sentence in ran.output
    again = CliRunner().invoke(app, [model, folder])
    assert again.exit_code == 2 and "exists already" in again.output
    assert not isinstance(again.exception, MotioneseError)


def test_lerobot_finds_the_plug_in_by_its_names(part):
    config = part("configuration_motionese").MotioneseConfig
    policy = part("modeling_motionese").MotionesePolicy
    assert policy.config_class is config and policy.name == "motionese"
    assert config(device="cpu").type == "motionese"
    assert f'name = "{PACKAGE}"' in (SOURCE.parent / "pyproject.toml").read_text()


def test_a_model_that_cannot_be_played_gets_no_folder(part, saved, tmp_path):
    with pytest.raises(ControlError, match="how long its motions are"):
        part("policy_folder").write(saved(*JOINTS, lengths=None), tmp_path / "policy")
    assert not (tmp_path / "policy").exists()
