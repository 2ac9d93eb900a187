"""What is written after --conditions and --seeds, right and wrong."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import SettingError
from motionese.experiment import read_settings
from motionese.interfaces.commands.choices import as_ranges, read_conditions, read_seeds


@pytest.mark.parametrize(
    ("texts", "names"),
    [
        ([], ["TD/MD", "TD/MND", "TND/MD", "TND/MND"]),
        (["TND/MND", "TD/MD"], ["TD/MD", "TND/MND"]),
        (["TND/MD, TD/MD", "TD/MD"], ["TD/MD", "TND/MD"]),
        (["td/mnd"], ["TD/MND"]),
    ],
)
def test_conditions(texts, names):
    assert [c.name for c in read_conditions(texts, read_settings())] == names


def test_an_unknown_condition_is_answered_with_the_nearest():
    with pytest.raises(SettingError, match="unknown condition 'TNDMND'; did you mean 'TND/MND'"):
        read_conditions(["TD/MD,TNDMND"], read_settings())


@pytest.mark.parametrize(
    ("text", "seeds"),
    [
        ("1", [0]),
        ("3", [0, 1, 2]),
        ("100-103", [100, 101, 102, 103]),
        ("7-7", [7]),
        ("1,5,9", [1, 5, 9]),
        ("9, 5-6 ,5", [5, 6, 9]),
        ("4294967295-4294967295", [4294967295]),
    ],
)
def test_seeds(text, seeds):
    assert read_seeds(text) == seeds


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("0", "there are no such seeds"),
        ("9-3", "there are no such seeds"),
        ("-1", "'-1' is no seed"),
        ("", "'' is no seed"),
        ("1,,2", "'' is no seed"),
        ("five", "'five' is no seed"),
        ("1.5", "'1.5' is no seed"),
        ("4294967296-4294967296", "the largest seed is 4294967295"),
        ("10001", "more than 10000 seeds"),
    ],
)
def test_no_seeds(text, told):
    with pytest.raises(SettingError) as caught:
        read_seeds(text)
    assert str(caught.value).startswith(f"--seeds {text}: ")
    assert told in str(caught.value)


@given(st.sets(st.integers(0, 40), min_size=1))
def test_ranges_are_read_back_as_they_were_written(seeds):
    written = as_ranges(sorted(seeds))
    assert read_seeds(written + f",{min(seeds)}") == sorted(seeds)


def test_ranges_are_short():
    assert as_ranges([0, 1, 2, 7, 9, 10]) == "0–2, 7, 9–10"
