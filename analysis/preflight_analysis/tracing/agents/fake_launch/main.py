"""Runs a launch file, and what the host asks of it: `main` is called with the job in the arguments of the process."""

from __future__ import annotations

import atexit
import base64
import contextlib
import inspect
import json
import linecache
import os
import re
import stat
import sys
import tempfile
import threading
import traceback
import types
import zlib
from typing import Any, Callable, Optional

from .. import installed
from ..anything import AnyBase, Anything, is_unknown, marked, on_condition, readable, unknown_text
from ..process import own_seconds
from . import programs, reads, rewrites, rewritten, unknown_files, waiting, written
from .base import OURS, RECORDER, Condition, LaunchContext, LaunchDescription, NotHereError
from .library import InvalidPythonLaunchFileError
from .modules import install, module_with
from .serialize import Serializer

_FUNCTION = "generate_launch_description"
MAX_FILES = 200
MAX_FILE_BYTES = 500_000
MAX_FRAMES = 30
_SKIPPED = ("ros_home", "ros_log", programs.PRINTED)
_NOT_IN_MODULE = re.compile(r"cannot import name '(\w+)' from '(?:launch|launch_ros)[.']")
_NOT_DEFINED = re.compile(r"name '(\w+)' is not defined")
_fork, _dup2 = os.fork, os.dup2
_ARGUMENTS = re.compile(r"\(\) (missing|got an unexpected keyword argument)")


def main() -> None:
    """Tell what the launch file makes, or what a call of the job's gives, as JSON on standard output."""
    job = json.loads(zlib.decompress(base64.b64decode("".join(sys.argv[1:]))))
    is_try = RECORDER.answers.begin()
    outside, folder = dict(os.environ), os.getcwd()
    output = os.dup(1)
    os.dup2(2, 1)
    RECORDER.file, RECORDER.packages, RECORDER.own_xacro = job["file"], job["packages"], job["own_xacro"]
    RECORDER.descriptions, RECORDER.assumed = job["descriptions"], frozenset(job["assumed"])
    for name, value in job.get("given", {}).items():
        os.environ.setdefault(name, value)  # what the sandbox sets itself, such as HOME, is so in it
    os.environ.update(job["env"])
    sys.argv = ["ros2", "launch", job["file"]]
    sys.path[:0] = job["paths"]
    branches = job.get("branches")

    def tell(text: str, *, failed: bool) -> None:
        if branches is not None:
            text = json.dumps({"branches": [text if failed else _branch(each) for each in branches]})
        with open(output, "w", encoding="utf-8", errors="surrogatepass") as out:
            out.write(text)

    def tell_other(text: str) -> None:
        """What another try tells, in the place of one that failed."""
        with contextlib.suppress(Exception):  # what the file may have made of `os`
            _clean()
            os.chdir(folder)
            _dup2(output, 1)
            RECORDER.answers.try_again(outside, text)
        _dup2(2, 1)
        tell(RECORDER.answers.first(text), failed=True)

    def give_up() -> None:
        if is_over.acquire(blocking=False):
            tell_other("")
            os._exit(0)

    def wait_for_end() -> None:
        deadline = own_seconds(this) + RECORDER.answers.seconds_left()
        while (left := deadline - own_seconds(this)) > 0:
            if has_ended.wait(left):
                return
        give_up()

    this = os.getpid()
    is_over, has_ended = threading.Lock(), threading.Event()
    timer = threading.Thread(target=wait_for_end, daemon=True)
    if is_try:
        timer.start()
    text, error = _answer(lambda: _run(job))
    is_over.acquire()  # not given back: it is over for the timer, too, or the timer ends this process
    if is_try:
        has_ended.set()
        timer.join()
    if error is not None and (is_try or RECORDER.answers.may_try(error)):
        tell_other(text)
    else:
        tell(text, failed=error is not None)


def _answer(work: Callable[[], dict[str, Any]]) -> tuple[str, Optional[dict[str, Any]]]:
    """What some work gives or raises, with the files that were written, as JSON; and what it raises."""
    try:
        result = work()
    except BaseException as error:
        result = {"error": _error_record(error)}
    if RECORDER.last_reads is not None:
        result["read"] = RECORDER.last_reads.record()
    result["guessed"] = [[readable(name), place] for (name, _), place in RECORDER.guessed.items()]
    result["missed"] = [[what, name, place] for (what, name), place in RECORDER.missed.items()]
    result["assumed"] = [[name, os.environ.get(name, ""), place] for name, place in RECORDER.assumed_in.items()]
    result["unmatched"] = RECORDER.unmatched
    result["files"] = _files()
    return json.dumps(result), result.get("error")


def _clean() -> None:
    """Remove what was written."""
    for path in _files():
        os.unlink(written.place(path))


