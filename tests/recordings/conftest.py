"""Recordings made by hand, and what every reader is asked about them."""

from pathlib import Path

import numpy as np
import pytest

from motionese.recordings import Episode, Recording, read


@pytest.fixture
def recording():
    """Two episodes of three channels at 25 Hz, with a gap, a given range, and names that try."""
    rng = np.random.default_rng(0)
    values = [rng.normal(size=(7, 3)), rng.normal(size=(4, 3))]
    masks = [rng.random((7, 3)) < 0.8, np.ones((4, 3), bool)]
    names = ["UR ↓", 'wave, "left"']
    return Recording(
        Path("by hand"),
        ("shoulder", "hand, x", "a[0]"),
        ("rad", "cm", ""),
        {"shoulder": (-4.0, 4.5)},
        25.0,
        tuple(Episode(n, None, v, m) for n, v, m in zip(names, values, masks, strict=True)),
        ("shoulder", "hand, x", "a[0]"),
    )


@pytest.fixture
def whole(recording):
    """The same without gaps."""
    episodes = tuple(
        Episode(e.name, None, e.values, np.ones_like(e.observed)) for e in recording.episodes
    )
    return Recording(
        recording.source,
        recording.channels,
        recording.units,
        recording.ranges,
        recording.rate_hz,
        episodes,
        recording.usual,
    )


@pytest.fixture
def table(tmp_path):
    """Write a table and read it."""

    def wrote(content, name="table.csv", **given):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read(path, **given)

    return wrote
