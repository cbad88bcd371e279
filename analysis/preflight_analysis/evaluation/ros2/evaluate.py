"""The walk over a ROS 2 launch file and its includes, from the root to a LaunchTree."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache

from preflight_analysis.documents.reading import Text, Unreadable
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.environment.launch_extensions import exposed_actions
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.commands import Commands, NoResults
from preflight_analysis.evaluation.files import Executables, Files, without_dots
from preflight_analysis.evaluation.problems import (
    ArgumentNeeded,
    ArgumentNotAChoice,
    DuplicateNode,
    IncludeCycle,
    IncludeNotFound,
    LaunchFileNotRun,
    MalformedPython,
    MalformedXml,
    MalformedYaml,
    MissingArgument,
    NestedTooDeeply,
    NoLaunchElement,
    NotTextFile,
    Problem,
    PythonException,
    UnexpandedEntity,
    UnknownIncludeArgument,
    UnreadableFile,
    UnreadableInclude,
)
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.root_args import report_undeclared
from preflight_analysis.evaluation.ros2.check_values import check_values_ros2
from preflight_analysis.evaluation.ros2.context import Context, Place, PushedParam, PushedRemap, PythonRun
from preflight_analysis.evaluation.ros2.declared import PASSED, Declared, required_arguments
from preflight_analysis.evaluation.ros2.events import Events
from preflight_analysis.evaluation.ros2.loops import rounds
from preflight_analysis.evaluation.ros2.nodes import (
    evaluate_composable,
    evaluate_executable,
    evaluate_node,
    namespace_of,
)
from preflight_analysis.evaluation.ros2.params import pushed_value
from preflight_analysis.evaluation.ros2.python_params import python_value
from preflight_analysis.evaluation.ros2.python_runs import called, calls_own_code, recorded
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.types import NotOfTypeError, coerce
from preflight_analysis.evaluation.ros2.written import is_from_yaml
from preflight_analysis.evaluation.tree import Arg, Include, LaunchTree, Use
from preflight_analysis.launch.check_language_ros2 import check_language_ros2
from preflight_analysis.launch.configurations import IMPLICIT, configurations_of
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile
from preflight_analysis.launch.problems import BadValue, LanguageProblem, UnknownElement
from preflight_analysis.launch.read import PYTHON_SUFFIX, read_launch
from preflight_analysis.launch.schema_ros2 import TAGS_ROS2

_FILLED_IN = re.compile(r"@[A-Za-z_]\w*@")
MAX_DEPTH = 150
"""Of groups and includes within each other."""
MAX_INCLUDES = 2_000
_WITH_ACTIONS = tuple(tag for tag, schema in TAGS_ROS2.items() if "node" in schema.children)
NO_RESULTS = NoResults()
_MALFORMED = {".yaml": MalformedYaml, ".yml": MalformedYaml, PYTHON_SUFFIX: MalformedPython}
_SURE_UNRUN = (MalformedPython, LaunchFileNotRun, ArgumentNotAChoice, NestedTooDeeply)
"""What can be said of a Python launch file that was not run."""


def evaluate_ros2(
    path: str,
    args: Mapping[str, str],
    files: Files,
    executables: Executables,
    environment: Environment,
    cwd: str,
    commands: Commands = NO_RESULTS,
) -> LaunchTree:
    """What `ros2 launch path name:=value...` would start.

    Never raises for what the files contain: what is wrong is in the tree's problems, and evaluation goes on. What
    starts of processes bring about comes after the rest, then, marked as deferred, what timers and other events do.
    Reads through `files` only; runs nothing.
    """
    state = Collector(2, files, executables, environment, cwd, commands)
    context = Context(environment.variables)
    for name, value in args.items():
        context.set(name, Resolved(value), None)
    path = os.path.normpath(path)
    walk = _Walk(state, context)
    walk.root(path, args)
    return LaunchTree(
        path,
        2,
        state.args,
        tuple(state.nodes),
        {},
        (),
        tuple(state.includes),
        {},
        tuple(state.uses),
        tuple(state.problems),
        tuple(state.unknowns),
        tuple(state.visited),
        state.inputs,
        tuple(state.commands),
        tuple(state.not_taken),
        state.edited,
    )


class _Walk:
    """One launch: actions in the order in which launch executes them."""

    def __init__(self, state: Collector, context: Context) -> None:
        self._state, self._context = state, context
        self._events = Events()
        self._deferred = False
        self._depth = 0
        self._exhausted = False
        self._names: list[set[str] | None] = [set()]
        """For each file that is being evaluated the configurations that it and those below it have to do with; None
        where that cannot be told."""
        self._recorded: dict[str, LaunchFile] = {}
        """Python launch files as their last run told them."""
        self._missing_below: list[Declared] = []
        """Required arguments that an include further down does not pass, as the check of one above it saw."""

    def root(self, path: str, args: Mapping[str, str]) -> None:
        """The root file, then what waits for timers."""
        whole = (Location.of_file(path),)
        found = self._state.read_launch_file(path)
        if isinstance(found, Unreadable):
            kind = NotTextFile if found.kind == "not-text" else UnreadableFile
            self._state.problem(kind(path, found.reason), whole)
            return
        self._context.launch_file = path
        found, run = self._as_run(found, ())
        self._required_arguments(found, sorted(args), None)
        self._file(Place(path, found.document.lines, (), run, found.partial), found)
        if (asked_for := self._names[-1]) is not None:
            report_undeclared(self._state, found, args, asked_for | IMPLICIT)
        self._root_args(found)
        while (upcoming := self._events.upcoming(sure=not self._state.unknowns)) is not None:
            self._deferred = upcoming.deferred
            self._actions(upcoming.place, upcoming.actions)
        self._report_missing_below()
        self._report_duplicates()

    def _report_duplicates(self) -> None:
        """Two nodes of one name: launch only warns, and both run."""
        first: dict[str, Location] = {}
        for node in self._state.nodes:
            if not node.named or node.unknowns:
                continue
            value = node.action.value("name")
            span = value.span if value is not None else node.action.kind_span
            place = self._state.location(node.location.file, span)
            if node.name in first:
                origin = (*node.origin[:-1], place)
                self._state.problem(DuplicateNode(node.name, first[node.name]), origin, fatal=False)
            else:
                first[node.name] = place

    def _report_missing_below(self) -> None:
        """launch stops there also where the include is never executed, for a condition around it that is false."""
        kinds = ((problem.kind, problem.location) for problem in self._state.problems)
        said = {(place, kind.name) for kind, place in kinds if isinstance(kind, MissingArgument)}
        for missing in self._missing_below:
            if missing.include is not None and (missing.include, missing.name) not in said:
                said.add((missing.include, missing.name))
                kind = MissingArgument(missing.name, missing.location.file, tuple(missing.passed))
                self._state.problems.append(Problem(kind, (missing.include,), True))

    def _root_args(self, launch_file: LaunchFile) -> None:
        own = {name: arg for name, arg in self._state.args.items() if arg.origin[-1].file == launch_file.path}
        self._state.args = own

    def _file(self, place: Place, launch_file: LaunchFile) -> None:
        """Execute one launch file."""
        state, document = self._state, launch_file.document
        if place.file not in state.visited:
            state.visited.append(place.file)
        self._note_names(launch_file)
        for problem in document.problems:
            kind = _MALFORMED.get(os.path.splitext(place.file)[1], MalformedXml)
            state.problem(kind(problem.message), place.origin(problem.span))
        for name, span in document.entities:
            state.problem(UnexpandedEntity(name), place.origin(span))
            state.note_unknown(f"&{name};", "entities of a DOCTYPE are not expanded", place.location(span))
        if not place.file.endswith(PYTHON_SUFFIX):
            for found in (*check_language_ros2(launch_file), *check_values_ros2(launch_file)):
                if not self._is_extension(place, found):
                    state.problem(found.kind, place.origin(found.span))
        if launch_file.root is None:
            span = document.root.tag_span if document.root is not None else Span(0, min(1, len(document.text)))
            tag = document.root.tag if document.root is not None else None
            state.problem(NoLaunchElement(tag), place.origin(span))
            return
        before = len(state.problems)
        self._actions(place, launch_file.root.children)
        if place.partial:
            # What is written in a program need not be what it does.
            state.problems[before:] = (
                problem
                for problem in state.problems[before:]
                if problem.location.file != place.file or isinstance(problem.kind, _SURE_UNRUN)
            )

    def _is_extension(self, place: Place, found: LanguageProblem) -> bool:
        """Whether it is a tag that a package defines; what that does is not known."""
        if not isinstance(found.kind, UnknownElement) or found.kind.parent not in _WITH_ACTIONS:
            return False
        tag = found.kind.tag
        package = exposed_actions(self._state.environment).get(tag)
        if package is not None:
            self._state.note_unknown(
                f"<{tag}>", f"what this tag of package '{package}' starts", place.origin(found.span)[-1]
            )
        return package is not None

    def _as_run(self, launch_file: LaunchFile, chain: Origin) -> tuple[LaunchFile, PythonRun | None]:
        """A Python launch file as its run tells it; any other is itself."""
        if not launch_file.path.endswith(PYTHON_SUFFIX):
            return launch_file, None
        found, run = recorded(self._state, self._context, launch_file, chain)
        self._recorded[launch_file.path] = found
        return found, run

    def _actions(self, place: Place, actions: tuple[Action, ...]) -> None:
        performer = Performer(self._state, self._context, place)
        for action in actions:
            execute = _EXECUTE.get(action.kind)
            if execute is None:
                if action.kind not in MEANS_NOTHING and place.run is not None:
                    at = place.location(action.head_span)
                    self._state.note_unknown(action.kind, "what it does is not known", at)
                continue
            if applies(performer, action):
                error = action.value("error")
                if error is not None:
                    name, _, message = error.text.partition(": ")
                    origin = place.origin(action.head_span)
                    self._state.problem(PythonException(name, message), origin)
                else:
                    before = len(self._state.nodes)
                    execute(self, performer, action)
                    if action.kind in _PROCESSES and len(self._state.nodes) > before:
                        self._events.started(place, action)
                    if place.run is not None:
                        self._on_exit(place, action)
            elif any(below.kind == "include" for below in action.walk()):
                self._names[-1] = None  # what it would include may have to do with any argument

    # Actions

    def _arg(self, performer: Performer, action: Action) -> None:
        """`DeclareLaunchArgument`."""
        name_value = action.value("name")
        if name_value is None:
            return
        name, place, state = name_value.text, performer.place, self._state
        default = action.value("default")
        given = self._context.get(name)
        origin = place.origin(action.head_span)
        location = place.location(name_value.span)
        if given is None:
            if default is not None:
                self._context.set(name, performer.value(default), place.origin(default.span))
            else:
                if not place.chain:
                    state.problem(ArgumentNeeded(name), origin)
                self._context.set(name, Resolved(f"$(var {name})", False), origin)
        found = self._context.get(name)
        value = found.value if found is not None and found.value.known else None
        self._check_choices(performer, action, name, value)
        shown = value.text if value is not None else None
        description = action.value("description")
        doc = description.text if description is not None else None
        value_origin = found.origin if found is not None else None
        text = default.text if default is not None else None
        state.args.setdefault(name, Arg(name, shown, text, default is None, origin, location, value_origin, doc))
        state.uses.append(Use("declaration", location, name, shown, None, value_origin or ()))
        self._context.declared[place.file, name] = location

    def _check_choices(self, performer: Performer, action: Action, name: str, value: Resolved | None) -> None:
        choices = [v.text for c in action.children if c.kind == "choice" and (v := c.value("value")) is not None]
        if not choices or value is None or value.text in choices:
            return
        found = self._context.get(name)
        declared = performer.place.origin(action.head_span)
        origin = found.origin if found is not None and found.origin else declared
        self._state.problem(ArgumentNotAChoice(name, value.text, tuple(choices), declared[-1]), origin)

    def _let(self, performer: Performer, action: Action) -> None:
        name, value = action.value("name"), action.value("value")
        if name is not None and value is not None:
            result, set_name = performer.value(value), performer.value(name).text
            self._context.set(set_name, result, performer.place.origin(action.head_span))
            location = performer.place.location(name.span)
            shown = result.text if result.known else None
            self._state.uses.append(Use("declaration", location, set_name, shown))
            self._context.declared[location.file, set_name] = location

    def _group(self, performer: Performer, action: Action) -> None:
        """`GroupAction`: scoped and forwarding unless it says otherwise."""
        scoped, forwarding, context = _flag(action, "scoped"), _flag(action, "forwarding"), self._context
        if self._too_deep(performer.place, action):
            return
        self._depth += 1
        if scoped:
            context.push_configurations()
            context.push_environment()
        if scoped and not forwarding:
            context.reset_environment()
            self._reset(performer, action)
        else:
            # One after the other: the value of one may name those before it.
            for name, result, origin in _kept(performer, action):
                context.set(name, result, origin)
        self._actions(performer.place, action.children)
        if scoped:
            context.pop_environment()
            context.pop_configurations()
        self._depth -= 1

    def _include(self, performer: Performer, action: Action) -> None:
        """`IncludeLaunchDescription`: what it passes, and what the file sets, stays set after it."""
        state, place = self._state, performer.place
        attribute = action.attribute("file")
        if attribute is None:
            return
        file = performer.value(attribute.value)
        origin = place.origin(action.head_span)
        at = place.location(attribute.value.span)
        passed = self._passed(performer, action)
        if not file.known:
            self._names[-1] = None
            self._context.cannot_follow(at)
            state.includes.append(Include(None, origin, at, {}, len(state.nodes)))
            state.note_unknown("<include>", "its file is not known", at)
            return
        path = os.path.normpath(os.path.join(state.cwd, file.text))
        path = located(state.environment, without_dots(path) or path)
        shown: dict[str, str | None] = {}
        include = Include(path, origin, at, shown, len(state.nodes))
        state.includes.append(include)
        state.uses.append(Use("include", at, file.text, path, Location.of_file(path)))
        if self._too_deep(place, action):
            return
        found = self._read(place, path, at)
        if found is None:
            self._names[-1] = None
            self._context.cannot_follow(at)
            return
        self._context.launch_file = path
        found, run = self._as_run(found, origin)
        self._required_arguments(found, [name for name, _ in passed], (*place.chain, at))
        for name, child in passed:
            value = child.value("value")
            result = performer.value(value) if value is not None else Resolved("", False)
            shown[name] = result.text if result.known else None
            self._context.set(name, result, place.origin(value.span if value is not None else child.kind_span))
        self._depth += 1
        self._names.append(set())
        self._file(Place(path, found.document.lines, origin, run, found.partial), found)
        if found.partial or found.document.problems:
            self._context.cannot_follow(at)
        below = self._names.pop()
        self._depth -= 1
        above = self._names[-1]
        self._names[-1] = None if below is None or above is None else above | below
        if below is not None:
            self._report_unused(place, path, passed, below)

    def _note_names(self, launch_file: LaunchFile) -> None:
        known = self._names[-1]
        found = configurations_of(launch_file)
        partial = found.computed or launch_file.root is None or bool(launch_file.document.problems)
        partial = partial or launch_file.partial or calls_own_code(launch_file)
        self._names[-1] = None if known is None or partial else known | found.declared | found.used

    def _report_unused(self, place: Place, path: str, passed: list[tuple[str, Action]], names: set[str]) -> None:
        """An argument that neither the file nor what it includes has to do with: launch accepts it without a word. The
        includer itself may use it later, as what an include sets stays set."""
        own = self._recorded.get(place.file) or self._state.files.launch_file(place.file, 2)
        used = frozenset[str]() if isinstance(own, Unreadable) else configurations_of(own).used
        if isinstance(own, LaunchFile) and (own.partial or calls_own_code(own)):
            return
        for name, child in passed:
            if name not in names and name not in used and name not in IMPLICIT:
                value = child.value("name")
                span = value.span if value is not None else child.kind_span
                kind = UnknownIncludeArgument(name, tuple(sorted(names)), path)
                self._state.problems.append(Problem(kind, place.origin(span), False))

    def _passed(self, performer: Performer, action: Action) -> list[tuple[str, Action]]:
        found = []
        for child in action.children:
            name = child.value("name")
            if child.kind == PASSED[action.kind] and name is not None:
                text = performer.value(name).text
                found.append((text, child))
                self._state.uses.append(Use("argument", performer.place.location(name.span), text, text))
        return found

    def _read(self, place: Place, path: str, at: Location) -> LaunchFile | None:
        """The included file; what is wrong with it is noted."""
        state, origin = self._state, (*place.chain, at)
        chain = [location.file for location in place.chain]
        if path in (place.file, *chain):
            state.problem(IncludeCycle(path, (*chain, place.file)), origin)
            return None
        found = state.read_launch_file(path)
        if isinstance(found, Unreadable) and found.kind == "missing":
            found = self._configured(path) or found
        if not isinstance(found, Unreadable):
            return found
        if found.kind == "missing":
            state.problem(IncludeNotFound(path, found.reason), origin)
        else:
            state.problem(UnreadableInclude(path, found.reason), origin)
        state.note_unknown("<include>", f"{path} {found.reason}", at)
        return None

    def _configured(self, path: str) -> LaunchFile | None:
        """A file that CMake makes of one with `.in` behind its name: that, with 0 for what the build fills in."""
        template = self._state.read_text(path + ".in")
        if isinstance(template, Unreadable):
            return None
        names = sorted(set(_FILLED_IN.findall(template.text)))
        if names:
            at = Location.of_file(path + ".in")
            self._state.note_unknown(", ".join(names), "the build fills it in", at)
        return read_launch(_filled_in(path, template.text), 2)

    def _required_arguments(self, launch_file: LaunchFile, passed: list[str], include: Origin | None) -> None:
        """Before it executes a file launch looks whether each required argument is passed by the include itself:
        a configuration that is set already does not count."""
        names = list(passed)
        if launch_file.partial:
            return
        for declared in required_arguments(launch_file, self._included_without_context):
            names += declared.passed
            if declared.name in names:
                continue
            if declared.include is not None:
                self._missing_below.append(declared)
            elif include is None:
                self._state.problem(ArgumentNeeded(declared.name), (declared.location,))
            else:
                kind = MissingArgument(declared.name, declared.location.file, tuple(passed))
                self._state.problem(kind, include)

    def _included_without_context(self, file: LaunchFile, action: Action) -> LaunchFile | None:
        value = action.value("file")
        if value is None or value.problem is not None:
            return None
        if any(part.command not in ("find-pkg-share", "find-pkg-prefix", "env") for part in value.substitutions):
            return None
        quiet = Collector(
            2, self._state.files, self._state.executables, self._state.environment, self._state.cwd, self._state.results
        )
        empty = Context(self._state.environment.variables)
        result = Performer(quiet, empty, Place(file.path, file.document.lines, ())).value(value)
        if not result.known:
            return None
        path = os.path.normpath(os.path.join(self._state.cwd, result.text))
        found = self._state.read_launch_file(located(self._state.environment, path))
        if isinstance(found, Unreadable):
            return None
        if found.path.endswith(PYTHON_SUFFIX):
            # Whether it is executed at all is not known yet: launch keeps to itself what it raises now.
            quiet.commands, quiet.inputs = self._state.commands, self._state.inputs
            found, _ = recorded(quiet, self._context, found, (file.document.location(value.span),))
        return None if found.partial else found

    def _too_deep(self, place: Place, action: Action) -> bool:
        if self._depth <= MAX_DEPTH and len(self._state.includes) <= MAX_INCLUDES:
            return False
        if not self._exhausted:
            self._exhausted = True
            limit = f"{MAX_DEPTH} levels" if self._depth > MAX_DEPTH else f"{MAX_INCLUDES} includes"
            self._state.problem(NestedTooDeeply(limit), place.origin(action.kind_span))
            at = place.location(action.kind_span)
            self._state.note_unknown(f"<{action.kind}>", f"there are more than {limit}", at)
        return True

    def _node(self, performer: Performer, action: Action) -> None:
        evaluate_node(performer, action, deferred=self._deferred)

    def _lifecycle(self, performer: Performer, action: Action) -> None:
        evaluate_node(performer, action, kind="lifecycle", deferred=self._deferred)

    def _container(self, performer: Performer, action: Action) -> None:
        before = len(self._state.nodes)
        evaluate_node(performer, action, kind="container", deferred=self._deferred)
        if len(self._state.nodes) > before:
            name = self._state.nodes[-1].name
            evaluate_composable(performer, action.children, name, applies, deferred=self._deferred)

    def _load(self, performer: Performer, action: Action) -> None:
        target = action.value("target")
        named = next((child for child in action.children if child.kind == "target"), None)
        if named is not None:
            ns, _ = namespace_of(performer, named, self._context.scope)
            base = named.value("name")
            above = ns.text if ns is not None and ns.text != "/" else ""
            name = f"{above}/{performer.value(base).text if base is not None else ''}"
            evaluate_composable(performer, action.children, name, applies, deferred=self._deferred)
        elif target is not None:
            name = performer.value(target).text
            evaluate_composable(performer, action.children, name, applies, deferred=self._deferred, target=target.span)

    def _executable(self, performer: Performer, action: Action) -> None:
        evaluate_executable(performer, action, deferred=self._deferred)

    def _push_namespace(self, performer: Performer, action: Action) -> None:
        ns, valid = namespace_of(performer, action, self._context.scope)
        if ns is not None and valid:
            self._context.scope.namespace = ns

    def _set_remap(self, performer: Performer, action: Action) -> None:
        source, target = action.value("from"), action.value("to")
        if source is None or target is None:
            return
        origin = performer.place.origin(action.head_span)
        remap = PushedRemap(performer.value(source), performer.value(target), origin)
        scope = self._context.scope
        if scope.remaps is None:
            scope.remaps = []
        scope.remaps.append(remap)

    def _set_parameter(self, performer: Performer, action: Action) -> None:
        name, value = action.value("name"), action.value("value")
        given = next((child for child in action.children if child.kind == "param"), None)
        if name is not None and given is not None:
            known, plain = python_value(performer, given)
            if known:
                origin = performer.place.origin(action.head_span)
                self._push_param(PushedParam(performer.value(name).text, plain, origin))
        elif name is not None and value is not None:
            found = pushed_value(performer, value)
            if found is not None:
                origin = performer.place.origin(action.head_span)
                self._push_param(PushedParam(performer.value(name).text, found, origin))

    def _set_parameters_from_file(self, performer: Performer, action: Action) -> None:
        file = action.value("filename")
        if file is not None:
            result = performer.value(file)
            if result.known:
                self._push_param(PushedParam(None, result.text, performer.place.origin(file.span)))

    def _push_param(self, param: PushedParam) -> None:
        scope = self._context.scope
        if scope.params is None:
            scope.params = []
        scope.params.append(param)

    def _timer(self, performer: Performer, action: Action) -> None:
        self._events.later(performer.place, action.children)

    def _loop(self, performer: Performer, action: Action) -> None:
        """`ForLoop` and `ForEach`: what is inside once for each round."""
        context = self._context
        for variables in rounds(performer, action):
            if self._too_deep(performer.place, action):
                return
            before, context.round = context.round, {**context.round, **variables}
            self._depth += 1
            self._actions(performer.place, action.children)
            self._depth -= 1
            context.round = before

    def _set_env(self, performer: Performer, action: Action) -> None:
        name, value = action.value("name"), action.value("value")
        if name is not None and value is not None:
            result = performer.value(value)
            if result.known:
                self._context.environment[performer.value(name).text] = result.text

    def _unset_env(self, performer: Performer, action: Action) -> None:
        name = action.value("name")
        if name is not None:
            self._context.environment.pop(performer.value(name).text, None)

    def _append_env(self, performer: Performer, action: Action) -> None:
        name, value = action.value("name"), action.value("value")
        if name is None or value is None:
            return
        key, result = performer.value(name).text, performer.value(value)
        separator = action.value("separator")
        between = performer.value(separator).text if separator is not None else os.pathsep
        environment = self._context.environment
        old = environment.get(key)
        if old is None:
            environment[key] = result.text
        elif _flag(action, "prepend", default=False):
            environment[key] = result.text + between + old
        else:
            environment[key] = old + between + result.text

    def _reset_env(self, performer: Performer, action: Action) -> None:
        self._context.reset_environment()

    def _reset(self, performer: Performer, action: Action) -> None:
        kept = list(_kept(performer, action))
        self._context.reset_configurations()
        for text, result, origin in kept:
            self._context.set(text, result, origin)

    def _unlet(self, performer: Performer, action: Action) -> None:
        name = action.value("name")
        if name is not None:
            self._context.scope.configurations.pop(performer.value(name).text, None)

    def _inline(self, performer: Performer, action: Action) -> None:
        """A launch description as an action, or included without a file."""
        for name, child in self._passed(performer, action):
            value = child.value("value")
            if value is not None:
                self._context.set(name, performer.value(value), performer.place.origin(value.span))
        if not self._too_deep(performer.place, action):
            self._depth += 1
            self._actions(performer.place, action.children)
            self._depth -= 1

    def _opaque(self, performer: Performer, action: Action) -> None:
        """What a function of the file's, or an action of its own, does with what is configured now."""
        number, name = action.value("id"), action.value("class")
        if number is None or name is None or self._too_deep(performer.place, action):
            return
        place, context = performer.place, self._context
        answer = called(self._state, context, place, number.text, name.text, "execute", action.head_span)
        origin = place.origin(action.head_span)
        if answer is None:
            context.cannot_follow(origin[-1])
            return
        for key, text in (answer.changed or {}).items():
            if key not in ("ros_namespace", "global_params", "ros_remaps"):
                context.set(key, Resolved(text), origin)
        for key in answer.removed:
            context.scope.configurations.pop(key, None)
        context.environment.update(answer.variables or {})
        self._depth += 1
        self._actions(answer.place, answer.actions)
        self._depth -= 1

    def _coroutine(self, performer: Performer, action: Action) -> None:
        at = performer.place.location(action.head_span)
        self._state.note_unknown("OpaqueCoroutine", "what it does is known only when it is launched", at)

    def _handler(self, performer: Performer, action: Action) -> None:
        """`RegisterEventHandler`."""
        if any(child.kind == "function" for child in action.children):
            at = performer.place.location(action.head_span)
            self._state.note_unknown("an event handler", "what its function does depends on the event", at)
        self._events.register(performer.place, action)

    def _remove_handler(self, performer: Performer, action: Action) -> None:
        self._events.unregister(performer.place, action)

    def _on_exit(self, place: Place, action: Action) -> None:
        for child in action.children:
            if child.kind == "on_exit":
                self._events.later(place, child.children)

    def _push_configurations(self, performer: Performer, action: Action) -> None:
        self._context.push_configurations()

    def _pop_configurations(self, performer: Performer, action: Action) -> None:
        self._pop(performer, action, self._context.pop_configurations, "launch_configurations")

    def _push_environment(self, performer: Performer, action: Action) -> None:
        self._context.push_environment()

    def _pop_environment(self, performer: Performer, action: Action) -> None:
        self._pop(performer, action, self._context.pop_environment, "environment")

    def _pop(self, performer: Performer, action: Action, pop: Callable[[], None], name: str) -> None:
        try:
            pop()
        except IndexError:
            origin, message = performer.place.origin(action.head_span), f"{name} stack unexpectedly empty"
            self._state.problem(PythonException("RuntimeError", message), origin)

    def _set_use_sim_time(self, performer: Performer, action: Action) -> None:
        """The frontends hand the text over where the action wants a bool: it fails when it is executed."""
        self._only_read(performer, action)
        value = action.value("value")
        if value is not None and not performer.place.file.endswith(PYTHON_SUFFIX):
            expected = 'what launch can use: it takes no text; write <set_parameter name="use_sim_time" value="..."/>'
            bad = BadValue(action.kind, "value", value.text, expected)
            self._state.problem(bad, performer.place.origin(value.span))

    def _set_log_dir(self, performer: Performer, action: Action) -> None:
        value = action.value("new_log_dir")
        if value is not None:
            result, environment = performer.value(value), self._context.environment
            folder = os.path.join(environment.get("ROS_LOG_DIR", ""), result.text)
            if result.known and os.path.isabs(folder):
                environment["ROS_LOG_DIR"] = folder

    def _only_read(self, performer: Performer, action: Action) -> None:
        """Actions that start nothing and set nothing that a node sees; their values are read all the same."""
        for attribute in action.attributes:
            if attribute.name not in ("if", "unless"):
                performer.value(attribute.value)


