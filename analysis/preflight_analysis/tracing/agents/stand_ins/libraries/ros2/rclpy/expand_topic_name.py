"""Names, relative to a node (https://design.ros2.org/articles/topic_and_service_names.html)."""

from __future__ import annotations

import re

from .exceptions import InvalidTopicNameException

_TOPIC = re.compile(r"(~(?=/|\Z))?/?([A-Za-z_{}][\w{}]*)?(/[A-Za-z_{}][\w{}]*)*\Z", re.ASCII)


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """The full name. Raises `ValueError` for one that is malformed."""
    text = str(topic_name)
    if not text or not _TOPIC.match(text) or text.endswith("/") or "//" in text:
        raise ValueError(f"Invalid topic name: {topic_name!r}")
    space = node_namespace.rstrip("/")
    full = text.replace("{node}", node_name).replace("{ns}", space).replace("{namespace}", space)
    if full == "~" or full.startswith("~/"):
        return f"{space}/{node_name}{full[1:]}"
    return full if full.startswith("/") else f"{space}/{full}"


def validated(name: str, node_name: str, space: str) -> str:
    """The same, with the exception that a node gets."""
    try:
        return expand_topic_name(name, node_name, space)
    except ValueError:
        raise InvalidTopicNameException(str(name), "topic name is malformed", 0) from None
