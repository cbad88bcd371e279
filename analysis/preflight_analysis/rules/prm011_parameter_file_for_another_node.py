"""PRM011: a parameter file that is given to a node and has nothing for it (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.ros2.param_files import Section, read_param_file
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Confidence, Edit, Finding, Fix, Related, Severity
from preflight_analysis.rules.nearest import nearest
from preflight_analysis.rules.problems import include_chain, quoted
from preflight_analysis.rules.rule import Context, Rule

_SHOWN = 3


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    given: dict[str, list[tuple[LaunchNode, Location]]] = {}
    for node in context.tree.nodes:
        for source in node.param_sources:
            if source.path is not None:
                given.setdefault(source.path, []).append((node, source.origin[-1]))
    names = {node.name for node in context.tree.nodes}
    for path, nodes in given.items():
        document = context.documents.get(path)
        if not isinstance(document, Document):
            continue
        file = read_param_file(document.text)
        sections = file.sections
        if not sections or any("$(" in section.pattern for section in sections):
            continue  # launch may make any name of a substitution
        # Those that fit no node at all are the ones that may be misspelt.
        lost = [s for s in sections if not (s.pattern in names if s.exact else any(map(s.fits, names)))]
        for node, location in nodes:
            # One that the launch file does not name may have any of the names in the file.
            if not (node.named or node.told) or file.reaching(node.name):
                continue
            shared = len(nodes) > 1
            yield from _about(rule, context, node, location, path, sections, lost, shared=shared)


def _about(
    rule: Rule,
    context: Context,
    node: LaunchNode,
    location: Location,
    path: str,
    sections: tuple[Section, ...],
    lost: list[Section],
    *,
    shared: bool,
) -> Iterator[Finding]:
    patterns = [section.pattern for section in lost]
    near = nearest(node.name, patterns) or (patterns[0] if len(patterns) == 1 and not shared else None)
    section = next((s for s in lost if s.pattern == near), None)
    if section is None and shared:
        return  # one file for several nodes, with nothing for this one: that is usual
    named = quoted(s.pattern for s in sections[:_SHOWN]) + (" and others" if len(sections) > _SHOWN else "")
    inferred = "; its source calls it so" if node.name_inferred else ""
    message = f"the file has nothing for {node.name}, which therefore ignores it; it is for {named}{inferred}"
    severity: Severity = "info" if inferred else "warning"
    confidence: Confidence = "possible" if inferred else "certain"
    fixes: tuple[Fix, ...] = ()
    related = [Related(f"{node.name} gets the file here", location)]
    if section is not None:
        place = Location(path, section.spans[-1])
        fixes = _rewrite(path, section, node.name)
        key = f"'{section.pattern}' is no node that gets this file: {node.name} does, and ignores it"
        yield rule.finding(key, place, severity=severity, confidence=confidence, related=related, fixes=fixes)
        related = [Related("the key", place)]
    elif sections:
        related = [Related("its first key", Location(path, sections[0].spans[-1]))]
    chain = include_chain(node.origin)
    about = (*related, *chain)
    yield rule.finding(message, location, severity=severity, confidence=confidence, related=about, fixes=fixes)


def _rewrite(path: str, section: Section, name: str) -> tuple[Fix, ...]:
    """The key as the node's name, where the key is in one piece; a name in the root needs no slash."""
    if len(section.spans) != 1:
        return ()
    key = name.removeprefix("/") if name.count("/") == 1 else name
    edit = Edit(Location(path, section.spans[0]), key)
    return (Fix(f"Write '{key}' as the key", (edit,), True),)


RULE = Rule(
    id="PRM011",
    name="parameter-file-for-another-node",
    severity="warning",
    what="Reports a parameter file that is given to a node while none of its keys is the name of the node, with its "
    "namespace, or a wildcard that fits it (ROS 2). A file that several nodes share may have nothing for one of them, "
    "unless a key that fits no node is near its name.",
    why="The node starts with its defaults, and neither `ros2 launch` nor the node says a word.",
    example="<!-- params.yaml: 'amcl: {ros__parameters: {max_particles: 800}}' -->\n"
    '<node pkg="localizer" exec="localizer" name="localizer">\n  <param from="params.yaml"/>\n</node>',
    instead="localizer:\n  ros__parameters:\n    max_particles: 800",
    generations=(2,),
    check=_check,
)