_EXECUTE: dict[str, Callable[[_Walk, Performer, Action], None]] = {
    "arg": _Walk._arg,
    "let": _Walk._let,
    "group": _Walk._group,
    "include": _Walk._include,
    "node": _Walk._node,
    "node_container": _Walk._container,
    "load_composable_node": _Walk._load,
    "executable": _Walk._executable,
    "push_ros_namespace": _Walk._push_namespace,
    "push-ros-namespace": _Walk._push_namespace,
    "set_remap": _Walk._set_remap,
    "set_parameter": _Walk._set_parameter,
    "set_parameters_from_file": _Walk._set_parameters_from_file,
    "timer": _Walk._timer,
    "ros_timer": _Walk._timer,
    "for": _Walk._loop,
    "for_each": _Walk._loop,
    "set_env": _Walk._set_env,
    "unset_env": _Walk._unset_env,
    "append_env": _Walk._append_env,
    "reset_env": _Walk._reset_env,
    "reset": _Walk._reset,
    "log": _Walk._only_read,
    "log_debug": _Walk._only_read,
    "log_info": _Walk._only_read,
    "log_warning": _Walk._only_read,
    "log_error": _Walk._only_read,
    "shutdown": _Walk._only_read,
    "set_use_sim_time": _Walk._set_use_sim_time,
    "set_ros_log_dir": _Walk._set_log_dir,
    "lifecycle_node": _Walk._lifecycle,
    "unlet": _Walk._unlet,
    "inline": _Walk._inline,
    "opaque": _Walk._opaque,
    "opaque_coroutine": _Walk._coroutine,
    "event_handler": _Walk._handler,
    "push_configurations": _Walk._push_configurations,
    "pop_configurations": _Walk._pop_configurations,
    "push_env": _Walk._push_environment,
    "pop_env": _Walk._pop_environment,
    "unregister_event_handler": _Walk._remove_handler,
    "unknown": _Walk._only_read,
}

