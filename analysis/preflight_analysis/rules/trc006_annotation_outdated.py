"""TRC006: an annotation says something else than the run of its node showed."""

from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.graph.outdated import Outdated, bring_up_to_date, compare, remove_item
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import fix, include_chain, replacement
from preflight_analysis.rules.further_reading import ANNOTATIONS, RUNS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.interface import DOES, Endpoint, Interface, ParamUse

_CONFLICT = "annotation of '{name}' has another type than the run of {node}: {type}"
_UNMADE = "annotation of '{name}' is not confirmed: the run of {node} does not show that it {does} it{near}"
_MISSING = "annotation of {node} is incomplete: in its run it {shown}{more}"
_MOST = 5
"""How many names a message has."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    if context.graph is None:
        return
    tags: dict[tuple[str, Span], list[tuple[LaunchNode, Interface]]] = {}
    for node, interface in zip(context.tree.nodes, context.graph.processes, strict=True):
        if interface.outcome.status != "not-run" and read_annotation(node.action)[0] is not None:
            tags.setdefault((node.location.file, node.action.span), []).append((node, interface))
    for (file, _), seen in tags.items():
        # What agrees does so wherever it stands; what differs is said with its places.
        if context.one(_agree, seen[0][0].name, *map(tuple, zip(*seen, strict=True))):
            continue
        outdated = compare(seen)
        if outdated is not None:
            yield from _findings(rule, context, file, seen[0][0], outdated)


def _agree(nodes: tuple[LaunchNode, ...], interfaces: tuple[Interface, ...]) -> bool:
    return compare(tuple(zip(nodes, interfaces, strict=True))) is None


def _findings(rule: Rule, context: Context, file: str, node: LaunchNode, outdated: Outdated) -> Iterator[Finding]:
    document = context.documents[file]
    edits = bring_up_to_date(outdated, document)
    fixes = (Fix(f"Update the annotation of '{node.name}' from its run", edits, preferred=True),) if edits else ()
    chain = include_chain(node.origin)
    for item, type_ in outdated.conflicts:
        yield rule.claim(
            say(_CONFLICT, name=item.what.name, node=node.name, type=type_),
            context.location(file, item.values["type"]),
            subject=Subject("annotation", item.what.name),
            kind="conflict",
            candidates=(type_,),
            related=chain,
            fixes=fixes,
        )
    for item in outdated.unmade:
        name, place = item.what.name, context.location(file, item.values["name"])
        meant = nearest(name, [what.name for what in outdated.missing if _does(what) == _does(item.what)])
        mends = fix(f"Remove '{name}' from the annotation", (remove_item(item, document),))
        if meant is not None:
            mends = (*replacement(context, place, meant, f"Replace '{name}' with '{meant}'"), *mends)
        yield rule.claim(
            say(_UNMADE, name=name, node=node.name, does=_does(item.what), near=did_you_mean(meant)),
            place,
            subject=Subject("annotation", name),
            kind="absent" if meant is None else "near",
            effect="note" if meant is not None else "style",
            doubts=doubts(DEPENDS=node.name if meant is None else ""),
            candidates=(meant,),
            related=chain,
            fixes=mends,
        )
    if outdated.missing:
        shown = ", ".join(f"{_does(what)} '{what.name}'" for what in outdated.missing[:_MOST])
        more = f" and {len(outdated.missing) - _MOST} more" if len(outdated.missing) > _MOST else ""
        yield rule.claim(
            say(_MISSING, node=node.name, shown=shown, more=more),
            context.location(file, outdated.groups[0].head),
            subject=Subject("annotation", node.name),
            kind="absent",
            effect="style",
            related=chain,
            fixes=fixes,
        )


def _does(what: Endpoint | ParamUse) -> str:
    return DOES[what.role] if isinstance(what, Endpoint) else "reads parameter"


RULE = Rule(
    id="TRC006",
    name="annotation-outdated",
    effect="misbehaves",
    kind="conflict",
    always=(Reason.UNSEEN,),
    sometimes=("note", "style", Reason.DEPENDS),
    what="Checks the `<topics>`, `<services>`, `<actions>` and `<params>` that annotate a node against its run. "
    "Missing parameters are reported only if some are annotated.",
    why="The annotation applies where the node cannot be run: on another machine, in an untrusted workspace, "
    "without hardware. Errors in it cause wrong findings there. It may describe more than the run on purpose.",
    example='<!-- <topics><topic name="scan" type="sensor_msgs/PointCloud" class="pub"/></topics> -->',
    instead='<!-- <topics><topic name="scan" type="sensor_msgs/LaserScan" class="pub"/></topics> -->',
    references=(
        ANNOTATIONS,
        RUNS,
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
