"""What a robot's sensors say, put into one row of the channels."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy import ndarray

from motionese.errors import ControlError, unknown

Reading = Mapping[str, float | None] | Sequence[float] | ndarray | None
"""Values by channel name (a channel may be left out), one per channel, or None: no new reading."""


def row_of(reading: Reading, channels: Sequence[str]) -> ndarray:
    """Return a reading [D] in the channels' units; NaN where nothing finite was read.

    Raises:
        ControlError: A channel that does not exist, a value that is no number, another width.
    """
    if reading is None:
        return np.full(len(channels), np.nan)
    given: Mapping[str, float | None] | Sequence[float] | ndarray = reading
    if isinstance(given, Mapping):
        for name in given:
            if name not in channels:
                raise ControlError(f"reading: {unknown('channel', name, channels)}")
        given = [np.nan if (v := given.get(name)) is None else v for name in channels]
    try:
        row = np.array(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ControlError(f"a reading must hold numbers, got {reading!r}") from error
    if row.shape != (len(channels),):
        raise ControlError(
            f"a reading must hold one value per channel ({', '.join(channels)}), "
            f"got shape {row.shape}"
        )
    row[~np.isfinite(row)] = np.nan
    return row
