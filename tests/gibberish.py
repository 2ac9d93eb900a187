"""Messages that a page never sends: nonsense, and what is nearly right."""

import json
import string

from hypothesis import strategies as some

anything = some.recursive(
    some.none()
    | some.booleans()
    | some.integers(-(2**70), 2**70)
    | some.floats()
    | some.text(max_size=40),
    lambda inner: some.lists(inner, max_size=4) | some.dictionaries(some.text(), inner, max_size=4),
    max_leaves=8,
)
numbers = some.floats(-1, 2) | some.floats() | some.integers(-5, 5) | some.floats(0, 3e4)
KINDS = (
    *(
        "hello",
        "pen",
        "demonstrate",
        "imitate",
        "learn",
        "forget",
        "replay",
        "rename",
        "grow",
        "map",
        "hover",
    ),
    *("begin", "teach", "call", "repeat", "compare", "open"),
    *("stop", "export", "left", "refused", "__class__"),
)
near = some.fixed_dictionaries(
    {"type": some.sampled_from(KINDS)},
    optional={
        "phase": some.sampled_from(["down", "move", "up", "sideways"]),
        "points": some.lists(some.tuples(numbers, numbers, numbers), max_size=6),
        "motion": some.sampled_from(["UR ↓", "UR ↓↑←", "", "../..", "babbling"]) | some.text(),
        "entry": some.integers(-1, 9),
        "name": some.sampled_from(["wave", "UR ↓", ""]) | some.text(),
        "slow": some.tuples(numbers, numbers),
        "primitive": some.sampled_from(["UR ↓", "LL ↑", "no such"]),
        "with": some.sampled_from(["fresh", "/etc", ""]),
        "take": some.booleans(),
        "robot": some.text(max_size=5),
        "grows": some.sampled_from(["never", "beginning", "tomorrow"]),
        "file": some.sampled_from([32 * "a", "../..", ""]),
        "session": some.text(max_size=5),
        "source": some.sampled_from(["drawn", "webcam", "scripted"]),
        "follow": some.booleans(),
    },
)
messages = some.one_of(
    near.map(json.dumps),
    near.map(json.dumps),
    anything.map(json.dumps),
    some.text(alphabet=string.printable, max_size=60),
)

drawn = some.tuples(some.floats(0, 3e4), some.floats(-1, 2), some.floats(-1, 2))
right = some.one_of(
    some.builds(
        lambda phase, points, follow: {
            "type": "pen",
            "phase": phase,
            "points": sorted(points),
            "follow": follow,
        },
        some.sampled_from(["down", "move", "up"]),
        some.lists(drawn, max_size=30),
        some.booleans(),
    ),
    some.builds(
        lambda motion: {"type": "demonstrate", "motion": motion},
        some.sampled_from(["UR ↓", "UR →", "LL ↑↓↑↓↑↓↑↓↑↓", "PUSH(R)+RAISE(R)", "babbling"]),
    ),
    some.builds(
        lambda kind, entry: {"type": kind, "entry": entry},
        some.sampled_from(["forget", "replay"]),
        some.integers(0, 40),
    ),
    some.builds(
        lambda a, b: {"type": "hover", "slow": [a, b], "primitive": "UR ↓"},
        some.floats(-100, 100),
        some.floats(-100, 100),
    ),
    some.sampled_from(["imitate", "learn", "grow", "map", "stop"]).map(lambda t: {"type": t}),
    some.sampled_from(["babbling", "fresh"]).map(lambda w: {"type": "begin", "with": w}),
    some.booleans().map(lambda take: {"type": "hello", "take": take}),
).map(json.dumps)
"""Messages that a page may send, in an order that makes no sense."""
