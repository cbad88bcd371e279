"""The scripts in `packaging/`, which is no package: its name is that of a library."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import pytest

PACKAGING = Path(__file__).resolve().parents[2] / "packaging"


def script(name: str) -> Any:
    """The module of `packaging/NAME.py`. Raises `ModuleNotFoundError` where there is none."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(PACKAGING))
        return importlib.import_module(name)
