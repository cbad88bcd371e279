"""What a Python launch file makes, or what a call of its own code gives, as it is read: the answer that a run gives
(`agents/fake_launch/main.py`), without one.

`unread` of the answer is what only a run tells; without any, the answer is that of a run.
"""

from __future__ import annotations

import ast
import hashlib
import itertools
import json
import logging
import os
import re
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from preflight_analysis.launch.python_source import module_of
from preflight_analysis.tracing.agents import anything
from preflight_analysis.tracing.agents.anything import AnyBase, Anything, is_unknown, marked, readable, unknown_text
from preflight_analysis.tracing.agents.fake_launch import (
    base,
    library,
    reads,
    rewrites,
)
from preflight_analysis.tracing.agents.fake_launch.base import RECORDER, LaunchDescription
from preflight_analysis.tracing.agents.fake_launch.main import _module_with, _of_ours
from preflight_analysis.tracing.agents.fake_launch.serialize import Serializer, TooMuchError
from preflight_analysis.tracing.reading import data_classes, interpreter, natives
from preflight_analysis.tracing.reading.around import Around, Context, Services
from preflight_analysis.tracing.reading.branches import Asked, Reading, with_branches
from preflight_analysis.tracing.reading.files import Disk, Files, Path
from preflight_analysis.tracing.reading.values import FAKES, NotRead, Raised, whole

_FUNCTION = "generate_launch_description"
MAX_TEXT = 300_000
MAX_PARTS = 2_000_000
MAX_CHARACTERS = 20_000_000
"""Of an answer."""
MAX_ASKED = 300
"""Conditions that are not known."""
MAX_FRAMES = 30
_LOCK = threading.RLock()
"""The fakes have what they remember in one place."""
_FIRST = next(RECORDER.count)
"""The number of what is made first: importing the fakes makes some."""
_OF_PROGRAM = (interpreter.__file__, natives.__file__, data_classes.__file__)
"""In whose frames the program asks."""
_OURS = re.compile(r"\bpreflight_analysis\.tracing\.(?:\w+\.)+")
"""Before the name of a class that takes the place of one of launch."""
_log = logging.getLogger(__name__)


class Surroundings(NamedTuple):
    """Where a launch file is read."""

    disk: Disk
    roots: tuple[str, ...]
    """The folders of the workspace, of which files may be read."""
    folders: tuple[str, ...]
    """Those of Python modules."""
    variables: Mapping[str, str]
    """Those of the environment that a run has besides the ones that the request gives."""
    installed: Callable[[], Sequence[tuple[str, str]]]
    """Paths in share folders, and the files and folders of the source that they will lead to."""
    shares: tuple[str, ...] = ()
    """Folders of installed packages, of which files may be read too."""


def read(job: Mapping[str, Any], within: Surroundings) -> dict[str, Any] | None:
    """The answer to a request (`evaluation.ros2.python_runs.parse_request`), None where it is not read at all."""
    told = tell(job, within)
    answer: dict[str, Any] | None = None if told is None else json.loads(told)
    return answer


def tell(job: Mapping[str, Any], within: Surroundings) -> str | None:
    """The same as JSON."""
    tree = module_of(job["text"]) if len(job["text"]) <= MAX_TEXT else None
    if tree is None:
        return None
    with _LOCK:
        try:
            made = _answer(job, tree, within)
            _measure(made)
            return _OURS.sub("", json.dumps(made, default=_as_text))
        except (NotRead, TooMuchError, RecursionError, MemoryError) as error:
            _log.debug("%s is not read: %s %s", job["file"], type(error).__name__, error)
            return None
        except Exception:
            _log.exception("reading %s failed", job["file"])
            return None


def _answer(job: Mapping[str, Any], tree: ast.Module, within: Surroundings) -> dict[str, Any]:
    """The answer, with what the other branches of conditions make that are not known."""
    numbers: dict[tuple[str, int], int] = {}

    def read(otherwise: frozenset[str]) -> Reading:
        with _Fakes(job, otherwise, numbers) as fakes:
            answer = fakes.answer(tree, within)
            return Reading(answer, fakes.asked, fakes.around.interpreter.steps if fakes.around is not None else 0)

    def other(otherwise: frozenset[str]) -> Reading | None:
        try:
            return read(otherwise)
        except (NotRead, TooMuchError, RecursionError, MemoryError):
            return None

    otherwise = frozenset(job.get("otherwise", ()))
    if otherwise:
        other(frozenset())  # it has the numbers
    return with_branches(read(otherwise), otherwise, other)


