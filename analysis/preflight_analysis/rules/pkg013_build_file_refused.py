"""PKG013: a build file that the build tools refuse."""

from __future__ import annotations

import ast
import os
import re
from collections.abc import Iterator

from preflight_analysis.documents.conflict_marks import conflict_mark
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.environment.build import BUILD_FILES, LISTS
from preflight_analysis.environment.cmake_syntax import commands
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.python_source import python_source
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import fix
from preflight_analysis.model.undefined_names import undefined_names
from preflight_analysis.rules.further_reading import PYTHON_PACKAGES, SETUP_CFG
from preflight_analysis.rules.packages import check_packages
from preflight_analysis.rules.rule import Rule

_SETUP = "setup.py"
_CFG = "setup.cfg"
_OPTION = re.compile(r"^(?P<name>(?:script-dir|install-scripts))[ \t]*=", re.MULTILINE)
"""Options of `ros2 pkg create`'s `setup.cfg` as they were written before setuptools 54.1."""
_WHOLE = frozenset(("ament_package", "ament_auto_package", "catkin_package"))
"""Commands that compare the name of the project with that of the package."""
_POSITIONAL = 1
"""Arguments that `glob.glob` takes without their names."""


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What is wrong with the build files of a package."""
    for name in (MANIFEST, *BUILD_FILES):
        path = package.manifest if name == MANIFEST else os.path.join(package.share, name)
        document = disk.text(path) if os.path.basename(path) == name else None
        if not isinstance(document, Document):
            continue
        conflict = conflict_mark(document.text)
        if conflict is not None:
            yield rule.claim(
                f"{name} has the marks of a merge conflict; the package does not build",
                document.location(conflict),
                subject=Subject("file", path),
            )
        elif name == MANIFEST:
            yield from _of_manifest(rule, document)
        elif name == LISTS:
            yield from _of_lists(rule, package, document)
        elif name == _SETUP and package.build_type == "ament_python":
            yield from _of_setup(rule, document)
        elif name == _CFG and package.build_type == "ament_python":
            yield from _of_cfg(rule, document)


def _of_manifest(rule: Rule, document: Document) -> Iterator[Finding]:
    for problem in parse_xml(document.path, document.text, lines=document.lines).problems[:1]:
        text = say("package.xml is not well-formed: {quoted}; its package is not found", quoted=problem.message)
        yield rule.claim(text, document.location(problem.span), subject=Subject("file", document.path))


def _of_lists(rule: Rule, package: Package, document: Document) -> Iterator[Finding]:
    found = commands(document.text)
    projects = [each for each in found if each.name == "project" and each.words]
    if len(projects) != 1 or not any(each.name in _WHOLE for each in found):
        return
    name = projects[0].words[0].text
    if name != package.name and "$" not in name:
        at = document.text.index(name, projects[0].at)
        yield rule.claim(
            f"project '{name}' has another name than its package '{package.name}' in package.xml; CMake stops",
            document.location(Span(at, at + len(name))),
            subject=Subject("package", package.name),
            kind="conflict",
            candidates=(package.name,),
        )


def _of_setup(rule: Rule, document: Document) -> Iterator[Finding]:
    source = python_source(document)
    if source.problem is not None:
        why, span = source.problem
        text = say("setup.py is not valid Python: {quoted}; the package does not build", quoted=why)
        yield rule.claim(text, document.location(span), subject=Subject("file", document.path))
        return
    for name, near, span, called in undefined_names(document):
        if called:
            edits = PythonWriter(document).rename_names(name, near) if near is not None else ()
            yield rule.claim(
                f"undefined name '{name}'; setup.py raises a NameError, and the package does not build"
                f"{did_you_mean(near)}",
                document.location(span),
                subject=Subject("name", name),
                kind="absent" if near is None else "near",
                candidates=(near,),
                fixes=fix(f"Replace '{name}' with '{near}'", edits, preferred=True),
            )
    if source.module is None:
        return
    modules, functions = _imported(source.module)
    for node in ast.walk(source.module):
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
            continue
        called_name = node.func.id
        if called_name in modules:
            yield rule.claim(
                f"'{called_name}' is a module and cannot be called; setup.py raises a TypeError, and the package does "
                f"not build; import it with `from {called_name} import {called_name}`",
                document.location(source.whole_span(node.func)),
                subject=Subject("name", called_name),
            )
        elif called_name in functions and len(node.args) > _POSITIONAL:
            yield rule.claim(
                f"'{called_name}' takes one argument and gets {len(node.args)}; setup.py raises a TypeError, and the "
                "package does not build",
                document.location(source.whole_span(node.func)),
                subject=Subject("name", called_name),
            )


def _imported(module: ast.Module) -> tuple[frozenset[str], frozenset[str]]:
    """The names that stand for a module of the same name and for nothing else, and those of `glob.glob`."""
    modules, functions, others = set[str](), set[str](), set[str]()
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names if alias.asname is None and "." not in alias.name}
        elif isinstance(node, ast.ImportFrom):
            names = {alias.asname or alias.name: alias.name for alias in node.names}
            functions |= {name for name, original in names.items() if node.module == original == "glob"}
            others |= names.keys()
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            others.add(node.id)
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            others.add(node.name)
    return frozenset(modules - others), frozenset(functions - modules)


def _of_cfg(rule: Rule, document: Document) -> Iterator[Finding]:
    for found in _OPTION.finditer(document.text):
        name = found["name"]
        yield rule.claim(
            f"option '{name}' in setup.cfg is deprecated: setuptools warns, and versions 78.0.0 and 78.0.1 refuse it; "
            f"write '{name.replace('-', '_')}'",
            document.location(Span(*found.span("name"))),
            subject=Subject("name", name),
            effect="note",
            candidates=(name.replace("-", "_"),),
        )


RULE = Rule(
    id="PKG013",
    name="build-file-refused",
    effect="stops-node",
    kind="invalid",
    sometimes=("note",),
    what="Checks `package.xml`, `CMakeLists.txt`, `setup.py` and `setup.cfg` for what the build tools refuse: marks of "
    "a merge conflict, XML that is not well-formed, a name in `project()` other than that of the package, options with "
    "dashes. In `setup.py`, for Python that does not parse or that raises an exception.",
    why="The package does not build, so none of its nodes and launch files is found. A package whose `package.xml` "
    "cannot be read is not built at all.",
    example="import glob\n\nsetup(data_files=[('share/robot/launch', glob('launch/*'))])",
    instead="from glob import glob\n\nsetup(data_files=[('share/robot/launch', glob('launch/*'))])",
    references=(PYTHON_PACKAGES, SETUP_CFG),
    check=check_packages(of_package),
    of_package=of_package,
)
