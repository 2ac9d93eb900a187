"""Changes of lesson and network that can never come: they are refused when settings are read."""

from collections.abc import Iterator, Sequence
from math import inf

from motionese.errors import SettingError, unknown
from motionese.imitation import Development, Until


def check_changes(development: Development, levels: Sequence[str], condition: str) -> None:
    """Check that every change of a development can come.

    Args:
        development: The development.
        levels: The network's levels, from io upwards.
        condition: The name of the condition that goes through it.

    Raises:
        SettingError: A level opens after development has ended at the latest, or something is
            awaited of a level that does not exist, or is not open then.
    """
    open_after, last = _open_after(development), development.most_loops()
    for many in sorted(development.openings):
        if (latest := open_after.get(many + 1, inf)) >= last:
            when = (
                "the level below it never opens"
                if latest == inf
                else (f"it waits for {latest:.0f} loops at most, and development ends after {last}")
            )
            raise SettingError(f"opens.{levels[many]} may never come in {condition}: {when}")
    for where, most, until in _awaited(development, levels):
        if until.emerged is None:
            continue
        level, known = until.emerged.level, list(levels[1:])
        if level not in known:
            raise SettingError(unknown(f"level in {where}.emerged", level, known))
        if known.index(level) + 1 >= most:
            raise SettingError(
                f"{where}.emerged can never be met in {condition}: {level} is not open then"
            )


def _open_after(development: Development) -> dict[int, float]:
    """Return by how many levels after how many loops at the latest so many are open."""
    begun, open_after = 0, dict[int, float]()
    for stage in development.stages:
        for many in range(1, stage.levels + 1):
            open_after.setdefault(many, begun)
        begun = stage.until.ends(begun)
    for many, until in sorted(development.openings.items()):
        if many in open_after:
            latest = until.ends(int(open_after[many]))
            open_after[many + 1] = min(open_after.get(many + 1, inf), latest)
    return open_after


def _awaited(development: Development, levels: Sequence[str]) -> Iterator[tuple[str, int, Until]]:
    """Yield what lasts until when: where it is said, and how many levels may be open then."""
    for number, stage in enumerate(development.stages):
        most = stage.levels
        while most in development.openings:
            most += 1
        yield f"stages.{number}.until", most, stage.until
    for many, until in development.openings.items():
        yield f"opens.{levels[many]}", many, until
