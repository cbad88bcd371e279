"""What is fuzzed: each parser of text that is not ours, as `run(data)` that raises where a promise is broken.

The promises: no exception but the documented one, spans that lie within their text, texts that every format of a report
can say, an answer soon. Seeds are valid inputs, and some that were wrong once.
"""

from __future__ import annotations

import contextlib
import dataclasses
import hashlib
import itertools
import json
import logging
import re
import signal
import tempfile
import time
import xml.etree.ElementTree as ET
import zlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from hypothesis import strategies as st
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable, _decode
from preflight_analysis.documents.span import LineIndex, Location, Span
from preflight_analysis.documents.yaml import parse_yaml
from preflight_analysis.environment.cmake import read_build
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import LEGACY_MANIFEST, find_packages
from preflight_analysis.environment.setup_py import read_python_build
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.ros2.param_files import read_made_param_file
from preflight_analysis.evaluation.ros2.simulated import plugins_in
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.yaml_params import YamlError, load_yaml
from preflight_analysis.findings.baseline import read_baseline
from preflight_analysis.findings.github import to_github
from preflight_analysis.findings.junit import to_junit
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import Report, to_json, to_text
from preflight_analysis.findings.sarif import to_sarif
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.interfaces.nodl_read import read_nodl
from preflight_analysis.live.compare import compare
from preflight_analysis.live.expected import expected_of
from preflight_analysis.live.model import CannotObserveError, Expected
from preflight_analysis.live.observe_ros1 import Ros1Observer
from preflight_analysis.live.observe_ros2 import said
from preflight_analysis.live.report import event_json, line
from preflight_analysis.live.watcher import State
from preflight_analysis.queries.calls import incoming, items_at, outgoing
from preflight_analysis.queries.completion import complete
from preflight_analysis.queries.completion_values import Lookup
from preflight_analysis.queries.definition import definition
from preflight_analysis.queries.folding import folds
from preflight_analysis.queries.hints import hints
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.lenses import lenses
from preflight_analysis.queries.links import links
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.references import references
from preflight_analysis.queries.rename import RenameRefusedError, prepare, rename
from preflight_analysis.queries.signature import signature
from preflight_analysis.queries.symbols import symbols
from preflight_analysis.queries.tokens import tokens
from preflight_analysis.robot.model import Simulated
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.robot.sdf import parse_sdf
from preflight_analysis.robot.semantic import parse_semantic
from preflight_analysis.robot.sources import source_file
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.snapshot import report as snapshot_report
from preflight_analysis.snapshot.difference import difference
from preflight_analysis.snapshot.files import NotASnapshotError, from_yaml, to_yaml
from preflight_analysis.tracing import node_recipe
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import NOT_RUN
from preflight_analysis.tracing.observation import observe
from preflight_analysis.tracing.reading import reader
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import Component, TraceRequest
from preflight_analysis.tracing.run import RawRun, _take
from preflight_analysis.tracing.trace_json import trace_json
from preflight_analysis.trees.read import read_trees
from preflight_analysis.workspace.index_data import data_of_index, index_of_data
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.project_settings import located_problems, read_project_settings
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Workspace
from preflight_server.cli.output import dumps_json
from support.logged_errors import LoggedErrors
from support.open_buffers import disk_with
from support.scripted_master import master

from fuzzing import seeds
from fuzzing.server import messages, server

SECONDS = 3.0
"""Of processor time that an input may take; a hundred times what a seed takes, on a busy machine with coverage."""
_UNSEEN = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")


class Wrong(Exception):
    """A promise that was not kept."""


class TooLong(BaseException):
    """It took too long; nothing that suppresses exceptions may suppress this."""


@dataclass(frozen=True)
class Target:
    """One parser. `seeds` are made when they are asked for; `words` are what its language is made of."""

    name: str
    run: Callable[[bytes], None]
    seeds: Callable[[], Sequence[bytes]]
    words: tuple[str, ...] = ()
    guided: bool = True
    """Whether the coverage of this process says anything about it."""


