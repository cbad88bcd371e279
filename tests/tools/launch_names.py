"""Lists the public names of `launch`, `launch_ros`, `launch_xml` and `launch_yaml` with what they take, from source.

`python tests/tools/launch_names.py --source launch=COMMIT --source launch_ros=COMMIT FOLDER...` prints the list of a
version; the folders are its checkouts (`git -C launch archive COMMIT | tar x -C FOLDER`). Nothing of them is imported.
`fixtures/ros2/launch_names/` has the lists of Humble, Jazzy and of Rolling as Kilted began; what came later, and was at
hand in single files and pages only, is in its `newer.json` by hand, with where each was read.
"""

from __future__ import annotations

import argparse
import ast
import json
import sys
from collections.abc import Iterator
from pathlib import Path

PACKAGES = ("launch", "launch_ros", "launch_xml", "launch_yaml")
Modules = dict[str, ast.Module]


def main() -> None:
    """Read the sources, print the list."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", action="append", default=[], help="REPOSITORY=COMMIT, for the record")
    parser.add_argument("folders", nargs="+", type=Path)
    options = parser.parse_args()
    modules: Modules = {}
    for folder in options.folders:
        modules.update(_modules(folder))
    sources = dict(sorted(each.split("=", 1) for each in options.source))
    names = {
        module: {name: _signature(modules, module, name) for name in _public(modules[module])} for module in modules
    }
    found = {module: dict(sorted(names[module].items())) for module in sorted(names) if names[module]}
    json.dump({"names": found, "sources": sources}, sys.stdout, indent=1)
    print()


def _modules(folder: Path) -> Modules:
    found: Modules = {}
    for package in PACKAGES:
        for root in {folder / package, folder / package / package}:
            for path in root.rglob("*.py") if (root / "__init__.py").exists() else ():
                parts = [package, *path.relative_to(root).with_suffix("").parts]
                if "conftest" not in parts:
                    name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
                    found[name] = ast.parse(path.read_text())
    return found


def _public(module: ast.Module) -> list[str]:
    """What `__all__` names, as far as there is such a thing, and what is defined here."""
    found: dict[str, None] = {}
    bound = {node.name for node in ast.walk(module) if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.alias))}
    bound |= {node.id for node in ast.walk(module) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
    for node in module.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            found[node.name] = None
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = [target.id for target in targets if isinstance(target, ast.Name)]
            if names == ["__all__"] and isinstance(node.value, (ast.List, ast.Tuple)):
                found.update((e.value, None) for e in node.value.elts if isinstance(e, ast.Constant))
            found.update((name, None) for name in names)
    return [name for name in found if name in bound and not name.startswith("_")]


def _signature(modules: Modules, module: str, name: str, depth: int = 0) -> str | None:
    """The parameters of a function, or of the class that says how it is made; None of anything else."""
    tree = modules.get(module)
    for node in tree.body if tree is not None and depth < 20 else ():
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.name == name:
            return ", ".join(_parameters(node.args))
        if isinstance(node, ast.ClassDef) and node.name == name:
            for each in node.body:
                if isinstance(each, ast.FunctionDef) and each.name == "__init__":
                    return ", ".join(list(_parameters(each.args))[1:])
            bases = [base.id for base in node.bases if isinstance(base, ast.Name)]
            return next((s for base in bases if (s := _signature(modules, module, base, depth + 1)) is not None), None)
        if isinstance(node, ast.ImportFrom) and any((alias.asname or alias.name) == name for alias in node.names):
            above = module if f"{module}.{node.module}" in modules else module.rpartition(".")[0]
            for _ in range(node.level - 1):
                above = above.rpartition(".")[0]
            target = f"{above}.{node.module}" if node.level else str(node.module)
            original = next(alias.name for alias in node.names if (alias.asname or alias.name) == name)
            return _signature(modules, target, original, depth + 1)
    return None


def _parameters(args: ast.arguments) -> Iterator[str]:
    """As they are written, `=` behind those that may be left out."""
    plain = [*args.posonlyargs, *args.args]
    optional = len(plain) - len(args.defaults)
    for index, arg in enumerate(plain):
        yield arg.arg + ("=" if index >= optional else "")
    if args.vararg is not None:
        yield "*" + args.vararg.arg
    elif args.kwonlyargs:
        yield "*"
    for arg, default in zip(args.kwonlyargs, args.kw_defaults, strict=True):
        yield arg.arg + ("=" if default is not None else "")
    if args.kwarg is not None:
        yield "**" + args.kwarg.arg


if __name__ == "__main__":
    main()
