"""Events of an end's quality of service, which never happen."""

from __future__ import annotations

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
