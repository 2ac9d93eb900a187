"""Types of ROS messages, as the log defines them or the standard does, and their fields."""

from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

from motionese.errors import MotioneseError
from motionese.recordings.formats.conventions import imported
from motionese.recordings.formats.message_log import Topic

ASIDE = (
    *("std_msgs/msg/Header", "std_msgs/msg/MultiArrayLayout"),
    *("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration"),
)
"""Types of fields that are no numbers of a motion."""
TEXT = ("string", "wstring")
LONGEST = 1 << 24
"""Items of the longest list; a damaged length must not fill the memory."""
_IDL_PART = "=" * 80 + "\n"


class Field(NamedTuple):
    """A field of a message: its name, and the attribute that holds it.

    Attributes:
        base: What it holds, such as float64; empty where it holds messages.
        kind: The type of the messages that it holds; empty where it holds none.
        several: Whether it is a list.
    """

    name: str
    attribute: str
    base: str
    kind: str
    several: bool

    @property
    def is_number(self) -> bool:
        """Tell whether it holds numbers."""
        return bool(self.base) and self.base not in TEXT


class UndefinedTypeError(Exception):
    """A type that neither the log nor the standard defines, or not as a type is defined."""


class Types:
    """The types that the messages of one topic are made of."""

    def __init__(self, topic: Topic, distribution: str) -> None:
        try:
            self.store = _defined(topic) if topic.definition.strip() else _standard(distribution)
            self.store.get_msgdef(topic.kind)
        except MotioneseError:
            raise
        # What the parser raises depends on what is wrong with the definition.
        except Exception as error:
            raise UndefinedTypeError(topic.kind) from error
        self._normalize = imported("rosbags.typesys.base", "ros", "").normalize_fieldname
        self._fields: dict[str, tuple[Field, ...]] = {}

    def fields(self, kind: str) -> tuple[Field, ...]:
        """Return the fields of a type, in order."""
        if kind not in self._fields:
            told = self.store.fielddefs[kind][1]
            named = (self._field(*each) for each in told)
            # What has no fields has this one, as CDR needs one.
            self._fields[kind] = tuple(f for f in named if not f.name.startswith("structure_needs"))
        return self._fields[kind]

    def numbered(self, kind: str) -> tuple[Field, ...]:
        """Return the fields of a type in which numbers of a motion may stand, or their names."""
        return tuple(field for field in self.fields(kind) if field.kind not in ASIDE)

    def leaves(self, kind: str, path: str = "") -> Iterator[tuple[str, Field]]:
        """Yield such fields of a type and of the messages in it, each with its attribute's path.

        Lists of messages are not gone into.
        """
        for field in self.numbered(kind):
            if field.kind and not field.several:
                yield from self.leaves(field.kind, f"{path}{field.attribute}.")
            else:
                yield path + field.attribute, field

    def _field(self, name: str, node: tuple[int, Any]) -> Field:
        # Nodes are 1: a base type, 2: a message, 3 and 4: lists of one of these.
        several = node[0] > 2
        shape, inner = node[1][0] if several else node
        base, kind = (inner[0], "") if shape == 1 else ("", inner)
        return Field(name, self._normalize(name), base, kind, several)


def normalized(kind: str) -> str:
    """Return a type's name with its `msg`, as ROS 2 has it: sensor_msgs/msg/JointState."""
    package, slash, name = kind.partition("/")
    return f"{package}/msg/{name}" if slash and "/" not in name else kind


def _defined(topic: Topic) -> Any:
    typesys = imported("rosbags.typesys", "ros", "reading ROS bags")
    text, types = topic.definition, {}
    if "idl" not in topic.grammar:
        types = typesys.get_types_from_msg(text, topic.kind)
    elif text.startswith(f"{_IDL_PART}IDL: "):
        for part in text.split(_IDL_PART)[1:]:
            types |= typesys.get_types_from_idl(part.partition("\n")[2])
    else:
        types = typesys.get_types_from_idl(text)
    store = typesys.get_typestore(typesys.Stores.EMPTY)
    store.max_sequence_length = LONGEST
    store.register(types)
    return store


@cache
def _standard(distribution: str) -> Any:
    typesys = imported("rosbags.typesys", "ros", "reading ROS bags")
    known = {store.value: store for store in typesys.Stores}
    store = typesys.get_typestore(known.get(f"ros2_{distribution}", typesys.Stores.LATEST))
    store.max_sequence_length = LONGEST
    return store
