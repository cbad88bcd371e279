"""What actionlib raises."""


class ActionException(Exception):
    """A type is no action."""
