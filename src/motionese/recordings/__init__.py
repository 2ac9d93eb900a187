"""What is in files of recordings, read, chosen, put on an even grid, before it is learned from."""

from motionese.recordings.channels import chosen
from motionese.recordings.choice import MARGIN, Choice, choose
from motionese.recordings.preparing import prepare
from motionese.recordings.ranges import range_of
from motionese.recordings.reading import FORMATS, read, write
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.survey import survey
from motionese.recordings.survey_numbers import ChannelNumbers, EpisodeNumbers, Survey

__all__ = [
    "FORMATS",
    "MARGIN",
    "ChannelNumbers",
    "Choice",
    "Episode",
    "EpisodeNumbers",
    "Recording",
    "Survey",
    "choose",
    "chosen",
    "prepare",
    "range_of",
    "read",
    "survey",
    "write",
]
