"""Python's search for garbage, left out where it costs more than it finds."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def uncollected() -> Iterator[None]:
    """What is not needed any more is freed as ever; only rings of objects stay until the end. Documents and trees have
    none, and to look for some in all of them takes a third of the time of a check with hundreds of launches."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
