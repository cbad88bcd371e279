"""Names, relative to the node's, with the remaps of the command line (http://wiki.ros.org/Names)."""

from __future__ import annotations

import os
import sys
from typing import Any

from .exceptions import ROSException, ROSInitException

SEP, PRIV_NAME, REMAP, ANYTYPE = "/", "~", ":=", "*"
TOPIC_ANYTYPE = SERVICE_ANYTYPE = ANYTYPE


def load_mappings(argv: Any) -> dict[str, str]:
    """The remaps of a command line; parameters `_x:=` are none."""
    pairs = (word.partition(REMAP) for word in argv if isinstance(word, str) and REMAP in word)
    return {
        source.strip(): target.strip() for source, _, target in pairs if source[:1] != "_" or source.startswith("__")
    }


_mappings = load_mappings(sys.argv)
_resolved_mappings: dict[str, str] = {}


def canonicalize_name(name: str) -> str:
    """Without empty steps."""
    if not name or name == SEP:
        return name
    return (SEP if name[0] == SEP else "") + SEP.join(step for step in name.split(SEP) if step)


def namespace(name: str) -> str:
    """The namespace of a full name, with `/` at its end."""
    return SEP if name in ("", SEP) else name.rstrip(SEP).rpartition(SEP)[0] + SEP


def is_global(name: str) -> bool:
    return bool(name) and name[0] == SEP


def is_private(name: str) -> bool:
    return bool(name) and name[0] == PRIV_NAME


def ns_join(space: str, name: str) -> str:
    """A name in a namespace."""
    if is_private(name) or is_global(name) or space == PRIV_NAME:
        return PRIV_NAME + name if space == PRIV_NAME else name
    if not space:
        return name
    return space + name if space.endswith(SEP) else space + SEP + name


def _resolved(name: str, caller_id: str) -> str:
    """As `resolve_name`, before remaps."""
    if not name:
        return namespace(caller_id)
    name = canonicalize_name(name)
    if is_global(name):
        return name
    if is_private(name):
        return canonicalize_name(caller_id + SEP + name[1:])
    return namespace(caller_id) + name


def reload_mappings(argv: Any) -> None:
    """Take the remaps of another command line."""
    global _mappings  # noqa: PLW0603
    _mappings = load_mappings(argv)


def initialize_mappings(node_name: str) -> None:
    """The node has this name from now on."""
    _resolved_mappings.clear()
    for source, target in _mappings.items():
        if source.startswith("__"):
            _resolved_mappings[source] = target
        else:
            _resolved_mappings[_resolved(source, node_name)] = _resolved(target, node_name)


def resolve_name_without_node_name(name: str) -> str:
    """The full name of what is made before the node has its own. Raises `ValueError` for a private one."""
    if is_private(name):
        raise ValueError("~name topics cannot be created before init_node() has been called")
    caller = ns_join(get_namespace(), "node")
    full = _resolved(name, caller)
    for source, target in _mappings.items():
        if _resolved(source, caller) == full:
            if is_private(target):
                raise ROSInitException(f"due to the way this node is written, {name} cannot be remapped to a ~name")
            return _resolved(target, caller)
    return full


def get_mappings() -> dict[str, str]:
    return _mappings


def get_resolved_mappings() -> dict[str, str]:
    return _resolved_mappings


def resolve_name(name: Any, caller_id: Any = None) -> str:
    """The full name, remapped."""
    full = _resolved(str(name) if name else "", caller_id or get_name())
    return _resolved_mappings.get(full, full) if name else full


def remap_name(name: str, caller_id: Any = None, resolved: bool = True) -> str:
    """The name itself where it is not remapped."""
    return _resolved(_mappings[name], caller_id or get_caller_id()) if name in _mappings else name


def scoped_name(caller_id: str, name: str) -> str:
    """A full name as a relative one."""
    if not is_global(caller_id):
        raise ROSException("caller_id must be global")
    return canonicalize_name(name)[len(namespace(caller_id)) :]


_caller_id = ""


def get_namespace() -> str:
    """The namespace that the launcher gave to the node."""
    space = _mappings.get("__ns") or os.environ.get("ROS_NAMESPACE") or SEP
    return canonicalize_name(SEP + space) + ("" if canonicalize_name(SEP + space) == SEP else SEP)


def get_name() -> str:
    """The node's own full name; `/unnamed` before it has one."""
    return _caller_id or get_namespace() + "unnamed"


def get_caller_id() -> str:
    return get_name()


def _set_caller_id(caller_id: str) -> None:
    global _caller_id  # noqa: PLW0603
    _caller_id = caller_id
