"""Writes the reference of all rules: `python -m preflight_analysis.rules.reference docs/rules`."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.finding import SEVERITIES, Severity
from preflight_analysis.findings.policy import EFFECTS, LIMITS, USUAL, judge
from preflight_analysis.rules.fix_availability import AVAILABILITY, fix_availability
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.rules.rule import Rule

COMMAND = "python -m preflight_analysis.rules.reference docs/rules"
SECTIONS = (
    "What it checks",
    "Severity",
    "Why it matters",
    "Example",
    "How to fix",
    "Fix availability",
    "Options",
    "Since",
    "ROS versions",
    "References",
)
"""The headings of each page, in their order."""
_TITLES = {
    "ACT": "Actions",
    "ARG": "Arguments",
    "BRG": "Bridges to Gazebo",
    "BTR": "Behavior trees",
    "CTL": "Controllers",
    "DEV": "Deviations among what is alike",
    "FRM": "Coordinate frames",
    "GRF": "The graph",
    "LCH": "Launch files",
    "MVT": "MoveIt",
    "PKG": "Packages and executables",
    "PRM": "Parameters",
    "QOS": "Quality of service",
    "SRV": "Services",
    "TOP": "Topics",
    "TRC": "Tracing",
    "URD": "Robot descriptions",
}
"""Of the families of rules. Which there are follows from the rules; each has to have one."""
_IN_BRANCHES = (
    "\n\nTags under a false condition are checked too. The finding names the arguments that make the condition true."
)
_EVERY_ROOT = "\n\nIn a file that other files include, the finding is reported only if it applies in every root."
_NEEDS = "This rule needs the interfaces of the nodes.\n"
_CASES = ("[Severity](../severity.md) says what else limits it.\n", "| severity | when |", "| --- | --- |")
_GENERATED = f"<!-- Written by `{COMMAND}`. Do not edit: the text is in the rule's file. -->\n"
_ROS_VERSIONS = {(1, 2): "ROS 1 and ROS 2.", (1,): "ROS 1.", (2,): "ROS 2."}
_SETTINGS = {
    "knowledge": "[`knowledge`](../knowledge.md) says what the parameters of your own nodes mean.",
    "external": "`external.topics` names topics that other programs publish or subscribe to.",
    "nodes": "`nodes` describes nodes that cannot be run.",
    "roots": "`roots` names the launch files to launch, and their arguments.",
}
"""What the keys of the settings file do that a rule's `settings` names."""
_PYTHON = ("def ", "while ", "open(", "pub =", "Node(", "front =", "condition=", "choices=", "arguments=", "Rewritten")


def pages() -> dict[str, str]:
    """The reference: file name to content, an `index.md` and a page for each rule."""
    rules = all_rules()
    return {"index.md": _index(rules), **{f"{rule.id}.md": f"{_GENERATED}\n{page(rule)}" for rule in rules}}


def page(rule: Rule) -> str:
    """One rule in Markdown."""
    sections = zip(SECTIONS, _contents(rule), strict=True)
    return "\n".join(
        (
            f"# {rule.id} {rule.name}\n",
            *((_NEEDS,) if rule.needs_graph else ()),
            *(f"## {heading}\n\n{content}\n" for heading, content in sections),
        )
    )


def _contents(rule: Rule) -> Iterator[str]:
    """What is below each heading."""
    more = (_IN_BRANCHES if rule.in_branches else "") + (_EVERY_ROOT if rule.every_root else "")
    yield f"{rule.what}{more}"
    yield "\n".join((*_CASES, *(f"| {severity} | {when} |" for severity, when in cases(rule))))
    yield rule.why
    yield _block(rule.example)
    yield f"Use instead:\n\n{_block(rule.instead)}"
    yield AVAILABILITY[fix_availability(rule)]
    yield _options(rule)
    yield f"Version {rule.since}."
    yield _ROS_VERSIONS[rule.generations]
    yield "\n".join(f"- {each}" for each in rule.references)


def _options(rule: Rule) -> str:
    return "\n".join(
        (
            "In [`.ros-preflight.yaml`](../settings.md):\n",
            f"- `severities` sets the severity of {rule.id}: `off`, `hint`, `info`, `warning` or `error`.",
            "- `paths` does the same for some files only.",
            *(f"- {_SETTINGS[each]}" for each in rule.settings),
            "\nTo suppress one finding, add a comment on its line or the line above.",
            "\nIn XML:\n",
            f"```xml\n<!-- preflight: ignore[{rule.id}] reason -->\n```",
            f"\nIn {'YAML, Python and build files' if rule.of_package is not None else 'YAML and Python'}:\n",
            f"```yaml\n# preflight: ignore[{rule.id}] reason\n```",
        )
    )


def cases(rule: Rule) -> Iterator[tuple[Severity, str]]:
    """How severe the findings of a rule are, and when: the usual case first, then what makes them more or less severe,
    the most severe first."""
    always = tuple(map(Doubt, rule.always))
    usual = judge(rule.effect, always)[0]
    deciding = (each.sentence for each in rule.always if LIMITS[each].severity == usual != USUAL[rule.effect])
    yield usual, "; ".join((EFFECTS[rule.effect], *deciding))
    others: list[tuple[Severity, str]] = []
    for each in rule.sometimes:
        if isinstance(each, Reason):
            severity, when = judge(rule.effect, (*always, Doubt(each)))[0], each.sentence
        else:
            severity, when = judge(each, always)[0], EFFECTS[each]
        if severity != usual:
            others.append((severity, when))
    yield from sorted(others, key=lambda case: -SEVERITIES.index(case[0]))


def rule_json(rule: Rule) -> dict[str, Any]:
    """The object of a rule in the contract."""
    return {
        "id": rule.id,
        "name": rule.name,
        "severity": rule.severity,
        "what": rule.what,
        "why": rule.why,
        "example": rule.example,
        "instead": rule.instead,
        "fix": fix_availability(rule),
        "since": rule.since,
        "generations": list(rule.generations),
        "references": list(rule.references),
    }


def write(folder: Path) -> None:
    """Write the pages into `folder`, and delete those of rules that are gone."""
    folder.mkdir(parents=True, exist_ok=True)
    content = pages()
    for old in folder.glob("*.md"):
        if old.name not in content:
            old.unlink()
    for name, text in content.items():
        (folder / name).write_text(text, encoding="utf-8")


def main(arguments: Sequence[str]) -> int:
    """The command line: one argument, the folder."""
    if len(arguments) != 1:
        print(f"usage: {COMMAND}", file=sys.stderr)
        return 2
    write(Path(arguments[0]))
    return 0


def _index(rules: Sequence[Rule]) -> str:
    lines = [_GENERATED, "# Rules\n"]
    for family, members in groupby(rules, lambda rule: rule.id[:3]):
        lines += [f"## {_TITLES[family]}\n", "| rule | name | severity | fix |", "| --- | --- | --- | --- |"]
        lines += [
            f"| [{rule.id}]({rule.id}.md) | {rule.name} | {rule.severity} | {fix_availability(rule)} |"
            for rule in members
        ]
        lines.append("")
    return "\n".join(lines)


def _block(text: str) -> str:
    return f"```{_language(text)}\n{text}\n```"


def _language(text: str) -> str:
    if text.startswith("<"):
        return "xml"
    if text.startswith(_PYTHON):
        return "python"
    return "yaml" if re.match(r"[\w/]+:(\s|$)", text) and "was not run" not in text else "text"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
