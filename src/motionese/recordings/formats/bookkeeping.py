"""What messages carry beside what was measured: headers, time stamps, sequence numbers."""

import re

_BOOKKEEPING = re.compile(
    r"(^|[./])(header|stamp|timestamp|seq|sec|secs|nsec|nsecs|nanosec|nanoseconds)([./]|$)"
)


def is_bookkeeping(path: str) -> bool:
    """Tell whether a path such as "header.stamp.secs" leads to a part of it."""
    return _BOOKKEEPING.search(path) is not None
