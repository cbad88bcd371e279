"""PRM011: a parameter file that is given to a node and has nothing for it (ROS 2)."""

from collections.abc import Iterator, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.param_files import Section
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.lost_files import LostFile, lost_files
from preflight_analysis.model.problems import enumerated, include_chain, replacement
from preflight_analysis.model.sections import FileUse, Getter, SectionUse, Slip, param_files
from preflight_analysis.rules.further_reading import COMMAND_LINE, NODE_ARGUMENTS, PARAMETERS
from preflight_analysis.rules.rule import Rule

_SHOWN = 3
_OF_OTHERS = "section '{section}' applies to no node that gets this file (only {node}{others})"
_OF_PROCESS = "section '{section}' applies to no node that gets this file; did you mean '{node}'?"
_GETS_ANOTHER = "section '{section}' applies to no node: {node} does not get this file"
_KEPT = "; {leak}; {advice}"
_NOT_OF_NODE = "no section of this file applies to {node}; it has sections for {sections}{inferred}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for used in param_files(context):
        if any("$(" in each.section.pattern for each in used.sections):
            continue  # launch may make any name of a substitution
        given = [each for each in used.getters if not each.beside and each.node.kind != "simulated"]
        # Said of the file as a whole, at the node.
        is_said = len(given) == 1 and any(not reached for _, reached in used.lacking)
        for each in used.sections:
            if each.meant:
                yield _about_key(rule, context, used, each)
            elif each.slip is not None:
                yield _about_namespace(rule, context, used.path, each, each.slip)
            elif each.unserved is not None and each.section.exact and not is_said:
                yield _about_another_file(rule, context, used, each, each.unserved)
    for lost in lost_files(context):
        yield _about_file(rule, context, lost)


def _about_namespace(rule: Rule, context: Context, path: str, lost: SectionUse, slip: Slip) -> Finding:
    section = lost.section
    return rule.claim(
        f"section '{section.pattern}' applies to no node; {lost.suggestion}",
        context.location(path, section.spans[-1]),
        subject=Subject("section", section.pattern),
        kind="near",
        doubts=lost.doubts,
        candidates=(slip.key,),
        every_root=True,
    )


def _about_another_file(rule: Rule, context: Context, used: FileUse, lost: SectionUse, node: Getter) -> Finding:
    section = lost.section
    return rule.claim(
        say(_GETS_ANOTHER, section=section.pattern, node=node.name),
        context.location(used.path, section.spans[-1]),
        subject=Subject("section", section.pattern),
        doubts=lost.doubts,
        related=(Related(f"{node.name} is started here", node.location), used.getters[0].related),
        every_root=True,
    )


def _about_key(rule: Rule, context: Context, used: FileUse, lost: SectionUse) -> Finding:
    nodes = [each.name for each in lost.meant]
    section = lost.section
    # The file may be for other nodes of the process.
    within = any(each.beside for each in lost.meant) or not {*nodes} & {each.name for each, _ in used.lacking}
    if within:
        text = say(_OF_PROCESS, section=section.pattern, node=nodes[0])
    else:
        shown = nodes[:_SHOWN] if len(nodes) <= _SHOWN else [*nodes[:_SHOWN], "others"]
        text = say(_OF_OTHERS, section=section.pattern, node=nodes[0], others=enumerated(shown).removeprefix(nodes[0]))
    return rule.claim(
        text,
        context.location(used.path, section.spans[-1]),
        subject=Subject("section", section.pattern),
        kind="near" if within else None,
        doubts=lost.doubts,
        candidates=nodes[:1],
        related=[Related(f"{each.node.name} gets the file here", each.location) for each in lost.meant[:_SHOWN]],
        fixes=_rewrite(context, used.path, section, nodes[0] if len(nodes) == 1 else _for_each(nodes)),
        every_root=True,
    )


def _about_file(rule: Rule, context: Context, lost: LostFile) -> Finding:
    used, given, meant, leaked, _ = lost
    node = given.node
    inferred = "; the name is from its source" if node.name_inferred else ""
    key = meant.section if meant is not None else used.sections[0].section
    text = say(_NOT_OF_NODE, node=node.name, sections=lost.sections, inferred=inferred)
    return rule.claim(
        text.followed_by(_KEPT, leak=lost.leak, advice=lost.advice) if leaked is not None else text,
        given.location,
        subject=Subject("file", used.path),
        kind="absent" if meant is None else "near",
        doubts=meant.doubts if meant is not None else doubts(ASSUMED=bool(inferred)),
        candidates=(key.pattern if meant is not None else None,),
        related=(
            Related(
                "the section" if meant is not None else "its first section", context.location(used.path, key.spans[-1])
            ),
            *(
                [Related("declared here" if lost.default else "passed here", leaked.origin[-1])]
                if leaked is not None
                else ()
            ),
            *include_chain(node.origin),
        ),
        fixes=_rewrite(context, used.path, key, node.name) if meant is not None else (),
    )


def _for_each(nodes: Sequence[str]) -> str | None:
    """A key for all nodes of one name, in whatever namespace."""
    bases = {names.leaf(node) for node in nodes}
    return f"/**/{bases.pop()}" if len(bases) == 1 else None


def _rewrite(context: Context, path: str, section: Section, name: str | None) -> tuple[Fix, ...]:
    """The key as the node's name, where the key is in one piece; a name in the root needs no slash."""
    if name is None or len(section.spans) != 1:
        return ()
    key = name.removeprefix("/") if name.count("/") == 1 else name
    return replacement(context, context.location(path, section.spans[0]), key, f"Replace the key with '{key}'")


RULE = Rule(
    id="PRM011",
    name="parameter-file-for-another-node",
    effect="no-effect",
    kind="unreachable",
    sometimes=(Reason.ASSUMED, Reason.UNSEEN, Reason.NOT_ANALYSED, Reason.COMPUTED, Reason.INTENDED),
    what="Checks for a parameter file in which no section applies to the node that gets it, and for a key that "
    "matches no node and is close to one. A file that several nodes share may have no section for one of them, unless "
    "it comes from an argument of another include, or of an including file while its own default fits. A section for "
    "a node that gets its parameters elsewhere counts.",
    why="The node starts with its defaults. Neither `ros2 launch` nor the node reports it.",
    example="<!-- params.yaml: 'amcl: {ros__parameters: {max_particles: 800}}' -->\n"
    '<node pkg="localizer" exec="localizer" name="localizer">\n  <param from="params.yaml"/>\n</node>',
    instead="localizer:\n  ros__parameters:\n    max_particles: 800",
    references=(
        PARAMETERS,
        NODE_ARGUMENTS,
        COMMAND_LINE,
    ),
    generations=(2,),
    check=_check,
)
