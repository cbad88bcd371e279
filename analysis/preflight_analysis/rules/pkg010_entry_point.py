"""PKG010: an entry point of setup.py that cannot be loaded (ROS 2)."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.edits.python import PythonWriter
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import python_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.package_files import files_in, module_file
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import fix
from preflight_analysis.model.python_definitions import names_of_module, runs_when_imported
from preflight_analysis.rules.further_reading import ENTRY_POINTS, PYTHON_PACKAGES
from preflight_analysis.rules.packages import check_packages, line_of
from preflight_analysis.rules.rule import Rule

if TYPE_CHECKING:
    from preflight_analysis.environment.setup_py import Called

_OBJECT = re.compile(r"(?P<module>[\w.]+) ?(?:: ?(?P<function>[\w.]+) ?)?(?:\[[^\[\]]*\])?")
"""What setuptools takes behind the equals sign, with single blanks."""
_INIT = "__init__.py"


def of_package(rule: Rule, disk: Disk, environment: Environment, package: Package) -> Iterator[Finding]:
    """What is wrong with the entry points of a package."""
    build = python_build(disk, package) if package.build_type == "ament_python" else None
    document = disk.text(build.file) if build is not None and build.file is not None else None
    if build is None or build.called is None or not isinstance(document, Document):
        return
    not_installed = set[str]()
    for text, line in build.called.entries:
        name, _, given = (part.strip() for part in text.partition("="))
        found = _OBJECT.fullmatch(" ".join(given.split())) if name else None
        if found is None:
            yield rule.claim(
                _malformed(text), line_of(document, line), subject=Subject("executable", text.strip()), kind="invalid"
            )
            continue
        module, function = found["module"], found["function"]
        about, place = Subject("executable", name), line_of(document, line, module)
        file = module_file(package.share, module, disk)
        if file is None:
            yield from _of_missing_module(
                rule, disk, environment, package, build.called, _Entry(name, module, document, place)
            )
            continue
        source = disk.text(file)
        known = names_of_module(source) if isinstance(source, Document) else None
        below = os.path.relpath(file, package.share)
        if isinstance(source, Document) and runs_when_imported(source):
            pass  # It starts as it is imported, and goes on when that has ended.
        elif function is None:
            message = f"entry point '{name}' names no function: it is written `{name} = {module}:main`"
            yield rule.claim(message, place, subject=about, kind="invalid")
        elif known is not None and function.partition(".")[0] not in known:
            near = nearest(function, known) or ("main" if "main" in known else None)
            place = line_of(document, line, f":{function}") if f":{function}" in text else place
            yield rule.claim(
                f"entry point '{name}': {below} has no function '{function}'{did_you_mean(near)}",
                place,
                subject=about,
                kind="absent" if near is None else "near",
                candidates=(near,),
                fixes=_renamed(document, place, f":{function}", f":{near}") if near is not None else (),
            )
        parent = module if below.endswith(_INIT) else module.rpartition(".")[0]
        if _is_left_out(build.called, module, parent) and parent not in not_installed:
            not_installed.add(parent)
            why = _why_left_out(disk, package, build.called, file, parent)
            yield rule.claim(
                f"module '{module}' of entry point '{name}' is not installed: {why}",
                line_of(document, line, module),
                subject=Subject("module", parent or module),
                # With links to the source it is found there.
                doubts=doubts(UNSEEN=True),
            )


def _malformed(text: str) -> str:
    if text.count("=") > 1 and text.count(":") > 1:
        return f"entry points run together, a comma is missing between them: '{text.strip()}'"
    return f"entry point '{text.strip()}' cannot be read; it is written `name = package.module:function`"


class _Entry(NamedTuple):
    """An entry point: its name, the module that it names, and where that stands."""

    name: str
    module: str
    document: Document
    place: Location


def _of_missing_module(
    rule: Rule, disk: Disk, environment: Environment, package: Package, called: Called, entry: _Entry
) -> Iterator[Finding]:
    name, module, document, place = entry
    top = module.partition(".")[0]
    there = sorted(_modules(disk, package))
    tops = {each.partition(".")[0] for each in there}
    is_of_others = top != package.name and top in environment.packages
    if top not in tops and (called.modules is None or top in called.modules or is_of_others):
        return
    relative = f"{module.replace('.', os.sep)}.py"
    if is_ignored(disk, os.path.join(package.share, relative)):
        return
    stem = module.rpartition(".")[2]
    near = module.removesuffix(".py") if module.removesuffix(".py") in there else nearest(module, there)
    inside = [each for each in there if each.partition(".")[0] in (top, package.name)]
    like = [each for each in inside if f"_{stem}_" in f"_{each.rpartition('.')[2]}_"]
    near = near or (like[0] if len(like) == 1 else None)
    yield rule.claim(
        f"entry point '{name}': there is no module '{module}' in package '{package.name}'{did_you_mean(near)}",
        place,
        subject=Subject("executable", name),
        kind="absent" if near is None else "near",
        doubts=doubts(UNSEEN=top not in tops and near is None),
        candidates=(near,),
        fixes=_renamed(document, place, module, near) if near is not None else (),
    )


def _modules(disk: Disk, package: Package) -> Iterator[str]:
    for path in files_in(disk, package.share, deep=True):
        below = os.path.relpath(path, package.share).removeprefix(f"src{os.sep}")
        parts = below.removesuffix(".py").split(os.sep)
        if below.endswith(".py") and all(part.isidentifier() for part in parts) and parts != ["setup"]:
            yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _is_left_out(called: Called, module: str, parent: str) -> bool:
    return called.modules is not None and module not in called.modules and parent not in called.modules


def _why_left_out(disk: Disk, package: Package, called: Called, file: str, parent: str) -> str:
    folder, lacking = os.path.dirname(file), None
    while len(folder) > len(package.share) and os.path.basename(folder) != "src":
        lacking = folder if not disk.is_file(os.path.join(folder, _INIT)) else lacking
        folder = os.path.dirname(folder)
    if called.finds and lacking is not None:
        below = os.path.relpath(lacking, package.share)
        return f"find_packages does not find a folder without {_INIT}, and {below} has none"
    return f"`packages` in setup.py does not list '{parent}'" if parent else "`py_modules` in setup.py does not list it"


def _renamed(document: Document, place: Location, old: str, new: str) -> tuple[Fix, ...]:
    span = place.span
    if document.text[span.start : span.end] != old:
        return ()
    edits = PythonWriter(document).replace(Span(span.start, span.end), new)
    return fix(f"Change '{old}' to '{new}'", edits, preferred=True) if edits else ()


RULE = Rule(
    id="PKG010",
    name="entry-point-not-loadable",
    effect="stops-node",
    kind="absent",
    sometimes=(Reason.UNSEEN,),
    what="Checks the `console_scripts` of `setup.py`: for a module or function that is not there, a module that "
    "`packages` leaves out, and entry points between which a comma is missing.",
    why="The package may build all the same. The executable then ends at once with `ModuleNotFoundError` or "
    "`AttributeError`.",
    example="entry_points={'console_scripts': ['driver = robot.drivr:main']}",
    instead="entry_points={'console_scripts': ['driver = robot.driver:main']}",
    references=(ENTRY_POINTS, PYTHON_PACKAGES),
    generations=(2,),
    check=check_packages(of_package),
    of_package=of_package,
)
