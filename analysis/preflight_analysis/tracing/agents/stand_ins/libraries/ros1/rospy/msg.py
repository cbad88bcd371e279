"""Messages of any type."""

from __future__ import annotations

from typing import Any

import genpy  # type: ignore[import-not-found]

from .exceptions import ROSException


class AnyMsg(genpy.Message):  # type: ignore[misc]
    """What a subscriber takes that takes all."""

    _md5sum = _type = "*"
    _has_header = False
    _full_text = ""
    __slots__ = ["_buff"]

    def __init__(self, *args: Any) -> None:
        if args:
            raise ROSException("AnyMsg does not accept arguments")
        self._buff = None
