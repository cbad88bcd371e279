"""`nav2_common.launch`, where navigation2 is neither installed nor in the workspace.

What each does is what ros-navigation/navigation2 has in nav2_common/nav2_common/launch/: rewritten_yaml.py,
replace_string.py, has_node_params.py, launch_config_as_bool.py, parse_multirobot_pose.py (Humble).
"""

from __future__ import annotations

import importlib
import tempfile
from typing import Any, Iterator, Optional

from ..anything import Anything, is_unknown, unknown_text
from .base import LaunchContext, Substitution, normalize_to_list_of_substitutions, perform_substitutions
from .substitutions import LaunchConfiguration

_MAX_TEXT = 10_000_000
_MARK = "ros__parameters"
_TRUE = ("true", "1", "yes", "on")


def _performed(context: LaunchContext, given: dict[str, list[Substitution]]) -> dict[str, str]:
    return {name: perform_substitutions(context, value) for name, value in given.items()}


def _normalized(given: Any) -> dict[str, list[Substitution]]:
    return {name: normalize_to_list_of_substitutions(given[name]) for name in given or ()}


class _OfFile(Substitution):
    def __init__(self, source_file: Any) -> None:
        self._source_file = normalize_to_list_of_substitutions(source_file)

    @property
    def name(self) -> list[Substitution]:
        return self._source_file

    def describe(self) -> str:
        return ""

    def _path(self, context: LaunchContext) -> str:
        return perform_substitutions(context, self._source_file)

    def _data(self, path: str) -> Any:
        with open(path) as file:
            return importlib.import_module("yaml").safe_load(file)


class RewrittenYaml(_OfFile):
    def __init__(
        self,
        source_file: Any,
        param_rewrites: Any,
        root_key: Any = None,
        key_rewrites: Any = None,
        value_rewrites: Any = None,
        convert_types: bool = False,
        out_dir: Any = None,
    ) -> None:
        super().__init__(source_file)
        self._param_rewrites, self._keys = _normalized(param_rewrites), _normalized(key_rewrites)
        self._values, self._convert_types = _normalized(value_rewrites), convert_types
        self._root = None if root_key is None else normalize_to_list_of_substitutions(root_key)

    def perform(self, context: LaunchContext) -> str:
        data = self._data(self._path(context))
        if isinstance(data, Anything):
            return str(data)
        params, values = _performed(context, self._param_rewrites), _performed(context, self._values)
        _replace_leaves(data, {name: self._converted(text) for name, text in params.items()})
        known = dict(_leaves(data, ""))
        for path, text in params.items():
            if path in known or _MARK in path.split("."):
                _set(data, path.split("."), self._converted(text))
        _rename(data, _performed(context, self._keys))
        data = self._replaced(data, values)
        root = perform_substitutions(context, self._root) if self._root is not None else ""
        with tempfile.NamedTemporaryFile("w", delete=False) as file:
            importlib.import_module("yaml").dump({root: data} if root else data, file)
        return file.name

    def _converted(self, text: str) -> Any:
        if self._convert_types:
            try:
                return float(text) if "." in text else int(text)
            except ValueError:
                pass
        return {"true": True, "false": False}.get(text.lower(), text)

    def _replaced(self, value: Any, values: dict[str, str]) -> Any:
        if isinstance(value, dict):
            return {key: self._replaced(each, values) for key, each in value.items()}
        if isinstance(value, list):
            return [self._replaced(each, values) for each in value]
        return self._converted(values[str(value)]) if str(value) in values else value


def _replace_leaves(data: Any, rewrites: dict[str, Any]) -> None:
    """Of each key that has a new value, wherever it is; lists are not looked into."""
    for key in data if isinstance(data, dict) else ():
        _replace_leaves(data[key], rewrites)
        if key in rewrites:
            data[key] = rewrites[key]


def _leaves(data: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Each value with the keys and indices that lead to it."""
    below = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else None
    if below is None:
        yield path, data
    for key, value in below or ():
        yield from _leaves(value, f"{path}.{key}" if path else str(key))


def _set(data: Any, keys: list[str], value: Any) -> None:
    for key in keys[:-1]:
        data = data[int(key)] if isinstance(data, list) else data.setdefault(key, {})
    data[int(keys[-1]) if isinstance(data, list) else keys[-1]] = value


def _rename(data: dict[str, Any], names: dict[str, str]) -> None:
    for key in list(data) if names else ():
        value = data[key]
        if key in names:
            data[names[key]] = data.pop(key)
        if isinstance(value, dict):
            _rename(value, names)


class ReplaceString(_OfFile):
    def __init__(self, source_file: Any, replacements: Any, condition: Any = None) -> None:
        super().__init__(source_file)
        self._replacements, self._condition = _normalized(replacements), condition

    @property
    def condition(self) -> Any:
        return self._condition

    def perform(self, context: LaunchContext) -> str:
        path = self._path(context)
        if self._condition is not None and not self._condition.evaluate(context):
            return path
        with open(path) as file:
            text = file.read()
        for old, new in _performed(context, self._replacements).items():
            if len(text) + text.count(old) * len(new) > _MAX_TEXT:
                raise ValueError("the file becomes too large")
            text = text.replace(old, new)
        with tempfile.NamedTemporaryFile("w", delete=False) as written:
            written.write(text)
        return written.name


class HasNodeParams(_OfFile):
    def __init__(self, source_file: Any, node_name: str) -> None:
        super().__init__(source_file)
        self._node = node_name

    def perform(self, context: LaunchContext) -> str:
        path = self._path(context)
        if is_unknown(path):
            return unknown_text(f"what {self._node} has in {path}")
        data = self._data(path)
        return str(isinstance(data, dict) and self._node in data)


class LaunchConfigAsBool(Substitution):
    def __init__(self, name: str) -> None:
        self._config = LaunchConfiguration(name)

    def perform(self, context: LaunchContext) -> str:
        text = self._config.perform(context)
        return text if is_unknown(text) else str(text.strip().lower() in _TRUE)


class ParseMultiRobotPose(Substitution):
    """Poses come from the command line, which has none here."""

    def __init__(self, target_argument: Any) -> None:
        self._argument = target_argument

    def value(self, context: Optional[LaunchContext] = None) -> dict[str, Any]:
        return {}
