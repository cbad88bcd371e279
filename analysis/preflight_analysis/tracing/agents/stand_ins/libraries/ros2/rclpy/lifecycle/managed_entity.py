"""What takes part in transitions."""

from . import ManagedEntity, SimpleManagedEntity

__all__ = ["ManagedEntity", "SimpleManagedEntity"]
