"""Python launch files: what is asked of their runs, and what the answers say. Nothing is run here.

A request is a text that names the run completely: the file with its text, the environment, and which of its own
functions or substitutions are to be called with what configuration. Answers are given like those of commands
(`evaluation/commands.py`), by `tracing/launch_files.py`; as long as there is none the file is taken for what can be
read from it. The answer comes from the user's own process: nothing of its form is relied on.
"""

from __future__ import annotations

import ast
import json
import logging
import re
from collections.abc import Callable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from functools import lru_cache
from typing import Any, Literal, NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.change import Change, change
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.problems import (
    AssumedVariable,
    LaunchFileNotRun,
    NothingToReplace,
    PackageNotFound,
    PythonException,
    PythonImportFailed,
    UndeclaredArgument,
    UnsetVariable,
)
from preflight_analysis.evaluation.ros2.context import Configuration, Context
from preflight_analysis.evaluation.ros2.place import Place, PythonRun
from preflight_analysis.evaluation.ros2.python_agreement import differences, with_places
from preflight_analysis.evaluation.ros2.python_branches import together
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown, readable, unknown_text
from preflight_analysis.evaluation.tree import Command, Edited
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.configurations import substitutions_of
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.launch.python_actions import actions_of
from preflight_analysis.launch.python_source import PythonSource

MARK = "\0launch file "
"""What no command line begins with."""
_PACKAGE = re.compile(r"package '([^']*)' not found")
_UNDEFINED = re.compile(r"name '(\w+)' is not defined")
_ENVIRON = re.compile(r"environ\s*\[\s*['\"]([^'\"]+)['\"]\s*\]")
_READS_ENVIRONMENT = re.compile(r"\b(?:environ|getenv)\b")
_READS = r"(?:environ(?:\.get)?|getenv)\s*[\[(]\s*['\"](%s)['\"]"
_NAMED = re.compile(r"(['\"])([A-Za-z_][A-Za-z0-9_]*)\1")
"""What no run is told, whatever its file asks for."""
_PACKAGE_ERROR = "PackageNotFoundError"
_UNSEENED = "a condition of the launch file depends on it"
_IMPORT_ERRORS = ("ModuleNotFoundError", "ImportError")
_ANSWERS = frozenset(("actions", "text", "error"))
_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Answer:
    """What a call gave: actions, or a text. `place` is that of the actions: calls in them come after this one."""

    place: Place
    actions: tuple[Action, ...] = ()
    text: str | None = None
    changed: Mapping[str, str] | None = None
    removed: tuple[str, ...] = ()
    variables: Mapping[str, str] | None = None


class _Reply(NamedTuple):
    """What an answer says, its text, and that of the reading which completes it."""

    values: Mapping[str, Any]
    output: str
    read: str | None


def request(run: PythonRun) -> str:
    """The name of a run."""
    request = {"file": run.file, "text": run.text, "env": dict(run.variables), "calls": list(run.calls)}
    if run.given:
        request["given"] = dict(run.given)
    if run.packages:
        request["packages"] = dict(run.packages)
    if run.otherwise:
        request["otherwise"] = list(run.otherwise)
    return MARK + json.dumps(request, sort_keys=True)


def parse_request(line: str) -> dict[str, Any] | None:
    """What `request` made a text from; None if it is a command line."""
    if not line.startswith(MARK):
        return None
    found: dict[str, Any] = json.loads(line[len(MARK) :])
    return found


def recorded(
    state: Collector, context: Context, launch_file: LaunchFile, chain: Origin
) -> tuple[LaunchFile, PythonRun | None]:
    """The launch file as its run tells it, and the run; without one as it can be read."""
    document, whole = launch_file.document, Span(0, 0)
    given = _given(document.text, context.initial_environment, state.environment.withheld)
    run = PythonRun(
        launch_file.path, document.text, context.changed_variables(), (), _source(document.text), given=given
    )
    run = _reusable(state, replace(run, packages=state.environment.meant))
    place = Place(launch_file.path, document.lines, chain, run)
    _note_withheld(state, place, run)
    unknowns, problems = len(state.unknowns), len(state.problems)
    reply = None
    if document.problems:
        at = launch_file.document.location(document.problems[0].span)
        state.note_unknown(launch_file.path, "it cannot be run as it is", at)
    else:
        reply = _ask(state, context, place, run, place.origin(whole))
    if reply is None and (last := _last_good(state, run)) is not None:
        run, reply, edited = last
        wrong = (*(p.span for p in document.problems), *(p.location.span for p in state.problems[problems:]))
        state.edited[run.file] = Edited(edited, frozenset(wrong))
        del state.unknowns[unknowns:]
    if reply is None or launch_file.root is None:
        return launch_file, None
    children = _actions(reply, run.source, whole)
    for name, value in _variables(reply).items():
        context.set_variable(name, value)
    partly = bool(reply.values.get("unread"))
    run = replace(run, read_partly=partly) if partly else run
    return replace(launch_file, root=replace(launch_file.root, children=children), partial=partly), run