@st.composite
def inputs(draw: st.DrawFn, target: Target) -> bytes:
    """A seed with some edits."""
    first = target.seeds()
    data = draw(st.sampled_from(first))
    word = st.sampled_from([each.encode() for each in target.words or ("x",)])
    piece = st.one_of(word, st.binary(max_size=8), st.text(max_size=6).map(lambda t: t.encode("utf-8", "replace")))
    for _ in range(draw(st.integers(0, 6))):
        start = draw(st.integers(0, len(data)))
        if draw(st.booleans()):
            other = draw(st.sampled_from(first))
            at = draw(st.integers(0, len(other)))
            new = other[at : at + draw(st.integers(0, 80))]
        else:
            new = draw(piece) * draw(st.sampled_from((1, 1, 1, 2, 50)))
        data = data[:start] + new + data[start + draw(st.integers(0, 60)) :]
    return data[: seeds.LONGEST]


def bounded(run: Callable[[bytes], None], data: bytes, seconds: float = SECONDS) -> None:
    """Run a target once; what is logged as an error, and what takes too long, is wrong too."""

    def stop(*_: object) -> None:
        raise TooLong(f"more than {seconds:g} s of processor time")

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        _errors.messages.clear()
        run(data)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
    if _errors.messages:
        raise Wrong(_errors.messages[0])


_errors = LoggedErrors()
logging.getLogger("preflight_analysis").addHandler(_errors)
logging.getLogger("preflight_analysis").propagate = False


# What results have to be


def text_of(data: bytes) -> str:
    """The text of an editor's buffer: the server lets no halves of surrogate pairs in."""
    return data.decode("utf-8", "replace")


def spans(value: object, depth: int = 0) -> Iterator[Span]:
    """All spans in plain data that are not those of a `Location`, which speak of some file."""
    if isinstance(value, Span):
        yield value
    elif isinstance(value, Location | str | bytes | int | float) or value is None or depth > 60:
        return
    elif dataclasses.is_dataclass(value):
        for field in dataclasses.fields(value):
            yield from spans(getattr(value, field.name), depth + 1)
    elif isinstance(value, Mapping):
        yield from spans(list(value.items()), depth + 1)
    elif isinstance(value, Iterable):
        for item in value:
            yield from spans(item, depth + 1)


def check_spans(value: object, text: str) -> None:
    """All spans lie within the text."""
    for span in spans(value):
        if not 0 <= span.start <= span.end <= len(text):
            raise Wrong(f"{span} in a text of {len(text)} characters, in a {type(value).__name__}")


def check_location(location: Location, documents: Mapping[str, Document]) -> None:
    """It lies within its file."""
    document = documents.get(location.file)
    if document is not None:
        check_spans(location.span, document.text)


def check_printable(text: str) -> None:
    """Neither a terminal nor UTF-8 stumbles over it."""
    if found := _UNSEEN.search(text):
        raise Wrong(f"{found[0]!r} would be printed: {text[max(0, found.start() - 60) : found.end() + 20]!r}")
    printable(text).encode()


def check_json(data: Mapping[str, Any]) -> None:
    """It can be said in JSON, which can be read."""
    text = dumps_json(data)
    check_printable(text)
    json.loads(text)


def check_report(report: Report, base: str) -> None:
    """Every format can say it."""
    check_json(to_json(report))
    check_json(to_sarif(report, all_rules(), base))
    check_printable(to_text(report, base=base))
    check_printable(to_github(report, base))
    ET.fromstring(to_junit(report, report.findings[:1], list(report.documents), base))


# The workspace that launch files are in


@dataclass(frozen=True)
class Place:
    """A package `p` of a generation of ROS, with nodes in Python and C++, and what else launch files name."""

    folder: Path
    environment: Environment


@cache
def _scratch() -> Path:
    holder = tempfile.TemporaryDirectory(prefix="preflight-fuzz-")
    _kept.append(holder)
    return Path(holder.name)


_kept: list[tempfile.TemporaryDirectory[str]] = []
_CMAKE = {
    1: "project(p)\ncatkin_package()\nadd_executable(cpp src/node.cpp)\n",
    2: "project(p)\nadd_executable(cpp src/node.cpp)\ninstall(TARGETS cpp DESTINATION lib/p)\n"
    "install(PROGRAMS scripts/node.py DESTINATION lib/p)\nament_package()\n",
}


