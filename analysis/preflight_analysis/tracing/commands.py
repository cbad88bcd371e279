"""The command of a parameter to its result: from the cache, or by a run in the sandbox.

As roslaunch does it (roslaunch.loader.Loader.param_value): split as a shell would, run without a shell in roslaunch's
own folder and environment, an error if it does not end with exit code 0, its standard output read as UTF-8.
"""

from __future__ import annotations

import base64
import copy
import functools
import hashlib
import json
import logging
import os
import re
import shlex
import shutil
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from preflight_analysis.catalogue.descriptions import is_described
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.secrets import is_key_file, shows_private_key
from preflight_analysis.environment import reach
from preflight_analysis.environment.catkin_python import source_folders
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.own_programs import OLD_XACRO, own_arguments
from preflight_analysis.environment.view import meaning, meant_by, of_generation
from preflight_analysis.evaluation.commands import CommandResult, named_paths
from preflight_analysis.evaluation.ros2 import expressions
from preflight_analysis.evaluation.ros2.python_runs import MARK, parse_request
from preflight_analysis.tracing import (
    compiled,
    interior,
    launch_files,
    own_xacro,
    ros1_recipe,
    ros2_recipe,
    run,
    sandbox,
)
from preflight_analysis.tracing import expressions as evaluated
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.backend import Visible
from preflight_analysis.tracing.outcome import stderr_tail
from preflight_analysis.tracing.records import paths
from preflight_analysis.tracing.repositories import hidden_paths
from preflight_analysis.tracing.store import (
    MAX_BYTES,
    Place,
    Store,
    any_changed_since,
    fingerprint,
    fingerprint_of_text,
    identity,
)
from preflight_analysis.tracing.trace import on_host

_log = logging.getLogger(__name__)

SCHEMA = "ros-preflight/command-cache/1"
MAX_ENTRY_BYTES = 16 << 20
_NO_NETWORK = re.compile(
    r"Network is unreachable|Name or service not known|Temporary failure in name resolution|Connection refused"
    r"|[Uu]nable to (communicate|contact|register) with (my |the )?(ROS )?master",
)
_PATH = re.compile(r"(?<![\w.])/[^\s:;,'\"`()<>\[\]]+")
_SHELLS = frozenset(("sh", "bash", "dash", "zsh", "ksh", "busybox", "perl", "ruby", "node", "awk"))
_PLAIN_LINE = re.compile(r"[\w\s./:=,+'\"|%@-]*")
"""Of a shell: it names all that it reads."""
_LIMITS = (signal.SIGXCPU, signal.SIGXFSZ)
_VARIABLES = {1: ros1_recipe.variables, 2: ros2_recipe.variables}


class CommandCache(Store):
    """What commands printed.

    An entry depends on the files that Python programs opened or looked for, and on the program and every existing
    file that its arguments name, also within an argument as for `bash -c`. What other programs (a shell's `cat`, a
    compiled generator) read besides is not seen: an entry stays valid when only that changes.
    """

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        super().__init__("commands", SCHEMA, MAX_ENTRY_BYTES, folder, max_bytes)

    def load(self, recipe: recipes.Recipe, packages: str, state: Callable[[str], str] = fingerprint) -> str | None:
        """What it printed, if no file that it depended on has changed; `state` tells one content from the next."""
        for path, entry in self._entries(self._place(recipe, packages)):
            try:
                output: str = entry["output"]
                valid = all(state(name) == known for name, known in entry["files"].items())
            except (KeyError, TypeError, AttributeError):
                continue
            if valid and isinstance(output, str):
                self._used(path)
                return output
        return None

    def store(
        self,
        recipe: recipes.Recipe,
        packages: str,
        output: str,
        files: Iterable[str],
        *,
        started: float,
        state: Callable[[str], str] = fingerprint,
    ) -> bool:
        """Keep the output of a run that began at `started`. False if a file has changed since, or the disk refused."""
        known = {path: state(path) for path in dict.fromkeys(files)}
        if any_changed_since(known, started):
            return False
        return self._keep(self._place(recipe, packages), known, {"files": known, "output": output})

    def _place(self, recipe: recipes.Recipe, packages: str) -> Place:
        named = {"argv": list(recipe.argv), "env": dict(recipe.stable), "cwd": recipe.cwd, "packages": packages}
        named["workspaces"] = list(recipe.workspaces)
        return self._place_of(named)


