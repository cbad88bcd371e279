"""Whether a rule offers fixes. It is read from the rule's source, because a text beside the code would become wrong."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from typing import Literal

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
    entries = (each for each in (rule.check, rule.unused_suppression, rule.left_out) if each is not None)
    reached: dict[tuple[str, str], ast.stmt] = {}
    for entry in entries:
        _reach(entry.__module__, entry.__qualname__.partition(".")[0], reached)
    calls = (call for each in reached.values() for call in _calls(each) if _makes_finding(call))
    return "sometimes" if any(each.arg == "fixes" for call in calls for each in call.keywords) else "never"


def _reach(module: str, name: str, reached: dict[tuple[str, str], ast.stmt]) -> None:
    """Adds a definition of a module, and all definitions of the rules that it names."""
    definition = _definitions(module).get(name)
    if definition is None or (module, name) in reached:
        return
    reached[module, name] = definition
    imported = _imported(module)
    for used in {node.id for node in ast.walk(definition) if isinstance(node, ast.Name)} - {*_MAKERS}:
        _reach(imported.get(used, module), used, reached)


@cache
def _definitions(module: str) -> Mapping[str, ast.stmt]:
    """The functions, classes and tables of a module."""
    found: dict[str, ast.stmt] = {}
    for node in _tree(module).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.Assign):
            found |= {target.id: node for target in node.targets if isinstance(target, ast.Name)}
    return found


@cache
def _imported(module: str) -> Mapping[str, str]:
    """The names that a module imports from the rules, each with its module."""
    imports = (node for node in _tree(module).body if isinstance(node, ast.ImportFrom))
    of_rules = ((each, each.module) for each in imports if each.module and each.module.startswith(_HOME))
    return {alias.name: home for each, home in of_rules for alias in each.names}


def _calls(definition: ast.stmt) -> Iterator[ast.Call]:
    return (node for node in ast.walk(definition) if isinstance(node, ast.Call))


def _makes_finding(call: ast.Call) -> bool:
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    return name in _MAKERS


@cache
def _tree(module: str) -> ast.Module:
    return ast.parse(inspect.getsource(import_module(module)))
