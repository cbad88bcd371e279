"""ACT002: client and server of an action have different types."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import Verbs
from preflight_analysis.rules.further_reading import ACTIONLIB, ACTIONS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.rules.type_mismatch import OF_MISMATCHES, mismatches


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    return mismatches(rule, context, "actions", Verbs("serves", "sends goals to"))


RULE = Rule(
    id="ACT002",
    name="action-type-mismatch",
    effect="breaks",
    kind="conflict",
    sometimes=OF_MISMATCHES,
    what="Checks for an action whose server and client have different types, or different definitions (MD5 sums) of "
    "one type.",
    why="Goals, feedback and results are rejected, with one line in a log. The client never gets a result.",
    example="<!-- /dock: my_robot/DockAction offered, the client has move_base_msgs/MoveBaseAction -->\n"
    '<remap from="move_base" to="/dock"/>',
    instead='<remap from="move_base" to="/navigation/move_base"/>',
    references=(
        ACTIONLIB,
        ACTIONS,
    ),
    settings=("nodes",),
    check=_check,
    needs_graph=True,
    every_root=True,
)
