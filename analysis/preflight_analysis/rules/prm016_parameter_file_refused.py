"""PRM016: a parameter file that is YAML and that rcl refuses (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.ros2.rcl_yaml import as_passed, refused_items
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.refused_files import reads_by_rcl, refusals
from preflight_analysis.rules.further_reading import NODE_ARGUMENTS, PARAMETERS
from preflight_analysis.rules.rule import Rule

_SHOWN = 5
_ONE = "{what}; rcl refuses the whole file, and {node} does not start"
_SEVERAL = "{what}; rcl refuses the whole file, and its {count} nodes do not start"
_ARRIVES = (
    "parameter '{name}' arrives as {refused}, because launch passes it without quotes; {node} does not start; set it "
    "in a parameter file, in quotes"
)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for refusal in refusals(context):
        if refusal.unmarked:
            continue
        given = refusal.given
        one, count, what = given[0][0].name, len(given), refusal.what
        text = say(_ONE, what=what, node=one) if count == 1 else say(_SEVERAL, what=what, count=count)
        more = f" (and {count - _SHOWN} more nodes)" if count > _SHOWN else ""
        yield rule.claim(
            text,
            refusal.place,
            subject=Subject("file", refusal.path),
            related=[
                Related(f"{node.name} gets the file here{more if index == _SHOWN else ''}", source.origin[-1])
                for index, (node, source) in enumerate(given[:_SHOWN], 1)
            ],
        )
    yield from _values(rule, context)


def _values(rule: Rule, context: Context) -> Iterator[Finding]:
    """Lists in the launch file: launch writes a parameter file of them, without quotes where Python needs none."""
    reported: set[Location] = set()
    for node in context.tree.nodes:
        for source in node.param_sources if reads_by_rcl(node) else ():
            for param in source.params if source.path is None else ():
                refused = refused_items(as_passed(param.value)) if isinstance(param.value, list) else None
                place = param.place
                if refused is None or place in reported:
                    continue
                reported.add(place)
                yield rule.claim(
                    say(_ARRIVES, name=param.name, refused=refused, node=node.name),
                    place,
                    subject=Subject("parameter", param.name),
                    related=include_chain(node.origin),
                )


RULE = Rule(
    id="PRM016",
    name="parameter-file-refused",
    effect="stops-node",
    kind="invalid",
    sometimes=(Reason.NOT_GIVEN,),
    what="Checks for parameter files that are valid YAML and that rcl refuses: a list of mixed types, a list of "
    "lists, a parameter without a value, a key with a slash below another key. `y`, `n`, `on` and `off` are "
    "bools.",
    why="rcl refuses the whole file: `Sequence should be of same type`. Each node that gets it exits at once, even "
    "if it has no section in the file.",
    example="camera:\n  ros__parameters:\n    gains: [1, 2.5]",
    instead="camera:\n  ros__parameters:\n    gains: [1.0, 2.5]",
    references=(
        PARAMETERS,
        NODE_ARGUMENTS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
