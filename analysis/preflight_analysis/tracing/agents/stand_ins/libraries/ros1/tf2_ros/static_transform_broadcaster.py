"""As the real library has it."""

from . import StaticTransformBroadcaster

__all__ = ["StaticTransformBroadcaster"]
