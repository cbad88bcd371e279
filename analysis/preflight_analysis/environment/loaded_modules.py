"""Python files that lie among launch files and are none: others load them as modules."""

from __future__ import annotations

import os
import re

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.python_text import LAUNCH_FUNCTION, PYTHON_SUFFIX

_LOADERS = re.compile(r"\b(?:run_path|spec_from_file_location|SourceFileLoader|load_source)\b")


def is_loaded_module(disk: Disk, path: str) -> bool:
    """Whether a Python file does not make what launch asks for, and one beside it loads it by its name."""
    text = disk.content(path) if path.endswith(PYTHON_SUFFIX) else None
    if text is None or LAUNCH_FUNCTION.search(text) is not None:
        return False
    folder, own = os.path.split(path)
    name = re.escape(own.removesuffix(PYTHON_SUFFIX))
    module = re.compile(rf"^\s*(?:from\s+\.?|import\s+(?:\w+\s*,\s*)*){name}\b", re.MULTILINE)
    for beside in disk.names(folder):
        other = disk.content(os.path.join(folder, beside)) if beside.endswith(PYTHON_SUFFIX) and beside != own else None
        if other is not None and (module.search(other) or (own in other and _LOADERS.search(other))):
            return True
    return False
