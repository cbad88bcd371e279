"""What rospy raises (http://docs.ros.org/en/noetic/api/rospy/html/rospy.exceptions-module.html)."""


class ROSException(Exception):
    """Any error."""


class ROSSerializationException(ROSException):
    """A message cannot be sent."""


class ROSInternalException(Exception):
    """Something is wrong in rospy."""


class ROSInitException(ROSException):
    """The node cannot be started."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """The node is shut down while it waits."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time jumped back."""

    def __init__(self, time: float) -> None:
        super().__init__(f"ROS time moved backwards: {time}s")
        self.time = time


class TransportException(ROSInternalException):
    """A connection is broken."""


class TransportTerminated(TransportException):
    """A connection is closed."""


class TransportInitError(TransportException):
    """A connection cannot be made."""


class ParameterInvalid(ROSInternalException):
    """A parameter of a call is malformed."""
