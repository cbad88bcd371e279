"""What is common to both ends of services."""


class ServiceException(Exception):
    """A call failed."""