@cache
def place(generation: int) -> Place:
    """Made once in a process."""
    folder = _scratch() / f"ros{generation}"
    tool = "catkin" if generation == 1 else "ament_cmake"
    share = folder / "src" / "p"
    files = {
        "package.xml": f"<package format='2'><name>p</name><buildtool_depend>{tool}</buildtool_depend></package>",
        "CMakeLists.txt": _CMAKE[generation],
        "src/node.cpp": "int main() {}",
        "scripts/node.py": "#!/usr/bin/env python3\n",
        "launch/other.launch": "<launch><arg name='a' default='1'/><node pkg='p' type='node.py' name='o'/></launch>",
        "launch/other.launch.xml": "<launch><arg name='a' default='1'/><node pkg='p' exec='node.py'/></launch>",
        "config/params.yaml": "a: 1\nb: {c: [1, 2]}\n" if generation == 1 else "/**:\n  ros__parameters: {a: 1}\n",
    }
    for name, text in files.items():
        path = share / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)
    package = Package("p", str(share), str(share / "package.xml"), build_type=tool)
    return Place(
        folder,
        Environment(
            generation,
            "noetic" if generation == 1 else "jazzy",
            {"HOME": "/nowhere"},
            (str(folder / "src"),),
            {"p": package},
            {},
            (),
            (),
            "/usr/bin/python3",
            workspace=str(folder),
        ),
    )


class _Answers:
    """Every command line, and every run of a Python launch file, gave this."""

    reader = None
    edition = 0
    placeholder = None

    def __init__(self, output: str) -> None:
        self._output = output

    def result(self, line: str) -> CommandResult | None:
        return CommandResult("done", self._output)

    def answering(self, question: str) -> tuple[str, ...]:
        return ()


def look(generation: int, texts: Mapping[str, str], root: str, answers: str | None = None) -> None:
    """Analyse a root with texts in open buffers, by their paths in the package, and ask all that an editor asks at a
    place that the first text decides."""
    there = place(generation)
    share = Path(there.environment.packages["p"].share)
    sources = Sources()
    paths = {name: str(share / name) for name in texts}
    for name, text in texts.items():
        sources.open(paths[name], text)
    commands = _Answers(answers) if answers is not None else None
    workspace = Workspace(there.environment, sources, str(there.folder), *([commands] if commands else []))
    analysis = workspace.static(str(share / root))
    analysis = workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), None)
    documents = analysis.documents
    for finding in analysis.findings:
        check_location(finding.location, documents)
        for related in finding.related:
            check_location(related.location, documents)
        for fix in finding.fixes:
            for edit in fix.edits:
                check_location(edit.location, documents)
    base = str(there.folder)
    check_report(Report(analysis.findings, documents), base)
    check_json(tree_json(analysis.tree, documents, analysis.findings))
    if analysis.graph is not None:
        check_json(graph_json(analysis.graph))
        expected_of(analysis.graph, documents)
    name, text = next(iter(texts.items()))
    path = paths[name]
    offset = zlib.crc32(text.encode("utf-8", "surrogatepass")) % (len(text) + 1)
    trigger = (None, text[offset - 1 : offset] or None)[offset % 2]
    for location in (n.location for n in analysis.tree.nodes):
        check_location(location, documents)
    found = hover([analysis], path, offset, 0)
    if found is not None:
        check_spans(found, text)
    launch_file = analysis.launch_files.get(path)
    if launch_file is None:
        return
    check_spans((launch_file.root, launch_file.extra_roots, launch_file.named), text)
    check_spans((launch_file.document.children, launch_file.document.problems), text)
    check_spans(symbols(launch_file), text)
    check_spans(folds(launch_file), text)
    check_spans(tokens(launch_file), text)
    check_spans(links(analysis, path), text)
    check_spans(hints([analysis], path, Span(0, len(text))), text)
    check_spans(signature(analysis, launch_file, offset, sources), text)
    executables = ExecutableIndex(there.environment)
    completion = complete(analysis, launch_file, offset, Lookup(sources, executables, workspace.ahead_of_runs), trigger)
    check_spans(completion, text)
    index = build_index(workspace, str(there.folder), ())
    if index is None:
        return
    context = QueryContext(path, (analysis,), index, workspace)
    for target in definition(context, offset, analysis.findings):
        check_spans(target, text) if target.__class__ is Span else None
    for reference in references(context, offset):
        check_location(reference.location, documents)
    lenses(context)
    for item in items_at(context, offset):
        str(item)
    incoming(context)
    outgoing(context)
    with contextlib.suppress(RenameRefusedError):
        prepare(context, offset)
        for edit in rename(context, offset, "new_name"):
            check_location(edit.location, documents)


# The targets


def ros1_launch(data: bytes) -> None:
    look(1, {"launch/x.launch": text_of(data)}, "launch/x.launch")


