"""As the real library has it."""

from . import TransformListener

__all__ = ["TransformListener"]
