"""Our own modules instead of a node: compiled by this interpreter, for the runs to come."""

from __future__ import annotations

import base64
import os
import py_compile
import sys
from typing import Any, Callable, Iterator

TOPS = ("lib/preflight_agents", "lib/aspectlib", "site")


def report(root: str, temporary: str, emit: Callable[[dict[str, Any]], Any]) -> None:
    """`emit` each module below `root` as `{"ev": "compiled", "path": ..., "data": base64}`. `temporary` is a folder to
    write to."""
    made = os.path.join(temporary, "made.pyc")
    for folder, names in _folders(root):
        for name in sorted(names):
            if name.endswith(".py"):
                source = os.path.join(root, folder, name)
                # The host knows a copy by the digest of what it was made from; times would not match there.
                mode = py_compile.PycInvalidationMode.UNCHECKED_HASH
                py_compile.compile(source, made, source, doraise=True, invalidation_mode=mode)
                path = f"{folder}/__pycache__/{name[:-3]}.{sys.implementation.cache_tag}.pyc"
                with open(made, "rb") as file:
                    emit({"own": {"ev": "compiled", "path": path, "data": base64.b64encode(file.read()).decode()}})


def _folders(root: str) -> Iterator[tuple[str, list[str]]]:
    for top in TOPS:
        for at, below, names in os.walk(os.path.join(root, top)):
            below[:] = sorted(set(below) - {"__pycache__"} if top == TOPS[0] else ())
            yield os.path.relpath(at, root), names
