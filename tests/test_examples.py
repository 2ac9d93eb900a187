"""Every example runs as it stands, draws its picture, and is shown in the gallery."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_draws_its_picture(example, tmp_path):
    environment = {**os.environ, "MPLBACKEND": "agg"}
    subprocess.run([sys.executable, str(example)], cwd=tmp_path, env=environment, check=True)
    assert (tmp_path / f"{example.stem}.png").stat().st_size > 10_000


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_it_is_shown_in_the_gallery(example):
    gallery = (ROOT / "docs" / "gallery.md").read_text()
    assert f"](../examples/{example.name})" in gallery
    assert f"](figures/examples/{example.stem}.png)" in gallery
    assert (ROOT / "docs" / "figures" / "examples" / f"{example.stem}.png").is_file()


def test_there_are_examples():
    assert len(EXAMPLES) >= 8
