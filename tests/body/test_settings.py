import pytest
from pydantic import ValidationError

from motionese.body import BodySettings


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
        BodySettings(**{field: value})


@pytest.mark.parametrize("rate_hz", [1, 2, 4, 5, 10, 20])
def test_rates_that_hold_whole_pictures(rate_hz):
    assert BodySettings(rate_hz=rate_hz).rate_hz == rate_hz


def test_settings_cannot_be_changed_afterwards():
    with pytest.raises(ValidationError):
        BodySettings().stiffness = 20.0
