"""Messages' base class and what goes wrong with them."""

from __future__ import annotations

from typing import Any


class MessageException(Exception):
    """Something is wrong with a message."""


class SerializationError(MessageException):
    """A message cannot be sent."""


class DeserializationError(MessageException):
    """A message cannot be read."""


class Message:
    """The base of the classes that are made of definitions."""

    __slots__: Any = ()
    _type = ""
    _md5sum = ""
    _slot_types: Any = ()
    _full_text = ""
    _has_header = False
