"""The types of messages, services and actions that classes of C++ stand for."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from preflight_analysis.source.cpp_values import CppType
from preflight_analysis.source.rclcpp_objects import POINTERS

_MESSAGE = re.compile(r"(?:::)?([A-Za-z]\w*)::(msg|srv|action)::([A-Za-z]\w*)(?:::|\Z)")
_HEADER = re.compile(r"([A-Za-z]\w*)/(msg|srv|action)/(?:detail/)?(\w+)\.h(?:pp)?\Z")
_WRAPPERS = frozenset({"shared_ptr", "unique_ptr"})


def message_type(
    type_: CppType, kind: str, includes: Sequence[str], has_type: Callable[[str, str, str], bool]
) -> str | None:
    """`pkg/msg/Name` of a class that messages, services or actions are made of.

    `includes` are those of the program, `has_type` tells whether a package has a type of that kind and name.
    """
    name = POINTERS.sub("", type_.name.removeprefix("::"))
    leaf = name.rpartition("::")[2]
    if leaf in _WRAPPERS and type_.args:
        return message_type(type_.args[0], kind, includes, has_type)
    if leaf == "TypeAdapter" and len(type_.args) == 2:
        return message_type(type_.args[1], kind, includes, has_type)
    found = _MESSAGE.match(name)
    if found is not None:
        return f"{found[1]}/{kind}/{found[3]}" if found[2] == kind else None
    if type_.file is None or "::" in name.removeprefix(f"{kind}::"):
        return None
    # Its namespace is used or around; the header that has it tells which.
    header = _header(leaf)
    for files in (type_.file.includes, includes):
        matches = (_HEADER.match(file) for file in files)
        packages = {m[1] for m in matches if m is not None and m[2] == kind and m[3] == header}
        if packages:
            return f"{packages.pop()}/{kind}/{leaf}" if len(packages) == 1 else None
    used = dict.fromkeys(path[0] for path in type_.file.namespaces if path)
    having = [package for package in used if has_type(package, kind, leaf)]
    return f"{having[0]}/{kind}/{leaf}" if len(having) == 1 else None


def _header(name: str) -> str:
    """The file of a message's header, as rosidl makes it of its name."""
    parts = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", parts).lower()
