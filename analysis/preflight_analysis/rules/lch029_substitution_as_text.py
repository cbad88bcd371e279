"""LCH029: a substitution that is none."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Edit, Finding, Fix
from preflight_analysis.launch.problems import SubstitutionAsText
from preflight_analysis.rules.problems import problem_finding, problems_of
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, SubstitutionAsText):
        text, meant = problem.kind.text, problem.kind.meant
        place = problem.location
        exact = context.text(place) == text
        fixes = (Fix(f"Write '{meant}'", (Edit(place, meant),), True),) if exact else ()
        message = f"'{text}' is no substitution: roslaunch takes it as text; '{meant}' is one"
        yield problem_finding(rule, problem, message, fixes=fixes)


RULE = Rule(
    id="LCH029",
    name="substitution-as-text",
    severity="warning",
    what="Reports what looks like a substitution and is none: without an end, or with other brackets.",
    why="""`roslaunch` replaces `$(arg name)` and its like only in that form, and leaves everything else as it stands. A
topic or file is then really called `$(arg name`, and nothing says so.""",
    example='<param name="port" value="${arg port}"/>\n<param name="rate" value="$(arg rate"/>',
    instead='<param name="port" value="$(arg port)"/>\n<param name="rate" value="$(arg rate)"/>',
    check=_check,
    problems=(SubstitutionAsText,),
)
