"""What a launch file asks for below a package that is not there, and who has just that."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping

from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Package
from preflight_analysis.model.context import Context

_PATH = r"[\w.+-]+(?:/[\w.+-]+)+"
_ARGUMENT = re.compile(r"\$\((?:arg|var)\s+(\w+)\s*\)")
_PATH_IN_XML = r"(?:[\w.+/-]|\$\((?:arg|var)\s+\w+\s*\))+"
_WORDS = r"(?:\s*,\s*['\"][\w./+-]+['\"])+"
_NODE = re.compile(r"<node\b[^<>]*")
_PROGRAM = re.compile(r"""\b(?:type|exec)\s*=\s*["']([^"']+)["']""")
_WORD = re.compile(r"['\"]([\w./+-]+)['\"]")
_SHARE = r"(?:FindPackageShare|get_package_share_(?:directory|path))\(\s*(?:package(?:_name)?\s*=\s*)?['\"]{}['\"]\s*\)"


def has_what_is_asked_of(context: Context, file: str, name: str) -> tuple[Package, str] | None:
    """The one package of the workspace in which all paths and programs are that `file` asks for of package `name`, and
    the first of those paths; None where there is no such package, or no path that is written out."""
    document = context.documents.get(file)
    if not isinstance(document, Document):
        return None
    values = {arg.name: arg.value for arg in context.tree.args.values()} if file == context.tree.file else {}
    paths = sorted(set(asked_below(document.text, name, values)))
    # A launch file that hands over to another one mostly has its name.
    paths = [path for path in paths if os.path.basename(path) != os.path.basename(file)]
    if not paths:
        return None
    programs = _started_of(document.text, name)
    having = [
        package
        for package in context.environment.own_packages
        if all(_has(context, package, path, name) for path in paths)
        and all(_has_program(context, package.name, program) for program in programs)
    ]
    return (having[0], paths[0]) if len(having) == 1 else None


def _has(context: Context, package: Package, path: str, name: str) -> bool:
    """Whether a path is there in a package, other than a launch file that hands over to that of package `name`."""
    full = os.path.join(package.share, path)
    text = context.disk.text(full) if context.disk.is_file(full) else None
    hands_over = isinstance(text, Document) and path in asked_below(text.text, name, {})
    return context.disk.exists(full) and not hands_over


def lacks_what_is_asked_of(context: Context, file: str, name: str, other: Package) -> bool:
    """Whether `file` starts a program of package `name` that another package does not have, or asks for paths that are
    written out, of which the other has none."""
    document = context.documents.get(file)
    if not isinstance(document, Document):
        return False
    paths = set(asked_below(document.text, name, {}))
    if paths and not any(context.disk.exists(os.path.join(other.share, path)) for path in paths):
        return True
    return not all(_has_program(context, other.name, program) for program in _started_of(document.text, name))


def _started_of(text: str, name: str) -> set[str]:
    """The programs of the package that tags start, but for those that are not written out."""
    of_package = re.compile(rf"""\bpkg\s*=\s*["']{re.escape(name)}["']""")
    tags = (tag[0] for tag in _NODE.finditer(text) if of_package.search(tag[0]))
    return {program[1] for tag in tags if (program := _PROGRAM.search(tag)) is not None and "$" not in program[1]}


def _has_program(context: Context, package: str, program: str) -> bool:
    executables = context.executables
    return executables.is_build_target(package, program) or program in executables.names(package)


def asked_below(text: str, name: str, values: Mapping[str, str | None]) -> Iterator[str]:
    """Paths of two parts or more: in XML behind the substitution, with arguments that have one of `values`, in Python
    joined to the share folder, or to a variable that has it."""
    escaped = re.escape(name)
    for found in re.finditer(rf"\$\(find(?:-pkg-share)?\s+{escaped}\s*\)/({_PATH_IN_XML})", text):
        path = _ARGUMENT.sub(lambda argument: values.get(argument[1]) or argument[0], found[1])
        if "$(" in path:
            path = path.partition("$(")[0].rpartition("/")[0]
        if re.fullmatch(_PATH, path):
            yield path
    share = _SHARE.format(escaped)
    folders = [share]
    for line in re.finditer(rf"^[ \t]*(\w+)[ \t]*=[^\n=]*{share}[ \t)]*$", text, re.MULTILINE):
        folders.append(rf"\b{line[1]}\b")
    for folder in folders:
        for found in re.finditer(rf"{folder}\s*\)?({_WORDS})", text):
            path = "/".join(word.strip("/") for word in _WORD.findall(found[1]))
            if "/" in path:
                yield path
        for found in re.finditer(rf"{folder}\s*\+\s*['\"]/({_PATH})['\"]", text):
            yield found[1]
        for found in re.finditer(rf"{folder}\s*\)?({_WORDS})\s*\]\s*\)\s*,\s*['\"]/([\w./+-]+)['\"]", text):
            yield "/".join([*_WORD.findall(found[1]), found[2]])
