"""Events of an end's quality of service, which never happen."""

from __future__ import annotations

import enum
from typing import Any


class _Callbacks:
    def __init__(self, **kwargs: Any) -> None:
        vars(self).update(kwargs)


class PublisherEventCallbacks(_Callbacks):
    """Those of publishers."""


class SubscriptionEventCallbacks(_Callbacks):
    """Those of subscriptions."""


class UnsupportedEventTypeError(Exception):
    """The middleware does not have an event."""


class EventHandler(_Callbacks):
    """Waits for an event."""


class QoSPublisherEventType(enum.IntEnum):
    """Events of publishers."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(enum.IntEnum):
    """Events of subscriptions."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class _Info:
    """What an event tells."""


QoSEventHandler = EventHandler
IncompatibleTypeInfo = QoSMessageLostInfo = QoSLivelinessLostInfo = QoSLivelinessChangedInfo = _Info
QoSOfferedDeadlineMissedInfo = QoSRequestedDeadlineMissedInfo = QoSPublisherMatchedInfo = _Info
QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo = QoSSubscriptionMatchedInfo = _Info
