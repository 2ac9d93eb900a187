"""From what a file holds to what can be learned from: chosen, finite, even, with ranges."""

from dataclasses import replace

from motionese.errors import MotionError
from motionese.recordings.channels import chosen
from motionese.recordings.choice import Choice
from motionese.recordings.even import even
from motionese.recordings.finite import finite
from motionese.recordings.ranges import all_ranges
from motionese.recordings.rate import rate_of
from motionese.recordings.recording import Recording
from motionese.recordings.resampling import resampled
from motionese.recordings.trimming import trimmed


def prepare(recording: Recording, choice: Choice) -> Recording:
    """Return a recording of the chosen channels at one rate, every channel with a range.

    Raises:
        ChannelError: A channel that does not exist, or whose range cannot be told.
        MotionError: A value that is not finite, or an episode of fewer than two rows.
        RecordingError: A rate that nobody tells or that differs, or times that do not rise.
        SettingError: A rate to resample to that is out of reach.
    """
    recording = finite(chosen(recording, choice), nan_is_gap=choice.nan == "gap")
    _check_lengths(recording)
    recording = even(recording, rate_of(recording, choice.rate_hz))
    if choice.resample_hz is not None:
        recording = resampled(recording, choice.resample_hz)
    if choice.trim > 0:
        recording = trimmed(recording, choice.trim, all_ranges(recording, choice))
    _check_lengths(recording)
    return replace(recording, ranges=all_ranges(recording, choice))


def _check_lengths(recording: Recording) -> None:
    for episode in recording.episodes:
        rows = len(episode.values)
        if rows < 2:
            raise MotionError(
                f"{recording.source}: episode '{episode.name}' has "
                f"{'1 row' if rows == 1 else 'no rows'}; at least 2 are needed"
            )
