"""LCH038: a file has more findings than are shown."""

from collections import Counter
from collections.abc import Iterator, Sequence

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.clipping import MAX_FINDINGS
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context
from preflight_analysis.rules.further_reading import SECURITY
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    """What the other rules find is counted after they have run."""
    return iter(())


def _left_out(rule: Rule, path: str, findings: Sequence[Finding]) -> Finding:
    counts = Counter(finding.rule for finding in findings)
    named = ", ".join(f"{count} of '{each}'" for each, count in counts.most_common())
    first = findings[0]  # the most severe of them
    message = f"{len(findings)} more findings of this file are left out: {named}"
    place, about = Location.of_file(path), Subject("file", path)
    return rule.claim(message, place, subject=about, effect=first.effect, doubts=first.doubts)


RULE = Rule(
    id="LCH038",
    name="findings-left-out",
    effect="misbehaves",
    kind="duplicate",
    sometimes=("stops-launch", "stops-node", "breaks", "no-effect", "note", "style"),
    what=f"Checks for files with more than {MAX_FINDINGS:,} findings, and counts those that are not shown. It is as "
    "severe as the most severe of them.",
    why="A faulty program, or an attack on the editor, makes a file with so many findings. Showing them takes "
    "longer than finding them.",
    example="<launch>\n  <!-- ten thousand unknown tags -->\n</launch>",
    instead="Correct the first findings, and suppress or switch off the rule with the most findings.",
    references=(SECURITY,),
    check=_check,
    left_out=_left_out,
)
