"""TOP004: a remap of a name that its node does not use."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation import names
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.context import Context
from preflight_analysis.model.idle_remaps import BY_CATALOGUE, BY_SOURCE, IdleRemap, idle_remaps
from preflight_analysis.model.names_in_sources import writes_name
from preflight_analysis.model.places import endpoints_of, related_endpoint
from preflight_analysis.model.problems import fix, include_chain
from preflight_analysis.model.well_known import IMAGE_TRANSPORTS
from preflight_analysis.rules.further_reading import REMAPPING_DESIGN, ROSLAUNCH_REMAP
from preflight_analysis.rules.rule import Rule

_DOES = {"publisher": "publishes", "subscriber": "subscribes to", "service": "serves", "client": "calls"}

_OF_ONE = "remap of '{name}' has no effect: {node} does not use that name"
_OF_SPAWNER = (
    "remap of '{name}' has no effect: {node} only asks for {controller}, which {does} '{end}' in the process of "
    "{manager}; put the remap there"
)
_OF_SEVERAL = "remap of '{name}' has no effect: none of its {number} nodes uses that name"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    idle = idle_remaps(context)
    documents = [context.documents.get(each.remap.source_location.file) for each in idle]
    written = [each.meant is not None and _is_written(context, each) for each in idle]
    yield from context.each_row(_finding, (idle, documents, written), rule)


def _is_written(context: Context, idle: IdleRemap) -> bool:
    """Whether a source of a node's package has the name, which the node may use later, or by a module that is not
    followed."""
    packages = [context.environment.packages.get(node.package or "") for node in idle.nodes]
    name = context.text(idle.remap.source_location)
    return "$" not in name and any(
        package is not None and writes_name(context.disk.db, package.share, name) for package in packages
    )


def _finding(idle: IdleRemap, document: Document | None, written: bool, rule: Rule) -> Finding:
    remap, meant = idle.remap, idle.meant
    source = names.resolve(remap.source, idle.nodes[0].name)
    node = idle.nodes[0].name
    said = say(_OF_ONE, name=source, node=node)
    if len(idle.nodes) > 1:
        said = say(_OF_SEVERAL, name=source, number=len(idle.nodes))
    known = doubts(
        FROM_SOURCE=node if idle.known_by == BY_SOURCE else "",
        CATALOGUE=node if idle.known_by == BY_CATALOGUE else "",
    )
    if meant is None or written:
        why = _lone_doubts(idle) if meant is None else doubts(IN_USE=True, NO_DIFFERENCE=True)
        return rule.claim(
            said.followed_by(
                " {known_by}{written}",
                known_by=idle.known_by,
                written="; a source of its package has the name" if meant is not None else "",
            ),
            remap.source_location,
            subject=Subject("remap", source),
            doubts=(*known, *doubts(DEPENDS=node), *why),
            related=include_chain(remap.origin),
        )
    evidence = f"did you mean '{_given(meant)}', which it {_DOES[meant.endpoint.role]}"
    if idle.manager:
        return _of_spawner(rule, idle, meant, known)
    if idle.is_reversed:
        evidence = f"'from' and 'to' are swapped: it {_DOES[meant.endpoint.role]} '{_given(meant)}'"
    elif idle.partner is not None:
        other = idle.partner
        does = _DOES[other.endpoint.role]
        evidence += f"? {other.node.name} {does} '{other.name}' ({other.endpoint.type})"
    else:
        evidence += " and which is unconnected?"
    sure = idle.partner is not None and idle.sure and not meant.endpoint.uncertain
    return rule.claim(
        said.followed_by("; {evidence}", evidence=evidence),
        remap.source_location,
        subject=Subject("remap", source),
        kind="near",
        doubts=(
            *known,
            *doubts(DEPENDS="" if sure else node, ASSUMED="other distribution" in meant.endpoint.evidence.doubts),
        ),
        candidates=(_given(meant),),
        related=(
            *((related_endpoint(idle.partner, _DOES[idle.partner.endpoint.role]),) if idle.partner else ()),
            *include_chain(remap.origin),
        ),
        fixes=() if idle.is_reversed else _fix(document, remap.source_location, meant),
        endpoints=endpoints_of(meant, *((idle.partner,) if idle.partner else ())),
    )


def _of_spawner(rule: Rule, idle: IdleRemap, meant: Connection, known: tuple[Doubt, ...]) -> Finding:
    remap, node, does = idle.remap, idle.nodes[0].name, _DOES[meant.endpoint.role]
    source = names.resolve(remap.source, node)
    named = {"name": source, "node": node, "controller": meant.node.name, "end": meant.name, "manager": idle.manager}
    return rule.claim(
        say(_OF_SPAWNER, does=does, **named),
        remap.source_location,
        subject=Subject("remap", source),
        doubts=(*known, *doubts(DEPENDS=node if meant.endpoint.uncertain else "")),
        related=(related_endpoint(meant, does), *include_chain(remap.origin)),
        endpoints=endpoints_of(meant, *((idle.partner,) if idle.partner else ())),
    )


def _lone_doubts(idle: IdleRemap) -> tuple[Doubt, ...]:
    """By the catalogue's word a name below a namespace that the node has nothing in is that of another node: the remap
    stands at the wrong one. A plain name is mostly there out of habit, and one of an image is made by a library."""
    node, source = idle.nodes[0].name, idle.remap.source
    if idle.known_by != BY_CATALOGUE or source.endswith(IMAGE_TRANSPORTS):
        return doubts(NO_DIFFERENCE=True)
    above = names.parent(names.resolve(source, node))
    foreign = source.strip("/").count("/") > 0 and not source.startswith("~")
    return doubts(INTENDED=not foreign or node.startswith(above))


def _given(connection: Connection) -> str:
    """A name as the node gave it: what a `from` in its tag would say."""
    return connection.endpoint.name


def _fix(document: Document | None, location: Location, meant: Connection) -> tuple[Fix, ...]:
    written = document.text[location.span.start : location.span.end] if document is not None else ""
    if document is None or not written or "$(" in written or "&" in written:
        return ()
    edits = writer_of(document).replace(location.span, _given(meant))
    return fix(f"Replace '{written}' with '{_given(meant)}'", edits, preferred=True)


RULE = Rule(
    id="TOP004",
    name="remap-without-effect",
    effect="no-effect",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(
        Reason.NO_DIFFERENCE,
        Reason.INTENDED,
        Reason.IN_USE,
        Reason.DEPENDS,
        Reason.ASSUMED,
        Reason.FROM_SOURCE,
    ),
    what="Checks for a remap whose `from` is not a topic, service or parameter of its nodes. Namespaces of names in "
    "use, and names below one, count as used: actions and image transports create such names.",
    why="A remap of an unused name is ignored without an error, and the node keeps its own name.",
    example='<!-- the node subscribes to cmd_vel_in -->\n<remap from="input_cmd_vel" to="cmd_vel_nav"/>',
    instead='<remap from="cmd_vel_in" to="cmd_vel_nav"/>',
    references=(
        ROSLAUNCH_REMAP,
        REMAPPING_DESIGN,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
