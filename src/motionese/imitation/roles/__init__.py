"""What role each level of the network plays: Cf the direction, Cs the order, or any other way.

All is measured of states that are recognised from fresh demonstrations, never of learned ones: of
those, how they were learned decides in advance what their parts can hold.
"""

from motionese.imitation.roles.boundaries import boundaries_found
from motionese.imitation.roles.decoders import decoded
from motionese.imitation.roles.exchange import exchanged
from motionese.imitation.roles.lesions import lesioned
from motionese.imitation.roles.recognised import (
    RecognisedDemonstration,
    RecognisedLesson,
    recognised,
)
from motionese.imitation.roles.symbols import readings, symbols_read

__all__ = [
    "RecognisedDemonstration",
    "RecognisedLesson",
    "boundaries_found",
    "decoded",
    "exchanged",
    "lesioned",
    "readings",
    "recognised",
    "symbols_read",
]
