"""`check(fixture)`: launch files with the expected findings written below the lines that they speak of.

    check('''
        <launch>
          <node pkg="p" type="t" name="$(arg camra)"/>
                                       ^^^^^^^^^^^^ error[ARG001] argument 'camra' is not declared
        </launch>
    ''')

The carets cover what is underlined, to the end of its first line; the text after `severity[RULE]` must be part of the
message. `//- /path` starts another file, the first one is `/main.launch` and is launched. A `package.xml` makes its
folder a package; there is always a package `p` in `/p`, and every executable of every package exists. All findings of
all files are compared with the expectations: nothing may be missing and nothing extra.

A `Workspace` analyses it, as for users, with the files of the fixture as open buffers; a `.ros-preflight.yaml` among
them has its settings.

What runs told of the nodes is in annotations in the launch files or in a section `//- interfaces` with JSON by name:
`{"/talker": {"publishers": {"chatter": "std_msgs/String"}, "params": {"~rate": 10}}}`, see `interface_from_json`.
Without either there is no graph.

A section `//- commands` has, by command line, what the commands of parameters gave, as the fields of `CommandResult`:
`{"xacro r.xacro": {"output": "<robot/>"}}`. One that is not in it has yet to be run.
"""

from __future__ import annotations

import json
import os
import re
import textwrap
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePosixPath
from typing import Any

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.edits.edit import Edit
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment, Executable, Package
from preflight_analysis.evaluation.commands import CommandResult, KnownResults
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.annotations import read_annotation
from preflight_analysis.model.context import Context
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.tracing.interface import (
    NOT_RUN,
    SEEN,
    Endpoint,
    Evidence,
    Frame,
    FrameUse,
    Interface,
    MadeNode,
    Outcome,
    ParamUse,
    Range,
    Role,
    Unsure,
)
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from support.claims import undeclared
from support.fix_property import Launch, tries
from support.messages import wording

_FILE = re.compile(r"//- (\S+)\s*\Z")
_EXPECTED = re.compile(r"\s*(\^+) (error|warning|info|hint)\[([A-Z]{3}\d{3})\] ?(.*)\Z")
_ROLES: Mapping[str, Role] = {
    "publishers": "publisher",
    "subscribers": "subscriber",
    "services": "service",
    "clients": "client",
    "action_servers": "action_server",
    "action_clients": "action_client",
}


@dataclass(frozen=True, order=True)
class Expectation:
    """A line of carets: where it is, both counted from 0, and what is to be said there."""

    file: str
    line: int
    column: int
    length: int
    severity: str
    rule: str
    message: str


@dataclass(frozen=True)
class Fixture:
    """A fixture taken apart: the files without the expectations."""

    files: Mapping[str, str]
    root: str
    interfaces: Mapping[str, Any] | None
    commands: Mapping[str, Any]
    expected: tuple[Expectation, ...]


class _EveryExecutable(ExecutableIndex):
    """Whatever a known package is asked for is there."""

    def __init__(self, environment: Environment, disk: Disk) -> None:
        super().__init__(environment, disk)
        self._packages = environment.packages

    def find(self, package: str, name: str) -> Executable:
        found = self._packages.get(package)
        if found is None:
            return Executable(None)
        path = f"{found.share}/{name}"
        return Executable(path, (path,), found.share)

    component = find


class _Workspace(Workspace):
    """The packages of a fixture."""

    def executables_in(self, environment: Environment) -> ExecutableIndex:
        return _EveryExecutable(environment, self.sources)


def read_fixture(text: str) -> Fixture:
    """Take a fixture apart."""
    files: dict[str, list[str]] = {}
    expected: list[Expectation] = []
    path = "/main.launch"
    for line in textwrap.dedent(text).strip("\n").split("\n"):
        if start := _FILE.match(line):
            path = start[1]
            files[path] = []
        elif found := _EXPECTED.match(line):
            above = len(files[path]) - 1
            expected.append(Expectation(path, above, found.start(1), len(found[1]), found[2], found[3], found[4]))
        else:
            files.setdefault(path, []).append(line)
    texts = {name: "\n".join(lines) + "\n" for name, lines in files.items()}
    interfaces, commands = texts.pop("interfaces", None), texts.pop("commands", "{}")
    given = json.loads(interfaces) if interfaces else None
    return Fixture(texts, next(iter(texts)), given, json.loads(commands), tuple(expected))


def analyse(
    fixture: Fixture,
    args: Mapping[str, str] | None = None,
    why_not_run: str | None = None,
    sources: Sources | None = None,
    branches: bool = False,
    edited: bool = False,
) -> Context:
    """What the rules get to see of a fixture. `sources` are those of fixtures before, whose files it replaces. With
    `branches` what conditions leave out is looked at, too. One that was `edited` may have lost nodes."""
    sources = sources or Sources()
    for path, text in fixture.files.items():
        sources.open(path, text)
    results = {line: _result(data) for line, data in fixture.commands.items()}
    workspace = _Workspace(environment_of(fixture), sources, "/", KnownResults(None, results, {}, None), reads=False)
    analysis = workspace.evaluated(fixture.root, args)
    if branches:
        analysis = analysis.with_branches(workspace.branches(analysis))
    tree = analysis.tree
    annotated = any(read_annotation(node.action)[0] for node in tree.nodes)
    if fixture.interfaces is None and not annotated:
        return replace(analysis.context, why_not_run=why_not_run)
    said = fixture.interfaces or {}
    if branches or edited:
        said = {name: said[name] for name in said if any(node.name == name for node in tree.nodes)}
    return workspace.with_interfaces(analysis, interfaces_of(tree, said), why_not_run).context


