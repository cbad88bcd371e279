"""Nodes, containers, composable nodes and other processes (`launch_ros.actions`, `launch.actions.ExecuteProcess`)."""

from __future__ import annotations

import os
import re
import shlex
from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast
from preflight_analysis.environment.model import Executable
from preflight_analysis.evaluation.files import without_dots
from preflight_analysis.evaluation.problems import InvalidName
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.ros2.launched import check_launched
from preflight_analysis.evaluation.ros2.param_files import EVERY
from preflight_analysis.evaluation.ros2.params import (
    NamedFile,
    Sources,
    allows_substitutions,
    file_source,
    pushed_source,
    tag_params,
)
from preflight_analysis.evaluation.ros2.processes import OUTPUTS
from preflight_analysis.evaluation.ros2.python_params import dict_params, named_params
from preflight_analysis.evaluation.ros2.rcl_yaml import value as rcl_value
from preflight_analysis.evaluation.ros2.remaps import is_rule_part
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, Param, ParamSource, Remap, Unknown, Use
from preflight_analysis.launch.model import Action, Literal, Substitution, Value
from preflight_analysis.launch.problems import BadValue

_WORD = re.compile(r"\w+")
_PARAM_OPTIONS = ("-p", "--param")
_NODE_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_NAMESPACE = re.compile(r"/|(?:/[A-Za-z_][A-Za-z0-9_]*)+")


def prefixed(base: str | None, ns: str | None) -> str | None:
    """`ns` below `base` (`launch_ros.utilities.prefix_namespace`)."""
    if ns is None:
        combined = base
    elif not base or ns.startswith("/"):
        combined = ns
    else:
        combined = ("" if base == "/" else base) + "/" + ns
    return combined.rstrip("/") if combined is not None and combined != "/" else combined


def absolute(ns: str | None) -> str | None:
    """`launch_ros.utilities.make_namespace_absolute`."""
    return ns if ns is None or ns.startswith("/") else "/" + ns


def namespace_of(performer: Performer, action: Action, *, fatal: bool = True) -> tuple[Resolved | None, bool]:
    """The namespace of a node, None where neither it nor what is around it says one, and whether it is valid.

    `fatal`: launch itself looks at it, and not only the container that is to load the node.
    """
    value = action.value("namespace")
    own = performer.value(value) if value is not None else None
    base = performer.context.namespace
    if own is None and base is None:
        return None, True
    known = (own is None or own.known) and (base is None or base.known)
    text = absolute(prefixed(base.text if base else None, own.text if own else None))
    result = Resolved(text or "/", known)
    if known and text is not None and _NAMESPACE.fullmatch(text) is None:
        origin = performer.place.origin(value.span if value is not None else action.kind_span)
        reason = "a namespace is made of letters, digits and underscores between single slashes"
        performer.state.problem(InvalidName(text, "namespace", reason), origin, fatal=fatal)
        return result, False
    return result, True


class _Unknowns:
    """What of a node's tag is not known."""

    def __init__(self, performer: Performer, action: Action) -> None:
        self._at = performer.place.origin(action.kind_span)[-1]
        partial = performer.place.partial
        self.found = [Unknown("the node", "its launch file was not run", self._at)] if partial else []

    def text(self, result: Resolved, what: str) -> str:
        """The text of a value, which is noted where it is not known."""
        if not result.known:
            self.found.append(Unknown(what, "it is not known", self._at))
        return result.text


