"""`ros-preflight check`: the findings of launch files and of other files, or of a whole workspace."""

from __future__ import annotations

import argparse
import logging
import os
import sys
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.json_text import dumps
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.environment.writing import write_file
from preflight_analysis.findings.baseline import read_baseline, to_baseline, without_known
from preflight_analysis.findings.contexts import RootFindings, causes_first
from preflight_analysis.findings.coverage import Coverage
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import SEVERITIES, Finding, Severity
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, place, relative, statistics, to_json, to_text
from preflight_analysis.findings.severities import ON, Severities, Wanted
from preflight_analysis.findings.severities import chosen as chosen_rules
from preflight_analysis.model.installation import packages_of
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.merged import CRASH, counting, merged
from preflight_analysis.workspace.project_settings import PROFILES, Profile
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.again import Looked, again_and_again
from preflight_server.cli.changes import changed_since, touched
from preflight_server.cli.errors import BROKEN, CLEAN, FOUND, CannotDoError
from preflight_server.cli.fixing import Key, key_of, planned, suppressed
from preflight_server.cli.garbage import uncollected
from preflight_server.cli.launches import STANDARD_INPUT, Launches, launches
from preflight_server.cli.output import colours, links, print_json, print_patch, print_text, say, say_failures
from preflight_server.cli.paths import with_paths
from preflight_server.cli.progress import Progress
from preflight_server.cli.project import Project, run_nodes_together

_log = logging.getLogger(__name__)
TOGETHER = 32
"""Launches of which all is run side by side, commands, Python launch files and nodes; their analyses are at hand
meanwhile."""
_MOST_ROUNDS = 5
"""A fix may show what else there is to fix."""
_DOING = ("watch", "fix", "diff", "add_noqa", "write_baseline")
"""What a check does beside telling."""
FORMATS = ("text", "json", "sarif", "junit", "github", "gitlab")

DESCRIPTION = """Find problems in launch files and in everything that they include. Without FILE, check the root
launch files of the current folder: those that no other file includes, and those that .ros-preflight.yaml names. Another
FILE, such as a parameter file, a build file or a robot description, is checked for what is wrong with itself. The
command runs nodes and parameter commands in a sandbox, without network and without write access to your files.
Calling it is your consent. The runs show what nodes publish, subscribe to and read. With --no-run nothing is
executed, and findings that need a run are missing."""


