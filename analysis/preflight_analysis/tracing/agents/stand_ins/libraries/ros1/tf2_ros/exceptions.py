"""What is wrong with a transform."""


class TransformException(Exception):
    """Anything."""


class ConnectivityException(TransformException):
    """Two frames are not connected."""


class LookupException(TransformException):
    """There is no such frame."""


class ExtrapolationException(TransformException):
    """Nothing is known of that time."""


class InvalidArgumentException(TransformException):
    """The question is malformed."""


class TimeoutException(TransformException):
    """The time is over."""