def evaluate_node(performer: Performer, action: Action, *, kind: str = "node", deferred: bool = False) -> None:
    """`<node>` and `<node_container>`; composable nodes of the container after it."""
    state, place = performer.state, performer.place
    executable = action.value("exec")
    if executable is None:
        return
    unknowns = _Unknowns(performer, action)
    known = unknowns.text
    exec_name = known(performer.value(executable), "exec")
    package_value = action.value("pkg")
    package = known(performer.value(package_value), "pkg") if package_value is not None else ""
    name_value = action.value("name")
    name = known(performer.value(name_value), "name") if name_value is not None else None
    if name is not None and name_value is not None and not unknowns.found and _NODE_NAME.fullmatch(name) is None:
        reason = "a name is a letter or underscore, then letters, digits and underscores"
        state.problem(InvalidName(name, "node", reason), place.origin(name_value.span))
        return
    ns, valid = namespace_of(performer, action)
    if not valid:
        return
    namespace = known(ns, "namespace") if ns is not None else "/"
    full = _full(namespace, name if name is not None else _guessed_name(exec_name))
    # launch has a key of its own for the values of a node only where both parts of its name are given.
    own = name is not None and ns is not None
    to = Sources(full if name is not None else _full(namespace, "?"), full if own else EVERY)
    _collect(performer, action, to, must_exist=False)
    remaps = _remaps(performer, action, full)
    given = _given_words(performer, action, "args")
    arguments = [word for word, _ in given]
    to.found[:0] = _of_command_line(performer, action, given, to.owner)
    if package:
        resolved = state.executables.find(package, exec_name)
    else:
        resolved = Executable(exec_name if state.files.is_file(exec_name) else None)
    place_of_name = name_value.span if name_value is not None else action.kind_span
    state.uses.append(Use("node", place.location(place_of_name), full, full))
    target = Location.of_file(resolved.path) if resolved.path is not None else None
    state.uses.append(Use("executable", place.location(executable.span), exec_name, resolved.path, target))
    state.nodes.append(
        LaunchNode(
            full,
            namespace if namespace.endswith("/") else namespace + "/",
            package,
            exec_name,
            kind,
            " ".join(arguments),
            tuple(remaps),
            tuple(_environment(performer, action)),
            place.origin(action.head_span),
            place.tag(action),
            resolved,
            respawn=_text(performer, action, "respawn", "false").lower() in ("true", "1"),
            output=_output(performer, action),
            cwd=_text(performer, action, "cwd", "") or None,
            launch_prefix=_text(performer, action, "launch-prefix", "") or None,
            unknowns=tuple(unknowns.found),
            named=name is not None,
            params=to.effective(),
            param_sources=tuple(to.found),
            lacks_params=to.lacks,
            deferred=deferred,
        )
    )


def evaluate_composable(
    performer: Performer,
    actions: Iterable[Action],
    container: str,
    applies: Callable[[Performer, Action], bool],
    *,
    deferred: bool,
    target: Span | None = None,
) -> None:
    """The `<composable_node>`s of a container or of a `<load_composable_node>`, whose `target` names the container."""
    state, place = performer.state, performer.place
    for action in actions:
        if action.kind != "composable_node" or not applies(performer, action):
            continue
        package, plugin = action.value("pkg"), action.value("plugin")
        name_value = action.value("name")
        if package is None or plugin is None:
            continue
        unknowns = _Unknowns(performer, action)
        name = unknowns.text(performer.value(name_value), "name") if name_value is not None else None
        ns, _ = namespace_of(performer, action, fatal=False)
        namespace = unknowns.text(ns, "namespace") if ns is not None else "/"
        package_name = unknowns.text(performer.value(package), "pkg")
        plugin_name = unknowns.text(performer.value(plugin), "plugin")
        full = _full(namespace, name if name is not None else plugin_name.rpartition("::")[2])
        to = Sources(full if name is not None else _full(namespace, "?"), composable=True)
        _collect(performer, action, to, must_exist=True)
        state.nodes.append(
            LaunchNode(
                full,
                namespace if namespace.endswith("/") else namespace + "/",
                package_name,
                plugin_name,
                "composable",
                "",
                tuple(_remaps(performer, action, full)),
                (),
                place.origin(action.head_span),
                place.tag(action),
                state.executables.component(package_name, plugin_name),
                unknowns=tuple(unknowns.found),
                named=name is not None,
                container=container,
                container_location=place.origin(target)[-1] if target is not None else None,
                plugin=plugin_name,
                extra_arguments=tuple(_extra_arguments(performer, action, full)),
                params=to.effective(),
                param_sources=tuple(to.found),
                lacks_params=to.lacks,
                deferred=deferred,
            )
        )


