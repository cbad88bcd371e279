"""Message, service and action definitions: where they are, and what they say.

The language is that of http://wiki.ros.org/msg and https://docs.ros.org/en/jazzy/Concepts/Basic/About-Interfaces.html.
"""

from __future__ import annotations

import json
import os
import re
from typing import Any, NamedTuple, Optional

from .basic import DEFINITIONS

KINDS = ("msg", "srv", "action")
_FIELD = re.compile(r"([A-Za-z][\w/]*)(?:<=(\d+))?(\[(?:<=)?\d*\])?\s+([A-Za-z]\w*)\s*(.*)\Z")
_CONSTANT = re.compile(r"([A-Za-z]\w*)(?:<=\d+)?\s+([A-Za-z]\w*)\s*=\s*(.*)\Z")
_CATALOGUE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "definitions.json")
"""Definitions of common packages, by full name (`std_msgs/msg/String`): texts without comments, `{"1": ..., "2": ...}`
by generation of ROS where they differ. Made by a command; without it `basic` and the workspace are known."""


class Field(NamedTuple):
    """A field: `array` is None, -1 for any length, or the length."""

    type: str
    array: Optional[int]
    name: str
    default: str


class Definition(NamedTuple):
    """What one part of a definition says."""

    fields: tuple[Field, ...]
    constants: dict[str, Any]


class Definitions:
    """Those of one generation of ROS. `packages` are the folders of packages by name."""

    def __init__(self, generation: int, packages: dict[str, str]) -> None:
        self._generation = generation
        self._packages = packages
        self._common: Optional[dict[str, Any]] = None

    def has_package(self, package: str) -> bool:
        """Whether the workspace has it, with definitions."""
        share = self._packages.get(package)
        return share is not None and any(os.path.isdir(os.path.join(share, kind)) for kind in KINDS)

    def text(self, package: str, kind: str, name: str) -> Optional[str]:
        """The whole definition; None where it is not at hand."""
        share = self._packages.get(package)
        if share is not None:
            try:
                with open(os.path.join(share, kind, f"{name}.{kind}"), encoding="utf-8", errors="replace") as file:
                    return file.read()
            except OSError:
                pass
        found = self._catalogue().get(f"{package}/{kind}/{name}")
        if isinstance(found, dict):
            found = found.get(str(self._generation))
        return found if isinstance(found, str) else None

    def names(self, package: str, kind: str) -> list[str]:
        """What of that kind a package has, as far as it is known."""
        share = self._packages.get(package)
        try:
            listed = os.listdir(os.path.join(share, kind)) if share is not None else []
        except OSError:
            listed = []
        prefix = f"{package}/{kind}/"
        generation = str(self._generation)
        common = [
            name[len(prefix) :]
            for name, text in self._catalogue().items()
            if name.startswith(prefix) and (isinstance(text, str) or generation in text)
        ]
        return sorted({*(name[: -len(kind) - 1] for name in listed if name.endswith("." + kind)), *common})

    def all(self, kind: str) -> list[str]:
        """The full names (`std_msgs/msg/String`) of all definitions of a kind that are at hand."""
        middle, generation = f"/{kind}/", str(self._generation)
        found = {
            name
            for name, text in self._catalogue().items()
            if middle in name and (isinstance(text, str) or generation in text)
        }
        for package, share in self._packages.items():
            try:
                listed = os.listdir(os.path.join(share, kind))
            except OSError:
                continue
            found.update(package + middle + name[: -len(kind) - 1] for name in listed if name.endswith("." + kind))
        return sorted(found)

    def _catalogue(self) -> dict[str, Any]:
        if self._common is None:
            self._common = dict(DEFINITIONS)
            try:
                with open(_CATALOGUE, encoding="utf-8") as file:
                    self._common.update(json.load(file))
            except (OSError, ValueError):
                pass
        return self._common


def parts(text: str) -> list[str]:
    """Those between lines of `---`: a request and a response; a goal, a result and a feedback."""
    return re.split(r"^---[^\n]*$", text, flags=re.MULTILINE)


def parse(text: str) -> Definition:
    """Read one part; a line that is malformed is left out."""
    fields: list[Field] = []
    constants: dict[str, Any] = {}
    for line in text.splitlines():
        clean = line.partition("#")[0].strip()
        constant = _CONSTANT.match(line.strip() if clean.startswith(("string", "wstring")) else clean)
        if constant is not None and clean:
            constants[constant[2]] = _value(constant[1], constant[3].strip())
            continue
        field = _FIELD.match(clean)
        if field is not None:
            array = field[3]
            length = None if array is None else int(array[1:-1]) if array[1:-1].isdigit() else -1
            fields.append(Field(field[1], length, field[4], field[5].strip()))
    return Definition(tuple(fields), constants)


def _value(kind: str, text: str) -> Any:
    if kind in ("string", "wstring"):
        return text[1:-1] if len(text) > 1 and text[0] == text[-1] and text[0] in "'\"" else text
    if kind == "bool":
        return text.lower() in ("1", "true")
    try:
        return float(text) if kind.startswith("float") else int(text, 0)
    except ValueError:
        return text


def default_value(field: Field) -> Any:
    """The value that a definition of ROS 2 gives a field of a basic type; None for none."""
    if not field.default or field.default[:1] == "[":
        return None
    return _value(field.type, field.default)
