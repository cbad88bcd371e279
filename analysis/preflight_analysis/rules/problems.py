"""Claims about what the evaluation met, and the edits that mend it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from preflight_analysis.evaluation.problems import Problem
from preflight_analysis.findings.claim import Effect, Kind, Subject, Text, say
from preflight_analysis.findings.doubt import Doubt
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import K, include_chain, problems_of
from preflight_analysis.rules.rule import Check, Rule


def problem_claim(
    rule: Rule,
    problem: Problem[ProblemKind],
    said: str | Text,
    *,
    subject: Subject,
    kind: Kind | None = None,
    effect: Effect | None = None,
    doubts: Iterable[Doubt] = (),
    candidates: Iterable[str | None] = (),
    related: Iterable[Related] = (),
    fixes: Iterable[Fix] = (),
    lack: Lack | None = None,
) -> Finding:
    """The finding for a problem, at its place, with the includes that lead there. One that stops the launcher has that
    effect."""
    return rule.claim(
        said,
        problem.location,
        subject=subject,
        kind=kind,
        effect=effect or ("stops-launch" if problem.fatal else None),
        doubts=doubts,
        candidates=candidates,
        related=(*related, *include_chain(problem.origin)),
        fixes=fixes,
        stops_launch=problem.fatal,
        lack=lack,
    )


def check_problems(
    said: Callable[[K], str], subject: Callable[[K], Subject], *kinds: type[K], quotes: bool = False
) -> Check:
    """The check of a rule that has nothing to do but to word its problems, or what a parser says of them (`quotes`)."""

    def check(rule: Rule, context: Context) -> Iterator[Finding]:
        for problem in problems_of(context, *kinds):
            words = said(problem.kind)
            text = say("{quoted}", quoted=words) if quotes else words
            yield problem_claim(rule, problem, text, subject=subject(problem.kind))

    return check