MEANS_NOTHING = frozenset(
    {
        # They belong to the action around them, which reads them.
        *("keep", "arg_passed", "choice", "argument", "ros_argument", "env", "param", "param_dict", "item", "remap"),
        *("composable_node", "target", "on_exit", "function"),
        "emit_event",  # handlers wait for it; what they start is deferred
        "lifecycle_transition",  # a state of a node, not its configuration
        "test",  # `launch_testing` starts no node
    }
)
"""Kinds that are recorded of a Python launch file, or written in others, and that no walk executes."""
_PROCESSES = frozenset({"node", "node_container", "lifecycle_node", "executable"})

EXECUTED = frozenset(_EXECUTE)
"""Kinds that are."""
_MAY_SET = frozenset({"arg", "let", "include", "group", "inline", "opaque", "for", "for_each"})
"""Actions after which there may be other configurations."""


def _kept(performer: Performer, action: Action) -> Iterator[tuple[str, Resolved, Origin]]:
    """What the `<keep>`s of an action set, each evaluated when it is asked for."""
    for child in action.children:
        name, value = child.value("name"), child.value("value")
        if child.kind == "keep" and name is not None and value is not None:
            yield performer.value(name).text, performer.value(value), performer.place.origin(child.head_span)


def applies(performer: Performer, action: Action) -> bool:
    """Whether an action is executed, by its `if` and `unless` (`launch.conditions`)."""
    for name in ("if", "unless"):
        attribute = action.attribute(name)
        if attribute is not None:
            return _condition(performer, action, attribute, name == "if")
    return True


