"""`ros-preflight rules`: the rules, or what one of them is about."""

from __future__ import annotations

import argparse

from preflight_analysis.rules.reference import page, rule_json
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.rules.rule import Rule

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, CannotDoError
from preflight_server.cli.output import print_json, print_text

DESCRIPTION = """List the rules, or explain one: what it checks, why it matters, an example and how to fix it."""
SCHEMA = "ros-preflight/rules/1"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_format(parser)
    parser.add_argument(
        "--no-run", action="store_true", help="accepted as for the other verbs; this one executes nothing"
    )
    rule = parser.add_argument("rule", metavar="RULE", nargs="?", help="the id or the name of a rule, such as TOP001")
    rule.completer = rule_ids  # type: ignore[attr-defined]  # argcomplete's


def rule_ids(prefix: str, **_: object) -> list[str]:
    """For the completion of a shell."""
    return [rule.id for rule in all_rules() if rule.id.startswith(prefix.upper())]


def rules_named(name: str) -> tuple[Rule, ...]:
    """The rule with this id or name, or none."""
    asked = name.lower()
    return tuple(rule for rule in all_rules() if asked in (rule.id.lower(), rule.name))


def run(args: argparse.Namespace) -> int:
    """Print one rule or all."""
    rules = all_rules()
    if args.rule is not None:
        rules = rules_named(args.rule)
        if not rules:
            raise CannotDoError(f"there is no rule {args.rule}; `ros-preflight rules` lists them")
    if args.format == "json":
        print_json({"schema": SCHEMA, "rules": [rule_json(rule) for rule in rules]})
    elif args.rule is not None:
        print_text(rule_page(rules[0]))
    else:
        print_text("".join(f"{rule.id}  {rule.severity:<7}  {rule.name}\n" for rule in rules))
    return CLEAN


def rule_page(rule: Rule) -> str:
    """The page of a rule, as docs/rules has it."""
    return page(rule)