@dataclass(frozen=True, slots=True)
class _Launched:
    """What is kept of a launch: a workspace may have a thousand of them."""

    root: Root
    files: tuple[str, ...]
    inputs: tuple[str, ...]
    findings: tuple[Finding, ...]
    documents: Mapping[str, Document]
    problems: tuple[str, ...]
    """What is wrong with the ROS that it is for."""
    nodes: tuple[tuple[str, str], ...]
    """The name of each node, and how it is known what it does; other processes have no interface to be known."""
    failures: tuple[Failure, ...]
    untried: int
    """How many tags that it leaves out were not looked into."""
    left_out: frozenset[str]
    """Those of the files that are not evaluated as a whole."""

    @classmethod
    def of(cls, root: Root, analysis: Analysis, untried: int) -> _Launched:
        """That of an analysis with its graph."""
        tree = analysis.tree
        interfaces = analysis.graph.processes if analysis.graph else (NOT_RUN,) * len(tree.nodes)
        return cls(
            root,
            tuple(file for file in analysis.tree.files if catalogued_file(file) is None),
            tuple(analysis.tree.inputs),
            analysis.offered,
            analysis.documents_of_findings,
            analysis.environment.problems,
            nodes=tuple(
                (node.name, interface.source)
                for node, interface in zip(tree.nodes, interfaces, strict=True)
                if node.kind != "process"
            ),
            failures=analysis.failures,
            untried=untried,
            left_out=frozenset(problem.location.file for problem in tree.problems if problem.kind.leaves_out),
        )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser, FORMATS)
    parser.set_defaults(fail_on="")  # what the profile says
    parser.add_argument(
        "launch_args",
        metavar="FILE",
        nargs="*",
        help="launch files with their arguments (name:=value), other files, folders, or - for standard input (default: "
        "the current folder)",
    )
    parser.add_argument("--stdin-filename", metavar="FILE", help="the file whose text is on standard input")
    parser.add_argument(
        "--severity",
        choices=tuple(reversed(SEVERITIES)),
        help="report findings of this severity or worse (default: info in text, hint in other formats)",
    )
    for option, text in (
        ("--select", "report only these rules and families, as LCH,TOP001"),
        ("--extend-select", "report these rules, too, where the settings leave them out"),
        ("--ignore", "leave these rules and families out"),
    ):
        parser.add_argument(option, type=options.selectors, action="extend", default=[], metavar="RULES", help=text)
    parser.add_argument(
        "--profile",
        choices=PROFILES,
        help="strict: warnings fail; launch: only what stops a launch is reported (default: that of the settings)",
    )
    parser.add_argument("--statistics", action="store_true", help="print how many findings each rule has instead")
    parser.add_argument("--fix", action="store_true", help="make the fixes that are certain, and say which")
    parser.add_argument("--unsafe", action="store_true", help="with --fix or --diff: also the other fixes")
    parser.add_argument("--diff", action="store_true", help="print what --fix would change, and write nothing")
    parser.add_argument(
        "--add-noqa", action="store_true", help="write a comment for each finding that suppresses it, and exit with 0"
    )
    parser.add_argument(
        "--require-complete", action="store_true", help="exit with 1 also if something is missing on this machine"
    )
    parser.add_argument("--baseline", metavar="FILE", help="leave out the findings of this list")
    parser.add_argument("--write-baseline", metavar="FILE", help="write a list of all findings and exit with 0")
    parser.add_argument(
        "--watch", action="store_true", help="check again after each change in the workspace, until interrupted"
    )
    parser.add_argument(
        "--changed-since",
        metavar="REV",
        help="check only launches that changed since this revision: in a file that they read, in the settings, or in a "
        "package whose nodes they start",
    )


def run(args: argparse.Namespace) -> int:
    """Print the findings; with `--watch` again and again."""
    _require_sense(args)
    if not args.watch:
        return _look(args).code
    return again_and_again(lambda: _look(args))


def _require_sense(args: argparse.Namespace) -> None:
    """Raises `CannotDoError` for options that cannot be combined."""
    given = [name for name in _DOING if getattr(args, name)]
    option = [f"--{name.replace('_', '-')}" for name in given]
    if len(given) > 1 and set(given) != {"fix", "diff"}:
        raise CannotDoError(f"{option[0]} and {option[1]} cannot be combined")
    if args.unsafe and not (args.fix or args.diff):
        raise CannotDoError("--unsafe is for --fix and --diff")
    reads = STANDARD_INPUT in args.launch_args
    if reads != (args.stdin_filename is not None):
        raise CannotDoError("- is for standard input, with --stdin-filename FILE, the file whose text that is")
    if reads and given and given != ["diff"]:
        raise CannotDoError(f"{option[0]} is for files, not for standard input")


def _look(args: argparse.Namespace) -> Looked:
    """Print the findings once."""
    known = _known(args.baseline) if args.baseline else frozenset()
    typed = {os.path.abspath(args.stdin_filename): _standard_input()} if args.stdin_filename else {}
    chosen, report, checked = _checked(args, known, typed)
    homes = [launch.home for launch in chosen]
    if args.write_baseline:
        say_failures(report.failures)
        return Looked(_write_baseline(report, args.write_baseline), homes, checked)
    severity: Severity = args.severity or ("info" if args.format == "text" else "hint")
    if args.fix and not args.diff:
        report, again = _fix(report, homes, severity, args, known)
        checked = again or checked
    say_failures(report.failures)
    if args.add_noqa or args.diff:
        does = (
            _suppress(report.at_least(severity), homes)
            if args.add_noqa
            else _diff(report.at_least(severity), homes, typed, args)
        )
        return Looked(BROKEN if report.failures else does, homes, checked)
    failing = options.failing(
        report.findings, args.fail_on or ("warning" if _profile(args, chosen) == "strict" else "error")
    )
    _print(report.at_least(severity), failing, checked, homes, args)
    found = int(bool(failing) or (args.require_complete and not report.complete))
    return Looked(BROKEN if report.failures else found, homes, {*checked, *report.documents})


