"""The configuration files of bridges between domains (`domain_bridge CONFIG`), which the launch hands to them.

https://github.com/ros2/domain_bridge
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from typing import TYPE_CHECKING

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, load_plain
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import words_of

if TYPE_CHECKING:
    from preflight_analysis.evaluation.ros2.state import State

_PACKAGE = "domain_bridge"


def is_domain_bridge(node: LaunchNode) -> bool:
    """Whether it carries topics from one domain to another."""
    return any(_PACKAGE in text for text in (node.package, node.executable, node.args))


def bridged_topics(node: LaunchNode, documents: Mapping[str, Document]) -> frozenset[str] | None:
    """The topics that a bridge carries, under all their names; None where that is not known."""
    path = _config_of(node)
    document = documents.get(path) if path is not None else None
    if document is None:
        return None
    try:
        data = load_plain(document.text)
    except CONSTRUCTION_ERRORS:
        return None
    topics = data.get("topics") if isinstance(data, dict) else None
    if not isinstance(topics, dict):
        return None
    entries = chain.from_iterable(given if isinstance(given, list) else [given] for given in topics.values())
    renamed = [entry["remap"] for entry in entries if isinstance(entry, dict) and "remap" in entry]
    return frozenset(f"/{str(name).lstrip('/')}" for name in (*topics, *renamed))


def note_files_of_domain_bridges(state: State) -> None:
    """Read the files: what they say is the launch's."""
    for node in state.nodes:
        path = _config_of(node)
        if path is not None:
            state.read_text(state.located(path))


def _config_of(node: LaunchNode) -> str | None:
    """The path of the file, the last word that is a path."""
    if node.package != _PACKAGE or node.unknowns:
        return None
    return next((word for word in reversed(words_of(node.args)) if word.startswith("/")), None)
