"""When the effects that a sequence has to bring about are due."""

from collections.abc import Sequence

from motionese.task.sequence import Primitive, PrimitiveSequence


def due_effects(
    sequence: PrimitiveSequence, begins: Sequence[int], rows: int
) -> list[tuple[Primitive, slice]]:
    """Return the primitives that have an effect, and the rows in which it counts.

    A stroke's rows count from its middle on, where an earlier effect is over, and the beginning of
    the following stroke, since the arm lags behind what it is commanded.

    Args:
        sequence: The sequence.
        begins: The rows at which its primitives begin.
        rows: How many rows it has.
    """
    spans = zip(sequence.primitives, begins, (*begins[1:], rows), strict=True)
    return [
        (primitive, slice(begin + (end - begin) // 2, end + (end - begin) // 3))
        for primitive, begin, end in spans
        if primitive.effect
    ]
