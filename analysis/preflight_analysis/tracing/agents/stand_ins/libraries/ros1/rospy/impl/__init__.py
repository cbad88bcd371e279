"""What rospy keeps for itself."""

from . import init, rosout, simtime, tcpros_service

__all__ = ["init", "rosout", "simtime", "tcpros_service"]