@dataclass(slots=True)
class _Ended:
    """A run as its records have it."""

    status: str = ""
    code: int | None = None
    why: str = ""
    output: bytes = b""
    files: dict[str, None] = field(default_factory=dict)
    wrote: dict[str, None] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class _Job:
    """A command whose program is there."""

    recipe: recipes.Recipe
    named: tuple[str, ...]
    """The program, and the existing files that the arguments name."""
    visible: list[str]


@dataclass(frozen=True, slots=True)
class _Done:
    """A run that has ended; `unchanged`: what it names is what it was before."""

    result: CommandResult
    ended: _Ended
    started: float
    unchanged: bool


class CommandRunner:
    """Runs commands of one environment in the folder `cwd`. Usable from several threads at once."""

    def __init__(
        self, environment: Environment, cwd: str, cache: CommandCache | None, disk: Disk | None = None
    ) -> None:
        self.environment = environment
        self._disk = disk or Disk()
        self.cwd = cwd
        self.cache = cache
        self._texts: Mapping[str, str] = {}
        """What is read in the place of files, by their real paths."""

    def over(self, texts: Mapping[str, str]) -> CommandRunner:
        """The same, for which texts of an editor count in the place of files, where the sandbox can do that. It reads
        the files: of those that have the text anyway nothing is to be done."""
        other = copy.copy(self)
        real = {os.path.realpath(path): text for path, text in texts.items()}
        other._texts = {path: text for path, text in real.items() if differs(path, text)}
        if other._texts and not sandbox.probe().replaces:
            other._texts = {}
        return other

    def _state(self, path: str) -> str:
        """What tells one content of a file from the next, as a run reads it."""
        text = self._texts.get(os.path.realpath(path)) if self._texts else None
        return fingerprint(path) if text is None else fingerprint_of_text(text)

    def lookup(self, line: str) -> CommandResult | None:
        """The cached result, if it is still valid; nothing is run."""
        try:
            job = self._job(line)
            return job if isinstance(job, CommandResult) else self._known(job)
        except Exception:
            _log.exception("looking up the command %s failed", line)
            return None

    def run(self, line: str, cancel: threading.Event) -> CommandResult:
        """The cached result, or that of a new run. Never raises: what stands in the way is the result's reason."""
        try:
            job = self._job(line)
            if isinstance(job, CommandResult):
                return job
            return self._known(job) or self._run(line, job, cancel)
        except Exception as error:
            _log.exception("running the command %s failed", line)
            return CommandResult("not-run", reason=f"the run failed: {error}")

    def _known(self, job: _Job) -> CommandResult | None:
        output = self.cache.load(job.recipe, self._packages, self._state) if self.cache is not None else None
        return own_xacro.judged(CommandResult("done", output)) if output is not None else None

    @functools.cached_property
    def _packages(self) -> str:
        """A digest of where packages are: programs find them by looking into folders, which leaves no trace."""
        places = sorted((package.name, package.share) for package in self.environment.packages.values())
        return hashlib.sha256(json.dumps(places).encode(errors="surrogatepass")).hexdigest()

    @functools.cached_property
    def _of_ros2(self) -> Environment:
        return of_generation(self.environment, 2)

    @functools.cached_property
    def _visible(self) -> list[str]:
        return recipes.visible_paths(self.environment)

    @functools.cached_property
    def _repositories(self) -> tuple[str, ...]:
        return hidden_paths(self.environment)

    @property
    def _interpreter(self) -> str:
        return self.environment.python or sys.executable

    def _job(self, line: str) -> _Job | CommandResult:
        request = parse_request(line)
        if request is not None:
            return self._asked(launch_files.make(self._of_ros2, request, self.cwd), str(request["file"]))
        if (expression := expressions.parse_request(line)) is not None:
            return self._asked(evaluated.make(self.environment, expression, self.cwd))
        try:
            words = shlex.split(line)
        except ValueError as error:
            return CommandResult("failed", reason=f"it cannot be split into words: {error}")
        if not words:
            return CommandResult("failed", reason="it is empty")
        program = os.path.join(self.cwd, words[0]) if "/" in words[0] else words[0]
        path = _VARIABLES[self.environment.generation](self.environment, ())["PATH"]
        is_ours = any(map(is_described, words))
        executable = shutil.which(program, path=path) if not is_ours else None
        if executable is None and (arguments := own_arguments(words)) is not None:
            files = tuple(_files_of(arguments, self.cwd))
            means = meaning(self.environment, meant_by(self.environment, files[0])) if files else self.environment
            old = words[0] == OLD_XACRO
            return self._asked(own_xacro.make(means, arguments, self.cwd, old=old), *files)
        if executable is None:
            return CommandResult("missing", reason=f"there is no program {words[0]}")
        python = self.environment.interpreter(self.environment.generation)
        if words[0] in ("python3", "python") and python is not None:
            executable = python  # as for `#!/usr/bin/env python3`
        if self.environment.ros.ament:
            recipe = ros2_recipe.make_command(self.environment, executable, words[1:], self.cwd)
        else:
            modules = source_folders(self._disk, self.environment)
            recipe = ros1_recipe.make_command(self.environment, executable, words[1:], self.cwd, modules)
        named = tuple(dict.fromkeys((executable, *_files_of(words[1:], self.cwd))))
        beyond = recipes.command_paths(self.environment, recipe, executable, named[1:], self._interpreter)
        return _Job(recipe, named, sorted({*self._visible, *beyond}))

    def _asked(self, recipe: recipes.Recipe, *files: str) -> _Job:
        """The run of something else than a command, for which our own code asks the user's interpreter."""
        named = tuple(path for path in (recipe.argv[0], *files) if os.path.isfile(path))
        beyond = recipes.command_paths(self.environment, recipe, recipe.argv[0], named[1:], self._interpreter)
        return _Job(recipe, named, sorted({*self._visible, *beyond}))

    def run_together(self, lines: Sequence[str], cancel: threading.Event) -> list[CommandResult]:
        """The same for the lines of one of `alike`, by one run as far as that is possible."""
        results: dict[str, CommandResult] = {}
        if len(lines) > 1:
            try:
                results = self._from_one_run(lines, cancel)
            except Exception:
                _log.exception("running commands together failed; each is run alone")
        return [results.get(line) or self.run(line, cancel) for line in lines]

    def _from_one_run(self, lines: Sequence[str], cancel: threading.Event) -> dict[str, CommandResult]:
        jobs = {line: job for line in lines if isinstance(job := self._job(line), _Job)}
        results = {line: known for line, job in jobs.items() if (known := self._known(job)) is not None}
        left = {line: job for line, job in jobs.items() if line not in results}
        if len(left) < 2 or cancel.is_set() or not sandbox.probe().works:
            return results
        requests = [request for line in left if (request := parse_request(line)) is not None]
        whole = launch_files.make(self._of_ros2, launch_files.together(requests), self.cwd)
        done = self._execute(self._asked(whole, str(requests[0]["file"])), cancel)
        if done.result.status == "done":
            answers = launch_files.apart(done.result.output, len(left))
            for (line, job), answer in zip(left.items(), answers, strict=True):
                if answer is not None:
                    results[line] = self._kept(line, job, replace(done, result=CommandResult("done", answer)))
        return results

    def _run(self, line: str, job: _Job, cancel: threading.Event) -> CommandResult:
        status = sandbox.probe()
        if not status.works:
            return CommandResult("not-run", reason=f"no sandbox: {status.reason}")
        if cancel.is_set():
            return CommandResult("not-run", reason="the run was cancelled")
        done = self._execute(job, cancel)
        if done.result.status == "failed":
            if status.narrow:
                why = (
                    f"{done.result.reason} in the sandbox by {status.backend}, which refuses more than bubblewrap would"
                )
                return CommandResult("not-run", reason=why, stderr_tail=done.result.stderr_tail)
            return _sandbox_to_blame(done.result, job, done.ended) or done.result
        return self._kept(line, job, done)

    def _execute(self, job: _Job, cancel: threading.Event) -> _Done:
        shown = Visible(tuple(job.visible), self._repositories, self._texts)
        agents = compiled.copies().of(self._interpreter, shown)
        before = list(map(identity, job.named))
        raw = run.execute_command(job.recipe, run.Inside(shown, self._interpreter, cancel, agents))
        ended = _read(raw)
        return _Done(_result(raw, ended), ended, raw.started, before == list(map(identity, job.named)))

    def _kept(self, line: str, job: _Job, done: _Done) -> CommandResult:
        """The result, which is kept if it is one to rely on."""
        result = done.result
        hidden = (path for path in on_host(done.ended.files, job.visible) if is_key_file(os.path.basename(path)))
        withheld = next(filter(self.environment.access.refusal, filter(os.path.isfile, hidden)), None)
        if withheld is not None:
            return CommandResult("not-run", reason=f"{withheld} {self.environment.access.refusal(withheld)}")
        if shows_private_key(result.output):
            return CommandResult("not-run", reason="it printed a private key, which is not kept")
        if result.status == "done" and line.startswith(MARK):
            narrow = sandbox.probe().narrow
            refused = launch_files.sandbox_to_blame(result.output, job.visible, narrow=narrow)
            if refused is not None:
                return CommandResult("not-run", reason=refused)
        if result.status == "done" and self.cache is not None and done.unchanged:
            files = (*job.named, *on_host(done.ended.files, job.visible))
            output, started = result.output, done.started
            if not self._may_be_kept(job, files):
                return own_xacro.judged(result)
            self.cache.store(job.recipe, self._packages, output, files, started=started, state=self._state)
        return own_xacro.judged(result)

    def _may_be_kept(self, job: _Job, files: Iterable[str]) -> bool:
        """Whether nothing of the user's own files outside of the workspace can be in the output."""
        access = self.environment.access
        return self._reads_are_seen(job) and not any(map(access.is_text_elsewhere, files))

    def _reads_are_seen(self, job: _Job) -> bool:
        """Whether it is known what a command reads: all that Python opens, and of other programs what their arguments
        name. Not of programs of the workspace, nor of a shell's line that finds files in another way."""
        programs = (job.recipe.argv[0], *filter(self._is_own_program, job.named[1:]))
        others = [p for p in programs if not (os.path.basename(p).startswith("python") or recipes.is_python(p))]
        if any(reach.in_workspace(self.environment, program) for program in others):
            return False
        if not others or os.path.basename(others[0]) not in _SHELLS:
            return True
        words = job.recipe.argv[1:]
        return words[:1] == ("-c",) and all(_PLAIN_LINE.fullmatch(word) and "cd" not in word.split() for word in words)

    def _is_own_program(self, path: str) -> bool:
        return os.access(path, os.X_OK) and reach.in_workspace(self.environment, path)