def _result(data: Mapping[str, Any]) -> CommandResult:
    tail = tuple(data.get("stderr_tail", ()))
    return CommandResult(data.get("status", "done"), data.get("output", ""), data.get("reason", ""), tail)


def findings_of(text: str, **options: Any) -> list[Finding]:
    """The findings of a fixture; what it expects is not looked at. How they are worded is."""
    findings = run_rules(analyse(read_fixture(text), **options))
    _check_wording(findings)
    return findings


def check(text: str, **options: Any) -> list[Finding]:
    """Compare the findings of a fixture with what it expects, and return them."""
    fixture = read_fixture(text)
    context = analyse(fixture, **options)
    findings = run_rules(context)
    actual = {_as_expectation(finding, context): finding for finding in findings}
    unmet = list(fixture.expected)
    extra: list[Expectation] = []
    for got in actual:
        met = next((want for want in unmet if _meets(got, want)), None)
        if met is None:
            extra.append(got)
        else:
            unmet.remove(met)
    complaint = [f"missing: {_shown(each)}" for each in unmet] + [f"not expected: {_shown(each)}" for each in extra]
    assert not complaint, "\n" + "\n".join(complaint)
    _check_wording(findings)
    _check_fixes(fixture, findings, context, options)
    return findings


def _check_fixes(fixture: Fixture, findings: Sequence[Finding], context: Context, options: Mapping[str, Any]) -> None:
    def again(texts: Mapping[str, str], _: Sequence[Launch]) -> Generator[list[Finding]]:
        after = replace(fixture, files={**fixture.files, **texts})
        yield run_rules(analyse(after, **{**options, "sources": None, "edited": True}))

    # What a command makes of an edited file the fixture does not say.
    told = frozenset(fixture.files) - context.launch_files.keys() if fixture.commands else frozenset()
    launch = Launch(fixture.root, findings, context.documents.keys())
    tried = tries(findings, lambda path: _text_of(context, path), again, launch, unlooked=told)
    wrong = [f"{each.rule}, {each.title}: {each.wrong}" for each in tried if each.wrong is not None]
    assert not wrong or os.environ.get("FIX_TALLY"), "\n" + "\n".join(wrong)


def _text_of(context: Context, path: str) -> str | None:
    document = context.documents.get(path) or context.disk.text(path)
    return document.text if isinstance(document, Document) else None


def _check_wording(findings: Sequence[Finding]) -> None:
    complaint = [each for finding in findings for each in (*wording(finding), *undeclared(finding))]
    assert not complaint, "\n" + "\n".join(complaint)


def apply(text: str, edits: tuple[Edit, ...]) -> dict[str, str]:
    """The files of a fixture after the edits."""
    files = dict(read_fixture(text).files)
    for edit in sorted(edits, key=lambda e: e.location.span, reverse=True):
        old = files[edit.location.file]
        span = edit.location.span
        files[edit.location.file] = old[: span.start] + edit.text + old[span.end :]
    return files


def _evidence(inferred: bool, conditional: bool = False) -> Evidence:
    return Evidence("source", doubts=("condition",) if conditional else ()) if inferred else SEEN


def _made_node(*, inferred: bool = False, **fields: Any) -> MadeNode:
    return MadeNode(**fields, evidence=_evidence(inferred))


def _frame(
    parent: str, child: str, static: bool = False, inferred: bool = False, conditional: bool = False, *place: Any
) -> Frame:
    return Frame(parent, child, static, _evidence(inferred, conditional), *place)


def _frame_use(frame: str, call: str, looked_up: bool = True, conditional: bool = False, *place: Any) -> FrameUse:
    return FrameUse(frame, call, looked_up, _evidence(True, conditional), *place)


