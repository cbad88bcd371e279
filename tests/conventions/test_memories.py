"""What is remembered is remembered by the database: see "What is remembered" in docs/architecture.md."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
# What runs inside the sandbox has a process of its own for each run.
SOURCES = sorted(
    path
    for folder in ("analysis", "server")
    for path in (ROOT / folder).rglob("*.py")
    if "agents" not in path.parts and "node_modules" not in path.parts
)
CACHES = {"cache", "lru_cache", "once_per_process"}
CONTAINERS = {
    "dict",
    "list",
    "set",
    "defaultdict",
    "OrderedDict",
    "WeakKeyDictionary",
    "WeakValueDictionary",
    "WeakSet",
}
OUTSIDE = {"open", "os", "Path", "shutil", "subprocess", "tempfile", "ctypes", "importlib"}
"""Names of what looks at the disk, the machine or other programs."""
ONCE_PER_PROCESS = {
    "_described",  # our own data
    "_agents_digest",  # our own code
    "_digest",  # by path and state of the file
    "_homes_of",  # by the home folder and the user
    "_in_place_of",  # a folder that the process removes at its end
    "_installed",  # with us
    "_lying_around",  # by the time of ten seconds, too
    "_masks_for",  # which home folders the machine has
    "_own_code",  # our own code
    "_package_of",  # of the command, which ends
    "places",  # what the kernel lets us do
    "to_uri",  # the encoding of names of files
    "version",  # likewise
}
"""Remembered although they look outside, and why that holds for the time of a process."""


def _name(node: ast.expr) -> str:
    node = node.func if isinstance(node, ast.Call) else node
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def _cached() -> Iterator[ast.FunctionDef]:
    for path in SOURCES:
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.FunctionDef) and CACHES & {_name(each) for each in node.decorator_list}:
                yield node


def test_only_functions_of_plain_values_have_caches_of_their_own() -> None:
    assert [each.name for each in _cached() if each.args.args and each.args.args[0].arg in ("self", "cls")] == []


def test_what_looks_outside_is_remembered_only_where_it_stays_so() -> None:
    found = {
        each.name for each in _cached() if OUTSIDE & {node.id for node in ast.walk(each) if isinstance(node, ast.Name)}
    }
    assert found == ONCE_PER_PROCESS


def test_modules_remember_nothing() -> None:
    found = []
    for path in SOURCES:
        tree = ast.parse(path.read_text())
        for statement in tree.body:
            value = getattr(statement, "value", None) if isinstance(statement, (ast.Assign, ast.AnnAssign)) else None
            if isinstance(statement, ast.AnnAssign) and ast.unparse(statement.annotation).startswith("Mapping"):
                continue  # nobody can write to it
            is_empty = isinstance(value, (ast.Dict, ast.List)) and not ast.unparse(value).strip("[]{}")
            if is_empty or (isinstance(value, ast.Call) and _name(value) in CONTAINERS and not value.args):
                found.append(f"{path.relative_to(ROOT)}:{statement.lineno}")
        found += [f"{path.relative_to(ROOT)}: global" for node in ast.walk(tree) if isinstance(node, ast.Global)]
    assert found == []