def _extra_arguments(performer: Performer, action: Action, node: str) -> Iterator[Param]:
    """What the container is told of a component."""
    for child in action.children:
        if child.kind == "extra_arg":
            yield from named_params(performer, (child,), node)
        elif child.kind == "extra_dict":
            yield from dict_params(performer, child, node)


def evaluate_executable(performer: Performer, action: Action, *, deferred: bool) -> None:
    """`<executable>`: a process that is no node."""
    if action.value("cmd") is None and not any(child.kind == "argument" for child in action.children):
        return
    words = _words(performer, action, "cmd")
    state, place = performer.state, performer.place
    check_launched(performer, action, words)
    state.nodes.append(
        LaunchNode(
            "",
            "/",
            "",
            words[0] if words else "",
            "process",
            " ".join(words[1:]),
            (),
            tuple(_environment(performer, action)),
            place.origin(action.head_span),
            place.tag(action),
            Executable(None),
            respawn=_text(performer, action, "respawn", "false").lower() in ("true", "1"),
            output=_output(performer, action),
            cwd=_text(performer, action, "cwd", "") or None,
            launch_prefix=_text(performer, action, "launch-prefix", "") or None,
            named=False,
            deferred=deferred,
        )
    )


def _full(namespace: str, name: str) -> str:
    return f"{'' if namespace == '/' else namespace}/{name}"


def _guessed_name(executable: str) -> str:
    """What a node is probably called that the launch file does not name."""
    return re.sub(r"\W", "_", os.path.basename(executable).rpartition(".")[0] or os.path.basename(executable))


def _text(performer: Performer, action: Action, name: str, default: str) -> str:
    value = action.value(name)
    if value is None:
        return default
    if value.typed is not None:
        return str(value.typed.value)
    return performer.value(value).text


def _output(performer: Performer, action: Action) -> str:
    """Where the output goes. What launch does not know it refuses when it starts the process."""
    text, value = _text(performer, action, "output", "log"), action.value("output")
    if value is not None and text not in OUTPUTS and _WORD.fullmatch(text) and performer.value(value).known:
        bad = BadValue(action.kind, "output", text, "screen, log, both, own_log or full", OUTPUTS)
        performer.state.problem(bad, performer.place.origin(value.span))
    return text


def _collect(performer: Performer, action: Action, to: Sources, *, must_exist: bool) -> None:
    """Pushed parameters first, then those of the node, in the order in which launch passes them."""
    node = to.owner
    for pushed in performer.context.params:
        to.add(pushed_source(performer, pushed, to, as_text=not must_exist))
    for child in action.children:
        origin = performer.place.origin(child.head_span)
        if child.kind == "param_dict":
            to.add(ParamSource(None, tuple(dict_params(performer, child, node)), origin))
        if child.kind != "param":
            continue
        file = child.value("from")
        if file is not None:
            result = performer.value(file)
            if not result.known:
                to.add(None)
            else:
                path = performer.state.located(os.path.join(performer.state.cwd, result.text))
                at = performer.place.origin(file.span)
                location, target = (
                    performer.place.location(file.span),
                    without_dots(performer.state.files, path) or path,
                )
                performer.state.uses.append(Use("file", location, result.text, target, Location.of_file(target)))
                substitute = allows_substitutions(performer, child)
                empty = _why_empty(file) if not result.text else None
                named = NamedFile(path, at, empty)
                to.add(file_source(performer, named, to, substitute=substitute, must_exist=must_exist))
        elif child.value("name") is not None:
            to.add(ParamSource(None, tuple(tag_params(performer, child, node)), origin))


def _why_empty(path: Value) -> str:
    arguments = [part.arguments for part in path.substitutions if part.command == "var"]
    return f"argument '{arguments[0]}' is empty" if len(arguments) == 1 else "its path is empty"