def _profile(args: argparse.Namespace, chosen: Sequence[Launches]) -> Profile:
    of_settings: list[Profile] = [each.workspace.workspace.settings.profile for each in chosen]
    return args.profile or next((each for each in of_settings if each != PROFILES[0]), PROFILES[0])


def _checked(
    args: argparse.Namespace, known: frozenset[str], typed: Mapping[str, str] | None = None
) -> tuple[Sequence[Launches], Report, tuple[str, ...]]:
    """What is launched, the findings that are wanted of it, and the files that were looked at."""
    rules: dict[str, Wanted] = {**dict.fromkeys(args.extend_select, ON), **chosen_rules(args.select, args.ignore)}
    launched = launches(args, chosen=[Severities(rules)] if rules else (), typed=typed or {})
    report, checked = look_at(launched, args)
    if _profile(args, launched) == "launch":
        report = replace(report, findings=[each for each in report.findings if each.effect == "stops-launch"])
    if args.baseline and not args.write_baseline:
        total = len(report.findings)
        report = without_known(report, known, _folder(args.baseline))
        say(f"ros-preflight: {total - len(report.findings)} of {total} findings are in {args.baseline}")
    return launched, report, checked


def _fix(
    report: Report, homes: Sequence[str], severity: Severity, args: argparse.Namespace, known: frozenset[str]
) -> tuple[Report, tuple[str, ...]]:
    """Make the fixes, look again, and make those that this shows; what is found then. A file that is less evaluated
    with its fixes is as it was."""
    left: dict[str, str] = {}
    futile: set[Key] = set()
    fixed: list[str] = []
    checked: tuple[str, ...] = ()
    for _ in range(_MOST_ROUNDS):
        plan = planned(report.at_least(severity), homes, left, futile, typed={}, unsafe=args.unsafe)
        left.update(plan.left)
        if not plan.changes:
            break
        try:
            plan.write()
            _, after, checked = _checked(args, known)
            # A fix may show further mistakes: they are told. That a file is lost for the launch is none of them.
            lost = {*after.coverage.not_evaluated} - {*report.coverage.not_evaluated}
            lost &= plan.changes.keys()
            in_vain = plan.futile(after)
            of_these = {edit.location.file for _, fix in in_vain for edit in fix.edits}
            undone = plan.undo(lost | of_these)
        except OSError as error:
            raise CannotDoError(f"{error.filename} cannot be written: {error.strerror}") from None
        if undone:
            left.update(dict.fromkeys(lost, "with its fixes it is not evaluated as a whole"))
            futile.update(key_of(finding) for finding, _ in in_vain)
            _, after, checked = _checked(args, known)
        for finding, fix in sorted(plan.fixes, key=lambda each: each[0].location):
            where = f"{place(finding.location, report.documents, os.getcwd())}: {finding.rule}: {fix.title}"
            if key_of(finding) in futile:
                say(f"not fixed {where}: the finding stays")
            elif undone.isdisjoint(edit.location.file for edit in fix.edits):
                say(f"fixed {where}")
                fixed.append(finding.location.file)
        report = after
    say(f"ros-preflight: fixed: {len(fixed)}, in files: {len(set(fixed))}")
    _say_left(left)
    return report, checked


