"""genpy: the base of all messages, times (http://docs.ros.org/en/noetic/api/genpy/html/)."""

from .message import DeserializationError, Message, MessageException, SerializationError
from .rostime import Duration, Time, TVal

__all__ = ("DeserializationError", "Duration", "Message", "MessageException", "SerializationError", "TVal", "Time")