def _remaps(performer: Performer, action: Action, node: str) -> list[Remap]:
    """The pushed rules first: of two for one name the first counts."""
    place = performer.place
    remaps = [
        Remap(p.source.text, p.target.text, p.origin, p.origin[-1], p.origin[-1], False)
        for p in performer.context.remaps
    ]
    for child in action.children:
        if child.kind != "remap":
            continue
        source, target = child.value("from"), child.value("to")
        if source is None or target is None:
            continue
        found, given = performer.value(source), performer.value(target)
        origin = place.origin(child.head_span)
        at = place.location(source.span), place.location(target.span)
        for end, value in ((found, source), (given, target)):
            if end.known and not is_rule_part(end.text):
                reason = "a name is made of letters, digits, _ and /; the node does not start"
                performer.state.problem(InvalidName(end.text, "remap", reason), place.origin(value.span), fatal=False)
        remaps.append(Remap(found.text, given.text, origin, *at, True))
    return remaps


def _environment(performer: Performer, action: Action) -> list[tuple[str, str]]:
    """What the process gets beyond, or in place of, what the launch was started with."""
    changed = performer.context.changed_variables()
    for child in action.children:
        name, value = child.value("name"), child.value("value")
        if child.kind == "env" and name is not None and value is not None:
            changed[performer.value(name).text] = performer.value(value).text
    return list(changed.items())


def _words(performer: Performer, action: Action, name: str) -> list[str]:
    return [word for word, _ in _given_words(performer, action, name)]


def _given_words(performer: Performer, action: Action, name: str) -> list[tuple[str, Span]]:
    """A command line, split where it is written: what a substitution comes to stays one word
    (`ExecuteProcess._parse_cmdline`)."""
    given = _values_of(action, "argument")
    if given:
        texts = [performer.value(value).text for value in given]
        if name == "args":
            texts = [text or "''" for text in texts]  # a program gets one that is empty
        texts = [performer.state.located(text) if text.startswith("/") else text for text in texts]
        return list(zip(texts, [value.span for value in given], strict=True))
    value = action.value(name)
    if value is None:
        return []
    if value.problem is not None:
        performer.value(value)
        return []
    return [(performer.parts(parts).text, value.span) for parts in _split(value)]


def _values_of(action: Action, kind: str) -> list[Value]:
    return [value for child in action.children if child.kind == kind and (value := child.value("value")) is not None]


def _of_command_line(
    performer: Performer, action: Action, given: Iterable[tuple[str, Span]], node: str
) -> Iterator[ParamSource]:
    """The parameters among the arguments of ROS (`-p name:=value`), which launch passes before its own."""
    words = [("--", action.kind_span), *given, ("--ros-args", action.kind_span)]
    words += [(performer.value(value).text, value.span) for value in _values_of(action, "ros_argument")]
    words += _given_words(performer, action, "ros_args") if action.value("ros_args") is not None else []
    inside = False
    for (option, _), (word, span) in pairwise(words):
        inside = option == "--ros-args" or (inside and option != "--")
        name, assigned, text = word.partition(":=")
        # A node's name before it would make it one of that node alone.
        if not inside or option not in _PARAM_OPTIONS or not assigned or ":" in name or is_unknown(word):
            continue
        try:
            written = compose_fast(text)
        except CONSTRUCTION_ERRORS:
            continue
        value = rcl_value(written) if written is not None else None
        origin = performer.place.origin(span)
        yield ParamSource(None, (Param(name, value, origin, node, origin[-1]),), origin, keys=(EVERY,))


def _split(value: Value) -> list[tuple[Literal | Substitution, ...]]:
    words: list[tuple[Literal | Substitution, ...]] = []
    word: list[Literal | Substitution] = []

    def end() -> None:
        nonlocal word
        words.append(tuple(word))
        word = []

    for part in value.parts:
        if not isinstance(part, Literal):
            word.append(part)
            continue
        try:
            tokens = shlex.split(part.text)
        except ValueError:
            tokens = part.text.split()
        if not tokens:
            end()
            continue
        if part.text[0].isspace() and word:
            end()
        word.append(Literal(tokens[0], part.span))
        if len(tokens) > 1:
            end()
            words.extend((Literal(token, part.span),) for token in tokens[1:-1])
            word.append(Literal(tokens[-1], part.span))
        if part.text[-1].isspace():
            end()
    if word:
        end()
    return words
