"""What a node ended for that only the sandbox lacks: its crash is no news of the launch file.

Programs say it in words of their own; those of the C library and of Python are the same everywhere.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable
from dataclasses import replace

from preflight_analysis.tracing import interior
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.observation import Observation

_LINES = 6
"""How many of the last lines are looked at: a warning long before is not what it ended for."""
_SIGNS = (
    (r"No space left on device|Errno 28\b|of space free on disk", "a file system with more room than in the sandbox"),
    (r"Read-only file system|Errno 30\b", "to write files where the sandbox lets nobody write"),
    (
        r"No usable sandbox|DevToolsActivePort|--no-sandbox|to new namespace"
        r"|Chrom(e|ium) (failed|crashed|not reachable)",
        "name spaces of its own, as browsers make them, which the sandbox refuses",
    ),
    (
        r"connect(ing)? to (the )?(X|display)|open display|no display|\$DISPLAY|DISPLAY (environment|variable)|\bxcb\b"
        r"|\bX11\b|\bGLX|GL context|Unable to create the rendering window|RenderingAPIException",
        "a display, or a graphics card",
    ),
    (
        r"Network is unreachable|No route to host|Name or service not known|Temporary failure in name resolution"
        r"|Errno -[23]\b|Max retries exceeded|Could not resolve host|Cannot assign requested address"
        r"|Connection ?refused",
        "a network",
    ),
    (r"Namespace \w+ not available", "a library of GObject introspection that is not installed here"),
    (r"Exec format error", "a processor of another kind, for which the program was built"),
    (r"error while loading shared libraries", "a shared library that is not installed here"),
    (r"EOFError: EOF when reading a line|Inappropriate ioctl for device", "a terminal, from which it reads"),
    (r"not a git repository", "the git repository, which the sandbox hides"),
    (r"Wrong input topic|does not appear to be published yet", "another node to publish a topic when it starts"),
)
_KNOWN = tuple((re.compile(pattern, re.IGNORECASE), what) for pattern, what in _SIGNS)
_DEVICE = re.compile(r"(?<![\w/.-])/dev/(?!null\b|zero\b|u?random\b|shm\b|stdin\b|stdout\b|stderr\b|tty\b)[\w./-]*\w")
_PATH = re.compile(r"(?<![\w/.])/(?!dev/|proc/)[^\s'\":;,\]\[()<>]+")
_WRITES = re.compile(r"writ|creat|sav|mkdir|Permission denied", re.IGNORECASE)


def explained(observed: Observation, visible: Iterable[str]) -> Interface:
    """The interface with what its node ended for, where that is the sandbox. `visible` are the host's paths below the
    masked folders that it showed."""
    interface, outcome = observed.interface, observed.interface.outcome
    failed = outcome.status == "crashed" or (outcome.status == "exited" and outcome.exit_code not in (None, 0))
    lacks = _lacks(outcome, observed.wrote, tuple(visible)) if failed else None
    return interface if lacks is None else replace(interface, outcome=replace(outcome, lacks=lacks))


def _lacks(outcome: Outcome, wrote: Collection[str], visible: tuple[str, ...]) -> str | None:
    lines = (*outcome.stderr_tail[-_LINES:], outcome.reason or "")
    for pattern, what in _KNOWN:
        if any(map(pattern.search, lines)):
            return what
    for line in lines:
        if (device := _DEVICE.search(line)) is not None:
            return f"the device {device[0]}, which the sandbox does not have"
        for path in _PATH.findall(line):
            if not interior.shown(path, visible) and os.path.exists(path):
                return f"'{path}', which the sandbox does not show"
            if (path in wrote or _WRITES.search(line.replace(path, ""))) and _may_be_written(path):
                return f"to write '{path}', which the sandbox does not let it"
    return None


def _may_be_written(path: str) -> bool:
    """Whether the user could, on the host."""
    return os.access(path if os.path.exists(path) else os.path.dirname(path), os.W_OK)
