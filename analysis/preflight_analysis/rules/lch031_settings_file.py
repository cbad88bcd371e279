"""LCH031: something in the settings file is not understood."""

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for message, location in context.settings_problems:
        yield rule.finding(f"in the settings: {message}", location)


RULE = Rule(
    id="LCH031",
    name="settings-file",
    severity="warning",
    what="Reports a key or a value in `.ros-preflight.yaml`, in the workspace's folder, that is not understood, and a "
    "settings file that cannot be read.",
    why="It is left out. What it was meant to say, of topics from outside, of nodes that cannot be run, of how launch "
    "files are launched, does not count, and findings may be wrong or missing.",
    example="external:\n  topic: [/scan]",
    instead="external:\n  topics: [/scan]",
    check=_check,
)
