"""The frontend for ROS 2's Python launch files as long as they are not run: what can be read from their text.

Only what is written out is read: literals, names that are assigned once, substitutions. The rest is not known, and
nothing is concluded from what is not there. What a run tells takes the place of it (`evaluation/ros2/python_runs.py`).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from preflight_analysis.documents.document import Document, SyntaxProblem
from preflight_analysis.documents.hash_comments import preflight_comments
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import Span
from preflight_analysis.launch import python_api
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution, Value
from preflight_analysis.launch.python_actions import actions_of
from preflight_analysis.launch.python_source import PythonSource, last_name
from preflight_analysis.launch.references import COMPONENT

_MAX_DEPTH = 40
_LONGEST = 60
"""Characters of code that is shown in the place of a value."""
_CONDITIONS = {"IfCondition": "if", "UnlessCondition": "unless"}
_NODE = ("pkg", "exec", "name", "namespace")
_ATTRIBUTES = {
    "arg": ("name", "default", "description"),
    "group": (),
    "include": ("file",),
    "let": ("name", "value"),
    "lifecycle_node": (*_NODE, "autostart"),
    "node": _NODE,
    "node_container": _NODE,
    "push_ros_namespace": ("namespace",),
    "set_env": ("name", "value"),
    "timer": ("period",),
}
"""The actions that are read, and what of them."""
_KINDS = {name: kind for name, kind in python_api.KINDS.items() if kind in _ATTRIBUTES}
_HOLDERS = ("group", "timer")


def read_ros2_python(source: Text) -> LaunchFile:
    """What the text says of the launch file. Any text gives one."""
    python = PythonSource(source.text, source.lines)
    problems = (SyntaxProblem(*python.problem),) if python.problem is not None else ()
    comments = preflight_comments(source.text, source.lines)
    document = Document(source.path, source.text, source.digest, comments, problems, source.lines)
    whole = Span(0, len(source.text))
    children = actions_of(_Reader(python).actions(), python, whole)
    root = Action("launch", Span(0, 0), (), children, (), Value("", whole, (Literal("", whole),)), Span(0, 0), whole)
    return LaunchFile(source.path, 2, root, document, partial=True, named=tuple(_named(python)))


def _named(source: PythonSource) -> Iterator[Substitution]:
    """The names of arguments, packages, variables and components, wherever they are written."""
    for node in source.nodes:
        found = _name_in(node) or _component_in(node)
        if found is not None:
            command, name, at = found
            span = source.span(at)
            yield Substitution(command, span, name, span, f"$({command} {name})", span, ((Literal(name, span),),))


def _component_in(node: ast.AST) -> tuple[str, str, ast.expr] | None:
    """`package/plugin` of a composable node, and the place of the plugin, if both are written out."""
    if not isinstance(node, ast.Call) or python_api.NODES.get(last_name(node.func)) != "composable_node":
        return None
    given = {k.arg: k.value for k in node.keywords}
    package, plugin = given.get("package"), given.get("plugin")
    if not isinstance(package, ast.Constant) or not isinstance(plugin, ast.Constant):
        return None
    names = [each.value for each in (package, plugin) if isinstance(each.value, str)]
    return (COMPONENT, "/".join(names), plugin) if len(names) == 2 else None


def _name_in(node: ast.AST) -> tuple[str, str, ast.expr] | None:
    """What kind of name a call or a subscript takes, and that name and its place if it is written out."""
    name: ast.expr | None = None
    command: str | None = None
    if isinstance(node, ast.Call):
        called = last_name(node.func)
        command, keyword = python_api.NAMES.get(called, (None, ""))
        if called == "get" and isinstance(node.func, ast.Attribute) and _is_configurations(node.func.value):
            command = "var"
        name = next((k.value for k in node.keywords if k.arg == keyword), node.args[0] if node.args else None)
    elif isinstance(node, ast.Subscript) and _is_configurations(node.value):
        command, name = "var", node.slice
    if command is None or not isinstance(name, ast.Constant) or not isinstance(name.value, str):
        return None
    return command, name.value, name


def _is_configurations(node: ast.expr) -> bool:
    return last_name(node) == "launch_configurations"


class _Reader:
    def __init__(self, source: PythonSource) -> None:
        self._source = source

    def actions(self) -> list[dict[str, Any]]:
        """All actions that are written, each once, those within others inside of them."""
        calls = [node for node in self._source.nodes if isinstance(node, ast.Call)]
        known = [call for call in calls if last_name(call.func) in _KINDS]
        known.sort(key=lambda call: (call.lineno, call.col_offset))
        inner = {id(each) for call in known for each in self._inside(call)}
        return [self._action(call, 0) for call in known if id(call) not in inner]

    def _inside(self, call: ast.Call) -> list[ast.Call]:
        """The actions that an action holds: written in it, or in variables that it names."""
        found: list[ast.Call] = []
        given = {k.arg: k.value for k in call.keywords}
        holder = given.get("actions", call.args[0] if call.args else None)
        if _KINDS[last_name(call.func)] not in _HOLDERS or holder is None:
            return found
        holder = self._source.resolved(holder)
        for each in holder.elts if isinstance(holder, (ast.List, ast.Tuple)) else ():
            inner = self._source.resolved(each)
            if isinstance(inner, ast.Call) and last_name(inner.func) in _KINDS:
                found.append(inner)
        return found

    def _action(self, call: ast.Call, depth: int) -> dict[str, Any]:
        kind = _KINDS[last_name(call.func)]
        made_by = python_api.made_by(kind)
        given = {k.arg: k.value for k in call.keywords if k.arg is not None}
        for name, node in zip(python_api.positional(made_by), call.args, strict=False):
            given.setdefault(name, node)
        parameters = {attribute: python_api.parameter_of(made_by, attribute) for attribute in _ATTRIBUTES[kind]}
        attributes = {ours: self._value(given[theirs]) for ours, theirs in parameters.items() if theirs in given}
        if "condition" in given:
            # Taken for unknown: whether it is executed is not for us to say.
            condition, of = self._source.resolved(given["condition"]), "if"
            if isinstance(condition, ast.Call) and condition.args and last_name(condition.func) in _CONDITIONS:
                of = _CONDITIONS[last_name(condition.func)]
                condition = condition.args[0]
            attributes[of] = [_unknown(condition)]
        children: list[dict[str, Any]] = []
        if kind == "arg" and "choices" in given and id(call) in self._source.sure:
            children = [{"k": "choice", "a": {"value": [c]}, "c": []} for c in self._texts(given["choices"])]
        if kind in _HOLDERS and depth < _MAX_DEPTH:
            children = [self._action(inner, depth + 1) for inner in self._inside(call)]
        if kind == "include" and "launch_arguments" in given:
            children = self._passed(given["launch_arguments"])
        if "parameters" in given and _ATTRIBUTES[kind][:2] == _NODE[:2]:
            children = self._parameter_files(given["parameters"])
        place = [call.lineno, call.col_offset]
        return {"k": kind, "n": last_name(call.func), "p": place, "a": attributes, "c": children}

    def _passed(self, node: ast.expr) -> list[dict[str, Any]]:
        """`{...}.items()`, or a list of pairs."""
        node = self._source.resolved(node)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "items":
            node = self._source.resolved(node.func.value)
        pairs: list[tuple[ast.expr | None, ast.expr]] = []
        if isinstance(node, ast.Dict):
            pairs = list(zip(node.keys, node.values, strict=True))
        elif isinstance(node, (ast.List, ast.Tuple)):
            pairs = [(p.elts[0], p.elts[1]) for p in node.elts if isinstance(p, ast.Tuple) and len(p.elts) == 2]
        return [
            {"k": "arg", "a": {"name": [key.value], "value": self._value(value)}, "c": []}
            for key, value in pairs
            if isinstance(key, ast.Constant) and isinstance(key.value, str)
        ]

    def _parameter_files(self, node: ast.expr) -> list[dict[str, Any]]:
        """The files among what a node has in `parameters`, whose paths are written out."""
        node = self._source.resolved(node)
        found: list[dict[str, Any]] = []
        for number, each in enumerate(node.elts if isinstance(node, (ast.List, ast.Tuple)) else ()):
            item = self._source.resolved(each)
            if isinstance(item, ast.Call) and last_name(item.func) == "ParameterFile" and item.args:
                item = item.args[0]
            path = self._value(item)
            if path and all(piece.get("s") != "python" for piece in path):
                found.append({"k": "param", "a": {"from": path}, "c": [], "part": number})
        return found

    def _texts(self, node: ast.expr) -> list[str]:
        node = self._source.resolved(node)
        elements = node.elts if isinstance(node, (ast.List, ast.Tuple)) else []
        texts = [each.value for each in elements if isinstance(each, ast.Constant)]
        found = [text for text in texts if isinstance(text, str)]
        return found if len(found) == len(elements) else []

    def _value(self, node: ast.expr, depth: int = 0) -> list[Any]:
        node = self._source.resolved(node)
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            return [{"x": node.value, "p": [node.lineno, node.col_offset, node.end_lineno, node.end_col_offset]}]
        if depth < _MAX_DEPTH and isinstance(node, (ast.List, ast.Tuple)):
            return [piece for each in node.elts for piece in self._value(each, depth + 1)]
        if depth < _MAX_DEPTH and isinstance(node, ast.Call):
            name = last_name(node.func)
            if name.endswith("LaunchDescriptionSource") and len(node.args) == 1:
                return self._value(node.args[0], depth + 1)
            if name == "join" and isinstance(node.func, ast.Attribute) and last_name(node.func.value) == "path":
                words = [self._value(each, depth + 1) for each in node.args]
                return [{"s": "path-join", "w": words, "n": name, "p": [node.lineno, node.col_offset]}]
            if name in python_api.COMMANDS:
                arguments = [*node.args, *(k.value for k in node.keywords)]
                if name == "PathJoinSubstitution" and arguments:
                    inner = self._source.resolved(arguments[0])
                    arguments = list(inner.elts) if isinstance(inner, (ast.List, ast.Tuple)) else arguments
                words = [self._value(each, depth + 1) for each in arguments]
                return [{"s": python_api.COMMANDS[name], "w": words, "n": name, "p": [node.lineno, node.col_offset]}]
        return [_unknown(node)]


def _unknown(node: ast.expr) -> dict[str, Any]:
    """What only a run tells, shown as it is written."""
    written = ast.unparse(node)
    shown = written if len(written) <= _LONGEST else f"{written[: _LONGEST - 3]}..."
    return {"s": "python", "w": [], "n": "", "p": None, "t": shown}
