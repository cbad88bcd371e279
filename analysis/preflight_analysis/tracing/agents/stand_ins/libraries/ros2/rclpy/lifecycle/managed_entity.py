"""What takes part in transitions."""

from . import ManagedEntity, SimpleManagedEntity, TransitionCallbackReturn

__all__ = ["ManagedEntity", "SimpleManagedEntity", "TransitionCallbackReturn"]
