"""Which processes and threads there are in the sandbox."""

from __future__ import annotations

import os
from typing import Optional

_FORKED = "/proc/loadavg"
"""Its last field is the last process number given in this pid namespace (proc(5))."""


def left_behind() -> list[int]:
    """The processes beside our own and bubblewrap's."""
    return sorted(int(name) for name in os.listdir("/proc") if name.isdigit() and int(name) not in (1, os.getpid()))


def crowded(most: Optional[int]) -> bool:
    """Whether there are more than `most`, for where nothing outside limits them. Cheap as long as not so many have ever
    been started."""
    if most is None:
        return False
    try:
        with open(_FORKED) as file:
            if int(file.read().split()[-1]) <= most:
                return False
    except (OSError, ValueError, IndexError):
        pass
    count = 0
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        count += 1
        if count > most:
            return True
        try:
            count += len(os.listdir("/proc/%s/task" % name)) - 1
        except OSError:
            continue
    return count > most
