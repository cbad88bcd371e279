"""As the real library has it."""

from . import TransformBroadcaster

__all__ = ["TransformBroadcaster"]
