"""Where motions are divided: by the pauses of the hand that was seen, and inside the network.

Compared with where the caregiver says that primitives begin, and with each other.
"""

from collections.abc import Sequence

from motionese.imitation.loop import Row
from motionese.imitation.roles.recognised import RecognisedLesson
from motionese.imitation.roles.symbols import Reading
from motionese.imitation.segments import Agreement, agreement, strokes_seen


def boundaries_found(
    shown: RecognisedLesson, readings: Sequence[Reading], rate_hz: float
) -> list[Row]:
    """Return where demonstrations are divided, and how far that is right.

    Args:
        shown: The demonstrations.
        readings: What each level's activity was read as while the network generated them.
        rate_hz: Rows a second [Hz].

    Returns:
        A row for each demonstration and `source`: "pauses", or a level with the kind of signatures
        that it was read by (`reference`). Boundaries [rows] that were `found` and that are `true`,
        how many there are of each, of both, and beside pauses of those that pauses tell too.
        Precision is `both_n / found_n`, recall `both_n / true_n`, over as many rows as one likes.
    """
    pauses = {
        (d.sequence.name, d.number): [start for start, _ in strokes_seen(d.seen, rate_hz)[1:]]
        for d in shown.usable
    }
    rows: list[Row] = []
    for each in shown.usable:
        who = each.sequence.name, each.number
        by_pauses, true = pauses[who], each.begins[1:]
        read = [r for r in readings if (r.motion.sequence.name, r.motion.number) == who]
        found = [("pauses", "", by_pauses)]
        found += [(r.level, r.reference, list(r.read.boundaries)) for r in read]
        for source, reference, boundaries in found:
            named = agreement(boundaries, true)
            rows.append(
                {
                    "source": source,
                    "reference": reference,
                    "motion": who[0],
                    "demonstration": who[1],
                    "found": _told(boundaries),
                    "true": _told(true),
                    **_counted(named),
                    "pauses_n": len(by_pauses),
                    "both_pauses_n": agreement(boundaries, by_pauses).both,
                }
            )
    return rows


def _told(boundaries: Sequence[int]) -> str:
    return " ".join(map(str, boundaries))


def _counted(found: Agreement) -> Row:
    return {f"{name}_n": count for name, count in found._asdict().items()}
