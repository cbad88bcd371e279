"""Substitutions: from a value as written to its text.

roslaunch replaces in two rounds, `$(find)` last, because what follows it is part of a path by then
(http://wiki.ros.org/roslaunch/XML#substitution_args).
"""

from __future__ import annotations

import os
from collections.abc import Callable

from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.own_programs import own_program
from preflight_analysis.evaluation import expression, values
from preflight_analysis.evaluation.problems import (
    ArgumentNeeded,
    EvalFailed,
    EvalNotAllowed,
    MissingArgument,
    PackageNotFound,
    UndeclaredArgument,
    UnsetVariable,
    WithheldVariable,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.state import State
from preflight_analysis.evaluation.tree import Use
from preflight_analysis.launch.model import Substitution, Value
from preflight_analysis.launch.problems import BadSubstitution, ProblemKind
from preflight_analysis.launch.substitutions import (
    COMMANDS_ROS1,
    SubstitutionSyntaxError,
    find_substitutions,
    is_eval,
)


class _Failure(Exception):  # noqa: N818 - not an error: a problem on its way to the list
    """A substitution that has no value. `kind` None: the reason is known already."""

    def __init__(self, kind: ProblemKind | None = None, origin: Origin | None = None) -> None:
        super().__init__(kind)
        self.kind, self.origin = kind, origin


def resolve(state: State, scope: Scope, value: Value, at: Span | None = None) -> Resolved:
    """Evaluate `value` in `scope`; problems are noted at the substitution concerned.

    `at` is the place to speak of instead, for texts that do not stand in the file as they are (`subst_value`).
    """
    if "$" not in value.text or (value.problem is None and value.is_literal):
        return Resolved(value.text)
    if value.problem is not None:
        state.problem(BadSubstitution(value.text, value.problem), scope.origin(at or value.span))
        return Resolved(value.text, False)
    text, known, finds = value.text, True, False
    for part in value.substitutions:
        span = at or part.span
        if part.command == "find":
            finds = True
            continue
        if part.command == "eval" and not is_eval(value.text):
            message = "$(eval ...) must be the whole value"
            state.problem(BadSubstitution(part.text, message), scope.origin(span))
            known = False
            continue
        result = _one(state, scope, part, span, record=at is None)
        if result is None:
            known = False
        elif is_eval(value.text) or text == part.text:
            text = result
        elif state.has_room(len(text) + text.count(part.text) * len(result), scope.origin(span)):
            text = text.replace(part.text, result)
        else:
            known = False
    if (finds or "$(" in text) and not is_eval(value.text):
        found = _finds(state, scope, value, text, at)
        text, known = found.text, known and found.known
    if at is None:
        state.uses.append(Use("value", scope.location(value.span), value.text, text if known else None))
    return Resolved(text, known)


def _one(state: State, scope: Scope, part: Substitution, span: Span, *, record: bool) -> str | None:
    words = [w for w in part.arguments.split(" ") if w]
    target: Location | None = None
    origin: Origin = ()
    try:
        if part.command == "arg":
            if len(words) != 1:
                raise _Failure(BadSubstitution(part.text, "$(arg name) takes exactly one name"))
            given, declaration = scope.arguments.get(words[0]), scope.arguments.declaration(words[0])
            origin = (given.origin if given else None) or ()
            target = declaration or (origin[-1] if origin else None)
            text = _arg(scope, words[0])
        else:
            text = _COMMANDS.get(part.command, _unknown_command)(state, scope, part, words)
    except _Failure as failure:
        if isinstance(failure.kind, WithheldVariable):
            state.withheld_variable(part.text, failure.kind.name, scope.origin(span))
        elif failure.kind is not None:
            state.problem(failure.kind, failure.origin or scope.origin(span))
        text = None
    if record:
        name = words[0] if words and part.command != "eval" else part.arguments
        state.uses.append(Use(part.command, scope.location(span), name, text, target, origin))
    return text


def _arg(scope: Scope, name: str) -> str:
    arguments = scope.arguments
    given = arguments.get(name)
    if given is not None:
        if given.text is None:
            raise _Failure
        return given.text
    declaration = arguments.declaration(name)
    if declaration is None:
        raise _Failure(UndeclaredArgument(name, tuple(sorted(arguments.declared_names | arguments.given_names))))
    if scope.chain:
        raise _Failure(MissingArgument(name, scope.file, tuple(sorted(arguments.given_names))), scope.chain)
    raise _Failure(ArgumentNeeded(name), (declaration,))


def _env(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    if len(words) != 1:
        raise _Failure(BadSubstitution(part.text, "$(env NAME) takes exactly one name"))
    return _environment_variable(state, words[0])


def _environment_variable(state: State, name: str) -> str:
    try:
        return state.environment.variables[name]
    except KeyError:
        withheld = name in state.environment.withheld
        raise _Failure(WithheldVariable(name) if withheld else UnsetVariable(name)) from None


def _is_unset(state: State, name: str) -> bool:
    return name not in state.environment.variables and name not in state.environment.withheld


def _optenv(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    if not words:
        raise _Failure(BadSubstitution(part.text, "$(optenv NAME default) needs a name"))
    return _optional_variable(state, words[0], " ".join(words[1:]))


def _optional_variable(state: State, name: str, default: str) -> str:
    return default if _is_unset(state, name) else _environment_variable(state, name)


def _anon(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    if len(words) != 1:
        raise _Failure(BadSubstitution(part.text, "$(anon name) takes exactly one name"))
    return _anonymous(state, scope, words[0])


def _anonymous(state: State, scope: Scope, identifier: str) -> str:
    if identifier not in scope.anonymous:
        scope.anonymous[identifier] = state.anonymous_name(identifier)
    return scope.anonymous[identifier]


def _dirname(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    return os.path.dirname(scope.file)


def _unknown_command(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    message = f"'{part.command}' is not a substitution" if part.command else "the substitution is empty"
    raise _Failure(BadSubstitution(part.text, message, part.command, COMMANDS_ROS1))


def _eval(state: State, scope: Scope, part: Substitution, words: list[str]) -> str:
    def by_name(name: str) -> object:
        if scope.arguments.get(name) is None and scope.arguments.declaration(name) is None:
            raise KeyError(name)
        return values.convert(_arg(scope, name), "auto")

    functions: dict[str, Callable[..., object]] = {
        "arg": lambda name: values.convert(_arg(scope, name), "auto"),
        "env": lambda name: _environment_variable(state, name),
        "optenv": lambda name, default="": _optional_variable(state, name, default),
        "find": lambda name: _package(state, name),
        "anon": lambda name: _anonymous(state, scope, name),
        "dirname": lambda: os.path.dirname(scope.file),
    }
    text = part.text[len("$(eval ") : -1]
    try:
        return str(expression.evaluate(text, by_name, functions))
    except expression.NotAllowedError as error:
        raise _Failure(EvalNotAllowed(text, str(error))) from error
    except expression.EvaluationError as error:
        raise _Failure(EvalFailed(text, str(error))) from error


def _package(state: State, name: str) -> str:
    package = state.environment.packages.get(name)
    if package is None:
        raise _Failure(PackageNotFound(name))
    return package.share


_COMMANDS: dict[str, Callable[[State, Scope, Substitution, list[str]], str]] = {
    "env": _env,
    "optenv": _optenv,
    "anon": _anon,
    "dirname": _dirname,
    "eval": _eval,
}


def _finds(state: State, scope: Scope, value: Value, text: str, at: Span | None) -> Resolved:
    """The second round: `$(find pkg)` with the path that follows it, up to a blank."""
    substitutions = {part.text: part for part in reversed(tuple(value.substitutions))}
    known = True
    try:
        pieces = [text[start:end] for start, end in find_substitutions(text)]
    except SubstitutionSyntaxError as error:
        state.problem(BadSubstitution(text, str(error)), scope.origin(at or value.span))
        return Resolved(text, False)
    for piece in pieces:
        words = [w for w in piece[2:-1].split(" ") if w]
        if not words or words[0] != "find":
            if (not words or words[0] not in COMMANDS_ROS1) and piece not in substitutions:
                # Made by a value: `$$(arg a)` where a is `(b)`.
                message = f"'{piece}', which the values make, is not a substitution"
                state.problem(BadSubstitution(piece, message), scope.origin(at or value.span))
            known = known and bool(words) and words[0] in COMMANDS_ROS1
            continue
        part = substitutions.get(piece)
        span = at or (part.span if part else value.span)
        try:
            if len(words) != 2:
                raise _Failure(BadSubstitution(piece, "$(find package) takes exactly one package"))
            share = _package(state, words[1])
        except _Failure as failure:
            if failure.kind is not None:
                state.problem(failure.kind, scope.origin(span))
            own = own_program(text, piece, words[-1])
            text, known = own or text, known and own is not None
            continue
        if not state.has_room(len(text) + len(share), scope.origin(span)):
            return Resolved(text, False)
        text = _insert_package(state, text, piece, words[1], share)
        if part is not None and at is None:
            manifest = state.environment.packages[words[1]].manifest
            target = Location.of_file(manifest)
            state.uses.append(Use("find", scope.location(span), words[1], share, target))
    return Resolved(text, known)


def _insert_package(state: State, text: str, piece: str, package: str, share: str) -> str:
    before, _, after = text.partition(piece)
    path, blank, rest = after.partition(" ")
    path = path.replace("\\", "/").removeprefix("/")
    if not path:
        return before + share + after
    return before + _path_in_package(state, package, share, path) + blank + rest


def _path_in_package(state: State, package: str, share: str, path: str) -> str:
    """Where `$(find package)/path` is: an executable of that base name in the first space that has any of the package,
    else the path below the package's folder, else below that of a devel or install space."""
    for space in (*state.environment.devel_spaces, *state.environment.system_prefixes):
        folder = os.path.join(space, "lib", package)
        if state.files.is_folder(folder):
            executable = os.path.join(folder, os.path.basename(path))
            if state.files.is_program(executable):
                return executable
            break
    below = os.path.join(share, path)
    if not state.files.exists(below):
        for space in state.environment.devel_spaces:
            other = os.path.join(space, "share", package, path)
            if state.files.exists(other):
                return other
    return below