def alike(lines: Iterable[str], most: int) -> list[tuple[str, ...]]:
    """Command lines in groups of at most so many, each of which one run may answer: other calls of the same Python
    launch file."""
    groups: dict[str, list[str]] = {}
    for line in lines:
        request = parse_request(line)
        groups.setdefault((request and launch_files.group(request)) or line, []).append(line)
    return [tuple(group[at : at + most]) for group in groups.values() for at in range(0, len(group), most)]


def differs(path: str, text: str) -> bool:
    """Whether there is a file, and it has another text."""
    try:
        return os.path.isfile(path) and Path(path).read_bytes() != text.encode("utf-8", "replace")
    except OSError:
        return False


def _files_of(words: Iterable[str], cwd: str) -> Iterator[str]:
    """The regular files that arguments name."""
    return filter(os.path.isfile, named_paths(words, cwd))


def _read(raw: run.RawRun) -> _Ended:
    """The records that a run of a command has; anything else is left out."""
    ended = _Ended()
    pieces: list[bytes] = []
    for record in raw.records:
        own, node_record = record.get("own"), record.get("node")
        if isinstance(own, dict) and own.get("ev") == "output" and isinstance(own.get("data"), str):
            pieces.append(base64.b64decode(own["data"]))
        elif isinstance(own, dict) and own.get("ev") == "end":
            ended.status, ended.why = str(own.get("status")), str(own.get("why"))
            code: Any = own.get("code")
            ended.code = code if isinstance(code, int) else None
        elif isinstance(node_record, dict) and node_record.get("ev") == "files":
            ended.files.update(dict.fromkeys(paths(node_record.get("paths"))))
        elif isinstance(node_record, dict) and node_record.get("ev") == "wrote":
            ended.wrote.update(dict.fromkeys(paths([node_record.get("path")])))
    ended.output = run.moved_back(b"".join(pieces), raw.moved)
    return ended


