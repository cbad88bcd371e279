"""The part of a command line that is ROS's: `--ros-args` (https://design.ros2.org/articles/ros_command_line_arguments.html)."""

from __future__ import annotations

import importlib
import json
from typing import Any

_VALUED = ("-r", "--remap", "-p", "--param", "--params-file", "-e", "--enclave", "--log-level", "--log-config-file")


def without(words: Any) -> list[str]:
    """What is the program's own."""
    return _split(words)[0]


def _split(words: Any) -> tuple[list[str], list[tuple[str, str]]]:
    own: list[str] = []
    ros: list[tuple[str, str]] = []
    inside = False
    rest = iter(words)
    for word in rest:
        if not inside:
            inside = word == "--ros-args"
            if not inside:
                own.append(word)
        elif word == "--":
            inside = False
        elif word in _VALUED:
            ros.append((word, next(rest, "")))
    return own, ros


class Arguments:
    """Remaps and parameters for the nodes of a process."""

    def __init__(self, words: Any) -> None:
        self.remaps: list[tuple[str, str, str]] = []
        """Node (empty for any), from, to."""
        self.params: list[tuple[str, dict[str, Any]]] = []
        """By the pattern of nodes' names, in order."""
        for option, value in _split(words)[1]:
            if option in ("-r", "--remap"):
                source, _, target = value.partition(":=")
                node, colon, name = source.rpartition(":")
                self.remaps.append((node if colon and "://" not in source else "", name if colon else source, target))
            elif option in ("-p", "--param"):
                source, _, target = value.partition(":=")
                node, _, name = source.rpartition(":")
                self.params.append((node or "/**", {name: _parsed(target)}))
            elif option == "--params-file":
                self.params += _read(value)

    def remapped(self, name: str, node: str, default: str) -> str:
        """What a name (`__node`, or a full one) is remapped to for a node."""
        for of, source, target in self.remaps:
            if of in ("", node) and source == name:
                return target
        return default

    def of(self, full_name: str) -> dict[str, Any]:
        """The parameters for a node, later ones over earlier ones."""
        found: dict[str, Any] = {}
        for pattern, values in self.params:
            if _fits(pattern, full_name):
                found.update(values)
        return found


def _fits(pattern: str, full_name: str) -> bool:
    """Whether a name is meant: `*` is one step, `**` any number."""
    steps, words = full_name.strip("/").split("/"), pattern.strip("/").split("/")

    def match(at: int, of: int) -> bool:
        if of == len(words):
            return at == len(steps)
        if words[of] == "**":
            return any(match(more, of + 1) for more in range(at, len(steps) + 1))
        return at < len(steps) and words[of] in ("*", steps[at]) and match(at + 1, of + 1)

    return match(0, 0)


def _read(path: str) -> list[tuple[str, dict[str, Any]]]:
    """A file of parameters: what the launcher writes is JSON, which is YAML."""
    try:
        with open(path, encoding="utf-8") as file:
            data = _parsed(file.read())
    except OSError:
        return []
    found: list[tuple[str, dict[str, Any]]] = []

    def below(name: str, value: Any) -> None:
        if isinstance(value, dict):
            for key, each in value.items():
                if key == "ros__parameters":
                    found.append((name or "/**", dict(_flat("", each))))
                else:
                    below(f"{name}/{str(key).strip('/')}", each)

    below("", data)
    return found


def _flat(prefix: str, values: Any) -> Any:
    if isinstance(values, dict):
        for key, value in values.items():
            if isinstance(value, dict):
                yield from _flat(f"{prefix}{key}.", value)
            else:
                yield f"{prefix}{key}", value


def _parsed(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        pass
    try:
        return importlib.import_module("yaml").safe_load(text)
    except Exception:
        return text