def _measure(answer: Any) -> None:
    """Raise `NotRead` where an answer is larger than anyone writes, with what is in it several times."""
    items, characters, level = MAX_PARTS, MAX_CHARACTERS, [answer]
    while level:
        below: list[Any] = []
        for each in level:
            if isinstance(each, str):
                characters -= len(each)
            elif isinstance(each, (dict, list, tuple)):
                items -= len(each)
                if items < 0:
                    break
                below += each.values() if isinstance(each, dict) else each
        if items < 0 or characters < 0:
            raise NotRead("the answer is too large")
        level = below


def _as_text(value: Any) -> str:
    """As a run tells it."""
    if not isinstance(value, (Anything, AnyBase)):
        raise NotRead(f"a {type(value).__name__} is told")
    return str(value)


def _name_of(job: Mapping[str, Any]) -> str:
    """Names what is asked, for the files that it writes."""
    asked = json.dumps([job["file"], job["text"], job["calls"]], sort_keys=True)
    return hashlib.sha256(asked.encode(errors="surrogatepass")).hexdigest()[:12]


class _Fakes:
    """The fakes, while they are used for one reading: conditions that are not known and reached as one of `otherwise`
    get the other answer. `numbers` are those of what is made where none does, by how that is reached and how often
    it was before: what several branches make has one number."""

    def __init__(self, job: Mapping[str, Any], otherwise: frozenset[str], numbers: dict[tuple[str, int], int]) -> None:
        self.job, self._otherwise, self._numbers = job, otherwise, numbers
        self.around: Around | None = None
        self.asked: dict[str, Asked] = {}
        self._made: dict[str, int] = {}
        self._asked = 0

    def __enter__(self) -> _Fakes:
        vars(RECORDER).clear()
        RECORDER.__init__()  # type: ignore[misc]
        anything._asked.clear()
        anything.on_use.clear()
        anything.on_condition[:] = [self._guess]
        vars(RECORDER)["count"] = self._known_numbers() if self._otherwise else self._first_numbers()
        RECORDER.file = self.job["file"]
        RECORDER.packages = dict(self.job["packages"])
        RECORDER.assumed = frozenset(self.job["assumed"])
        vars(RECORDER).update(
            place=self._place,
            place_of=lambda frame: self._place(),
            asks_for=self._note_assumed,
            looks_for=lambda path, found, frame: None,
        )
        return self

    def __exit__(self, *_: object) -> None:
        anything.on_condition.clear()
        vars(RECORDER).clear()
        RECORDER.__init__()  # type: ignore[misc]

    def _place(self) -> list[int] | None:
        return None if self.around is None else self.around.interpreter.place_in(RECORDER.file)

    def _first_numbers(self) -> Iterator[int]:
        for number in itertools.count(_FIRST):
            self._numbers[self._reached()] = number
            yield number

    def _known_numbers(self) -> Iterator[int]:
        while True:
            reached = self._reached()
            number = self._numbers.get(reached)
            yield int(hashlib.sha256(repr(reached).encode()).hexdigest()[:12], 16) if number is None else number

    def _reached(self) -> tuple[str, int]:
        """How that is reached which is made now, and how often it was before."""
        asks = "" if self.around is None else self.around.interpreter.asks
        count = self._made[asks] = self._made.get(asks, 0) + 1
        return asks, count

    def _note_assumed(self, variable: Any, frame: Any) -> None:
        if variable in RECORDER.assumed:
            RECORDER.assumed_in.setdefault(variable, self._place())

    def _guess(self, name: str, frame: Any, answer: bool) -> bool:
        if frame.f_code.co_filename not in _OF_PROGRAM:
            return answer
        self._asked += 1
        if self._asked > MAX_ASKED:
            raise NotRead("too many conditions are not known")
        RECORDER.note_guess(name, frame)
        return self._chosen(answer)

    def _chosen(self, answer: bool) -> bool:
        """The answer to the condition that the program asks for now."""
        if self.around is None:
            return answer
        interpreter = self.around.interpreter
        node, key = interpreter.frame.node, interpreter.asks
        answer ^= key in self._otherwise
        if isinstance(node, ast.expr) and key not in self.asked:
            # Python asks whether it is in there.
            is_negated = isinstance(node, ast.Compare) and isinstance(node.ops[0], ast.NotIn)
            self.asked[key] = Asked(ast.unparse(node), answer ^ is_negated)
        return answer

    def answer(
        self,
        tree: ast.Module,
        within: Surroundings,
    ) -> dict[str, Any]:
        """The answer of a run."""
        job = self.job
        known = {**job.get("given", {}), **within.variables, **job["env"]}
        self.around = around = Around(
            job,
            lambda unknown: Files(within.disk, within.roots, within.shares, unknown, within.installed, _name_of(job)),
            within.folders,
            known,
        )
        result: dict[str, Any]
        with _in_fakes(around):
            try:
                result = self._run(around, tree)
                failed = False
            except Raised as raised:
                result, failed = {"error": _error_record(around, raised)}, True
        if failed and (
            RECORDER.guessed or RECORDER.answers._given or around.asked_unset or around.files.looked_in_vain
        ):
            around.unknown(str(result["error"]["type"]), "it may be another one in a run")
        result["guessed"] = [[readable(name), place] for (name, _), place in RECORDER.guessed.items()]
        result["missed"] = [[what, name, place] for (what, name), place in RECORDER.missed.items()]
        result["assumed"] = [[name, known.get(name, ""), place] for name, place in RECORDER.assumed_in.items()]
        result["unmatched"], result["files"] = RECORDER.unmatched, around.files.made
        result["unread"] = [[name, reason, place] for (name, reason, _), place in around.unread.items()]
        return result

    def _run(self, around: Around, tree: ast.Module) -> dict[str, Any]:
        job, environment = self.job, dict(dict.items(around.environment))
        contents: dict[str, Any] = {"__name__": "python_launch_file", "__file__": job["file"]}
        around.interpreter.run_module(tree, job["file"], contents)
        description = self._description(around, contents)
        if isinstance(description, (Anything, AnyBase)):
            description = LaunchDescription([description])
        if not isinstance(description, LaunchDescription):
            kind = type(description).__name__
            raise Raised(
                TypeError(f"generate_launch_description() gives back a '{kind}' in place of a LaunchDescription")
            )
        result = {"actions": _described(description.entities), "env": _changed(around, environment)}
        for call in job["calls"]:
            RECORDER.begin()
            result = self._call(around, call)
        return result

    def _description(self, around: Around, contents: dict[str, Any]) -> Any:
        function = contents.get(_FUNCTION)
        if function is None:
            raise NotRead("it has no function for a description")
        return around.interpreter.call(function, (), {})

    def _call(self, around: Around, call: Mapping[str, Any]) -> dict[str, Any]:
        thing = RECORDER.made.get(call["id"])
        if thing is None or type(thing).__name__ != call["name"]:
            raise NotRead("what is called is another thing")
        context = Context()
        before = {name: marked(value) for name, value in call["configurations"].items()}
        context.launch_configurations = reads.Configurations(before)
        context.extend_globals(
            {"current_launch_file_path": call["file"], "current_launch_file_directory": os.path.dirname(call["file"])}
        )
        around.files.given.update(call["files"])
        dict.update(around.environment, call["env"])
        environment = dict(dict.items(around.environment))
        if call["what"] == "perform":
            return {"text": self._performed(around, thing, context)}
        made = around.interpreter._native(self._executed, thing, context)
        after = dict(context.launch_configurations)
        return {
            "actions": made,
            "set": {k: str(v) for k, v in after.items() if isinstance(k, str) and before.get(k) != v},
            "unset": [k for k in before if k not in after],
            "env": _changed(around, environment),
        }

    def _performed(self, around: Around, thing: Any, context: Any) -> str:
        if isinstance(thing, base.Condition):
            return str(around.interpreter.call(thing.evaluate, (context,), {})).lower()
        text = str(around.interpreter._native(around.performed, thing, context))
        rewrites.tell_source(thing, context, text)
        RECORDER.unmatched += [[*each, thing.preflight_place] for each in rewrites.unmatched(thing, context)]
        is_guess = RECORDER.guessed and not is_unknown(text) and around.files.isfile(text) is not True
        return unknown_text(next(iter(RECORDER.guessed))[0]) if is_guess else text

    @staticmethod
    def _executed(thing: Any, context: Any) -> list[Any]:
        given = thing.execute(context)
        serializer = Serializer()
        made: list[Any] = [serializer.plain_entity(each) for each in context.preflight_executed]
        if isinstance(given, LaunchDescription):
            given = given.entities
        if given is not None:
            made += _described(given if isinstance(given, (list, tuple)) else [given])
        return made