@dataclass(frozen=True, slots=True, eq=False)
class _Known:
    """A run whose answer is known, and what of its context that depends on: names, None where all of them count."""

    line: str
    text: str
    variables: Mapping[str, str]
    calls: tuple[Mapping[str, Any], ...]
    configurations: frozenset[str] | None
    environment: frozenset[str] | None
    file: bool

    def answers(self, run: PythonRun) -> bool:
        """Whether it holds for a run that asks the same question."""
        if not run.calls:
            return _same(self.variables, run.variables, self.environment)
        then, now = self.calls[-1], run.calls[-1]
        before, given = then["configurations"], now["configurations"]
        if self.configurations is None:
            written = now["files"]
        else:
            named = (value for name in self.configurations if isinstance(value := given.get(name), str))
            written = {path: now["files"][path] for path in named if path in now["files"]}
        return (
            _same(before, given, self.configurations)
            and _same(then["env"], now["env"], self.environment)
            and (not self.file or then["file"] == now["file"])
            and all(then["files"].get(path) == text for path, text in written.items())
        )


def _same(then: Mapping[str, Any], now: Mapping[str, Any], names: frozenset[str] | None) -> bool:
    return then == now if names is None else all(then.get(name) == now.get(name) for name in names)


def _names(value: object) -> frozenset[str] | None:
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        return None
    return frozenset(value)


@lru_cache(maxsize=1024)
def _known(line: str, output: str) -> _Known | None:
    """A run by its line and its answer."""
    run, reply = parse_request(line), _read(output)
    if run is None or not isinstance(reply, dict):
        return None
    read = reply.get("read")
    if not isinstance(read, dict):
        read = {}
    configurations, environment = _names(read.get("configurations")), _names(read.get("env"))
    is_file = read.get("file") is not False
    return _Known(line, run["text"], run["env"], tuple(run["calls"]), configurations, environment, is_file)


def _reusable(state: Collector, run: PythonRun) -> PythonRun:
    """The run that answered the question in a context that makes no difference; itself where there is none."""
    for line in state.results.answering(_question(run, run.text)) if not run.otherwise else ():
        known = _known_of(state, line)
        if known is not None and known.answers(run):
            return replace(run, variables=known.variables, calls=known.calls)
    return run


def _known_of(state: Collector, line: str) -> _Known | None:
    result = state.results.result(line)
    return _known(line, result.output) if result is not None and result.status == "done" else None


def _last_good(state: Collector, run: PythonRun) -> tuple[PythonRun, _Reply, Span] | None:
    """The last run of the launch file (or of the same call in it) that went well, what it told, and what of the text
    is another one since. It counts until there is one of the text as it is: half typed it cannot be run, and a run
    takes its time."""
    if (reading := _last_reading(state, run)) is not None:
        return reading
    for line in reversed(state.results.answering(_question(run, None))):
        known, result = _known_of(state, line), state.results.result(line)
        if known is None or result is None or not known.answers(run):
            continue
        changed = change(known.text, run.text)
        source = _source(known.text, changed)
        earlier = replace(
            run, text=known.text, source=source, variables=known.variables, calls=known.calls, replaced=True
        )
        return earlier, _reply(result.output), changed.after
    return None


def _last_reading(state: Collector, run: PythonRun) -> tuple[PythonRun, _Reply, Span] | None:
    """The same by reading, where that leaves nothing to a run."""
    reader = state.results.reader
    for text in reader.texts_before(run.file) if reader is not None else ():
        earlier = replace(run, text=text)
        reading = reader.reading(request(earlier)) if reader is not None and text != run.text else None
        values = _read(reading.output) if reading is not None else None
        if reading is not None and isinstance(values, dict) and values.get("unread") == [] and "error" not in values:
            changed = change(text, run.text)
            earlier = replace(earlier, source=_source(text, changed), replaced=True)
            return earlier, _reply(reading.output), changed.after
    return None


