"""Substitutions of ROS 2: from a value as written to its text, as `launch.substitutions` perform them."""

from __future__ import annotations

import math
import os
import re
import shlex
from collections.abc import Callable, Sequence

from preflight_analysis.catalogue.descriptions import is_described
from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.environment.own_programs import OWN_PROGRAMS, own_arguments, own_prefix, without_own_prefix
from preflight_analysis.evaluation import expression
from preflight_analysis.evaluation.catalogued import described_share
from preflight_analysis.evaluation.problems import (
    CommandFailed,
    CommandMissing,
    CommandNotRun,
    EvalFailed,
    EvalNotAllowed,
    MalformedCommand,
    PackageNotFound,
    UndeclaredArgument,
    UnsetParameter,
    UnsetVariable,
    WithheldFile,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2 import expressions
from preflight_analysis.evaluation.ros2.context import Context
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.python_runs import OwnCode, called
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.ros2.types import loaded
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown, readable
from preflight_analysis.evaluation.tree import Command, Use
from preflight_analysis.launch.model import Literal, Substitution, Value
from preflight_analysis.launch.problems import BadSubstitution, ProblemKind
from preflight_analysis.launch.substitutions_ros2 import SUBSTITUTIONS_ROS2, parse_value_ros2

Parts = tuple[Literal | Substitution, ...]

SHARE = re.compile(r"\$\((?:find-pkg-share|the share folder of) ([\w-]+)\)")
"""The share folder of a package that is not here, as XML and YAML have it and as a Python file that was run."""


class _Failure(Exception):  # noqa: N818 - not an error: a problem on its way to the list
    """A substitution that has no value. `kind` None: the reason is known already."""

    def __init__(self, kind: ProblemKind | None = None, *, fatal: bool | None = None) -> None:
        super().__init__(kind)
        self.kind, self.fatal = kind, fatal


class Performer:
    """Performs the substitutions of one launch file. What goes wrong is noted at the substitution concerned."""

    def __init__(self, state: State, context: Context, place: Place) -> None:
        self.state, self.context, self.place = state, context, place
        self._in_command = False

    def value(self, value: Value) -> Resolved:
        """The text of a whole value."""
        if value.problem is not None:
            span = value.problem_span or value.span
            self.state.problem(BadSubstitution(value.text, value.problem), self.place.origin(span))
            return Resolved(value.text, False)
        if len(value.parts) == 1 and isinstance(value.parts[0], Literal):
            return Resolved(value.parts[0].text)  # most values, and at each keystroke
        result = self.parts(value.parts)
        if not value.is_literal:
            text = result.text if result.known else None
            self.state.uses.append(Use("value", self.place.location(value.span), value.text, text))
        return result

    def parts(self, parts: Parts) -> Resolved:
        """The pieces put together."""
        texts, known = [], True
        for part in parts:
            if isinstance(part, Literal):
                texts.append(part.text)
                continue
            result = self._one(part)
            if result is None:
                result = self.instead(part)
            known = known and result is not None
            texts.append(part.text if result is None else result)
        if len(texts) > 1 and not self.state.has_room(sum(map(len, texts)), self.place.origin(parts[0].span)):
            return Resolved("".join(part.text for part in parts), False)
        return Resolved("".join(texts), known)

    def instead(self, part: Substitution) -> str | None:
        """What is taken for a substitution that has no value; None: nothing, and the whole is not known."""
        if not self._in_command:
            return None
        if part.command == "find-pkg-share":
            name = self.parts(part.words[0])
            return described_share(name.text, 2, self.state.environment) if name.known else None
        text = part.text
        if part.command == "var":
            found = self.context.get(part.arguments)
            text = found.value.text if found is not None else ""
        shares = SHARE.sub(lambda match: described_share(match[1], 2, self.state.environment) or match[0], text)
        return shares if "$(" not in shares and shares != text else None

    def _one(self, part: Substitution) -> str | None:
        target: Location | None = None
        origin: Origin = ()
        try:
            known = SUBSTITUTIONS_ROS2.get(part.command)
            of_python = _PERFORM_PYTHON.get(part.command) if self.place.is_python else None
            if known is None and of_python is None:
                message = f"'{part.command}' is not a substitution"
                raise _Failure(BadSubstitution(part.text, message, part.command, tuple(SUBSTITUTIONS_ROS2)))
            if known is not None and of_python is None:
                arity, count = known[2], len(part.words)
                if count < arity.least or (arity.most is not None and count > arity.most):
                    raise _Failure(BadSubstitution(part.text, f"$({part.command}) takes {arity}"))
            text: str | None = (of_python or _PERFORM[part.command])(self, part)
        except _Failure as failure:
            if failure.kind is not None:
                origin = self.place.origin(part.span)
                self.state.problem(failure.kind, origin, fatal=failure.fatal)
            text = None
        name = "".join(p.text for p in part.words[0]) if part.words else ""
        if part.command == "var":
            given = self.context.get(name)
            origin = (given.origin if given is not None else None) or ()
            target = self.context.declared(self.place.file, name) or (origin[-1] if origin else None)
        elif part.command == "find-pkg-share" and text is not None:
            manifest = self.state.environment.packages[self._word(part, 0)].manifest
            target = Location.of_file(manifest)
        kind = {"var": "arg", "find-pkg-share": "find"}.get(part.command, part.command)
        self.state.uses.append(Use(kind, self.place.location(part.span), name, text, target, origin))
        return text

    # What a substitution's `perform` does

    def _word(self, part: Substitution, index: int) -> str:
        """An argument; a value that is not known makes the whole not known."""
        result = self.parts(part.words[index])
        if not result.known:
            raise _Failure
        return result.text

    def _var(self, part: Substitution) -> str:
        name = self._word(part, 0)
        found = self.context.get(name)
        if found is None:
            if len(part.words) == 2:
                return self._word(part, 1)
            not_followed = self.context.not_followed
            raise _Failure(UndeclaredArgument(name, self.context.names, not_followed), fatal=not_followed is None)
        if not found.value.known:
            raise _Failure
        return found.value.text

    def _env(self, part: Substitution) -> str:
        name = self._word(part, 0)
        found = self.context.variable(name)
        if found is None:
            if name in self.state.environment.withheld:
                self.state.withheld_variable(part.text, name, self.place.origin(part.span))
                raise _Failure
            if len(part.words) == 2:
                return self._word(part, 1)
            raise _Failure(UnsetVariable(name))
        return found

    def _share(self, part: Substitution) -> str:
        name = self._word(part, 0)
        package = self.state.environment.packages.get(name)
        if package is None:
            raise _Failure(PackageNotFound(name))
        return package.share

    def _prefix(self, part: Substitution) -> str:
        name = self._word(part, 0)
        if self._calls_own(name):
            self.state.problem(PackageNotFound(name), self.place.origin(part.span))
            return own_prefix(name)
        share = self._share(part)
        end = os.path.join("share", name)
        return share[: -len(end)].rstrip("/") if share.endswith("/" + end) else share

    def _calls_own(self, package: str) -> bool:
        """Whether a command line may call our own program in the place of that of a package which is not here."""
        return self._in_command and package in OWN_PROGRAMS and package not in self.state.environment.packages

    def _executable_of_package(self, part: Substitution) -> str:
        name, package = self._word(part, 0), self._word(part, 1)
        if name == package and self._calls_own(package):
            self.state.problem(PackageNotFound(package), self.place.origin(part.span))
            return name
        if package not in self.state.environment.packages:
            raise _Failure(PackageNotFound(package))
        found = self.state.executables.find(package, name)
        if found.path is None:
            # What is not built yet is no reason to call the launch file wrong.
            self.state.note_unknown(part.text, f"{package} has no executable '{name}'", self._at(part))
            raise _Failure
        return found.path

    def _executable(self, part: Substitution) -> str:
        name = self._word(part, 0)
        path = self.context.variable("PATH")
        folders = [""] if os.path.dirname(name) else path.split(os.pathsep) if path else []
        paths = (os.path.join(folder, name) for folder in folders)
        found = next((p for p in paths if self.state.files.is_program(os.path.join(self.state.cwd, p))), None)
        if found is None and name in OWN_PROGRAMS:
            return name
        if found is None:
            self.state.note_unknown(part.text, f"'{name}' is not on the PATH", self._at(part))
            raise _Failure
        return found

    def _at(self, part: Substitution) -> Location:
        return self.place.location(part.span)

    def _eval(self, part: Substitution) -> str:
        text, distro = self._word(part, 0), self.state.environment.distro
        alone = distro in expressions.WITHOUT_MODULES
        if alone and len(part.words) == 2 and not self.place.is_python:
            raise _Failure(BadSubstitution(part.text, f"$(eval) takes 1 argument in ROS 2 {distro}"))
        given = self._word(part, 1) if len(part.words) == 2 else "math"
        modules = [name for each in given.split(",") if (name := each.strip())]
        if modules != ["math"] and not alone:
            return self._run_eval(part, text, modules)
        try:
            return str(expression.evaluate_ros2(text, module=not alone))
        except expression.NotAllowedError:
            return self._run_eval(part, text, modules)
        except expression.EvaluationError as error:
            raise _Failure(EvalFailed(text, str(error))) from error

    def _run_eval(self, part: Substitution, text: str, modules: Sequence[str]) -> str:
        """The text of an expression that Python itself has to evaluate, in the sandbox."""
        line = expressions.request(text, modules, self.state.environment.distro)
        result = self.state.results.result(line)
        self.state.commands.append(Command(line, "", self.place.origin(part.span), result, launch_file=True))
        if result is None:
            self.state.note_unknown(part.text, "it was not evaluated", self._at(part))
            raise _Failure
        if result.status != "done":
            raise _Failure(EvalNotAllowed(text, result.reason))
        outcome = expressions.read_answer(result.output)
        if outcome.text is None and outcome.sure:
            raise _Failure(EvalFailed(text, outcome.error))
        if outcome.text is None:
            raise _Failure(EvalNotAllowed(text, outcome.error))
        return outcome.text

    def _dirname(self, part: Substitution) -> str:
        return os.path.dirname(self.context.launch_file)

    def _filename(self, part: Substitution) -> str:
        return self.context.launch_file

    def _command(self, part: Substitution) -> str:
        self._in_command, before = True, self._in_command
        try:
            line = without_own_prefix(self._word(part, 0))
        finally:
            self._in_command = before
        if line is None:
            raise _Failure
        try:
            words = shlex.split(line)
        except ValueError as error:
            raise _Failure(MalformedCommand(str(error))) from error
        if any(map(is_described, words)) and own_arguments(words) is None:
            raise _Failure  # the catalogue has nothing for other programs
        for word in words:
            # What the package will install elsewhere is read where it is now.
            if word.startswith("/"):
                line = line.replace(word, self.state.located(word))
        if self.state.results.placeholder is not None:
            return self.state.results.placeholder
        if (reason := self.state.withholds_files_of(line, self.place.origin(part.span))) is not None:
            self.state.note_unknown(part.text, reason, self._at(part))
            raise _Failure
        result = self.state.results.result(line)
        self.state.commands.append(Command(line, "", self.place.origin(part.span), result))
        if result is not None and result.status == "done":
            return result.output
        if result is not None and result.status in ("failed", "missing"):
            if result.status == "failed":
                raise _Failure(CommandFailed(result.reason, result.stderr_tail))
            raise _Failure(CommandMissing(line))
        if result is not None:
            problem = CommandNotRun(result.reason)
            if not result.output:
                raise _Failure(problem)
            self.state.problem(problem, self.place.origin(part.span))
            return result.output
        self.state.note_unknown(part.text, "the command was not run", self._at(part))
        raise _Failure

    def _anon(self, part: Substitution) -> str:
        name = self._word(part, 0)
        key = "anon" + name
        found = self.context.get(key)
        if found is None:
            self.context.set(key, Resolved(self.state.anonymous_name(name)), self.place.origin(part.span))
            found = self.context.get(key)
        return found.value.text if found is not None else name

    def _truth(self, part: Substitution, index: int) -> bool:
        text = self._word(part, index)
        truth = yaml_bool(text)
        if truth is None:
            message = f"'{text}' is neither true nor false"
            raise _Failure(BadSubstitution(part.text, message))
        return truth

    def _not(self, part: Substitution) -> str:
        return _text(not self._truth(part, 0))

    def _and(self, part: Substitution) -> str:
        return _text(all([self._truth(part, 0), self._truth(part, 1)]))

    def _or(self, part: Substitution) -> str:
        return _text(any([self._truth(part, 0), self._truth(part, 1)]))

    def _any(self, part: Substitution) -> str:
        return _text(any(self._truth(part, index) for index in range(len(part.words))))

    def _all(self, part: Substitution) -> str:
        return _text(all(self._truth(part, index) for index in range(len(part.words))))

    def _equals(self, part: Substitution) -> str:
        return _text(_equal(self._word(part, 0), self._word(part, 1)))

    def _not_equals(self, part: Substitution) -> str:
        return _text(not _equal(self._word(part, 0), self._word(part, 1)))

    def _if(self, part: Substitution) -> str:
        if self._truth(part, 0):
            return self._word(part, 1)
        return self._word(part, 2) if len(part.words) == 3 else ""

    def _file_content(self, part: Substitution) -> str:
        path = self._word(part, 0)
        found = self.state.read_text(os.path.join(self.state.cwd, path))
        if isinstance(found, Unreadable) and found.kind == "withheld":
            raise _Failure(WithheldFile(path, found.reason))
        if isinstance(found, Unreadable):
            message = f"the file '{path}' {found.reason}"
            raise _Failure(BadSubstitution(part.text, message))
        return found.text

    def _param(self, part: Substitution) -> str:
        name = self._word(part, 0)
        for param in self.context.params:
            if param.name == name:
                return str(param.value)
        if len(part.words) == 2:
            return self._word(part, 1)
        not_followed = self.context.not_followed
        raise _Failure(UnsetParameter(name, not_followed), fatal=not_followed is None)

    def _log_dir(self, part: Substitution) -> str:
        self.state.note_unknown(part.text, "the folder of the logs is made at launch", self._at(part))
        raise _Failure

    def _string_join(self, part: Substitution) -> str:
        delimiter, *words = (self._word(part, index) for index in range(len(part.words)))
        return delimiter.join(words)

    def _of_round(self, part: Substitution) -> str:
        name = self._word(part, 0)
        found = self.context.of_round(name)
        if found is None and len(part.words) == 2:
            return self._word(part, 1)
        if found is None:
            message = f"no loop around it has a variable '{name}'"
            raise _Failure(BadSubstitution(part.text, message))
        return found

    def _path_join(self, part: Substitution) -> str:
        words = [self._word(part, index) for index in range(len(part.words))]
        return os.path.join(*words) if words else ""

    # Those of Python launch files only

    def _find_package(self, part: Substitution) -> str:
        message = "FindPackage finds no folder by itself; use FindPackageShare or FindPackagePrefix"
        raise _Failure(BadSubstitution(part.text, message))

    def _written(self, part: Substitution) -> str:
        text = self._word(part, 0)
        span = part.span
        result = self.value(parse_value_ros2(SpannedText(text, span, (*(span.start,) * len(text), span.end))))
        if not result.known:
            raise _Failure
        return result.text

    def _config_equals(self, part: Substitution) -> str:
        found = self.context.get(self._word(part, 0))
        if found is not None and not found.value.known:
            raise _Failure
        expected = self._word(part, 1) if len(part.words) == 2 else None
        equal = (found.value.text if found is not None else None) == expected
        return _text(equal == (part.command == "config-equals"))

    def _local(self, part: Substitution) -> str:
        self.state.note_unknown(part.text, "it is known only when it is launched", self._at(part))
        raise _Failure

    def _unknown(self, part: Substitution) -> str:
        self.state.note_unknown(self._word(part, 0), "what it comes from is not installed here", self._at(part))
        raise _Failure

    def _not_read(self, part: Substitution) -> str:
        self.state.note_unknown("a value", "the launch file was not run", self._at(part))
        raise _Failure

    def _of_branches(self, part: Substitution) -> str:
        what = self._word(part, 0)
        self.state.note_unknown(what, "what the launch file makes depends on it, and it is not known", self._at(part))
        raise _Failure

    def _own(self, part: Substitution) -> str:
        number, name = (self._word(part, index) for index in (0, 1))
        answer = called(self.state, self.context, self.place, OwnCode(number, name, "perform", part.span))
        if answer is None or answer.text is None:
            raise _Failure
        if is_unknown(answer.text):
            self.state.note_unknown(part.text, f"it is {readable(answer.text)}", self._at(part))
            raise _Failure
        return answer.text


_PERFORM_PYTHON: dict[str, Callable[[Performer, Substitution], str]] = {
    "find-pkg": Performer._find_package,
    "written": Performer._written,
    "config-equals": Performer._config_equals,
    "config-not-equals": Performer._config_equals,
    "local": Performer._local,
    "python": Performer._not_read,
    "own": Performer._own,
    "unknown": Performer._unknown,
    "branch": Performer._of_branches,
    "command": Performer._command,
}
_PERFORM: dict[str, Callable[[Performer, Substitution], str]] = {
    "var": Performer._var,
    "env": Performer._env,
    "find-pkg-share": Performer._share,
    "find-pkg-prefix": Performer._prefix,
    "exec-in-pkg": Performer._executable_of_package,
    "find-exec": Performer._executable,
    "eval": Performer._eval,
    "dirname": Performer._dirname,
    "filename": Performer._filename,
    "command": Performer._command,
    "anon": Performer._anon,
    "not": Performer._not,
    "and": Performer._and,
    "or": Performer._or,
    "any": Performer._any,
    "all": Performer._all,
    "equals": Performer._equals,
    "not-equals": Performer._not_equals,
    "if": Performer._if,
    "file-content": Performer._file_content,
    "param": Performer._param,
    "launch_log_dir": Performer._log_dir,
    "log_dir": Performer._log_dir,
    "path-join": Performer._path_join,
    "string-join": Performer._string_join,
    "for-var": Performer._of_round,
    "index": Performer._of_round,
}


def yaml_bool(text: str) -> bool | None:
    """What `launch.utilities.type_utils.coerce_to_type(text, bool)` makes of it; None where it raises."""
    if text in ("1", "0"):
        return text == "1"
    try:
        value = loaded(text)
    except CONSTRUCTION_ERRORS:
        return None
    return value if isinstance(value, bool) else None


def _text(truth: bool) -> str:
    return str(truth).lower()


def _equal(left: str, right: str) -> bool:
    """Truth values, numbers or texts, in this order (`launch.substitutions.EqualsSubstitution`)."""
    booleans = ("true", "false", "1", "0")
    if left.lower() in booleans and right.lower() in booleans:
        return (left.lower() in ("true", "1")) == (right.lower() in ("true", "1"))
    numbers = _numbers((left, right))
    if numbers is not None:
        return math.isclose(*numbers)
    return left == right


def _numbers(texts: Sequence[str]) -> tuple[float, float] | None:
    try:
        one, other = (float(text) for text in texts)
    except ValueError:
        return None
    return one, other