def _condition(performer: Performer, action: Action, attribute: ActionAttribute, wanted: bool) -> bool:
    """Whether a condition is what is wanted; it is not where it is not known or none."""
    result = performer.value(attribute.value)
    span = attribute.value.span
    if not result.known:
        at = performer.place.location(span)
        performer.state.note_unknown(f"<{action.kind} {attribute.name}>", "its condition is not known", at)
        if action.kind in _MAY_SET:
            performer.context.cannot_follow(at)
        return False
    word = result.text.strip().lower()
    if word in ("true", "1", "false", "0"):
        taken = (word in ("true", "1")) == wanted
        if not taken:
            origin = performer.place.origin(action.head_span)
            performer.state.note_not_taken(action, attribute, result.text, origin)
        return taken
    bad = BadValue(action.kind, attribute.name, result.text, "true, false, 1 or 0", ("true", "false"))
    performer.state.problem(bad, performer.place.origin(span))
    return False


@lru_cache(maxsize=64)
def _filled_in(path: str, template: str) -> Text:
    """What the build makes of a template; one text for one template, so that its places are the same each time."""
    return Text.of(path, _FILLED_IN.sub("0", template))


def _flag(action: Action, name: str, *, default: bool = True) -> bool:
    """A boolean attribute; a text that may have substitutions counts as true, as it does for launch."""
    value = action.value(name)
    if value is None:
        return default
    if value.typed is not None:
        return bool(value.typed.value)
    if is_from_yaml(action):
        return bool(value.text)
    try:
        return bool(coerce(value.text, "bool", or_text=True))
    except NotOfTypeError:
        return default
