"""Arguments that an included file keeps of another include: in ROS 2 they stay set after it."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode, Use
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context


def leaked_argument(context: Context, node: LaunchNode, path: str) -> Use | None:
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
