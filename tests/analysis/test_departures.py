"""The list of departures: read whole, and naming settings that exist."""

import re
from importlib import resources

import pytest

from motionese.analysis.mochizuki2013 import departures
from motionese.experiment import read_settings

TEXT = resources.files("motionese.analysis.mochizuki2013").joinpath("departures.md").read_text()
NAMED = re.findall(r"`([a-z_]+\.[a-z_.]+)(?: = ([^`]+))?`", TEXT)


def test_every_line_is_read():
    found = departures()
    assert len(found) == TEXT.count("\n- ")
    assert {each.heading for each in found} >= {"Network", "Learning"}
    assert all(each.what.endswith(".") and len(each.why) > 20 for each in found)
    assert not any("`" in each.why or "*" in each.what for each in found)


@pytest.mark.parametrize(("name", "value"), NAMED)
def test_named_settings_exist(name, value):
    here = read_settings().model_dump()
    for part in name.split("."):
        here = here[part]
    if value:
        read_settings(overrides=[f"{name}={value}"])


def test_settings_are_named():
    assert len(NAMED) >= 8
