"""Parameter files that nodes get and that have nothing for them, and the arguments that they have these of (ROS 2).

An argument that one include is passed stays set after it: a file that is included later and has a default for it gets
the value of the other one. So does a file whose includer declares an argument of that name.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.evaluation.tree import LaunchNode, Use
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Literal, Substitution
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.model.arguments import declarations
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import quoted
from preflight_analysis.model.sections import FileUse, Getter, SectionUse, param_files

_SHOWN = 3


class LostFile(NamedTuple):
    """A file that a node gets and of which nothing is for it. `meant` is the section that was to be, `leaked` the
    declaration of the argument that has the file of another include, or of an includer: `default` is then the file, by
    its name, that it would have without, in which there is a section for the node."""

    used: FileUse
    getter: Getter
    meant: SectionUse | None
    leaked: Use | None
    default: str = ""

    @property
    def sections(self) -> str:
        """What the file has instead, in quotes."""
        keys = [each.section.pattern for each in self.used.sections]
        return quoted(keys[:_SHOWN]) + (" and others" if len(keys) > _SHOWN else "")

    @property
    def leak(self) -> str:
        """Whose the file is, in words that go on from it; "" where it is the node's."""
        if self.leaked is None:
            return ""
        if self.default:
            said = f"which an including file declares, too: the default '{self.default}' here has no effect"
        else:
            said = "which another include was passed and which stays set"
        return f"the file is from '{self.leaked.name}', {said}"

    @property
    def advice(self) -> str:
        """What to do about that."""
        return "pass that one in the include" if self.default else "put that one into a group"

    @property
    def reason(self) -> str:
        """What is so, in words."""
        said = f"no section of this file applies to {self.getter.name}; it has sections for {self.sections}"
        return f"{said}; {self.leak}" if self.leak else said


@derived
def lost_files(context: Context) -> tuple[LostFile, ...]:
    """Those of a launch. A file for several nodes may have nothing for one of them, unless it is from elsewhere."""
    found: list[LostFile] = []
    for used in param_files(context):
        if any("$(" in each.section.pattern for each in used.sections):
            continue  # launch may make any name of a substitution
        own = [each for each in used.getters if not each.beside and each.node.kind != "simulated"]
        for getter, reached in used.lacking if used.sections else ():
            if reached:
                continue
            meant = used.meant_for(getter)
            leaked = _leaked_argument(context, getter.node, used.path) if meant is None else None
            default = ""
            if meant is None and leaked is None:
                leaked, default = _inherited_argument(context, getter.node, used.path) or (None, "")
            if len(own) == 1 or meant is not None or leaked is not None:
                found.append(LostFile(used, getter, meant, leaked, default))
    return tuple(found)


def _leaked_argument(context: Context, node: LaunchNode, path: str) -> Use | None:
    """The declaration of the argument by whose value a node gets a file, where another include was passed that value
    and no include on the way to the node. The origin ends where it was passed."""
    chain = set(node.origin[:-1])
    above = {location.file for location in chain}
    for use in _declarations(context).get((node.location.file, path), ()):
        setter = use.origin[-1]
        others = [each for each in context.tree.includes if each.args.get(use.name) == path]
        elsewhere = bool(others) and not any(chain.issuperset(each.origin) for each in others)
        if setter.file in above and elsewhere and _is_passed(context, use.name, setter):
            return use
    return None


def _inherited_argument(context: Context, node: LaunchNode, path: str) -> tuple[Use, str] | None:
    """The declaration of the argument by whose value a node gets a file, where that is set by the declaration of an
    includer; and the name of the file that the default of its own names, where that has a section for the node."""
    launch_file = context.launch_files.get(node.location.file)
    above = {location.file for location in node.origin[:-1]} - {node.location.file}
    for use in _declarations(context).get((node.location.file, path), ()):
        setter = use.origin[-1]
        if launch_file is None or setter.file not in above or _is_passed(context, use.name, setter):
            continue
        for tag in declarations(launch_file).get(use.name, ()):
            default = tag.value("default")
            name = os.path.basename(_last_text(default.parts)) if default is not None else ""
            if is_yaml(name) and _has_section(context, node, name):
                return use, name
    return None


def _last_text(parts: Sequence[Literal | Substitution]) -> str:
    """The text that a value ends with, be it the last word of a substitution that joins paths."""
    last = parts[-1] if parts else None
    if isinstance(last, Substitution):
        return _last_text(last.words[-1]) if last.words else ""
    return last.text if last is not None else ""


def _has_section(context: Context, node: LaunchNode, name: str) -> bool:
    """Whether the package of a node's launch file has a parameter file of this name with a section for the node."""
    package = package_around(context.environment, node.location.file)
    paths = files_in(context.disk, package.share, deep=True) if package is not None else ()
    documents = (context.disk.text(path) for path in paths if os.path.basename(path) == name)
    return any(
        read_param_file(document).reaching(node.name, composable=node.kind == "composable")
        for document in documents
        if isinstance(document, Document)
    )


@derived
def _declarations(context: Context) -> Mapping[tuple[str, str], list[Use]]:
    """The declared arguments whose values come from elsewhere, by their files and values."""
    found: dict[tuple[str, str], list[Use]] = {}
    for use in context.tree.uses:
        if use.kind == "declaration" and use.value is not None and use.origin:
            found.setdefault((use.location.file, use.value), []).append(use)
    return found


def _is_passed(context: Context, name: str, place: Location) -> bool:
    """Whether the value at a place is that of an argument of an include, not of a declaration."""
    before = [
        use
        for use in context.tree.uses
        if use.kind in ("declaration", "argument")
        and (use.name, use.location.file) == (name, place.file)
        and use.location.span.end <= place.span.start
    ]
    return bool(before) and max(before, key=lambda use: use.location.span.end).kind == "argument"