def ros2_xml(data: bytes) -> None:
    look(2, {"launch/x.launch.xml": text_of(data)}, "launch/x.launch.xml")


def ros2_yaml(data: bytes) -> None:
    look(2, {"launch/x.launch.yaml": text_of(data)}, "launch/x.launch.yaml")


def ros2_python(data: bytes) -> None:
    look(2, {"launch/x.launch.py": text_of(data)}, "launch/x.launch.py")


class _Raises(logging.Handler):
    """What is logged where a reading raised."""

    def emit(self, record: logging.LogRecord) -> None:
        if record.exc_info is not None and record.exc_info[1] is not None:
            raise record.exc_info[1]


def python_reading(data: bytes) -> None:
    """A Python launch file that is read, and then each function that it leaves to be called."""
    there = place(2)
    share = there.environment.packages["p"].share
    job = {"file": f"{share}/launch/x.launch.py", "text": text_of(data), "env": {}, "calls": [], "assumed": []}
    log = logging.getLogger(reader.__name__)
    log.handlers[:] = [_Raises()]
    within = reader.Surroundings(Disk(), (str(there.folder),), (share,), {}, lambda: [])
    check_json(reader.read({**job, "packages": {"p": share}}, within))


_CALLER = "from p import other\ndef generate_launch_description():\n    return LaunchDescription([Node(package='p')])\n"


def launch_answers(data: bytes) -> None:
    """What the run of a Python launch file gave."""
    look(2, {"launch/x.launch.py": _CALLER}, "launch/x.launch.py", text_of(data))


_ROS1_PARAMS = (
    "<launch><rosparam command='load' file='$(find p)/config/params.yaml'/>"
    "<node pkg='p' type='node.py' name='n'>"
    "<rosparam command='load' file='$(find p)/config/params.yaml'/></node></launch>"
)
_ROS2_PARAMS = (
    "<launch><node pkg='p' exec='node.py'><param from='$(find-pkg-share p)/config/params.yaml'/></node></launch>"
)


def ros1_params(data: bytes) -> None:
    text = text_of(data)
    with contextlib.suppress(YamlError):
        load_yaml(text)
    look(1, {"config/params.yaml": text, "launch/x.launch": _ROS1_PARAMS}, "launch/x.launch")


def ros2_params(data: bytes) -> None:
    text = text_of(data)
    check_spans(read_made_param_file(text), text)
    check_spans(parse_yaml("/x.yaml", text).document, text)
    look(2, {"config/params.yaml": text, "launch/x.launch.xml": _ROS2_PARAMS}, "launch/x.launch.xml")


def decoding(data: bytes) -> None:
    """The bytes of a file of any encoding."""
    found = _decode("/x.launch", data)
    if isinstance(found, Unreadable):
        check_printable(printable(found.reason))
    else:
        found.text.encode("utf-8", "surrogatepass")


def package_xml(data: bytes) -> None:
    for name in ("package.xml", LEGACY_MANIFEST):
        folder = _scratch() / f"manifest-{name}" / "q"
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
        for each in find_packages([str(folder.parent)]).packages.values():
            if not isinstance(each.name, str) or not all(isinstance(d, str) for d in each.dependencies):
                raise Wrong(f"{each}")


def cmake(data: bytes) -> None:
    text = text_of(data)
    build = read_build("/w/p", "p", disk_with({"/w/p/CMakeLists.txt": text, "/w/p/more.cmake": text}))
    for target in build.targets.values():
        build.sources(target)
    for name in ("cpp", "node.py", ""):
        build.made_of(name)
        build.library(name)


_BRIDGE = (
    "<launch><node pkg='ros_gz_bridge' exec='parameter_bridge' args='-p config_file:=$(find-pkg-share p)/b.yaml'/>"
    "</launch>"
)


def gazebo_bridges(data: bytes) -> None:
    """The configuration file of a bridge."""
    look(2, {"b.yaml": text_of(data), "launch/x.launch.xml": _BRIDGE}, "launch/x.launch.xml")


def robot_description(data: bytes) -> None:
    """What it says of the robot, and to the plugins of ros2_control in Gazebo; where its elements are written."""
    text = text_of(data)
    for plugin in plugins_in(text):
        assert plugin.namespace.startswith("/")
    description = parse_description(text)
    assert set(description.roots) <= set(description.links)
    assert not description.lacks or not any("${" in link for link in description.links)
    found = source_file(disk_with({"/w/robot.urdf": text}).db, "/w/robot.urdf")
    for written in found.written if found is not None else ():
        assert 0 <= written.span.start <= written.span.end <= len(text)
        assert written.may_be(written.value) or not written.is_literal


