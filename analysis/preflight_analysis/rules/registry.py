"""Finds the rules and runs them. A rule is a module of this package whose name starts with its id."""

from __future__ import annotations

import importlib
import logging
import pkgutil
import re
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from operator import is_
from types import ModuleType

import preflight_analysis.rules as package
from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.set_aside import is_set_aside
from preflight_analysis.evaluation.problems import CommandFailed
from preflight_analysis.evaluation.tree import Include, Unknown
from preflight_analysis.findings.clipping import most_severe
from preflight_analysis.findings.doubt import Doubt, Reason
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import SEVERITIES, Finding, Related, under
from preflight_analysis.findings.instances import together, with_others
from preflight_analysis.findings.policy import doubted
from preflight_analysis.findings.severities import ALL, family_of
from preflight_analysis.findings.suppression import Filtered, apply_suppressions, read_suppressions
from preflight_analysis.incremental.kept import Before
from preflight_analysis.launch.recognize import FileKind
from preflight_analysis.model.catalogued import robots_by_catalogue
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import files_of_package, packages_around
from preflight_analysis.model.installation import build_files_of
from preflight_analysis.model.problems import include_chain, numbered_problems, problems_of
from preflight_analysis.robot.sources import documents_of
from preflight_analysis.rules.loose_param_files import findings_of_loose_files, findings_of_param_file
from preflight_analysis.rules.packages import check_nothing, said_of_description, said_of_package
from preflight_analysis.rules.rule import Rule, in_root
from preflight_analysis.tracing.once_per_process import once_per_process

_log = logging.getLogger(__name__)
_GRAVE = ("error", "warning")
_MOST_CONTEXTS = 5
"""Further includes that a finding tells of: a file may be included a thousand times."""
_OF_FILES: Mapping[FileKind, tuple[Callable[[Context], Iterable[Finding]], ...]] = {
    "parameter file": (findings_of_param_file,),
}
"""What is said of a file for itself, beside what rules say of its package. The root of the context is the file."""
_RULE_MODULE = re.compile(r"[a-z]{3}\d{3}_")


@once_per_process
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


@once_per_process
def families() -> tuple[str, ...]:
    """The first letters of the ids, in order."""
    return tuple(dict.fromkeys(family_of(rule.id) for rule in all_rules()))


def is_selector(name: str) -> bool:
    """Whether a name stands for rules: for one, for a family, or for all."""
    return name == ALL or name in families() or rule_by_id(name) is not None


def run_rules(
    context: Context, rules: Sequence[Rule] | None = None, failures: list[Failure] | None = None
) -> list[Finding]:
    """The findings of all rules (or of `rules`), without repetitions and suppressed ones, sorted by place.

    Of a file with very many the most severe, and one that counts the others.
    Each is marked as holding in `context.root`. A rule that raises costs its own findings alone where `failures` are
    given, to which it is added.
    """
    chosen = tuple(all_rules() if rules is None else rules)
    found, ran = _found(context, chosen, failures)
    if context.of_branches:
        said = {(finding.rule, finding.location) for finding in found}
        found += [each for each in context.of_branches if (each.rule, each.location) not in said]
    by_file = context.grouped(_file, "", found)
    documents = {**context.documents, **_texts(context.disk, by_file.keys() - context.documents.keys())}
    of_documents = context.each(read_suppressions, documents.values())
    suppressions = {path: each for path, (each, _) in zip(documents, of_documents, strict=True) if each}
    chains = _first_chains(context)
    guessed = {unknown.location.file for unknown in context.tree.unknowns if unknown.decides}
    in_branches = context.grouped(_file, "in branches", (each for each in context.tree.unknowns if each.covers))
    sorted_findings: list[Finding] = []
    for path in sorted({*by_file, *suppressions}):
        silenced = suppressions.get(path, ())
        here = context.whole(_alike, path, by_file.get(path, ()))
        covering = in_branches.get(path, ())
        here = context.one(_with_doubts, path, here, path in guessed, covering, _why_set_aside(context, path, here))
        document = documents[path] if silenced else None
        left = context.one(apply_suppressions, path, context.one(unique, path, here), silenced, document)
        judged = tuple(ran) if silenced else ()
        sorted_findings += context.one(_of_file, path, path, left, chains.get(path, ()), context.root, chosen, judged)
    return sorted_findings


def found_in_branch(
    context: Context, pause: Callable[[], object] = lambda: None, failures: list[Failure] | None = None
) -> list[Finding]:
    """What the rules that speak of branches say of a launch with other arguments, suppressed or not, each with the
    includes that lead there: of one with a graph those that need it, of any other one the rest. `pause` is called
    before each rule: it may raise to stop here. `failures` as for `run_rules`."""
    found, _ = _found(context, _of_branches(context.graph is not None, pause), failures)
    chains = _first_chains(context)
    return [_with_chain(each, chains.get(each.location.file, ())) for each in found]


