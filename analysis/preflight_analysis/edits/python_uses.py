"""For how many things a text stands that is written in a Python launch file.

Through variables, loops and the functions of the file it may go to several, and an edit that is right for one of them
need not be for another.
"""

from __future__ import annotations

import ast
from collections.abc import Hashable, Iterator, Mapping, Sequence

from preflight_analysis.launch.python_source import last_name

_MAX_DEPTH = 12
_PACKAGE = "package"
_OF_PACKAGES = frozenset(
    (
        *("get_package_share_directory", "get_package_share_path", "get_package_prefix", "FindPackageShare"),
        *("FindPackagePrefix", "FindPackage"),
    )
)
_HOLDING = (ast.List, ast.Tuple, ast.Set, ast.Dict, ast.Starred, ast.IfExp, ast.BoolOp)
_LOOPS = (ast.For, ast.comprehension)


class PythonUses:
    """The uses of what is written in one file. `parents` are the nodes around each, by `id`."""

    def __init__(self, nodes: Sequence[ast.AST], parents: Mapping[int, ast.AST]) -> None:
        self._parents = parents
        self._loads: dict[str, list[ast.Name]] = {}
        self._functions: dict[str, ast.FunctionDef] = {}
        self._calls: dict[str, list[ast.Call]] = {}
        for node in nodes:
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
                self._loads.setdefault(node.id, []).append(node)
            elif isinstance(node, ast.FunctionDef):
                self._functions[node.name] = node
            elif isinstance(node, ast.Call):
                self._calls.setdefault(last_name(node.func), []).append(node)

    def is_for_one(self, node: ast.expr) -> bool:
        """Whether what is written there stands for one thing: a package is the same wherever it is named."""
        return len(set(self._of(node, 0))) <= 1

    def _of(self, node: ast.AST, depth: int) -> Iterator[Hashable]:
        parent = self._parents.get(id(node))
        if parent is None or depth > _MAX_DEPTH:
            yield from (id(node), None)  # it may be anything
        elif isinstance(parent, ast.keyword):
            yield from self._passed(self._parents.get(id(parent)), parent.arg, parent, depth)
        elif isinstance(parent, ast.Call) and parent.func is not node:
            yield from self._passed(parent, parent.args.index(node), node, depth)  # type: ignore[arg-type]
        elif isinstance(parent, _HOLDING):
            yield from self._of(parent, depth + 1)
        elif isinstance(parent, (ast.Assign, ast.AnnAssign)):
            for target in parent.targets if isinstance(parent, ast.Assign) else [parent.target]:
                yield from self._named(target, node, depth)
        elif isinstance(parent, _LOOPS) and parent.iter is node:
            yield from self._named(parent.target, node, depth)
        elif isinstance(parent, ast.arguments):
            yield from self._default(parent, node, depth)
        elif isinstance(parent, ast.Return):
            function = self._function_around(parent)
            for call in self._calls.get(function.name, ()) if function is not None else ():
                yield from self._of(call, depth + 1)
        else:
            yield id(parent)

    def _passed(
        self, call: ast.AST | None, parameter: str | int | None, given: ast.AST, depth: int
    ) -> Iterator[Hashable]:
        """What an argument of a call is for."""
        name = last_name(call.func) if isinstance(call, ast.Call) else ""
        function = self._functions.get(name)
        if function is not None:
            names = [each.arg for each in (*function.args.posonlyargs, *function.args.args)]
            if isinstance(parameter, int) and parameter < len(names):
                parameter = names[parameter]
            yield from self._loaded(parameter, depth, function) if isinstance(parameter, str) else (id(given), None)
        elif parameter == _PACKAGE or name in _OF_PACKAGES:
            yield _PACKAGE
        else:
            yield id(given)

    def _named(self, target: ast.expr, value: ast.AST, depth: int) -> Iterator[Hashable]:
        """What the names are for that get a value, or some of it each."""
        names = [each.id for each in ast.walk(target) if isinstance(each, ast.Name)]
        if not isinstance(target, (ast.Name, ast.Tuple, ast.List)):
            yield from (id(value), None)
        elif isinstance(target, ast.Name):
            yield from self._loaded(target.id, depth, self._function_around(target))
        else:
            # Each name gets something else: of one literal it is one of them.
            within = self._function_around(target)
            found = [frozenset(self._loaded(name, depth, within)) for name in names]
            yield from max(found, key=len, default=())

    def _default(self, given: ast.arguments, value: ast.AST, depth: int) -> Iterator[Hashable]:
        by_place = [*given.posonlyargs, *given.args][-len(given.defaults) :] if given.defaults else []
        by_name = zip(given.kwonlyargs, given.kw_defaults, strict=True)
        for parameter, default in (*zip(by_place, given.defaults, strict=True), *by_name):
            if default is value:
                yield from self._loaded(parameter.arg, depth, self._function_around(given))

    def _loaded(self, name: str, depth: int, within: ast.FunctionDef | None) -> Iterator[Hashable]:
        inside = None if within is None else {id(each) for each in ast.walk(within)}
        for each in self._loads.get(name, ()):
            if inside is None or id(each) in inside:
                yield from self._of(each, depth + 1)

    def _function_around(self, node: ast.AST | None) -> ast.FunctionDef | None:
        while node is not None and not isinstance(node, ast.FunctionDef):
            node = self._parents.get(id(node))
        return node
