"""That something cannot be renamed."""


class RenameRefusedError(Exception):
    """Why it cannot be renamed, in words for the user."""
