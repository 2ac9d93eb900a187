"""Every way to read a short motion as elements, and the fewest changes between two readings."""


def readings(activity, signatures):
    """Yield cost, symbols and boundaries of all readings.

    A reading lays every row of the motion beside a row of a signature: the first beside a first
    one, the last beside a last one, and from row to row it stays, goes on by one or two, or passes
    from a last row to a first.
    """

    def go_on(t, e, row, cost, symbols, boundaries):
        cost += sum((a - b) ** 2 for a, b in zip(activity[t], signatures[e][1][row], strict=True))
        ended = row == len(signatures[e][1]) - 1
        if t == len(activity) - 1:
            if ended:
                yield cost, symbols, boundaries
            return
        for following in range(row, min(row + 3, len(signatures[e][1]))):
            yield from go_on(t + 1, e, following, cost, symbols, boundaries)
        if ended:
            for other, (name, _) in enumerate(signatures):
                yield from go_on(t + 1, other, 0, cost, (*symbols, name), (*boundaries, t + 1))

    for e, (name, _) in enumerate(signatures):
        yield from go_on(0, e, 0, 0.0, (name,), ())


def distance(one, other):
    """The fewest symbols to put in, leave out or replace."""
    if not one or not other:
        return len(one) + len(other)
    return min(
        distance(one[1:], other[1:]) + (one[0] != other[0]),
        distance(one[1:], other) + 1,
        distance(one, other[1:]) + 1,
    )
