"""Controllers of ros_control: what the scripts of `controller_manager` ask of a manager.

http://wiki.ros.org/controller_manager#Helper_scripts
"""

from __future__ import annotations

from typing import NamedTuple

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import words_of

_PACKAGE = "controller_manager"
_LOADING = {"spawner": (), "controller_manager": ("load", "spawn"), "spawner.py": ()}
"""The programs that load controllers, each with the words that say so."""
_WITH_VALUE = ("--namespace", "--wait-for", "--timeout", "--shutdown-timeout")


class Asked(NamedTuple):
    """What a script asks a manager for: the manager's namespace, without a slash at its end, and controllers."""

    namespace: str
    controllers: tuple[str, ...]

    def full(self, controller: str) -> str:
        """The full name of a controller."""
        return names.resolve(controller, f"{self.namespace}/{_PACKAGE}")


def asked_of(node: LaunchNode) -> Asked | None:
    """What the arguments of such a script say; None of other nodes, and where they are not all known."""
    if node.package != _PACKAGE or node.executable not in _LOADING or node.unknowns:
        return None
    words, namespace, found = iter(words_of(node.args)), node.namespace, list[str]()
    verbs = _LOADING[node.executable]
    if verbs and next(words, "") not in verbs:
        return None
    for word in words:
        option, equals, value = word.partition("=")
        if option in _WITH_VALUE:
            value = value if equals else next(words, "")
            namespace = names.resolve(value, node.name) if option == "--namespace" and value else namespace
        elif names.is_legal(word) and word:
            found.append(word)
    return Asked(namespace.rstrip("/"), tuple(found))


def loaded_by(node: LaunchNode) -> tuple[str, ...]:
    """The full names of the controllers that a script loads; none of other nodes."""
    asked = asked_of(node)
    return tuple(map(asked.full, asked.controllers)) if asked is not None else ()