def _diff(report: Report, homes: Sequence[str], typed: Mapping[str, str], args: argparse.Namespace) -> int:
    """Print what fixes would change."""
    plan = planned(report, homes, {}, typed=typed, unsafe=args.unsafe)
    unprinted = [file for file, patch in plan.patches(os.getcwd()) if not print_patch(patch)]
    _say_left(
        {**plan.left, **dict.fromkeys(unprinted, "its patch has characters that drive a terminal; --fix changes it")}
    )
    return FOUND if plan.changes else CLEAN


def _standard_input() -> str:
    try:
        return sys.stdin.buffer.read().decode("utf-8").removeprefix("\ufeff")
    except UnicodeDecodeError:
        raise CannotDoError("standard input is not in UTF-8") from None


def _suppress(report: Report, homes: Sequence[str]) -> int:
    """Write comments that suppress the findings."""
    plan, without = suppressed(report, homes)
    try:
        plan.write()
    except OSError as error:
        raise CannotDoError(f"{error.filename} cannot be written: {error.strerror}") from None
    say(f"ros-preflight: suppressed: {len(report.findings) - without}, in files: {len(plan.changes)}")
    if without:
        say(f"ros-preflight: for {without} no comment can be written where they are")
    _say_left(plan.left)
    return CLEAN


def _say_left(left: Mapping[str, str]) -> None:
    for file, why in sorted(left.items()):
        say(f"ros-preflight: {relative(file, os.getcwd())} is left alone: {why}")


@uncollected()
def look_at(chosen: Sequence[Launches], args: argparse.Namespace) -> tuple[Report, tuple[str, ...]]:
    """The findings of all that is launched, each once, and the launch files that were looked at."""
    changed = {each.home: changed_since(args.changed_since, each.home) for each in chosen} if args.changed_since else {}
    progress = Progress(sum(len(each.roots) for each in chosen))
    found: list[_Launched] = []
    reached: set[str] = set()
    of_packages: list[Finding] = []
    documents: dict[str, Document] = {}
    failed: list[Failure] = []
    done = 0
    try:
        for launch in chosen:
            settings = os.path.join(launch.home, SETTINGS_FILE)
            for first in range(0, len(launch.roots), TOGETHER):
                together = launch.roots[first : first + TOGETHER]
                launch.workspace.run_commands(together)
                looked_at: list[tuple[Root, Project, int]] = []
                for root in together:
                    progress.step(done, printable(relative(root.label, os.getcwd())))
                    done += 1
                    with _noted(failed, root):
                        project = launch.workspace.analysed(root.path, dict(root.args))
                        reached.update(each.share for each in packages_of(project.analysis.context))
                        if not changed or touched(project.analysis, changed[launch.home], settings):
                            branches = launch.workspace.branches(project.analysis)
                            launch.workspace.workspace.set_branches(project.analysis.launch, branches)
                            looked_at.append((root, project, branches.untried))
                run_nodes_together(
                    [project for _, project, _ in looked_at], args, report=progress.part, running=progress.running
                )
                for root, project, untried in looked_at:
                    with _noted(failed, root):
                        found.append(_Launched.of(root, project.with_results(), untried))
    finally:
        progress.end()
    checked: list[str] = []
    unreached = 0
    for launch in chosen:
        rest = [package for package in launch.packages if package.share not in reached] if not changed else []
        unreached += len(rest)
        more, texts = launch.workspace.workspace.findings_of_packages(rest, param_files=True)
        of_packages += more
        documents |= texts
        for path, kind in launch.files.items():
            if not changed or os.path.realpath(path) in changed[launch.home]:
                checked.append(path)
                more, texts = launch.workspace.workspace.findings_of_file(path, kind)
                of_packages += more
                documents |= texts
    kept = _not_included(found, frozenset[Root]().union(*(each.asked for each in chosen)))
    files = tuple(dict.fromkeys(file for each in kept for file in each.files))
    documents |= {path: document for each in kept for path, document in each.documents.items()}
    left_out = frozenset[str]().union(*(each.left_out for each in kept))
    nodes = [node for each in kept for node in each.nodes]
    coverage = Coverage(
        len(files),
        len(files) - len(left_out.intersection(files)),
        Counter(source for _, source in nodes),
        sum(each.untried for each in kept),
        not_evaluated=tuple(sorted(left_out.intersection(files))),
        unknown_nodes=tuple(sorted({name for name, source in nodes if source == "none"})),
        other_files=len(checked),
        packages=unreached,
    )
    problems = dict.fromkeys(problem for each in kept for problem in each.problems)
    failed += [failure for each in kept for failure in each.failures]
    of_launches = _merged(kept)
    said = {(each.rule, each.location) for each in of_launches}
    others = [each for each in dict.fromkeys(of_packages) if (each.rule, each.location) not in said]
    return Report.of((*of_launches, *others), documents, coverage, problems, failed), (*files, *checked)