def simulated_world(data: bytes) -> None:
    """The worlds and models that it has, as far as they are in each other."""

    def depth(each: Simulated) -> int:
        return 1 + max(map(depth, each.models), default=0)

    for found in parse_sdf(text_of(data)) or ():
        assert found.kind in ("world", "model")
        assert depth(found) < 20


def semantic_description(data: bytes) -> None:
    """What it says of the groups of a robot."""
    found = parse_semantic(text_of(data))
    for named in (*found.links, *found.joints, *found.group_names) if found is not None else ():
        assert named.value and "$" not in named.value


def behavior_tree(data: bytes) -> None:
    """What is named in a tree stands where it is said to stand."""
    text = text_of(data)
    found = read_trees(Document("/w/tree.xml", text, "", (), (), LineIndex(text)))
    spans = [*(each.span for each in found.includes), *(each.span for node in found.nodes for each in node.attributes)]
    for span in (*spans, *(each.span for each in (*found.nodes, *found.subtrees))):
        assert 0 <= span.start < span.end <= len(text)


def setup_py(data: bytes) -> None:
    text = text_of(data)
    for name in ("setup.py", "setup.cfg", "pyproject.toml"):
        read_python_build("/w/p", "p", disk_with({f"/w/p/{name}": text}))


def settings(data: bytes) -> None:
    folder = _scratch() / "settings"
    folder.mkdir(exist_ok=True)
    (folder / ".ros-preflight.yaml").write_bytes(data)
    found = read_project_settings(str(folder))
    document, problems = located_problems(found)
    for message, location in problems:
        printable(message).encode("utf-8", "surrogatepass")
        check_spans(location.span, document.text if document else "")


@cache
def _asked() -> tuple[Recipe, TraceRequest]:
    there = place(1)
    script = str(Path(there.environment.packages["p"].share) / "scripts" / "node.py")
    request = TraceRequest("/node", "p", script, params={"/a": 1, "/node/b": [1, 2]})
    return node_recipe.make(there.environment, request, None), request


def cache_entries(data: bytes) -> None:
    """An entry of the cache, its check sum right: who can write there can make that, too."""
    recipe, request = _asked()
    kept = TraceCache(_scratch() / "cache")
    where = kept._place(recipe, request)
    where.folder.mkdir(parents=True, exist_ok=True)
    path = where.folder / f"{where.recipe}-x.json"
    path.write_bytes(hashlib.sha256(data).hexdigest().encode() + b"\n" + data)
    interface = kept.load(recipe, request)
    if interface is not None:
        check_json(trace_json([(_node(), interface)]))
    for each in kept.traces_of(1, "p", "node.py", None)[1]:
        check_json(trace_json([(_node(), each.interface)]))


@cache
def _node() -> LaunchNode:
    there = place(1)
    path = str(Path(there.environment.packages["p"].share) / "launch" / "other.launch")
    return Workspace(there.environment, Sources(), str(there.folder)).static(path).tree.nodes[0]


@cache
def _indexed() -> Workspace:
    there = place(1)
    return Workspace(there.environment, Sources(), str(there.folder))


def kept_index(data: bytes) -> None:
    """What a process, or an earlier start, wrote of the workspace index; lists of entries are texts of their own."""
    try:
        said = json.loads(data)
    except (ValueError, RecursionError):
        return
    if isinstance(said, dict):
        for part in ("files", "roots"):
            if isinstance(said.get(part), list):
                said[part] = [json.dumps(each) for each in said[part]]
        index_of_data(said, _indexed())


def _written_index() -> list[bytes]:
    workspace = _indexed()
    said = data_of_index(workspace.sources, build_index(workspace, str(place(1).folder)))
    return [json.dumps({**said, **{part: [*map(json.loads, said[part])] for part in ("files", "roots")}}).encode()]


