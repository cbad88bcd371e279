"""LCH045: a secret, or a file out of reach, whose value is not read."""

from collections.abc import Iterator

from preflight_analysis.documents.secrets import REMEDY
from preflight_analysis.evaluation.problems import WithheldFile, WithheldVariable
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import problems_of, shown
from preflight_analysis.rules.further_reading import SECURITY
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, WithheldVariable, WithheldFile):
        match problem.kind:
            case WithheldVariable(name):
                about = Subject("variable", name)
                message = f"environment variable '{name}' is a secret and is not read; {REMEDY}"
            case WithheldFile(path, reason):
                about = Subject("file", path)
                message = f"'{shown(path, context)}' {reason}"
        yield problem_claim(rule, problem, message, subject=about, effect="note")


RULE = Rule(
    id="LCH045",
    name="secret-not-read",
    effect="note",
    kind="invalid",
    what="Checks for a secret, by the name, place or content of a file or variable, whose value is not read. Without "
    "trust, files outside of the workspace and the package paths are not read either.",
    why="The launch works, but the value is unresolved here, and what depends on it is not checked. A value would "
    "reach nodes in the sandbox, reports and caches. `ROS_PREFLIGHT_ALLOW_SECRETS`, `--allow-secret` and "
    "`rosPreflight.allowSecrets` allow single files, folders and variables. A workspace cannot.",
    example='<param name="license" textfile="$(env HOME)/.config/robot/license.txt"/>',
    instead='<param name="license_file" value="$(env HOME)/.config/robot/license.txt"/>',
    references=(SECURITY,),
    check=_check,
    problems=(WithheldVariable, WithheldFile),
    in_branches=True,
)
