"""Settings: read from presets and files, overridden by name, refused with the nearest name."""

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.body.actroid import Actroid
from motionese.errors import MotioneseError, SettingError
from motionese.experiment.presets import PRESETS, differences, preset_text, read_settings


def test_the_default_preset_gives_every_setting():
    table = tomllib.loads(preset_text("default"))
    dumped = read_settings().model_dump(mode="json")
    given = {path for path, _ in flat(table)}
    optional = {"task.places", "network.levels.io.size", "recognition.levels"} | {
        path
        for path, _ in flat(dumped)
        if path.startswith(("evaluation.recognition.", "evaluation.repertoire."))
        or path.endswith((".caregiver", ".in_all", ".least", ".settled", ".mastered", ".emerged"))
        or path.startswith(("opens", "stages.0.choosing.", "stages.1.choosing."))
    }
    assert {path for path, _ in flat(dumped)} - given - optional == set()


def flat(table, prefix=""):
    if isinstance(table, list) and table and isinstance(table[0], dict):
        table = {str(i): each for i, each in enumerate(table)}
    if isinstance(table, dict) and (table or not prefix):
        for name, value in table.items():
            yield from flat(value, f"{prefix}.{name}" if prefix else name)
    else:
        yield prefix, table


def test_the_paper_preset_is_the_paper_where_it_speaks():
    paper, default = read_settings("paper"), read_settings("default")
    assert not paper.network.learned_bias
    assert paper.network.initial_io == "zero"
    assert paper.training.optimiser == "descent"
    assert paper.imitation.memory == 1
    assert not paper.imitation.efference_copy
    assert not any(paper.training.noise.values())
    assert paper.network.levels == default.network.levels
    sizes = [(level.size, level.tau) for level in paper.network.drawn_levels(Actroid.channels)]
    assert sizes == [(6, 2.0), (40, 5.0), (2, 70.0)]


@pytest.mark.parametrize("preset", PRESETS)
@pytest.mark.parametrize("quick", [False, True])
def test_presets_are_valid_and_hold_what_their_files_say(preset, quick):
    settings = read_settings(preset, quick=quick).model_dump(mode="json")
    text = tomllib.loads(preset_text("quick" if quick else preset))
    told = dict(flat(text))
    held = dict(flat(settings))
    assert {path: held[path] for path in told} == told


def test_evaluation_recognises_as_learning_does_but_for_what_it_says():
    settings = read_settings(overrides=["recognition.rate=0.07", "recognition.starts=5"])
    assert settings.evaluation.recognition.rate == 0.07
    assert settings.evaluation.recognition.iterations != settings.recognition.iterations
    own = read_settings(overrides=["evaluation.recognition.starts=9"])
    assert (own.evaluation.recognition.starts, own.recognition.starts) == (9, 0)


