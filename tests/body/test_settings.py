import pytest
from pydantic import TypeAdapter, ValidationError

from motionese.body import BODIES, BodySettings
from motionese.body.actroid import ActroidSettings


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("rate_hz", 0.0),
        ("rate_hz", 7.0),
        ("rate_hz", 40.0),
        ("stiffness", 14.0),
        ("stiffness", 81.0),
        ("stiffness", float("nan")),
        ("vision", "camera"),
        ("pixel_noise", -0.1),
        ("stifness", 30.0),
    ],
)
def test_wrong_settings_are_refused(field, value):
    with pytest.raises(ValidationError, match=field):
        ActroidSettings(**{field: value})


@pytest.mark.parametrize("rate_hz", [1, 2, 4, 5, 10, 20])
def test_rates_that_hold_whole_pictures(rate_hz):
    assert ActroidSettings(rate_hz=rate_hz).rate_hz == rate_hz


def test_settings_cannot_be_changed_afterwards():
    with pytest.raises(ValidationError):
        ActroidSettings().stiffness = 20.0


@pytest.mark.parametrize("name", BODIES)
def test_the_name_says_whose_settings_they_are(name):
    read = TypeAdapter(BodySettings).validate_python({"name": name, "rate_hz": 5})
    assert read == BODIES[name][0](rate_hz=5)


def test_settings_of_another_robot_are_refused():
    with pytest.raises(ValidationError, match="stiffness"):
        TypeAdapter(BodySettings).validate_python({"name": "desk_arm", "stiffness": 30.0})
