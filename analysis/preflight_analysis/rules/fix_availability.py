"""Whether a rule offers fixes. It is read from the rule's source, because a text beside the code would become wrong."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Literal, NamedTuple

from preflight_analysis.rules.rule import Rule

Availability = Literal["sometimes", "never"]
AVAILABILITY: Mapping[Availability, str] = {
    "sometimes": "A fix is available for some findings.",
    "never": "No fix is available.",
}
_HOME = "preflight_analysis.rules."
_MAKERS = ("claim", "problem_claim")
"""The functions that make findings; `fixes` is a keyword of each."""


def fix_availability(rule: Rule) -> Availability:
    """`sometimes`: where the writer of the file's format can make it. `never`: no finding of the rule is made with
    fixes."""
    checks = (rule.check, rule.of_package, rule.of_description, rule.unused_suppression, rule.left_out)
    entries = (each for each in checks if each is not None)
    sources = _Sources()
    for entry in entries:
        sources.reach(entry.__module__, entry.__qualname__.partition(".")[0])
    calls = (call for each in sources.reached.values() for call in _calls(each) if _makes_finding(call))
    return "sometimes" if any(each.arg == "fixes" for call in calls for each in call.keywords) else "never"


class _Sources:
    """The modules of the rules, as far as one of them reaches."""

    def __init__(self) -> None:
        self.reached: dict[tuple[str, str], ast.stmt] = {}
        self._modules: dict[str, _Module] = {}

    def reach(self, module: str, name: str) -> None:
        """Adds a definition of a module, and all definitions of the rules that it names."""
        if module not in self._modules:
            tree = ast.parse(inspect.getsource(import_module(module)))
            self._modules[module] = _Module(_definitions(tree), _imported(tree))
        there = self._modules[module]
        definition = there.definitions.get(name)
        if definition is None or (module, name) in self.reached:
            return
        self.reached[module, name] = definition
        for used in {node.id for node in ast.walk(definition) if isinstance(node, ast.Name)} - {*_MAKERS}:
            self.reach(there.imported.get(used, module), used)


class _Module(NamedTuple):
    definitions: Mapping[str, ast.stmt]
    imported: Mapping[str, str]


def _definitions(tree: ast.Module) -> Mapping[str, ast.stmt]:
    """The functions, classes and tables of a module."""
    found: dict[str, ast.stmt] = {}
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.Assign):
            found |= {target.id: node for target in node.targets if isinstance(target, ast.Name)}
    return found


def _imported(tree: ast.Module) -> Mapping[str, str]:
    """The names that a module imports from the rules, each with its module."""
    imports = (node for node in tree.body if isinstance(node, ast.ImportFrom))
    of_rules = ((each, each.module) for each in imports if each.module and each.module.startswith(_HOME))
    return {alias.name: home for each, home in of_rules for alias in each.names}


def _calls(definition: ast.stmt) -> Iterator[ast.Call]:
    return (node for node in ast.walk(definition) if isinstance(node, ast.Call))


def _makes_finding(call: ast.Call) -> bool:
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    return name in _MAKERS
