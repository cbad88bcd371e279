"""PRM020: what `RewrittenYaml` or `ReplaceString` is to replace is not in the file (ROS 2)."""

import re
from collections.abc import Iterator

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.problems import NothingToReplace
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest_slip
from preflight_analysis.model.places import quoted_once
from preflight_analysis.model.problems import problems_of, rename, shown
from preflight_analysis.rules.further_reading import FORMATS, NAV2
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_KEY = re.compile(r"^[ \t-]*[\"']?([\w./-]+)[\"']?[ \t]*:", re.MULTILINE)
_MARKED = re.compile(r"<[\w/-]+>|\{[\w/-]+\}|\$[\w/-]+\$|%[\w/-]+%|@[\w/-]+@")
_LONGEST = 500_000
"""Characters of a file in which a like name is looked for."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, NothingToReplace):
        name, by, path = problem.kind.name, problem.kind.by, problem.kind.path
        found = context.documents.get(path) or context.disk.text(path)
        text = found.text if isinstance(found, Document) else ""
        near = _near(name, by, text[:_LONGEST])
        there = f"'{shown(path, context)}'" if text else "the file"
        what = "key" if by == "RewrittenYaml" else "text"
        place = _place(context, problem.location, name)
        yield problem_claim(
            rule,
            problem,
            f"{what} '{name}' of {by} replaces nothing: {there} does not contain it{did_you_mean(near)}",
            subject=Subject("parameter", name),
            kind="absent" if near is None else "near",
            doubts=doubts(SHARED=near is None, NO_DIFFERENCE=near is None),
            candidates=(near,),
            fixes=rename(context, place, name, near) if near is not None else (),
        )


def _near(name: str, by: str, text: str) -> str | None:
    """What is in the file and differs by a slip; of a path the last key does."""
    if by != "RewrittenYaml":
        return nearest_slip(name, _MARKED.findall(text))
    above, dot, leaf = name.rpartition(".")
    near = nearest_slip(leaf, _KEY.findall(text))
    return f"{above}{dot}{near}" if near is not None else None


def _place(context: Context, around: Location, name: str) -> Location:
    """Where the file names it, if that is once."""
    return quoted_once(context, around.file, name) or around


RULE = Rule(
    id="PRM020",
    name="nothing-to-replace",
    effect="no-effect",
    kind="near",
    sometimes=(Reason.SHARED, Reason.NO_DIFFERENCE),
    what="Checks for a key in the `param_rewrites` of a `RewrittenYaml`, or a text in the `replacements` of a "
    "`ReplaceString`, that the source file lacks. Launch files often have rewrites for several files.",
    why="`RewrittenYaml` adds no keys. The nodes keep the value of the file, and no tool reports it.",
    example="RewrittenYaml(source_file=params, param_rewrites={'use_sim_tme': use_sim_time})",
    instead="RewrittenYaml(source_file=params, param_rewrites={'use_sim_time': use_sim_time})",
    references=(
        NAV2,
        FORMATS,
    ),
    generations=(2,),
    check=_check,
    problems=(NothingToReplace,),
)