@contextmanager
def _noted(failed: list[Failure], root: Root) -> Iterator[None]:
    """Of many launches, one that we cannot analyse for an error of ours costs its own findings alone."""
    try:
        yield
    except CannotDoError:
        raise
    except Exception as error:
        _log.exception("the analysis of %s failed", root.label)
        failed.append(Failure.of(error, root.path))


def _not_included(found: Sequence[_Launched], asked: Collection[Root]) -> list[_Launched]:
    """Without those that another one turned out to include, once its Python launch files were run."""
    count = counting({each.root: each.files for each in found}, asked)
    return [each for each in found if each.root in count]


def _merged(launched: Sequence[_Launched]) -> tuple[Finding, ...]:
    """As an editor shows them."""
    reports = [
        RootFindings(each.root.label, frozenset((*each.files, *each.inputs)), each.findings) for each in launched
    ]
    if len(reports) == 1 and not any(each.crash_of for each in reports[0].findings):
        return reports[0].findings
    found = causes_first(merged(reports), CRASH)
    return tuple(finding for file in sorted(found) for finding in found[file])


def _folder(file: str) -> str:
    return os.path.dirname(os.path.abspath(file))


def _known(file: str) -> frozenset[str]:
    try:
        return read_baseline(Path(file).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise CannotDoError(f"{file} does not exist; --write-baseline {file} creates it") from None
    except (OSError, ValueError) as error:
        raise CannotDoError(f"{file} is not a list of findings: {error}") from None


def _write_baseline(report: Report, file: str) -> int:
    try:
        write_file(file, (dumps(to_baseline(report, _folder(file)), indent=2) + "\n").encode())
    except OSError as error:
        raise CannotDoError(f"{file} cannot be written: {error.strerror}") from None
    count = len(report.findings)
    say(f"ros-preflight: {file} has {count} finding{'' if count == 1 else 's'}")
    return BROKEN if report.failures else CLEAN


def _print(
    report: Report,
    failing: Sequence[Finding],
    checked: Sequence[str],
    homes: Sequence[str],
    args: argparse.Namespace,
) -> None:
    base = os.getcwd()
    match args.format:
        case "json":
            print_json(with_paths(to_json(report), args, homes))
        case "sarif":
            from preflight_analysis.findings.sarif import to_sarif  # noqa: PLC0415, other formats start faster without

            print_json(to_sarif(report, all_rules(), base))
        case "junit":
            from preflight_analysis.findings.junit import to_junit  # noqa: PLC0415, likewise

            print_text(to_junit(report, failing, checked, base))
        case "github":
            from preflight_analysis.findings.github import to_github  # noqa: PLC0415, likewise

            print_text(to_github(report, base), commands=True)
        case "gitlab":
            from preflight_analysis.findings.gitlab import to_gitlab  # noqa: PLC0415, likewise

            print_json(to_gitlab(report, base))
        case _:
            # Empty counts as not set: https://no-color.org
            text = (
                statistics(report, base)
                if args.statistics
                else to_text(report, base=base, colour=colours(), host=links())
            )
            print_text(text, painted=colours())