def trace_events(data: bytes) -> None:
    """The lines that come out of the sandbox, and what a node printed."""
    recipe, request = _asked()
    raw = RawRun(stderr=data)
    for each in data.split(b"\n"):
        _take(each, raw)
    of_component = dataclasses.replace(request, generation=2, component=Component("p::C", "/c", "/box"))
    for asked in (of_component, *(dataclasses.replace(request, generation=generation) for generation in (1, 2))):
        found = observe(raw, recipe, asked)
        check_json(trace_json([(_node(), found.interface)]))
        for each in found.interface.outcome.stderr_tail:
            check_printable(each)
    there = place(1)
    workspace = Workspace(there.environment, Sources(), str(there.folder))
    root = str(Path(there.environment.packages["p"].share) / "launch" / "other.launch")
    analysis = workspace.with_interfaces(workspace.static(root), [found.interface], None)
    check_report(Report(analysis.findings, analysis.documents), str(there.folder))
    hover([analysis], root, analysis.documents[root].text.index("node.py"), 0)


def master_answers(data: bytes) -> None:
    """What a master, its nodes and its services answer; the parts of the input are the answers, in turn."""
    with master(data) as uri:
        observer = Ros1Observer(uri)
        try:
            found = observer.observe(2.0)
        except CannotObserveError as error:
            printable(str(error)).encode("utf-8", "surrogatepass")
            return
        finally:
            observer.close()
    _compared(found)


