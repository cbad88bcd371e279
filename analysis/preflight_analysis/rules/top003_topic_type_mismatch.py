"""TOP003: publisher and subscriber of a topic have different types."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.places import Verbs
from preflight_analysis.rules.rule import Context, Rule
from preflight_analysis.rules.type_mismatch import mismatches


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    return mismatches(rule, context, "topics", Verbs("publishes", "subscribes to"))


RULE = Rule(
    id="TOP003",
    name="topic-type-mismatch",
    severity="error",
    what="Reports a topic that one node publishes with another type than a second one subscribes to, or with another "
    "definition (MD5 sum) of the same type. `*` fits any type.",
    why="The two nodes refuse to connect, with one line in a log; no message arrives.",
    example="<!-- /pose: geometry_msgs/Pose published, geometry_msgs/PoseStamped subscribed -->\n"
    '<remap from="goal" to="/pose"/>',
    instead='<remap from="goal" to="/pose_stamped"/>',
    check=_check,
    needs_graph=True,
    every_root=True,
)
