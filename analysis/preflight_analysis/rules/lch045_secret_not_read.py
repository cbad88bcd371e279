"""LCH045: a secret, or a file out of reach, whose value is not read."""

from collections.abc import Iterator

from preflight_analysis.documents.secrets import REMEDY
from preflight_analysis.evaluation.problems import WithheldFile, WithheldVariable
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.further_reading import SECURITY
from preflight_analysis.rules.problems import problem_finding, problems_of, shown
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, WithheldVariable, WithheldFile):
        match problem.kind:
            case WithheldVariable(name):
                message = f"environment variable '{name}' is a secret and is not read; {REMEDY}"
            case WithheldFile(path, reason):
                message = f"'{shown(path, context)}' {reason}"
        yield problem_finding(rule, problem, message)


RULE = Rule(
    id="LCH045",
    name="secret-not-read",
    severity="info",
    what="Checks for a secret whose value is not read. Files: in a dot folder of a home folder (but `~/.ros`), in "
    "another user's home folder, with keys or passwords by name or content, in `/run/secrets`, `/proc` or `/sys`. "
    "Environment variables: those whose name or value is that of a secret (`TOKEN`, `API_KEY`, `PASSWORD`). In a "
    "workspace that is not trusted, and for `mcp`, files outside of the workspace and the package paths are not read "
    "either.",
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