def _described(entities: Any) -> list[Any]:
    if isinstance(entities, (list, tuple)):
        whole(entities)
    return Serializer().description(entities)


def _changed(around: Around, before: Mapping[str, str]) -> dict[str, str]:
    return {k: v for k, v in dict.items(around.environment) if before.get(k) != v}


def _error_record(around: Around, raised: Raised) -> dict[str, Any]:
    error = raised.error
    try:
        message = str(around.interpreter.call(str, (error,), {}))
    except Raised:
        message = "<exception str() failed>"
    record: dict[str, Any] = {
        "type": type(error).__name__,
        "message": message[:2000],
        "frames": raised.frames[-MAX_FRAMES:],
    }
    if isinstance(error, ImportError):
        record["module"], record["instead"] = error.name or "", _module_with(message)
    if isinstance(error, OSError) and isinstance(error.filename, str):
        record["path"] = error.filename
    if isinstance(error, OSError):
        record["errno"] = error.errno
    if (RECORDER.unknown or RECORDER.guessed) and not _of_ours(error, message):
        record["unsure"] = True
    if isinstance(error, base.NotHereError):
        record["refused"] = True
    return record


@contextmanager
def _in_fakes(around: Around) -> Iterator[None]:
    """The fakes ask the reading where they ask Python in a run. Of the system they have nothing that is not named."""
    files = around.files
    paths = {name: getattr(os.path, name) for name in ("join", "dirname", "basename", "normpath")}
    system = Services(
        path=Services(**paths, isfile=files.isfile, isdir=files.isdir, exists=files.exists, abspath=files.abspath),
        environ=around.environment,
        listdir=files.names,
        **{name: getattr(os, name) for name in ("fspath", "fsdecode", "PathLike", "sep", "pathsep")},
    )
    instead: dict[str, Any] = {name: Services() for name in _OF_SYSTEM}
    instead |= dict.fromkeys(_BUILT_IN, _nothing_of_system)
    instead |= {
        "os": system,
        "open": files.open,
        "importlib": Services(import_module=around.imported),
        "tempfile": Services(NamedTemporaryFile=files.temporary),
        "pathlib": Services(Path=Path),
        "xml": Services(etree=Services(ElementTree=Services(parse=around.parsed_xml))),
        "eval": around.evaluated,
        "provided_for": lambda frame, errors: around.is_provided_for(errors),
    }
    before = []
    for names in _SERVED:
        before.append({name: names.get(name, _ABSENT) for name in instead if name in names or name in _BUILT_IN})
        names.update({name: instead[name] for name in before[-1]})
    others = [(vars(reads), "is_own", lambda frame: True), (vars(library), "LaunchContext", Context)]
    kept = [names[name] for names, name, _ in others]
    for names, name, value in others:
        names[name] = value
    try:
        yield
    finally:
        for (names, name, _), value in zip(others, kept, strict=True):
            names[name] = value
        for names, was in zip(_SERVED, before, strict=True):
            for name, value in was.items():
                if value is _ABSENT:
                    del names[name]
                else:
                    names[name] = value
        del Path._files, Context._around


def _nothing_of_system(*_: Any, **__: Any) -> Any:
    raise NotRead("what the system has")


_OF_SYSTEM = (
    "os",
    "importlib",
    "subprocess",
    "shutil",
    "tempfile",
    "glob",
    "pathlib",
    "xml",
    "linecache",
    "atexit",
    "stat",
    "io",
)
_BUILT_IN = ("open", "eval", "exec", "compile", "__import__", "input", "breakpoint")
_SERVED = [
    vars(module)
    for name, module in sorted(sys.modules.items())
    if name.startswith(FAKES + ".") and name.rpartition(".")[2] not in ("main", "modules", "rewritten", "unknown_files")
]
"""The names in the modules of the fakes. The others have to do with how a run is done."""
_ABSENT = object()