def found_in_loose_files(context: Context) -> Iterator[Finding]:
    """What is wrong with parameter files of the package that no node of the launch gets, and with descriptions. To read
    them takes time: it is no part of what is found at a keystroke."""
    yield from findings_of_loose_files(context)
    yield from without_suppressed(context.disk, _found_in_descriptions(context))


def _found_in_descriptions(context: Context) -> Iterator[Finding]:
    """What rules say of descriptions as launched they say once, and what xacro has said of one is known."""
    evaluated = documents_of(context.tree, context.disk, context.environment)
    failed = [line for problem in problems_of(context, CommandFailed) for line in problem.kind.stderr]
    words = frozenset(word for line in failed for word in re.findall(r"[\w.-]+", line))
    for each in packages_around(context):
        for path in files_of_package(context.disk.db, context.environment, each):
            for finding in found_in_description(context.disk, context.environment, path):
                if path not in evaluated or not _is_of_launches(finding.rule):
                    known = finding.subject is not None and finding.subject.name in words
                    yield doubted(finding, Doubt(Reason.EXPLAINED)) if known else finding


def _is_of_launches(rule_id: str) -> bool:
    """Whether the rule speaks of the descriptions of launches, too."""
    rule = rule_by_id(rule_id)
    return rule is not None and rule.check is not check_nothing


