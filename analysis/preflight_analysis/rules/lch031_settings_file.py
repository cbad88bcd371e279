"""LCH031: something in the settings file is not understood."""

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.rules.further_reading import OUR_SETTINGS
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for message, location in context.settings_problems:
        yield rule.claim(message, location, subject=Subject("setting", message))


RULE = Rule(
    id="LCH031",
    name="settings-file",
    effect="no-effect",
    kind="invalid",
    what="Checks for invalid keys and values in `.ros-preflight.yaml` and in the files that its key "
    "`knowledge` names, and for such a file that cannot be read.",
    why="The invalid part is ignored: external topics, described nodes or roots are missing. Findings may be wrong "
    "or missing.",
    example="external:\n  topic: [/scan]",
    instead="external:\n  topics: [/scan]",
    references=(OUR_SETTINGS,),
    check=_check,
)
