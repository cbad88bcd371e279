"""Parameter files that nodes get and that have nothing for them, and the arguments that they have these of (ROS 2).

An argument that one include is passed stays set after it: a file that is included later and has a default for it gets
the value of the other one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode, Use
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import quoted
from preflight_analysis.model.sections import FileUse, Getter, SectionUse, param_files

_SHOWN = 3


class LostFile(NamedTuple):
    """A file that a node gets and of which nothing is for it. `meant` is the section that was to be, `leaked` the
    declaration of the argument that has the file of another include."""

    used: FileUse
    getter: Getter
    meant: SectionUse | None
    leaked: Use | None

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
        return f"the file is from '{self.leaked.name}', which another include was passed and which stays set"

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
            if len(own) == 1 or meant is not None or leaked is not None:
                found.append(LostFile(used, getter, meant, leaked))
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