def _question(run: PythonRun, text: str | None) -> str:
    return _question_of(run.file, text, run.variables, run.calls, run.given, run.packages)


def _question_of(
    file: str,
    text: str | None,
    variables: Mapping[str, str],
    calls: Sequence[Mapping[str, Any]],
    given: Mapping[str, str],
    packages: Mapping[str, str],
) -> str:
    """What is asked, but for the context of what is asked: of the file itself, or of the last call. `text`: None for
    whatever it is or was."""
    of_last: list[Any] = [None]
    if calls:
        last = calls[-1]
        of_last = [dict(variables), list(calls[:-1]), last["id"], last["name"], last["what"]]
    always = [file] if text is None else [file, digest(text), dict(given), dict(packages)]
    return json.dumps([*always, of_last], sort_keys=True)


def answered_questions(line: str, result: CommandResult) -> tuple[str, ...]:
    """The questions that a run answers, of the file as it is and, if it went well, whatever its text is; none for the
    command line of something else."""
    run = parse_request(line)
    reply = _read(result.output) if run is not None and result.status == "done" else None
    if run is None or not isinstance(reply, dict):
        return ()
    good = not isinstance(reply.get("error"), dict)
    texts = (run["text"], None) if good else (run["text"],)
    more = run.get("given", {}), run.get("packages", {})
    return tuple(_question_of(run["file"], text, run["env"], run["calls"], *more) for text in texts)


class OwnCode(NamedTuple):
    """A function, substitution or condition of the file's own: its number in the run, its name, what launch does with
    it and where it stands."""

    number: str
    name: str
    what: Literal["execute", "perform"]
    at: Span


def called(state: Collector, context: Context, place: Place, code: OwnCode) -> Answer | None:
    """What code of the file's own gives; None if that is not known."""
    number, name, what, at = code
    if place.run is None or not number.isdigit():
        state.note_unknown(name, "the launch file was not run", place.location(at))
        return None
    configurations = _configurations(context)
    given = {v for v in configurations.values() if isinstance(v, str)}
    call = {
        "id": int(number),
        "name": name,
        "what": what,
        "configurations": configurations,
        "env": context.changed_variables(),
        "file": context.launch_file,
        "files": {path: made.text for path in given if (made := state.text_made(path)) is not None},
    }
    run = _reusable(state, replace(place.run, calls=(*place.run.calls, call)))
    unknowns, problems = len(state.unknowns), len(state.problems)
    reply = _ask(state, context, place, run, place.origin(at))
    if reply is None and not (run.replaced or run.otherwise) and (last := _last_good(state, run)) is not None:
        run, reply, edited = last
        if not state.is_edited(run.file):
            wrong = frozenset(problem.location.span for problem in state.problems[problems:])
            state.edited[run.file] = Edited(edited, wrong)
        del state.unknowns[unknowns:]
    if reply is None:
        return None
    if what == "perform":
        text = reply.values.get("text")
        return Answer(place, text=text) if isinstance(text, str) else None
    changed, removed = _texts(reply.values.get("set")), reply.values.get("unset")
    gone = tuple(each for each in removed if isinstance(each, str)) if isinstance(removed, list) else ()
    actions = _actions(reply, run.source, at)
    return Answer(replace(place, run=run), actions, None, changed, gone, _variables(reply))


@derived
def calls_own_code(launch_file: LaunchFile) -> bool:
    """Whether there is code of the file's own, which may do with configurations what it likes."""
    for action in launch_file.root.walk() if launch_file.root is not None else ():
        if action.kind in ("opaque", "opaque_coroutine", "function"):
            return True
        if any(substitution.command == "own" for substitution in substitutions_of(action)):
            return True
    return False


def _given(text: str, environment: Mapping[str, str], withheld: AbstractSet[str]) -> dict[str, str]:
    """The variables of the environment that a launch file names, as `os.environ['ROBOT']`: XML reads them as well. Of a
    secret it is told that it is set."""
    if _READS_ENVIRONMENT.search(text) is None:
        return {}
    names = sorted({name for _, name in _NAMED.findall(text)})
    known = {name: value for name in names if (value := environment.get(name)) is not None}
    return {**known, **{name: unknown_text(f"the variable {name}") for name in names if name in withheld}}


