"""What is in files of recordings, read, chosen, put on an even grid, before it is learned from."""

from motionese.recordings.binary import with_binary
from motionese.recordings.choice import MARGIN, Choice, choose, chosen
from motionese.recordings.examination import examined
from motionese.recordings.finding import Finding, refuse_any
from motionese.recordings.preparation import evened, finished, prepare, range_of
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.registry import FORMATS, OPTIONS, read, read_stored, write
from motionese.recordings.stored import StoredEpisode, StoredRecording
from motionese.recordings.stored_preparation import prepare_stored
from motionese.recordings.survey import ChannelNumbers, EpisodeNumbers, Survey, survey
from motionese.recordings.units import factor, in_units

__all__ = [
    "FORMATS",
    "MARGIN",
    "OPTIONS",
    "ChannelNumbers",
    "Choice",
    "Episode",
    "EpisodeNumbers",
    "Finding",
    "Recording",
    "StoredEpisode",
    "StoredRecording",
    "Survey",
    "choose",
    "chosen",
    "evened",
    "examined",
    "factor",
    "finished",
    "in_units",
    "prepare",
    "prepare_stored",
    "range_of",
    "read",
    "read_stored",
    "refuse_any",
    "survey",
    "with_binary",
    "write",
]
