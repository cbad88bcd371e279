"""Nodes with a life cycle."""

from . import LifecycleNode, LifecycleNodeMixin, LifecycleState, TransitionCallbackReturn

__all__ = ["LifecycleNode", "LifecycleNodeMixin", "LifecycleState", "TransitionCallbackReturn"]
