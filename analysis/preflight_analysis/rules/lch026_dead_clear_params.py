"""LCH026: clear_params that deletes nothing of what it seems to."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Origin
from preflight_analysis.evaluation.tree import LaunchTree, Param, Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.model.syntax import Tag, Tags
from preflight_analysis.rules.further_reading import ROSLAUNCH_ARCHITECTURE, ROSLAUNCH_GROUP
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tree = context.tree
    if not tree.clear_params:
        return
    uses = [use for use in tree.uses if use.kind == "clear_params" and use.value is not None]
    tags = Tags(context.launch_files)
    for use in uses:
        tag = tags.at(use.origin[-1])
        namespace = use.value or "/"
        if tag is None or tag.action.kind in ("node", "test"):
            # A node's own parameters are loaded before its tag as often as in it: nobody expects them to go.
            continue
        below = [param for param in tree.all_params if param.name.startswith(namespace)]
        if not below and not _lives(tree, namespace):
            if tree.complete:
                yield rule.claim(
                    f"clear_params has no effect: this launch has no node or parameter below '{namespace}'",
                    use.location,
                    subject=Subject("name", namespace),
                    related=include_chain(use.origin),
                )
            continue
        staying = [param for param in below if _set_before(context, param.origin, use, tag)]
        if staying:
            yield _kept(rule, use, namespace, staying)


def _lives(tree: LaunchTree, namespace: str) -> bool:
    return any(node.name.startswith(namespace) or node.name == namespace.rstrip("/") for node in tree.nodes)


def _set_before(context: Context, origin: Origin, use: Use, tag: Tag) -> bool:
    """Whether a parameter is set earlier in the launch than the tag, and not inside of it."""
    here = (*use.origin[:-1], context.location(use.location.file, tag.action.span))
    for mine, other in zip(origin, here, strict=False):
        if mine.file != other.file:
            return False
        if mine.span.end <= other.span.start:
            return True
        if mine.span != other.span:
            return False
    return False


def _kept(rule: Rule, use: Use, namespace: str, staying: list[Param]) -> Finding:
    shown = quoted(param.name for param in staying[:3])
    more = f" and {len(staying) - 3} more" if len(staying) > 3 else ""
    return rule.claim(
        f"clear_params does not clear {shown}{more}: roslaunch deletes '{namespace}' before it sets any parameter",
        use.location,
        subject=Subject("name", namespace),
        related=(*(Related(f"'{p.name}' is set here", p.origin[-1]) for p in staying[:3]), *include_chain(use.origin)),
    )


RULE = Rule(
    id="LCH026",
    name="dead-clear-params",
    effect="style",
    kind="unused",
    what="Checks for `clear_params` of a group or include whose namespace has neither a node nor a parameter. It "
    "also checks for a namespace in which an earlier tag of the launch sets parameters: those stay.",
    why="`roslaunch` deletes the namespaces first, whatever the order of the tags, and sets parameters afterwards. "
    "It deletes only what an earlier launch has left behind.",
    example='<param name="/arm/rate" value="10"/>\n<group ns="arm" clear_params="true">\n'
    '  <node pkg="arm" type="driver" name="driver"/>\n</group>',
    instead='<group ns="arm" clear_params="true">\n  <param name="rate" value="10"/>\n'
    '  <node pkg="arm" type="driver" name="driver"/>\n</group>',
    references=(
        ROSLAUNCH_GROUP,
        ROSLAUNCH_ARCHITECTURE,
    ),
    generations=(1,),
    check=_check,
    every_root=True,
)