def _note_withheld(state: Collector, place: Place, run: PythonRun) -> None:
    """Note the secrets that a launch file reads: each where it does first."""
    for name in run.given:
        if name in state.environment.withheld and (read := re.search(_READS % re.escape(name), run.text)) is not None:
            origin = place.origin(Span(read.start(1), read.end(1)))
            state.withheld_variable(run.text[read.start() : read.end()], name, origin)


def _configurations(context: Context) -> dict[str, Any]:
    """What is configured, with a mark for what is not known."""
    given = dict(context.configurations)
    if (namespace := context.namespace) is not None:
        given["ros_namespace"] = Configuration(namespace, None)
    found: dict[str, Any] = {
        name: each.value.text if each.value.known else unknown_text(name) for name, each in given.items()
    }
    if params := context.params:
        found["global_params"] = [[p.name, p.value] if p.name is not None else p.value for p in params]
    if remaps := context.remaps:
        found["ros_remaps"] = [[remap.source.text, remap.target.text] for remap in remaps]
    return found


def _ask(state: Collector, context: Context, place: Place, run: PythonRun, origin: Origin) -> _Reply | None:
    """The answer to a run, None if there is none or it has failed."""
    line = request(run)
    result = state.results.result(line) if not run.read_partly else None
    what = "the launch file" if not run.calls else str(run.calls[-1]["name"])
    if result is None or result.status == "not-run":
        reading = reader.reading(line) if (reader := state.results.reader) is not None else None
        values = _read(reading.output) if reading is not None else None
        unread = values.get("unread") if isinstance(values, dict) else None
        if result is None and unread and not run.read_partly and state.results.answering(_question(run, None)):
            reading = None  # until the run is there, the last one tells more
        if unread != [] and not run.replaced and not run.read_partly:
            state.commands.append(Command(line, "", origin, result, launch_file=True))
        if unread != [] and result is not None:
            state.note_unknown(what, f"it was not run: {result.reason}", origin[-1])
            state.problem(LaunchFileNotRun(what, result.reason), origin)
        if reading is None:
            if result is None:
                state.note_unknown(what, "it was not run", origin[-1])
            return None
        _unread(state, place, run, unread, origin)
        result = reading
    elif not run.replaced:
        state.commands.append(Command(line, "", origin, result, launch_file=True))
    if result.status != "done":
        state.problem(PythonException("", result.reason), origin)
        state.note_unknown(what, result.reason, origin[-1])
        return None
    reply, read = _read(result.output), result.output
    if not isinstance(reply, dict):
        state.note_unknown(what, "its run gave no answer that can be read", origin[-1])
        return None
    reading = reader.reading(line) if "unread" not in reply and (reader := state.results.reader) is not None else None
    if reading is not None:
        read = reading.output
        _compare(run.file, result.output, read)
    for path, text in (_texts(reply.get("files")) or {}).items():
        if state.files.exists(path):
            continue  # a file of the host's is what it is, whatever the run says
        state.made[path] = Document(path, text, digest(text), (), (), LineIndex(text))
    _guessed(state, place, run, reply.get("guessed"), origin)
    _missed(state, context, place, run, reply.get("missed"), origin)
    _assumed(state, place, run, reply.get("assumed"), origin)
    _unmatched(state, place, run, reply.get("unmatched"), origin)
    error = reply.get("error")
    if isinstance(error, dict):
        _raised(state, place, run, error, origin)
        return None
    return _reply(result.output, read)


@lru_cache(maxsize=256)
def _reply(output: str, read: str | None = None) -> _Reply:
    """An answer, with what only a reading tells: the places of texts, and what the other branches of conditions make.
    To what it makes a run may give other numbers."""
    values, reading = _read(output), _read(read) if read not in (None, output) else None
    if not isinstance(reading, dict):
        return _Reply(together(values, values.get("branches"), callable=True), output, read)
    if isinstance(values.get("actions"), list):
        values = {**values, "actions": with_places(values["actions"], reading.get("actions"))}
    return _Reply(together(values, reading.get("branches"), callable=False), output, read)