def found_in_description(disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """What is wrong with one file of robot descriptions or worlds, whatever launch reads it."""
    for rule in all_rules():
        if rule.of_description is not None:
            yield from said_of_description(disk.db, rule.of_description, rule, environment, path)


def found_in_supposed(context: Context, path: str) -> Iterator[Finding]:
    """What the rules of single parameters say of a file, in a launch that nobody has written and that gives it to the
    nodes of its sections: of names that are like none that a node declares they say nothing, as it may be another."""
    found, _ = _found(context, [rule for rule in all_rules() if rule.of_param], None)
    for each in found:
        if each.location.file == path and each.kind != "absent":
            related = tuple(one for one in each.related if one.location.file != context.root)
            yield doubted(replace(each, related=related), Doubt(Reason.NOT_GIVEN))


def found_in_packages(disk: Disk, environment: Environment, packages: Iterable[Package]) -> Iterator[Finding]:
    """What is wrong with how packages are built and installed, whatever launch starts their nodes, without what is
    suppressed."""
    rules = tuple(rule for rule in all_rules() if rule.of_package is not None)
    ran = tuple(rule.id for rule in rules)
    for each in packages:
        by_file: dict[str, list[Finding]] = {path: [] for path in build_files_of(disk, each)}
        for rule in rules:
            if rule.of_package is not None and each.generation in rule.generations:
                for finding in said_of_package(disk.db, rule.of_package, rule, environment, each):
                    by_file.setdefault(finding.location.file, []).append(finding)
        texts = _texts(disk, by_file)
        for path, found in by_file.items():
            document = texts.get(path)
            silenced = read_suppressions(document)[0] if document is not None else ()
            filtered = apply_suppressions(unique(found), silenced, document)
            yield from (*filtered.left, *_useless(all_rules(), filtered, ran))


def _texts(disk: Disk, paths: Iterable[str]) -> dict[str, Document]:
    return {path: text for path in sorted(paths) if isinstance(text := disk.text(path), Document)}


def found_in_file(context: Context, kind: FileKind, package: Package | None) -> tuple[Finding, ...]:
    """What is wrong with the file that `context` is of, which is no launch file, for itself and as a part of its
    package: also what is said elsewhere and mended in it. Without what comments silence."""
    path, disk, environment = context.root, context.disk, context.environment
    said = [each for check in _OF_FILES.get(kind, ()) for each in check(context)]
    if kind == "robot description":
        said += found_in_description(disk, environment, path)
    found = [*without_suppressed(disk, said)]
    if package is not None:
        found += found_in_packages(disk, environment, (package,))
    return tuple(sorted((each for each in dict.fromkeys(found) if _is_of(each, path)), key=_place))


def without_suppressed(disk: Disk, findings: Iterable[Finding]) -> Iterator[Finding]:
    """The findings that no comment in their file silences."""
    by_file: dict[str, list[Finding]] = {}
    for each in findings:
        by_file.setdefault(each.location.file, []).append(each)
    texts = _texts(disk, by_file)
    for path, here in by_file.items():
        document = texts.get(path)
        silenced = read_suppressions(document)[0] if document is not None else ()
        yield from apply_suppressions(here, silenced, document).left


def _is_of(finding: Finding, path: str) -> bool:
    """Whether a finding is in a file, or mended in it."""
    places = (finding.location, *(edit.location for fix in finding.fixes for edit in fix.edits))
    return any(place.file == path for place in places)


def _of_branches(needs_graph: bool, pause: Callable[[], object]) -> Iterator[Rule]:
    for rule in all_rules():
        if rule.in_branches and rule.needs_graph == needs_graph:
            pause()
            yield rule


def _found(context: Context, rules: Iterable[Rule], failures: list[Failure] | None) -> tuple[list[Finding], list[str]]:
    """All that rules say, and the ids of those that did not raise."""
    findings: list[Finding] = []
    ran: list[str] = []
    catalogued = any(catalogued_file(path) is not None for path in context.tree.inputs)
    by_catalogue = robots_by_catalogue(context)
    for rule in rules:
        if context.tree.generation not in rule.generations or (rule.needs_graph and context.graph is None):
            continue
        context.disk.db.leave_if_cancelled()
        try:
            found = list(rule.check(rule, context))
        except Exception as error:
            if failures is None:
                raise
            _log.exception("rule %s %s failed on %s; its findings are left out", rule.id, rule.name, context.root)
            failures.append(Failure.of(error, context.root, rule.id))
            continue
        ran.append(rule.id)
        said = _in_order(rule, found, context) if rule.problems else found
        if rule.of_robot and by_catalogue is not None:
            of_catalogue = Doubt(Reason.CATALOGUE if by_catalogue else Reason.OTHER_VERSION)
            said = [doubted(each, of_catalogue) for each in said]
        findings += filter(None, map(partial(_outside, rule), said)) if catalogued else said
    return findings, ran


def _file(stands: Finding | Unknown) -> str:
    return stands.location.file


def _outside(rule: Rule, finding: Finding) -> Finding | None:
    """A finding as one of files that can be mended: of two ends of which one is the catalogue's it is said at the
    other; None where nothing outside of the catalogue is to do with it."""
    fixes = tuple(fix for fix in finding.fixes if not any(_is_catalogued(edit.location) for edit in fix.edits))
    if not _is_catalogued(finding.location):
        return finding if fixes == finding.fixes else replace(finding, fixes=fixes)
    others = (each for each in finding.related if each.role != "included") if rule.needs_graph else ()
    place = next((each.location for each in others if not _is_catalogued(each.location)), None)
    return replace(finding, location=place, fixes=fixes) if place is not None else None


def _is_catalogued(location: Location) -> bool:
    return catalogued_file(location.file) is not None


def _alike(before: Before[tuple[Finding, ...]] | None, findings: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """The findings, the equal ones of before for those: what was made of them is found again."""
    if before is None:
        return findings
    # Most are the very same, and to compare by value takes long.
    same = {*map(id, before[1])}.intersection(map(id, findings))
    known = {finding: finding for finding in before[1] if id(finding) not in same}
    found = tuple(
        old if id(each) not in same and (old := known.get(each)) is not None and _is_alike(old, each) else each
        for each in findings
    )
    return before[1] if len(found) == len(before[1]) and all(map(is_, found, before[1])) else found


def _is_alike(one: Finding, other: Finding) -> bool:
    # What is not compared has to be the same, too.
    return (one.launch_order, one.endpoints, one.crash_of) == (other.launch_order, other.endpoints, other.crash_of)


def _with_doubts(
    findings: tuple[Finding, ...], is_guessed: bool, in_branches: Sequence[Unknown], set_aside: str | None
) -> tuple[Finding, ...]:
    """What the rules found in one file. `is_guessed`: it is a program, and which branches it takes is not all known;
    `in_branches` are those; `set_aside`: why nobody starts it as it is."""
    if set_aside is not None:
        findings = tuple(_information(f, set_aside) if f.severity in _GRAVE else f for f in findings)
    if is_guessed:
        findings = tuple(doubted(f, Doubt(Reason.BRANCHES)) if f.confidence == "certain" else f for f in findings)
    for branch in in_branches:
        covers = frozenset(branch.covers)
        findings = tuple(
            under(f, branch.what) if not f.condition and _stands_in(f.location, covers) else f for f in findings
        )
    return findings


def _stands_in(place: Location, covers: Iterable[Location]) -> bool:
    return any(around.span.start <= place.span.start < around.span.end for around in covers)


def _of_file(
    path: str,
    filtered: Filtered,
    chain: tuple[Related, ...],
    root: str,
    rules: tuple[Rule, ...],
    ran: tuple[str, ...],
) -> tuple[Finding, ...]:
    """What is said of one file, of what the rules `ran` found there and no comment silences."""
    left = [_in_context(finding, chain, root) for finding in filtered.left]
    left += [in_root(finding, root) for finding in _useless(rules, filtered, ran)]
    left, others = most_severe(left)
    counts = next((rule for rule in rules if rule.left_out is not None), None)
    if others and counts is not None and counts.left_out is not None:
        left.append(in_root(counts.left_out(counts, path, others), root))
    return tuple(sorted(left, key=_place))


def _useless(rules: Iterable[Rule], filtered: Filtered, ran: Collection[str]) -> Iterator[Finding]:
    """What is said of the comments that silenced nothing of the rules `ran`."""
    judge = next((rule for rule in rules if rule.unused_suppression is not None), None)
    if judge is not None and judge.unused_suppression is not None:
        yield from (judge.unused_suppression(judge, unused) for unused in filtered.unused if unused.rule in ran)


def _why_set_aside(context: Context, path: str, findings: Iterable[Finding]) -> str | None:
    if not any(each.severity in _GRAVE for each in findings):
        return None
    if is_set_aside(context.disk, context.environment, path):
        return "colcon ignores this folder"
    package = package_around(context.environment, path) if not context.tree.ros.ament else None
    # Ports from ROS 1 to ROS 2 often keep the old launch files.
    left_over = package is not None and package.is_ament and not package.conditional
    return "launch file of ROS 1 in a ROS 2 package" if left_over else None


def _information(finding: Finding, why: str) -> Finding:
    text = finding.text.followed_by(" ({set_aside})", set_aside=why)
    return doubted(replace(finding, text=text, message=f"{finding.message} ({why})"), Doubt(Reason.SET_ASIDE))


def _in_order(rule: Rule, findings: Iterable[Finding], context: Context) -> Iterator[Finding]:
    """The findings of a rule, those that stop the launcher with their place in the order in which it meets them.

    One place can stop it in several ways: where a file is included twice, each time with other arguments.
    """
    met: dict[Location, deque[int]] = {}
    for number, problem in numbered_problems(context, *rule.problems):
        if problem.fatal:
            met.setdefault(problem.location, deque()).append(number)
    for finding in findings:
        numbers = met.get(finding.location) if finding.stops_launch else None
        yield replace(finding, launch_order=numbers.popleft()) if numbers else finding


def unique(findings: Iterable[Finding]) -> list[Finding]:
    """Each rule says each thing of a place once, and what it says of it in further includes of the same file (other
    arguments, another namespace) becomes a related place of what it says in the first one that is as severe as any."""
    places: dict[tuple[str, Location], list[Finding]] = {}
    for finding in findings:
        places.setdefault((finding.rule, finding.location), []).append(finding)
    left: list[Finding] = []
    for (_, place), found in places.items():
        left += found if len(found) == 1 else _of_all_contexts(place, found)
    return left


def _of_all_contexts(place: Location, findings: Iterable[Finding]) -> Iterator[Finding]:
    """What one rule says of one place."""
    contexts: dict[tuple[Location, ...], dict[str, Finding]] = {}
    for finding in findings:
        chain = tuple(related.location for related in finding.related if related.role == "included")
        contexts.setdefault(chain, {}).setdefault(finding.message, finding)
    ranks = {chain: max(SEVERITIES.index(f.severity) for f in said.values()) for chain, said in contexts.items()}
    lead = max(ranks, key=ranks.__getitem__)
    said_first = contexts.pop(lead)
    first, *more = together(said_first.values())
    reported = set(said_first)
    others: list[Related] = []
    for chain, said in contexts.items():
        where = chain[0] if chain else place
        others += [Related(f"in another context: {message}", where) for message in said if message not in reported]
        reported.update(said)
    elsewhere = [each for said in contexts.values() for each in said.values()]
    yield replace(with_others(first, elsewhere), related=(*first.related, *others[:_MOST_CONTEXTS]))
    yield from more


def _in_context(finding: Finding, chain: tuple[Related, ...], root: str) -> Finding:
    return in_root(_with_chain(finding, chain), root)


def _with_chain(finding: Finding, chain: tuple[Related, ...]) -> Finding:
    """One about a file, whatever includes it, says how the file is reached."""
    if not chain or any(related.role == "included" for related in finding.related):
        return finding
    return replace(finding, related=(*finding.related, *chain))


def _first_chains(context: Context) -> dict[str, tuple[Related, ...]]:
    chains: dict[str, tuple[Related, ...]] = {context.root: ()}
    includes = context.tree.includes
    for include, chain in zip(includes, context.each(_chain, includes), strict=True):
        if include.path is not None:
            chains.setdefault(include.path, chain)
    return chains


def _chain(include: Include) -> tuple[Related, ...]:
    return include_chain((*include.origin, include.file_location))


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
