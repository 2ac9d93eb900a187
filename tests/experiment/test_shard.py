"""Shards: every run is in one of them, and no two processes do the same."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import RunFolderError, SettingError
from motionese.experiment.run_folder import Opening, open_run_folders
from motionese.experiment.shard import Shard, read_shard


@given(st.integers(0, 60), st.integers(1, 12))
def test_every_run_is_in_one_shard_and_all_have_as_many(runs, parts):
    shards = [Shard(n, parts).part(range(runs)) for n in range(1, parts + 1)]
    assert sorted(run for part in shards for run in part) == list(range(runs))
    sizes = [len(part) for part in shards]
    assert max(sizes) - min(sizes) <= 1


def test_every_shard_has_its_share_of_every_condition():
    conditions = [place % 4 for place in range(16)]
    assert sorted(Shard(2, 4).part(conditions)) == [0, 1, 2, 3]


@pytest.mark.parametrize("text", ["", "2", "0/3", "4/3", "-1/3", "1/0", "a/b", "1/10001", "1/2/3"])
def test_what_is_no_shard_is_refused(text):
    with pytest.raises(SettingError, match=r"^--shard .*: write I/N, the I-th of N parts"):
        read_shard(text)


def opened(path, settings, shard):
    return open_run_folders(
        [Opening(path, settings, "default")], read_shard(shard) if shard else None
    )


def test_shards_of_one_study_share_its_folder_and_keep_others_out(tmp_path, small_settings):
    with opened(tmp_path, small_settings, "1/3"), opened(tmp_path, small_settings, "3/3"):
        for other in ("3/3", "1/2", ""):
            with (
                pytest.raises(
                    RunFolderError, match=r"shard [13]/3 is under way .* number of shards"
                ),
                opened(tmp_path, small_settings, other),
            ):
                pass
    with opened(tmp_path, small_settings, "1/2"):
        pass
    with opened(tmp_path, small_settings, ""):
        pass


def test_a_shard_leaves_what_another_one_is_writing(tmp_path, small_settings):
    with opened(tmp_path, small_settings, "1/2"):
        part = tmp_path / ".loop-01.safetensors.77.part"
        part.touch()
        with opened(tmp_path, small_settings, "2/2"):
            assert part.exists()
    with opened(tmp_path, small_settings, ""):
        assert not part.exists()


def test_a_shard_is_kept_out_while_all_runs_are_under_way(tmp_path, small_settings, monkeypatch):
    monkeypatch.setattr("motionese.experiment.run_folder.SHARDS_WAIT_S", 0.1)
    with (
        opened(tmp_path, small_settings, ""),
        pytest.raises(RunFolderError, match="is in use by another process"),
        opened(tmp_path, small_settings, "1/2"),
    ):
        pass