def interface_from_json(data: Mapping[str, Any]) -> Interface:
    """An interface as fixtures write it: endpoints `{"publishers": {name: type}}` and so on for each role, `params`
    `{name: default}`, null for none, or `{name: {"access": ...}}`, and `described` `{name: {"type": ..., "range":
    [0, 10], ...}}` of them; `source` where it was not run; `status`, `exit_code`, `reason`, `stderr`, `notes`,
    `answers`, `lacks`; `frames`, lists `[parent, child, static, inferred, conditional, file,
    line]`, `frame_uses`, lists `[frame, call, looked_up, conditional, file, line]`; `md5` `{name: sum}`;
    `qos` `{name: {policy: value}}`;
    `made` `{name: [file, line]}`; `unnamed`, those of the names that are random in each run; `builtin`, `speculative`,
    `on_demand` and `similar`, lists of names; `catalogued`;
    `nodes`, those that the process makes, with the fields of `MadeNode` and `inferred`.
    """
    made, unnamed = data.get("made", {}), data.get("unnamed", ())
    endpoints = [
        Endpoint(
            role,
            name,
            type_,
            data.get("md5", {}).get(name),
            {**({"latch": True} if name in data.get("latched", ()) else {}), **data.get("qos", {}).get(name, {})},
            source_file=made.get(name, [None, None])[0],
            source_line=made.get(name, [None, None])[1],
            builtin=name in data.get("builtin", ()),
            evidence=_evidence_of(data, name),
        )
        for key, role in _ROLES.items()
        for name, type_ in data.get(key, {}).items()
    ]
    params = [
        ParamUse(name, default["access"])
        if isinstance(default, dict) and "access" in default
        else ParamUse(
            name, "get", default, default is not None, default is None, *made.get(name, ()), **_described(data, name)
        )
        for name, default in data.get("params", {}).items()
    ]
    outcome = Outcome(
        data.get("status", "spinning"),
        data.get("exit_code"),
        data.get("signal"),
        tuple(data.get("stderr", ())),
        data.get("reason"),
        answers=tuple(data.get("answers", ())),
        lacks=data.get("lacks"),
    )
    source = data.get("source", "none" if outcome.status == "not-run" else "trace")
    nodes = tuple(_made_node(**node) for node in data.get("nodes", ()))
    return Interface(
        source,
        outcome,
        tuple(each for each in endpoints if each.name not in unnamed),
        tuple(params),
        unnamed=tuple(each for each in endpoints if each.name in unnamed),
        notes=tuple(data.get("notes", ())),
        frames=tuple(_frame(*each) for each in data.get("frames", ())),
        frame_uses=tuple(_frame_use(*each) for each in data.get("frame_uses", ())),
        nodes=nodes,
        transitions=tuple(data.get("transitions", ())),
        unnamed_calls=tuple(data.get("unnamed_calls", ())),
        stand_ins=tuple(data.get("stand_ins", ())),
    )


def _described(data: Mapping[str, Any], name: str) -> dict[str, Any]:
    given = dict(data.get("described", {}).get(name, {}))
    return {**given, "range": Range(*given["range"])} if "range" in given else given


def _evidence_of(data: Mapping[str, Any], name: str) -> Evidence:
    """How an end of that name is known, of an interface as fixtures write it."""
    said_by = data.get("catalogued", "")
    known = Evidence("catalogue", said_by) if said_by else Evidence()
    known = Evidence("similar") if name in data.get("similar", ()) else known
    doubts: dict[str, Unsure] = {"speculative": "made-up answer", "on_demand": "on demand"}
    return known.but(*(doubt for key, doubt in doubts.items() if name in data.get(key, ())))


def interfaces_of(tree: LaunchTree, given: Mapping[str, Any]) -> list[Interface]:
    unknown = set(given) - {node.name for node in tree.nodes}
    assert not unknown, f"the fixture has interfaces of nodes that are not there: {unknown}"
    return [interface_from_json(given[node.name]) if node.name in given else NOT_RUN for node in tree.nodes]


def environment_of(fixture: Fixture) -> Environment:
    packages = {"p": Package("p", "/p", "/p/package.xml")}
    for path, text in fixture.files.items():
        folder = PurePosixPath(path)
        if folder.name == "package.xml":
            name = next(iter(re.findall(r"<name>(.*)</name>", text)), folder.parent.name)
            dependencies = frozenset(re.findall(r"depend>(.*)</", text))
            packages[name] = Package(name, str(folder.parent), path, dependencies)
    workspace = next(
        (str(path.parent) for path in map(PurePosixPath, fixture.files) if path.name == SETTINGS_FILE), None
    )
    return Environment(1, "noetic", {}, ("/",), packages, {}, (), (), "/usr/bin/python3", workspace=workspace)


def _as_expectation(finding: Finding, context: Context) -> Expectation:
    location = finding.location
    document = context.documents.get(location.file) or context.disk.text(location.file)
    assert isinstance(document, Document), location.file
    lines = document.lines
    line, column = lines.position(location.span.start)
    end_line, end_column = lines.position(location.span.end)
    if end_line != line:
        text = document.text
        end_column = len(text[lines.line_start(line) : lines.line_span(line).end].rstrip("\r\n"))
    length = max(1, end_column - column)
    return Expectation(location.file, line, column, length, finding.severity, finding.rule, finding.message)


def _meets(got: Expectation, want: Expectation) -> bool:
    same_place = (got.file, got.line, got.column, got.length) == (want.file, want.line, want.column, want.length)
    return same_place and (got.severity, got.rule) == (want.severity, want.rule) and want.message in got.message


def _shown(each: Expectation) -> str:
    place = f"{each.file}:{each.line + 1}:{each.column + 1}+{each.length}"
    return f"{place} {each.severity}[{each.rule}] {each.message}"