@lru_cache(maxsize=256)
def _compare(file: str, run: str, read: str) -> None:
    """Log where a reading is wrong, once: what is known of it has to be what the run tells."""
    one, other = _read(read), _read(run)
    if not (isinstance(one, dict) and isinstance(other, dict)) or not _ANSWERS & other.keys():
        return
    try:
        found = next(differences(one, other), None)
    except (KeyError, TypeError, AttributeError, IndexError):
        return  # nothing of the form of what a run tells is relied on
    if found is not None:
        _log.warning("reading %s differs from its run: %s", file, found)


@lru_cache(maxsize=64)
def _source(text: str, since: Change | None = None) -> PythonSource:
    return PythonSource(text, LineIndex(text), since)


# A file whose functions ask for more runs, one after another, is evaluated again after each of them.


@lru_cache(maxsize=256)
def _read(output: str) -> Any:
    """What an answer says, which nobody changes; None if it cannot be read."""
    try:
        return json.loads(output)
    except (ValueError, RecursionError):
        return None


@lru_cache(maxsize=256)
def _actions_of(output: str, read: str | None, source: PythonSource, around: Span) -> tuple[Action, ...]:
    return actions_of(_reply(output, read).values.get("actions"), source, around)


def _actions(reply: _Reply, source: PythonSource, around: Span) -> tuple[Action, ...]:
    """The actions of an answer."""
    return _actions_of(reply.output, reply.read, source, around)


def _missed(state: Collector, context: Context, place: Place, run: PythonRun, missed: object, origin: Origin) -> None:
    """The modules, packages, variables and configurations that were not there, and for which something stood in: each
    where it is asked for first."""
    for each in missed if isinstance(missed, list) else ():
        match each:
            case [str(what), str(name), at] if is_unknown(name):
                state.note_unknown(
                    readable(name), f"the name of the {what} is unresolved", _line(place, run, at, origin)[-1]
                )
            case ["variable" | "none", str(name), at] if name in state.environment.withheld:
                state.withheld_variable(name, name, _line(place, run, at, origin))
            case ["variable" | "none", str(name), at] if name in state.environment.variables:
                there = _line(place, run, at, origin)[-1]
                state.note_unknown(name, f"the sandbox is not told what {name} is", there)
            case ["configuration", str(name), at]:
                undeclared = UndeclaredArgument(name, context.names, context.not_followed)
                state.problem(undeclared, _line(place, run, at, origin), fatal=undeclared.not_followed is None)
            case ["none", str(name), at]:
                state.problem(UnsetVariable(name), _line(place, run, at, origin), fatal=False)
            case [str(what), str(name), at] if what in _MISSED:
                state.problem(_MISSED[what](name), _line(place, run, at, origin))


def _unread(state: Collector, place: Place, run: PythonRun, unread: object, origin: Origin) -> None:
    """What only a run of the file tells."""
    for each in unread if isinstance(unread, list) else ():
        match each:
            case [str(name), str(reason), at]:
                state.note_unknown(name, reason, _line(place, run, at, origin)[-1])


def _assumed(state: Collector, place: Place, run: PythonRun, assumed: object, origin: Origin) -> None:
    """The variables of ROS that it asked for and that are not set."""
    for each in assumed if isinstance(assumed, list) else ():
        match each:
            case [str(name), str(value), at]:
                state.problem(AssumedVariable(name, value), _line(place, run, at, origin))


def _unmatched(state: Collector, place: Place, run: PythonRun, unmatched: object, origin: Origin) -> None:
    """What is to be replaced in a file and is not in it."""
    for each in unmatched if isinstance(unmatched, list) else ():
        match each:
            case [str(by), str(name), str(path), at]:
                state.problem(NothingToReplace(name, by, path), _line(place, run, at, origin), fatal=False)


def _guessed(state: Collector, place: Place, run: PythonRun, guessed: object, origin: Origin) -> None:
    """The conditions of the file that are not known, one branch of which it took."""
    for each in guessed if isinstance(guessed, list) else ():
        match each:
            case [str(name), at]:
                there = _line(place, run, at, origin)[-1]
                state.note_unknown(readable(name), _UNSEENED, there, decides=True)


def _line(place: Place, run: PythonRun, at: object, origin: Origin) -> Origin:
    """The line of a place that an answer names."""
    line = at[0] if isinstance(at, list) and at and isinstance(at[0], int) else 0
    return place.origin(run.source.line_span(line)) if line else origin


