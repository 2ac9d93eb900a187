"""Episodes that a file sets apart for testing, by the names that it gives to parts of itself."""

from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from motionese.recordings.finding import Finding

TRAINING = "train"
TESTING = ("valid", "validation", "val", "test", "eval")


def set_apart(
    source: Path, parts: Mapping[str, Collection[str]], episodes: Sequence[str]
) -> tuple[tuple[str, ...], tuple[Finding, ...]]:
    """Return the episodes set apart, in their order, and what is wrong with the parts.

    Those of a part called as in `TESTING`; where there is none, those that are not to be trained
    on.

    Args:
        source: The file, for the findings.
        parts: The names of the episodes in every part, as the file tells them.
        episodes: The names of all episodes.
    """
    findings = []
    for part, members in parts.items():
        missing = [name for name in members if name not in set(episodes)]
        if missing:
            what = f"'{part}' names an episode '{missing[0]}', which is not there"
            findings.append(Finding("left out", source, what, count=len(missing)))
    learned = set(parts.get(TRAINING, episodes))
    tested = {name for part in TESTING for name in parts.get(part, ())}
    if both := [name for name in episodes if TRAINING in parts and name in learned & tested]:
        what = f"is both in '{TRAINING}' and in a part for testing; it is held out"
        findings.append(Finding("left out", source, what, episode=both[0], count=len(both)))
    if not any(part in parts for part in TESTING):
        tested = set(episodes) - learned
    return tuple(name for name in episodes if name in tested), tuple(findings)