def graph_of_ros2(data: bytes) -> None:
    """What the helper says of a ROS 2 system, whose names others make up."""
    try:
        found = said(text_of(data), "domain 0")
    except (CannotObserveError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return
    _compared(found)


def _compared(found: Any) -> None:
    there = place(found.generation)
    root = "launch/other.launch" if found.generation == 1 else "launch/other.launch.xml"
    analysis = _root(found.generation, root)
    assert analysis.graph is not None
    for expected in (expected_of(analysis.graph, analysis.documents), Expected(found.generation, ())):
        comparison = compare(expected, found)
        check_json(event_json(State(comparison)))
        for issue in comparison.issues:
            check_printable(line(issue, str(there.folder)))


@cache
def _root(generation: int, root: str) -> Any:
    there = place(generation)
    workspace = Workspace(there.environment, Sources(), str(there.folder))
    analysis = workspace.static(str(Path(there.environment.packages["p"].share) / root))
    return workspace.with_interfaces(analysis, [NOT_RUN] * len(analysis.tree.nodes), None)


def snapshots(data: bytes) -> None:
    text = text_of(data)
    try:
        found = from_yaml(text)
    except NotASnapshotError as error:
        printable(str(error)).encode("utf-8", "surrogatepass")
        return
    for other in (found, _empty()):
        between = difference(other, found)
        check_json(snapshot_report.to_json(between))
        printable(snapshot_report.to_text(between, "a", "b"))
        snapshot_report.to_markdown(between, "a", "b")
    from_yaml(to_yaml(found))


@cache
def _empty() -> Any:
    return from_yaml("schema: ros-preflight/snapshot/1\nnodes: {}\n")


def nodl(data: bytes) -> None:
    text = text_of(data)
    for path, generation in itertools.product(("/x.nodl.yaml", "/x.nodl.xml"), (1, 2)):
        for described in read_nodl(path, text, generation):
            repr(described)


def baseline(data: bytes) -> None:
    with contextlib.suppress(ValueError):
        read_baseline(text_of(data))


_STARTS = {
    1: "<launch><node pkg='p' type='node.py' name='n'><param name='a' value='1'/></node>"
    "<node pkg='p' type='cpp' name='c'/></launch>",
    2: "<launch><node pkg='p' exec='node.py'><param name='a' value='1'/></node><node pkg='p' exec='cpp'/></launch>",
}


def _source(name: str, data: bytes) -> None:
    text = text_of(data)
    look(1, {"launch/x.launch": _STARTS[1], name: text}, "launch/x.launch")
    look(2, {"launch/x.launch.xml": _STARTS[2], name: text}, "launch/x.launch.xml")


def python_source(data: bytes) -> None:
    _source("scripts/node.py", data)


def cpp_source(data: bytes) -> None:
    _source("src/node.cpp", data)


def lsp_messages(data: bytes) -> None:
    """Bodies of messages, one a line, for the real server, which has to answer a question after them."""
    server().send(data)


def _entries() -> list[bytes]:
    """What the cache itself writes."""
    recipe, request = _asked()
    records = [dict(each) for each in seeds.EVENTS]
    found = observe(RawRun(records=records), recipe, request)
    kept = TraceCache(_scratch() / "written")
    kept.store(recipe, request, found.interface, found.dependencies, started=time.time() + 9)
    return [path.read_bytes().partition(b"\n")[2] for path in (_scratch() / "written").rglob("*.json")]


TARGETS = (
    Target(
        "ros1-xml", ros1_launch, lambda: seeds.files("ros1/**/*.launch", "ros1/**/*.test", "documents/*"), seeds.XML
    ),
    Target("ros2-xml", ros2_xml, lambda: seeds.files("ros2/**/*.launch.xml", "ros2/**/*_launch.xml"), seeds.ROS2),
    Target(
        "ros2-yaml",
        ros2_yaml,
        lambda: seeds.files("ros2/**/*launch.yaml", "ros2/**/*launch.yml"),
        (*seeds.YAML, *seeds.ROS2),
    ),
    Target("ros2-python", ros2_python, lambda: seeds.files("ros2/**/*launch.py"), seeds.PYTHON),
    Target(
        "python-reading",
        python_reading,
        lambda: [*seeds.files("ros2/**/*launch.py"), *seeds.READ],
        (*seeds.PYTHON, *seeds.READ_WORDS),
    ),
    Target("launch-answers", launch_answers, lambda: seeds.json_lines(*seeds.ANSWERS), seeds.JSON),
    Target("ros1-params", ros1_params, lambda: seeds.files("ros1/**/*.yaml"), seeds.YAML),
    Target(
        "ros2-params", ros2_params, lambda: seeds.files("ros2/**/*params*.yaml", "ros2/**/config/*.yaml"), seeds.YAML
    ),
    Target(
        "decoding",
        decoding,
        lambda: [b"<?xml version='1.0' encoding='%s'?><launch/>" % e for e in (b"latin-1", b"utf-7")],
    ),
    Target("package-xml", package_xml, lambda: seeds.files("**/package.xml"), seeds.XML),
    Target(
        "cmake",
        cmake,
        lambda: seeds.files("**/CMakeLists.txt") or [b"project(p)\nadd_executable(cpp a.cpp)\n"],
        seeds.CMAKE,
    ),
    Target(
        "setup-py",
        setup_py,
        lambda: [*seeds.files("**/setup.py", "**/setup.cfg"), seeds.SETUP, seeds.SETUP_CFG, seeds.PYPROJECT],
        seeds.PYTHON,
    ),
    Target("gazebo-bridges", gazebo_bridges, lambda: [seeds.BRIDGES], seeds.YAML),
    Target("behavior-tree", behavior_tree, lambda: [seeds.BEHAVIOR_TREE], seeds.XML),
    Target("semantic-description", semantic_description, lambda: [seeds.SRDF], seeds.XML),
    Target("simulated-world", simulated_world, lambda: [seeds.WORLD], seeds.XML),
    Target("robot-description", robot_description, lambda: [seeds.ROBOT, seeds.ROBOT_IN_PART], seeds.XML),
    Target("settings", settings, lambda: [seeds.SETTINGS], seeds.YAML),
    Target("cache-entries", cache_entries, _entries, seeds.JSON),
    Target("kept-index", kept_index, _written_index, seeds.JSON),
    Target(
        "trace-events",
        trace_events,
        lambda: [b"\n".join(seeds.json_lines(*seeds.EVENTS)), *seeds.json_lines(*seeds.EVENTS)],
        seeds.JSON,
    ),
    Target(
        "master-answers", master_answers, seeds.master_answers, ("<array>", "<nil/>", "<value>", "<struct>", "<i4>")
    ),
    Target("ros2-graph", graph_of_ros2, lambda: seeds.json_lines(seeds.GRAPH, {"error": "x"}), seeds.JSON),
    Target("snapshots", snapshots, lambda: [seeds.SNAPSHOT], seeds.YAML),
    Target("nodl", nodl, lambda: [seeds.NODL, seeds.NODL_1], (*seeds.YAML, *seeds.XML)),
    Target(
        "baseline",
        baseline,
        lambda: seeds.json_lines({"schema": "ros-preflight/baseline/1", "findings": [{"fingerprint": "x"}]}),
    ),
    Target("python-source", python_source, lambda: seeds.files("**/scripts/*", "**/*_node.py"), seeds.PYTHON),
    Target("cpp-source", cpp_source, lambda: seeds.files("**/*.cpp"), seeds.CPP),
    Target("lsp-messages", lsp_messages, messages, ("null", "-1", "1e999", '"{uri}"', "[]", "{}"), guided=False),
)