def _result(raw: run.RawRun, ended: _Ended) -> CommandResult:
    tail = stderr_tail(raw.stderr)
    if raw.cancelled:
        return CommandResult("not-run", reason="the run was cancelled", stderr_tail=tail)
    if raw.killed or ended.status == "timed-out":
        return CommandResult("not-run", reason=f"it did not end within {run.COMMAND_SECONDS:g} s", stderr_tail=tail)
    if ended.status == "too-long" or raw.dropped:
        limit = f"{run.COMMAND_BYTES >> 20} MiB"
        return CommandResult("not-run", reason=f"it printed more than {limit}", stderr_tail=tail)
    if ended.status in ("crowded", "heavy", "full", "watching") or (raw.out_of_memory and ended.code != 0):
        return CommandResult("not-run", reason="it needed more than the sandbox gives it", stderr_tail=tail)
    if ended.status == "exec-failed":
        return CommandResult("failed", reason=f"it cannot be started: {ended.why}", stderr_tail=tail)
    if ended.status != "ended" or ended.code is None:
        said = f": {tail[-1]}" if tail else ""
        return CommandResult("not-run", reason=f"the sandbox ended before it did{said}", stderr_tail=tail)
    if -ended.code in _LIMITS:
        return CommandResult("not-run", reason="it needed more than the sandbox gives it", stderr_tail=tail)
    if ended.code < 0:
        return CommandResult("failed", reason=f"it was killed by {_signal(-ended.code)}", stderr_tail=tail)
    if ended.code:
        return CommandResult("failed", reason=f"it ended with exit code {ended.code}", stderr_tail=tail)
    try:
        return CommandResult("done", ended.output.decode())
    except UnicodeDecodeError as error:
        return CommandResult("failed", reason=f"what it printed is not UTF-8: {error.reason}", stderr_tail=tail)


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _sandbox_to_blame(result: CommandResult, job: _Job, ended: _Ended) -> CommandResult | None:
    """A failure that would most likely not be one outside: of what the sandbox keeps from a command."""
    said = "\n".join(result.stderr_tail)
    needed = recipes.out_of_reach(job.recipe, job.named[0], job.visible)
    met = (*([needed] if needed else []), *job.named, *ended.files, *_PATH.findall(said))
    hidden = [p for p in met if not interior.shown(p, job.visible) and os.path.exists(p)]
    written = [p for p in ended.wrote if interior.shown(p, job.visible) and not p.startswith(("/dev/", "/proc/"))]
    if "not a git repository" in said:
        why = "it needs the git repository, which the sandbox hides"
    elif hidden:
        why = f"it needs {hidden[0]}, which the sandbox hides"
    elif written or "Read-only file system" in said:
        why = f"it writes {written[0] if written else 'files'}, which the sandbox does not let it"
    elif _NO_NETWORK.search(said):
        why = "it needs a network or a ROS master, which the sandbox does not have"
    else:
        return None
    return CommandResult("not-run", reason=f"{result.reason} in the sandbox; {why}", stderr_tail=result.stderr_tail)
