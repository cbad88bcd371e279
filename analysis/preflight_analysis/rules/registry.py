"""Finds the rules and runs them. A rule is a module of this package whose name starts with its id."""

from __future__ import annotations

import importlib
import logging
import pkgutil
import re
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from itertools import pairwise
from types import ModuleType

import preflight_analysis.rules as package
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import SEVERITIES, Finding
from preflight_analysis.findings.suppression import apply_suppressions
from preflight_analysis.rules.rule import Context, Rule, in_root

_log = logging.getLogger(__name__)
_RULE_MODULE = re.compile(r"[a-z]{3}\d{3}_")


@cache
def all_rules() -> tuple[Rule, ...]:
    """Every rule, sorted by id. Raises `TypeError` for a rule module without `RULE`, `ValueError` for a doubled id."""
    rules = sorted((_rule_of(module) for module in _modules()), key=lambda rule: rule.id)
    doubled = {a.id for a, b in pairwise(rules) if a.id == b.id}
    if doubled:
        raise ValueError(f"two rules with the id {', '.join(sorted(doubled))}")
    return tuple(rules)


def rule_by_id(rule_id: str) -> Rule | None:
    """The rule of that id."""
    return next((rule for rule in all_rules() if rule.id == rule_id), None)


def run_rules(context: Context, rules: Sequence[Rule] | None = None) -> list[Finding]:
    """The findings of all rules (or of `rules`), without repetitions and suppressed ones, sorted by place.

    Each is marked as holding in `context.root`. A rule that raises is logged and costs its own findings alone.
    """
    chosen = all_rules() if rules is None else rules
    raw: list[Finding] = []
    ran: set[str] = set()
    for rule in chosen:
        if rule.needs_graph and context.graph is None:
            continue
        try:
            found = list(rule.check(rule, context))
        except Exception:
            _log.exception("rule %s %s broke on %s; its findings are left out", rule.id, rule.name, context.root)
            continue
        ran.add(rule.id)
        raw.extend(_in_order(rule, found, context) if rule.problems else found)
    filtered = apply_suppressions(unique(raw), context.documents)
    kept = list(filtered.kept)
    judge = next((rule for rule in chosen if rule.unused_suppression is not None), None)
    if judge is not None and judge.unused_suppression is not None:
        kept += [judge.unused_suppression(judge, unused) for unused in filtered.unused if unused.rule in ran]
    return sorted((in_root(finding, context.root) for finding in kept), key=_place)


def _in_order(rule: Rule, findings: Iterable[Finding], context: Context) -> Iterator[Finding]:
    """The findings of a rule, those that stop the launcher with their place in the order in which it meets them.

    One place can stop it in several ways: where a file is included twice, each time with other arguments.
    """
    met: dict[Location, deque[int]] = {}
    for number, problem in enumerate(context.tree.problems):
        if problem.fatal and problem.kind in rule.problems:
            met.setdefault(problem.location, deque()).append(number)
    for finding in findings:
        numbers = met.get(finding.location) if finding.stops_launch else None
        yield replace(finding, met=numbers.popleft()) if numbers else finding


def unique(findings: Iterable[Finding]) -> list[Finding]:
    """One finding for each rule, place and message: a file that is included twice shows its error once."""
    first: dict[tuple[str, object, str], Finding] = {}
    for finding in findings:
        first.setdefault((finding.rule, finding.location, finding.message), finding)
    return list(first.values())


def _place(finding: Finding) -> tuple[str, int, int, int, str, str]:
    span = finding.location.span
    rank = len(SEVERITIES) - SEVERITIES.index(finding.severity)
    return finding.location.file, span.start, span.end, rank, finding.rule, finding.message


def _modules() -> Iterable[ModuleType]:
    for info in pkgutil.iter_modules(package.__path__):
        if _RULE_MODULE.match(info.name):
            yield importlib.import_module(f"{package.__name__}.{info.name}")


def _rule_of(module: ModuleType) -> Rule:
    rule = getattr(module, "RULE", None)
    if not isinstance(rule, Rule):
        raise TypeError(f"{module.__name__} declares no RULE")
    return rule
