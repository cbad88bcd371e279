"""Writes the reference of all rules: `python -m preflight_analysis.rules.reference docs/rules`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from preflight_analysis.rules.registry import all_rules
from preflight_analysis.rules.rule import Rule

COMMAND = "python -m preflight_analysis.rules.reference docs/rules"
_FAMILIES = {
    "ACT": "Actions",
    "ARG": "Arguments",
    "GRF": "The graph",
    "LCH": "Launch files",
    "PKG": "Packages and executables",
    "PRM": "Parameters",
    "QOS": "Quality of service",
    "SRV": "Services",
    "TOP": "Topics",
    "TRC": "Tracing",
}
_IN_BRANCHES = "It looks into tags that a condition leaves out, too, and says with which arguments it holds.\n"
_GENERATED = f"<!-- Written by `{COMMAND}`. Do not edit: the text is in the rule's file. -->\n"


def pages() -> dict[str, str]:
    """The reference: file name to content, an `index.md` and a page for each rule."""
    rules = all_rules()
    return {"index.md": _index(rules), **{f"{rule.id}.md": page(rule) for rule in rules}}


def page(rule: Rule) -> str:
    """One rule in Markdown."""
    return "\n".join(
        (
            _GENERATED,
            f"# {rule.id} {rule.name}\n",
            f"Severity: {rule.severity}{_needs(rule)}\n",
            f"## What it does\n\n{rule.what}\n",
            *([_IN_BRANCHES] if rule.in_branches else []),
            f"## Why is this bad\n\n{rule.why}\n",
            f"## Example\n\n```{_language(rule.example)}\n{rule.example}\n```\n",
            f"## Use instead\n\n```{_language(rule.instead)}\n{rule.instead}\n```\n",
            f"To silence it on a line: `<!-- preflight: ignore[{rule.id}] reason -->` there or on the line above.",
            "",
        )
    )


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
    for prefix, family in _FAMILIES.items():
        members = [rule for rule in rules if rule.id.startswith(prefix)]
        if members:
            lines += [f"## {family}\n", "| rule | name | severity |", "| --- | --- | --- |"]
            lines += [f"| [{rule.id}]({rule.id}.md) | {rule.name} | {rule.severity} |" for rule in members]
            lines.append("")
    return "\n".join(lines)


def _needs(rule: Rule) -> str:
    return "; needs the interfaces of the nodes" if rule.needs_graph else ""


def _language(text: str) -> str:
    if text.startswith("<"):
        return "xml"
    return "python" if text.startswith(("def ", "while ", "open(", "pub =")) else "text"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
