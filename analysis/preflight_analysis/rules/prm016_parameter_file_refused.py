"""PRM016: a parameter file that is YAML and that rcl refuses (ROS 2)."""

from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    seen: set[tuple[str, bool]] = set()
    told: set[Location] = set()
    for node in context.tree.nodes:
        if node.container is not None:
            continue  # launch_ros reads the file of a composable node, which takes some of it
        for source in node.param_sources:
            path = source.path
            document = context.documents.get(path) if path is not None else None
            if path is None or (path, source.substituted) in seen or not isinstance(document, Document):
                continue
            seen.add((path, source.substituted))
            for what, span in read_param_file(document.text).refused:
                at = Location(path, span)
                if at in told or (source.substituted and "$(" in document.text[span.start : span.end]):
                    continue  # what a substitution comes to may be fine
                told.add(at)
                yield rule.finding(
                    f"{what}; the client libraries refuse the whole file for it, and the node does not start",
                    at,
                    related=(Related(f"{node.name} gets the file here", source.origin[-1]),),
                )


RULE = Rule(
    id="PRM016",
    name="parameter-file-refused",
    severity="error",
    what="Reports what a parameter file of ROS 2 cannot have although it is YAML: a list whose items are of several "
    "types, such as `[1, 2.5]`, a list of lists, a parameter without a value, two slashes in a node's name (a key that "
    "begins with a slash below another one).",
    why="The file is refused as a whole: `Sequence should be of same type`. Each node that gets it ends at once.",
    example="camera:\n  ros__parameters:\n    gains: [1, 2.5]",
    instead="camera:\n  ros__parameters:\n    gains: [1.0, 2.5]",
    generations=(2,),
    check=_check,
)
