"""genpy without numpy, until somebody else imports it: its import takes a quarter of a rospy node's way to its loop.

genpy wants it for one thing alone: to know numpy's numbers when it checks the type of a field that it could not
serialise. There are no such numbers before somebody has imported numpy.
"""

from __future__ import annotations

import sys
from importlib.abc import MetaPathFinder
from types import ModuleType
from typing import Any, List, Optional, Sequence

NAME = "genpy.message"
_NUMBERS = ("float32", "float64", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64")
"""As genpy lists them."""

refused: list[str] = []
"""Who was told that there is no numpy."""


class WithoutNumpy(MetaPathFinder):
    """Has genpy's own import of numpy fail, for which it is prepared."""

    def find_spec(self, fullname: str, path: Optional[Sequence[str]], target: Optional[ModuleType] = None) -> None:
        if fullname != "numpy":
            return
        frame: Any = sys._getframe(1)
        while frame is not None and str(frame.f_globals.get("__name__")).startswith(
            ("importlib.", "_frozen_importlib")
        ):
            frame = frame.f_back
        if frame is not None and frame.f_globals.get("__name__") == NAME:
            refused.append(fullname)
            raise ModuleNotFoundError("No module named 'numpy'", name="numpy")


class _Types(List[Any]):
    """Types of numbers, and numpy's as soon as there are any."""

    def __contains__(self, kind: object) -> bool:
        numpy = sys.modules.get("numpy")
        return super().__contains__(kind) or any(kind is getattr(numpy, name, self) for name in _NUMBERS)


def weave(message: Any) -> None:
    """Give genpy back what it was refused."""
    if refused and isinstance(getattr(message, "_valid_float_types", None), list):
        message._valid_float_types = _Types(message._valid_float_types)