def _branch(branch: dict[str, Any]) -> Optional[str]:
    """The answer to one more call, in a process of its own: the next one finds everything as this one did. None where
    that is not possible, where it went wrong, or where other answers are to be tried."""
    if threading.active_count() > 1 or not hasattr(os, "memfd_create"):
        return None  # other threads are not there in a copy
    before = _files()
    answer = os.memfd_create("answer")
    sys.stdout.flush()
    sys.stderr.flush()
    child = _fork()
    if not child:
        try:
            text, error = _answer(lambda: _in_branch(branch))
            if error is None or not RECORDER.answers.may_try(error):
                with open(answer, "wb") as out:
                    out.write(text.encode(errors="surrogatepass"))
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
        finally:
            os._exit(0)
    _, status = os.waitpid(child, 0)
    with open(answer, "rb") as told:
        told.seek(0)
        text = told.read().decode(errors="surrogatepass")
    after = _files()
    for path in after.keys() - before.keys():
        os.unlink(written.place(path))
    return text if text and not status and all(after.get(path) == known for path, known in before.items()) else None


def _in_branch(branch: dict[str, Any]) -> dict[str, Any]:
    RECORDER.begin()
    return _call(branch)


def _write(files: dict[str, str]) -> None:
    for path, text in files.items():
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def _run(job: dict[str, Any]) -> dict[str, Any]:
    on_condition.append(RECORDER.guess)
    install()
    installed.install(job["installed"])
    reads.install()
    unknown_files.install()
    rewritten.install()
    waiting.install()
    environment = dict(os.environ)
    with reads.noted():
        actions = _described(job)
    changed = {k: v for k, v in os.environ.items() if environment.get(k) != v}
    result: dict[str, Any] = {"actions": actions, "env": changed}
    for call in job["calls"]:
        RECORDER.begin()
        result = _call(call)
    return result


def _described(job: dict[str, Any]) -> list[dict[str, Any]]:
    """The actions of the file."""
    lines = job["text"].splitlines(keepends=True)
    linecache.cache[job["file"]] = (len(job["text"]), None, lines, job["file"])  # the editor's, not the disk's
    module = types.ModuleType("python_launch_file")
    module.__file__ = job["file"]
    sys.modules["python_launch_file"] = module
    exec(rewritten.compiled(job["text"], job["file"]), vars(module))  # noqa: S102 - what this is for; inside the sandbox
    description = _description(module)
    if isinstance(description, (Anything, AnyBase)):
        description = LaunchDescription([description])
    if not isinstance(description, LaunchDescription):
        kind = type(description).__name__
        raise TypeError(f"generate_launch_description() gives back a '{kind}' in place of a LaunchDescription")
    return Serializer().description(description.entities)


def _description(module: types.ModuleType) -> Any:
    """What the file describes; one for `launch_test` has another function, which gives values for the tests besides."""
    of_tests = getattr(module, "generate_test_description", None)
    function = getattr(module, _FUNCTION, None)
    if function is not None:
        return function()
    if of_tests is None:
        import difflib  # noqa: PLC0415 - which other launch files do without

        near = difflib.get_close_matches(_FUNCTION, [name for name, thing in vars(module).items() if callable(thing)])
        instead = f"; did you mean '{near[0]}'?" if near else ""
        raise InvalidPythonLaunchFileError(f"the launch file has no function '{_FUNCTION}'{instead}")
    takes_ready = "ready_fn" in inspect.signature(of_tests).parameters
    found = of_tests(ready_fn=lambda: None) if takes_ready else of_tests()
    return found[0] if isinstance(found, tuple) and found else found


def _call(call: dict[str, Any]) -> dict[str, Any]:
    """Execute an action, or perform a substitution or condition."""
    thing = RECORDER.made[call["id"]]
    context = LaunchContext()
    before = {name: marked(value) for name, value in call["configurations"].items()}
    context.launch_configurations = given = reads.Configurations(before)
    context.extend_globals(
        {"current_launch_file_path": call["file"], "current_launch_file_directory": os.path.dirname(call["file"])}
    )
    _write(call["files"])
    os.environ.update(call["env"])
    environment = dict(os.environ)
    with reads.noted():
        if call["what"] == "perform":
            is_condition = isinstance(thing, Condition)
            text = str(thing.evaluate(context)).lower() if is_condition else str(thing.perform(context))
            rewrites.tell_source(thing, context, text)
            RECORDER.unmatched += [[*each, thing.preflight_place] for each in rewrites.unmatched(thing, context)]
            # The file that it wrote is known but for what it wrote of that.
            is_guess = RECORDER.guessed and not is_unknown(text) and not os.path.isfile(text)
            return {"text": unknown_text(next(iter(RECORDER.guessed))[0]) if is_guess else text}
        actions = _executed(thing, context)
        if context.launch_configurations is not given:
            given.preflight_read_all()
    after = dict.copy(given) if context.launch_configurations is given else dict(context.launch_configurations)
    return {
        "actions": actions,
        "set": {k: str(v) for k, v in after.items() if isinstance(k, str) and before.get(k) != v},
        "unset": [k for k in before if k not in after],
        "env": {k: v for k, v in os.environ.items() if environment.get(k) != v},
    }


