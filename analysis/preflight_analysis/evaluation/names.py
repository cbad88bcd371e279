"""ROS 1 graph resource names: joining, resolving and checking them (http://wiki.ros.org/Names)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

_LEGAL = re.compile(r"[~/A-Za-z][\w/]*\Z")


def is_private(name: str) -> bool:
    """Whether it is a `~private` name."""
    return name.startswith("~")


def is_global(name: str) -> bool:
    """Whether it starts at the root."""
    return name.startswith("/")


def is_legal(name: str) -> bool:
    """A letter, `~` or `/` first, then letters, digits, `_` and `/`; the empty name is the namespace itself."""
    return not name or (_LEGAL.match(name) is not None and "//" not in name)


def is_legal_in_ros2(name: str) -> bool:
    """Whether ROS 2 takes it for the name of a topic or service, too: no part begins with a digit.

    `rcl_validate_topic_name`; the name that the code gives is checked before it is remapped.
    """
    return is_legal(name) and not any(part[:1].isdigit() for part in name.split("/"))


def canonicalize(name: str) -> str:
    """Without doubled or trailing slashes."""
    if name == "/" or ("//" not in name and not name.endswith("/")):
        return name
    joined = "/".join(part for part in name.split("/") if part)
    return "/" + joined if name[0] == "/" else joined


def as_namespace(name: str) -> str:
    """A global name with a slash at both ends, `robot` becomes `/robot/`."""
    if not is_global(name):
        name = "/" + name
    return name if name.endswith("/") else name + "/"


def parent(name: str) -> str:
    """The namespace of a name, with its trailing slash: `/` of `/a`, `/a/` of `/a/b`."""
    return name.rstrip("/").rpartition("/")[0] + "/"


def leaf(name: str) -> str:
    """The last part of a name, the one that its namespace does not have."""
    return name.rpartition("/")[2]


def with_namespaces(full_names: Iterable[str]) -> set[str]:
    """The names and the namespaces that they are in, up to but without the root: `/a` and `/a/b` of `/a/b`."""
    found: set[str] = set()
    new = {*full_names}
    while new:
        found |= new
        new = {name.rpartition("/")[0] for name in new} - found
    found.discard("")
    return found


def join(namespace: str, name: str) -> str:
    """`name` below `namespace`; global and private names stay what they are."""
    if is_private(name) or is_global(name) or not namespace:
        return name
    if namespace == "~":
        return "~" + name
    return namespace + name if namespace.endswith("/") else f"{namespace}/{name}"


def resolve(name: str, node: str, remaps: Mapping[str, str] | None = None) -> str:
    """The final name of what `node` (a full name) calls `name`.

    `remaps` maps resolved names to resolved names, see `resolve_remaps`. As both client libraries do: the name is
    resolved first and then looked up, and a remapped name is not remapped again.
    """
    name = canonicalize(name)
    if not name:
        full = parent(node)
    elif is_global(name):
        full = name
    elif is_private(name):
        full = canonicalize(f"{node}/{name[1:]}")
    else:
        full = canonicalize(parent(node) + name)
    return remaps.get(full, full) if remaps else full


def resolve_remaps(remaps: tuple[tuple[str, str], ...], node: str) -> dict[str, str]:
    """`from:=to` pairs as handed to `node`, both sides resolved; a later one for the same name wins."""
    return {resolve(source, node): resolve(target, node) for source, target in remaps}
