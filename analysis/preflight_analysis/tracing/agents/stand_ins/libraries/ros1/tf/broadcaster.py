"""What tells transforms."""

from . import TransformBroadcaster

__all__ = ["TransformBroadcaster"]
