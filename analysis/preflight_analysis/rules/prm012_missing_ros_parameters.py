"""PRM012: values of a parameter file that stand below no `ros__parameters` (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.edits.yaml import YamlWriter
from preflight_analysis.evaluation.ros2.param_files import MARK, may_be_mark
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix
from preflight_analysis.model.refused_files import refusals
from preflight_analysis.rules.further_reading import NODE_ARGUMENTS, PARAMETERS
from preflight_analysis.rules.rule import Rule

MESSAGE = "{}; rcl refuses the whole file"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for refusal in refusals(context):
        document = context.document(refusal.path)
        if not refusal.unmarked or document is None:
            continue
        node, source = refusal.given[0]
        yield rule.claim(
            MESSAGE.format(refusal.what),
            refusal.place,
            subject=Subject("parameter", refusal.unmarked),
            related=(Related(f"{node.name} gets the file here", source.origin[-1]),),
            fixes=marked(document, refusal.place.span),
        )


def marked(document: Document, key: Span) -> tuple[Fix, ...]:
    """A fix that writes `ros__parameters` above a key: in the place of a slip of it, or between it and the node."""
    writer = writer_of(document)
    if not isinstance(writer, YamlWriter):
        return ()
    above = [(document.text[span.start : span.end], span) for span in writer.ancestors(key)]
    slip = next(((name, span) for name, span in above if may_be_mark(name)), None)
    if slip is not None:
        return fix(f"Replace '{slip[0]}' with '{MARK}'", writer.replace(slip[1], MARK), preferred=True)
    return fix(f"Put the values below '{MARK}'", writer.nest(key, MARK), preferred=True)


RULE = Rule(
    id="PRM012",
    name="missing-ros-parameters",
    effect="stops-node",
    kind="invalid",
    sometimes=(Reason.NOT_GIVEN,),
    what="Checks for a value in a parameter file that is below a node's name without `ros__parameters` between them. "
    "The first one of a file is reported. A file for components may have such values.",
    why="The client libraries refuse the whole file, and the node does not start.",
    example="camera:\n  rate: 30",
    instead="camera:\n  ros__parameters:\n    rate: 30",
    references=(
        PARAMETERS,
        NODE_ARGUMENTS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