def _module(name: str) -> PythonImportFailed:
    return PythonImportFailed(name, f"No module named '{name}'", stood_in_for=True)


_MISSED: dict[str, Callable[[str], ProblemKind]] = {
    "module": _module,
    "package": PackageNotFound,
    "variable": UnsetVariable,
}


def _variables(reply: _Reply) -> dict[str, str]:
    """The variables that were set to what is known."""
    return {k: v for k, v in (_texts(reply.values.get("env")) or {}).items() if not is_unknown(v)}


def _raised(state: Collector, place: Place, run: PythonRun, error: Mapping[str, Any], origin: Origin) -> None:
    """What an exception says, on the line of the file that raised it. Where it may come of something that is not known
    the file is not to blame."""
    name, message = str(error.get("type")), str(error.get("message"))
    state.note_unknown(name, readable(message), origin[-1])
    if error.get("unsure") is True:
        return
    frames = error.get("frames")
    own = [
        (frame[0], frame[1])
        for frame in (frames if isinstance(frames, list) else ())
        if isinstance(frame, list) and len(frame) == 3 and isinstance(frame[0], str) and isinstance(frame[1], int)
    ]
    here = [line for file, line in own if file == run.file]
    if here:
        named = _name_on(run, here[-1], message) if name == "NameError" else None
        origin = place.origin(named or run.source.line_span(here[-1]))
    package = _PACKAGE.search(message) if name == _PACKAGE_ERROR else None
    variable = _variable(run, here[-1], message) if name == "KeyError" and here else None
    if package is not None:
        state.problem(PackageNotFound(package[1]), origin)
    elif variable is not None and variable in state.environment.withheld:
        state.withheld_variable(name, variable, origin)
    elif variable is not None and variable in state.environment.variables:
        state.note_unknown(name, f"the sandbox is not told what {variable} is", origin[-1])
    elif variable is not None:
        state.problem(UnsetVariable(variable), origin)
    elif name in _IMPORT_ERRORS:
        module = str(error.get("module", ""))
        instead = str(error.get("instead", ""))
        state.problem(PythonImportFailed(module, message, instead=instead), origin)
    else:
        behind = [(file, line) for file, line in own if file.startswith("/") and state.text_made(file) is None]
        places = tuple(_frame(state, place, run, file, line) for file, line in behind)
        if name == "AssertionError" and not message and behind:
            message = _asserted(state, run, *behind[-1])
        state.problem(PythonException(name, message, places, str(error.get("absent") or "")), origin)


def _name_on(run: PythonRun, line: int, message: str) -> Span | None:
    """Where the name stands on a line that nothing defines."""
    found = _UNDEFINED.match(message)
    names = (node for node in run.source.nodes if isinstance(node, ast.Name) and node.lineno == line)
    node = next((each for each in names if found is not None and each.id == found[1]), None)
    return run.source.span(node) if node is not None else None


def _variable(run: PythonRun, line: int, message: str) -> str | None:
    """The environment variable that `os.environ['NAME']` on the line misses."""
    span = run.source.line_span(line)
    return next((n for n in _ENVIRON.findall(run.text[span.start : span.end]) if f"'{n}'" == message), None)


def _frame(state: Collector, place: Place, run: PythonRun, file: str, line: int) -> Location:
    """A line of the file or of one that it uses."""
    if file == run.file:
        return place.location(run.source.line_span(line))
    found = state.read_text(file)
    return found.location(found.lines.line_span(line - 1)) if isinstance(found, Document) else Location.of_file(file)


def _asserted(state: Collector, run: PythonRun, file: str, line: int) -> str:
    """The `assert` that failed on a line and says nothing itself; "" where there is none."""
    found = state.read_text(file) if file != run.file else None
    text = found.text if isinstance(found, Document) else run.text if file == run.file else ""
    module = PythonSource(text, LineIndex(text)).module
    for node in ast.walk(module) if module is not None else ():
        if isinstance(node, ast.Assert) and node.lineno <= line <= (node.end_lineno or node.lineno):
            return f"assert {' '.join((ast.get_source_segment(text, node.test) or '').split())}"
    return ""


def _texts(value: object) -> dict[str, str] | None:
    if not isinstance(value, dict):
        return None
    return {k: v for k, v in value.items() if isinstance(k, str) and isinstance(v, str)}
