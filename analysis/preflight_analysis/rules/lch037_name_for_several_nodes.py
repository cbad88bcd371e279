"""LCH037: a name for a process that has several nodes (ROS 2)."""

from collections.abc import Iterable, Iterator

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import all_of, fix, include_chain, quoted
from preflight_analysis.rules.further_reading import COMMAND_LINE, REMAPPING_DESIGN
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph = context.graph
    for node, interface in zip(context.tree.nodes, graph.processes, strict=True) if graph is not None else ():
        if not node.named or len(interface.nodes) < 2:
            continue
        renamed = [each for each in interface.nodes if each.renamed]
        given = list(dict.fromkeys(each.given for each in renamed))
        if len(given) < 2:
            continue
        inferred = any(each.evidence.inferred for each in renamed)
        value = node.action.value("name")
        span = value.span if value is not None else node.action.kind_span
        leaf = names.leaf(node.name)
        spaces = {names.canonicalize(f"/{each.space}") for each in renamed} if node.namespace == "/" else {""}
        same = len(spaces) < len(renamed)
        what = f"duplicate node name '{node.name}'" if same and len(spaces) == 1 else f"each is '{leaf}'"
        seen = interface.source == "trace" and not interface.stand_ins
        yield rule.claim(
            f"'name' renames all nodes of this process ({quoted(given)}): {what}; to rename one, remap "
            f"'{given[0]}:__node' to '{leaf}' instead",
            context.location(node.location.file, span),
            subject=Subject("node", node.name),
            effect=None if same else "note",
            doubts=doubts(ASSUMED=inferred, FROM_SOURCE=not seen),
            related=include_chain(node.origin),
            fixes=_renamed_alone(context, node, given, leaf),
        )


def _renamed_alone(context: Context, node: LaunchNode, given: Iterable[str], name: str) -> Iterator[Fix]:
    """A remap for one of the nodes in the place of the name; which one was meant is for the user to say."""
    attribute, writer = node.action.attribute("name"), context.writer(node.location.file)
    if attribute is None or writer is None or attribute.value.text != name:
        return
    for each in given:
        remap = writer.add_remap(node.action, f"{each}:__node", name)
        yield from fix(f"Rename '{each}' only", all_of(writer.remove_attribute(attribute), remap))


RULE = Rule(
    id="LCH037",
    name="name-for-several-nodes",
    effect="misbehaves",
    kind="duplicate",
    sometimes=("note", Reason.ASSUMED, Reason.FROM_SOURCE),
    what="Checks for a `name` in the tag of a process with several nodes, if a run or the source shows that they "
    "take it.",
    why="launch passes `-r __node:=name` to the process, which renames each of its nodes. They share one name, and "
    "their parameters, services and lifecycles collide. Sections of parameter files with their original names apply "
    "to none of them.",
    example='<!-- makes the nodes front and rear -->\n<node pkg="scanners" exec="both" name="scanner"/>',
    instead='<node pkg="scanners" exec="both">\n  <remap from="front:__node" to="scanner"/>\n</node>',
    references=(
        REMAPPING_DESIGN,
        COMMAND_LINE,
    ),
    generations=(2,),
    check=_check,
    needs_graph=True,
)