def _executed(thing: Any, context: LaunchContext) -> list[dict[str, Any]]:
    given = thing.execute(context)
    serializer = Serializer()
    actions: list[dict[str, Any]] = [serializer.plain_entity(each) for each in context.preflight_executed]
    if isinstance(given, LaunchDescription):
        given = given.entities
    if given is not None:
        actions += serializer.description(given if isinstance(given, (list, tuple)) else [given])
    return actions


_OURS = re.compile(r"\bpreflight_agents\.(?:\w+\.)+")
"""Before the name of a class that takes the place of one of launch."""


def _error_record(error: BaseException) -> dict[str, Any]:
    frames = [
        [frame.filename, frame.lineno, frame.name]
        for frame in traceback.extract_tb(error.__traceback__)
        if not frame.filename.startswith((OURS, "<frozen"))
    ]
    if isinstance(error, SyntaxError) and error.filename:
        frames.append([error.filename, error.lineno or 1, ""])
    message = error.msg if isinstance(error, SyntaxError) else _OURS.sub("", str(error))
    record: dict[str, Any] = {"type": type(error).__name__, "message": message[:2000], "frames": frames[-MAX_FRAMES:]}
    if isinstance(error, NameError) and _is_set_somewhere(message):
        record["elsewhere"] = True
    if isinstance(error, ImportError):
        record["module"] = error.name or ""
        record["instead"] = _module_with(message)
    if isinstance(error, OSError) and isinstance(error.filename, str):
        record["path"] = error.filename
    if isinstance(error, OSError):
        record["errno"] = error.errno
    absent = _looked_for(error)
    if absent is not None:
        record["absent"] = absent[:2000]
    if (RECORDER.unknown or RECORDER.guessed) and not _of_ours(error, message):
        record["unsure"] = True
    if isinstance(error, NotHereError):
        record["refused"] = True
    return record


def _module_with(message: str) -> str:
    """The module of launch that has the name which another one does not; "" where there is none."""
    name = _NOT_IN_MODULE.match(message)
    return module_with(name[1]) if name is not None else ""


def _looked_for(error: BaseException) -> Optional[str]:
    """What a function of the file looked for last, without finding it, that raises by a `raise` of its own."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    if trace is None:
        return None
    code = trace.tb_frame.f_code
    raises = linecache.getline(code.co_filename, trace.tb_lineno).lstrip().startswith("raise")
    return RECORDER.absent.get(code) if raises else None


def _is_set_somewhere(message: str) -> bool:
    """Whether a branch that was not taken may have set a name of the launch file."""
    name, text = _NOT_DEFINED.search(message), "".join(linecache.getlines(RECORDER.file))
    return name is not None and re.search(rf"(?:^\s+|:\s*){name[1]}\s*=[^=]", text, re.MULTILINE) is not None


def _of_ours(error: BaseException, message: str) -> bool:
    """Whether it says what launch would say whatever is unknown: of arguments that an action does not take, and of
    values that no condition has chosen."""
    if not isinstance(error, TypeError) or is_unknown(message):
        return False
    frames = traceback.extract_tb(error.__traceback__)
    is_ours = bool(frames and frames[-1].filename.startswith(OURS)) and not RECORDER.guessed
    return is_ours or _ARGUMENTS.search(message) is not None


def _files() -> dict[str, str]:
    """Texts that were written, which are gone when the sandbox is."""
    found: dict[str, str] = {}
    root = tempfile.gettempdir()
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if folder != root or name not in _SKIPPED]
        if _is_mount(folder, root):
            folders[:] = []
            continue
        for name in names:
            path = os.path.join(folder, name)
            try:
                info = os.lstat(path)
                if len(found) < MAX_FILES and stat.S_ISREG(info.st_mode) and info.st_size <= MAX_FILE_BYTES:
                    with open(path, encoding="utf-8") as file:
                        found[written.own_path(path)] = file.read()
            except (OSError, ValueError):
                continue
    return found


def _is_mount(folder: str, root: str) -> bool:
    """Whether it was bound back from outside: nothing in it was made here."""
    try:
        return folder != root and os.stat(folder).st_dev != os.stat(root).st_dev
    except OSError:
        return True