def test_a_file_is_laid_over_the_default(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("[network]\ngain = 3.0\n\n[task.places]\nUR = [0.5, -0.3, 1.05]\n")
    settings = read_settings(str(path))
    assert (settings.network.gain, settings.network.influence) == (3.0, 0.5)
    assert list(settings.network.levels) == ["io", "cf", "cs"]
    assert settings.task.places == {"UR": (0.5, -0.3, 1.05)}


@pytest.mark.parametrize(
    ("override", "told"),
    [
        ("network.levels.sc.tau=40", "did you mean 'network.levels.cs'?"),
        ("trainning.epochs=3", "unknown setting 'trainning'; did you mean 'training'?"),
        ("training.epoch=3", "did you mean 'training.epochs'?"),
        ("training.epochs.more=3", "unknown setting 'training.epochs.more'"),
        ("training.bound.cff=3", "did you mean 'cf'?"),
        ("training=3", "is a group of settings"),
        ("training.epochs", "--set takes name=value"),
        ("network.levels.cs.tau=0.5", "network.levels.cs.tau = 0.5: input should be greater"),
        ("network.levels.cs.tau=nan", "network.levels.cs.tau = nan"),
        ("network.levels.cs.size=0", "network.levels.cs.size = 0"),
        ("training.optimiser=sgd", "training.optimiser = 'sgd'"),
        ("training.epochs=many", "training.epochs = 'many'"),
        ("body.stiffness=2", "body.stiffness = 2"),
        ("body.rate_hz=7", "body.rate_hz = 7"),
        ("training.noise.cf=-1", "training.noise.cf = -1"),
    ],
)
def test_wrong_settings_are_named(override, told):
    with pytest.raises(SettingError) as error:
        read_settings(overrides=[override])
    assert told in str(error.value)
    assert "\n" not in str(error.value)


def test_by_level_settings_can_be_set_one_by_one():
    settings = read_settings(overrides=["training.noise.cs=0.1", "recognition.bound.cf=20"])
    assert settings.training.noise == {"cf": 0.2, "cs": 0.1}
    assert settings.recognition.bound == {"cf": 20.0, "cs": 5.0}


@pytest.mark.parametrize(
    ("text", "error", "told"),
    [
        ("[training", SettingError, "not a TOML file"),
        ("[training]\nepoch = 3", SettingError, "did you mean 'training.epochs'?"),
        ("[task]\nname = 'shape'", SettingError, "did you mean 'shapes'?"),
        ("[task.places]\nUX = [1.0, 2.0, 3.0]", SettingError, "unknown place 'UX'"),
        ("[body]\nname = 'actroit'", SettingError, "body.name = 'actroit'"),
        ("[network]\nlevels = 3", SettingError, "network.levels = 3"),
        ("recognition = 5", SettingError, "setting recognition = 5"),
        ("evaluation = 5", SettingError, "setting evaluation = 5"),
        ("[evaluation]\nrecognition = 5", SettingError, "setting evaluation.recognition = 5"),
        ("[training]\nbound = -1", SettingError, "setting training.bound = -1"),
    ],
)
def test_wrong_files_are_told(tmp_path, text, error, told):
    path = tmp_path / "mine.toml"
    path.write_text(text)
    with pytest.raises(error) as raised:
        read_settings(str(path))
    assert told in str(raised.value)


def test_a_file_s_levels_are_all_there_are(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        "[network.levels]\nio = { size = 6, tau = 2.0 }\ncf = { size = 30, tau = 4.0 }\n"
        "[training]\nbound = 5.0\n[recognition]\nbound = 100.0\n"
        '[[stages]]\nlesson = "primitives"\nlevels = ["io", "cf"]\nuntil = { loops = 2 }\n'
    )
    settings = read_settings(str(path))
    assert list(settings.network.levels) == ["io", "cf"]
    assert settings.training.shared == {}, "the top level's states belong to single motions"
    path.write_text(
        "[network.levels]\ncf = { size = 9, tau = 4.0 }\ncs = { size = 2, tau = 9.0 }\n"
    )
    with pytest.raises(SettingError, match="all levels must be listed, from io upwards"):
        read_settings(str(path))


def test_a_preset_that_does_not_exist_is_told():
    with pytest.raises(SettingError, match="unknown preset 'papper'; did you mean 'paper'"):
        read_settings("papper")


@given(st.text(max_size=40))
def test_no_override_ends_in_anything_but_a_sentence(text):
    try:
        read_settings(overrides=[text])
    except MotioneseError as error:
        assert str(error)


@given(st.text(max_size=30).filter(lambda t: "\n" not in t))
def test_no_value_ends_in_anything_but_a_sentence(text):
    try:
        read_settings(overrides=[f"training.epochs={text}"])
    except MotioneseError as error:
        assert str(error)


def test_differences_are_told_by_name():
    one = read_settings().model_dump(mode="json")
    other = read_settings(overrides=["network.levels.cs.tau=40"]).model_dump(mode="json")
    assert differences(one, other) == ["network.levels.cs.tau: 70.0 → 40.0"]
    assert differences(one, one) == []
