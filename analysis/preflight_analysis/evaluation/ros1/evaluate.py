"""The walk over a launch file and its includes, from the root to a LaunchTree."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Mapping
from collections.abc import Set as AbstractSet

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names, values
from preflight_analysis.evaluation.catalogued import in_catalogue
from preflight_analysis.evaluation.files import without_dots
from preflight_analysis.evaluation.known_files import params_of_files
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.problems import (
    IncludeCycle,
    MalformedXml,
    NestedTooDeeply,
    NoLaunchElement,
    UndefinedMachine,
    UnexpandedEntity,
    UnknownIncludeArgument,
)
from preflight_analysis.evaluation.root_args import report_undeclared
from preflight_analysis.evaluation.ros1.arguments import (
    are_those_of,
    declared_args,
    evaluate_arg,
    names_asked_for,
    passed_args,
)
from preflight_analysis.evaluation.ros1.attributes import Attributes, applies
from preflight_analysis.evaluation.ros1.included import (
    Passed,
    Record,
    language_problems,
    passed_to,
)
from preflight_analysis.evaluation.ros1.nodes import evaluate_node
from preflight_analysis.evaluation.ros1.params import evaluate_param, evaluate_rosparam
from preflight_analysis.evaluation.ros1.parts import MAX_REMEMBERED_DEPTH, Evaluate, remembered, within_tags
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.ros1.scope_arguments import Arguments, ArgValue, PassedArguments
from preflight_analysis.evaluation.ros1.state import MAX_INCLUDES, State
from preflight_analysis.evaluation.ros1.tags import (
    clear_params,
    evaluate_env,
    evaluate_machine,
    evaluate_remap,
    namespace_of,
)
from preflight_analysis.evaluation.rviz import note_configs_of_rviz
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import Include, LaunchTree, Use
from preflight_analysis.generation import ros
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.problems import ConflictingAttributes
from preflight_analysis.launch.read import generation_of

MAX_DEPTH = 150
"""Of groups and includes within each other. Real launches stay below twenty; Python's stack ends at a multiple."""


def evaluate(
    path: str,
    args: Mapping[str, str],
    within: Surroundings,
    *,
    by_parts: bool = False,
    assumed: AbstractSet[Location] = frozenset(),
    outline: bool = False,
) -> LaunchTree:
    """What `roslaunch path name:=value...` would start.

    Never raises for what the files contain: what is wrong is in the tree's problems, and evaluation goes on. Relative
    paths in launch files are relative to `within.cwd`, as in roslaunch. Reads through `within.files` only and runs
    nothing: what it does not know of commands stands in the tree's `commands`. `by_parts`: includes and tags are
    remembered for these surroundings. The tags at `assumed` are taken whatever their conditions say: not by parts then.
    Nor an `outline`: that lacks what YAML says, where executables are, and what is wrong in the language of the files.
    """
    state, environment = State(within, by_parts=by_parts, assumed=assumed, outline=outline), within.environment
    path = os.path.normpath(path)
    found = state.read_launch_file(path)
    if isinstance(found, Unreadable):
        state.unreadable_root(path, found)
    else:
        ns = args.get("__ns") or environment.variables.get("ROS_NAMESPACE") or "/"
        scope = Scope(path, found.document.lines, (), names.as_namespace(ns))
        scope.arguments = Arguments(values={name: ArgValue(value, None) for name, value in args.items()})
        _file(state, scope, found, None)
        state.args = declared_args(scope, found)
        if (asked_for := names_asked_for(found)) is not None:
            report_undeclared(state, found, args, asked_for)
    note_configs_of_rviz(state, state.nodes)
    file_params = params_of_files(
        state, state.nodes, state.params, KnownMeanings(within.knowledge, environment.distro, 1)
    )
    _check_machines(state)
    if not outline:
        _check_language(state)
    return LaunchTree(
        path,
        1,
        state.args,
        tuple(state.nodes),
        state.params,
        tuple(state.clear_params),
        tuple(state.includes),
        state.machines,
        tuple(state.uses),
        tuple(state.problems),
        tuple(state.unknowns),
        tuple(state.visited),
        state.inputs,
        tuple(state.commands),
        tuple(state.not_taken),
        file_params=file_params,
    )


_MAY_DECLARE_MACHINES = ("<machine", "<include", "<group if", "<group unless")
"""What is not known of a launch that may hold the machine which seems to be missing."""


def _file(state: State, scope: Scope, launch_file: LaunchFile, default_machine: str | None) -> str | None:
    """Evaluate one file in `scope`; the default machine after it."""
    document = launch_file.document
    for problem in document.problems:
        state.problem(MalformedXml(problem.message), scope.origin(problem.span))
    for name, span in document.entities:
        state.problem(UnexpandedEntity(name), scope.origin(span))
        state.unknown(f"&{name};", "entities of a DOCTYPE are not expanded", scope, span)
    root = launch_file.root
    _check_root(state, scope, launch_file)
    if root is not None:
        _conditions_of_launch(state, scope, root)
    state.visited.setdefault(scope.file)
    return _actions(state, scope, root.children, default_machine) if root is not None else default_machine


def _check_root(state: State, scope: Scope, launch_file: LaunchFile) -> None:
    """The document element has to be `<launch>`, and the only one of that name."""
    document, root = launch_file.document, launch_file.root
    if root is not None:
        # Of a text that is not well-formed it is said where that ends: a start tag for an end tag is one slip.
        if launch_file.extra_roots and not document.problems:
            state.problem(NoLaunchElement("launch"), scope.origin(launch_file.extra_roots[0]))
    elif document.root is not None:
        state.problem(NoLaunchElement(document.root.tag), scope.origin(document.root.tag_span))
    elif not document.problems:
        state.problem(NoLaunchElement(None), scope.origin(Span(0, min(1, len(document.text)))))


def _conditions_of_launch(state: State, scope: Scope, root: Action) -> None:
    """roslaunch reads `if` and `unless` of `<launch>`, but makes no substitutions there and goes on in any case."""
    attributes = Attributes(state, scope, root)
    conditions = ("if", "unless")
    given = [found for found in map(root.attribute, conditions) if found is not None]
    for attribute in given:
        if "$" in attribute.value.text:
            attributes.bad_value(attribute.name, attribute.value.text, "true, false, 1 or 0; nothing is replaced here")
            return
    if len(given) > 1:
        state.problem(ConflictingAttributes(root.kind, conditions), scope.origin(root.kind_span))
    for attribute in given[:1]:
        try:
            values.to_bool(attribute.value.text)
        except values.BadValueError as error:
            attributes.bad_value(attribute.name, attribute.value.text, str(error), ("true", "false"))


def _actions(state: State, scope: Scope, actions: tuple[Action, ...], default_machine: str | None) -> str | None:
    within: Hashable | None = None
    made = 0
    for action in actions:
        evaluate = _EVALUATED_APART.get(action.kind)
        if action.kind == "arg":
            evaluate_arg(state, scope, action)
            continue
        if action.kind == "rosparam":
            evaluate_rosparam(state, scope, action)
            continue
        if action.kind == "include" and scope.chain:
            # Included files are remembered anyhow; to try those within each other apart would double at each level.
            after = _include(state, scope, action, default_machine)
            if after != default_machine:
                default_machine, within = after, None
            continue
        if evaluate is not None:
            # Those that follow each other have the same scope, but for the anonymous names that one of them makes.
            if within is None or len(scope.anonymous) != made:
                within, made = within_tags(state, scope, default_machine), len(scope.anonymous)
            after = remembered(state, scope, action, within, _of_tag(evaluate, action, default_machine))
            if after != default_machine:
                default_machine, within = after, None
            continue
        within = None
        match action.kind:
            case "group":
                default_machine = _group(state, scope, action, default_machine)
            case "param":
                evaluate_param(state, scope, action)
            case "remap":
                remap = evaluate_remap(state, scope, action, inside_node=False)
                if remap is not None:
                    scope.add_remap(remap)
            case "env":
                evaluate_env(state, scope, action)
            case "machine":
                default_machine = evaluate_machine(state, scope, action) or default_machine
    return default_machine


def _of_tag(evaluate: _Evaluate, action: Action, default_machine: str | None) -> Evaluate:
    return lambda state, scope: evaluate(state, scope, action, default_machine)


def _node(state: State, scope: Scope, action: Action, default_machine: str | None) -> str | None:
    evaluate_node(state, scope, action, default_machine)
    return default_machine


def _group(state: State, scope: Scope, action: Action, default_machine: str | None) -> str | None:
    """`<group>` (http://wiki.ros.org/roslaunch/XML/group)."""
    if not applies(state, scope, action):
        return default_machine
    attributes = Attributes(state, scope, action)
    ns = namespace_of(state, scope, action, attributes)
    if ns is None:
        return default_machine
    if _too_deep(state, scope, action):
        return default_machine
    inside = scope.child(ns.text)
    inside.private_params = list(inside.private_params)
    clear_params(attributes, inside, ns.text)
    if not attributes.all_known:
        state.unknown("<group>", "its namespace is not known", scope, action.kind_span)
    return _actions(state, inside, action.children, default_machine)


def _include(state: State, scope: Scope, action: Action, default_machine: str | None) -> str | None:
    """`<include>` (http://wiki.ros.org/roslaunch/XML/include)."""
    if not applies(state, scope, action):
        return default_machine
    attributes = Attributes(state, scope, action)
    required = attributes.require("file")
    file_attribute = action.attribute("file")
    if required is None or file_attribute is None:
        return default_machine
    file = required[0]
    pass_all = attributes.convert("pass_all_args", False, values.to_flag)
    ns = namespace_of(state, scope, action, attributes)
    if ns is None:
        return default_machine
    inside = scope.child(ns.text)
    clear_params(attributes, inside, ns.text)
    passed, tags = passed_args(state, scope, inside, action, pass_all)
    place = scope.location(file_attribute.value.span)
    origin = scope.origin(action.head_span)
    shown = {name: value.text for name, value in passed.items()}
    catalogued = None
    if not file.known:
        named = in_catalogue(file.text, 1, state.environment)
        catalogued = state.of_catalogue(named, scope.origin(file_attribute.value.span))
    state.includes.append(Include(file.text if file.known else catalogued, origin, place, shown))
    if not file.known and catalogued is None:
        state.unknown("<include>", "its file is not known", scope, file_attribute.value.span)
        return default_machine
    # The empty path is not the working directory.
    real = catalogued or (without_dots(state.files, os.path.join(state.cwd, file.text)) if file.text else None)
    path = real or os.path.normpath(os.path.join(state.cwd, file.text))
    state.uses.append(Use("include", place, file.text, path, Location.of_file(path)))
    if _too_deep(state, scope, action):
        return default_machine
    file_origin = scope.origin(file_attribute.value.span)
    if real is None:
        state.unreadable_include(path, Unreadable(path, "does not exist", "missing"), file_origin)
        return default_machine
    found = _included(state, scope, path, passed, file_origin)
    if found is None:
        return default_machine
    inside.file, inside.lines, inside.chain = path, found.document.lines, origin
    inside.arguments, inside.anonymous, inside.pass_all_args = Arguments(values=passed), {}, pass_all
    default_machine = _included_file(state, inside, found, default_machine)
    if not pass_all:
        declared = tuple(sorted(inside.arguments.declared))
        for name, tag in tags.items():
            if name not in declared:
                state.problem(UnknownIncludeArgument(name, declared, path), scope.origin(tag.span))
    return default_machine


_Evaluate = Callable[[State, Scope, Action, str | None], str | None]
"""Evaluates a tag in a scope, where that is the default machine, and returns which one is after it."""
_EVALUATED_APART: Mapping[str, _Evaluate] = {"node": _node, "test": _node, "include": _include}
"""Tags that change nothing of the scope that they are in, but for anonymous names."""


def _included_file(state: State, inside: Scope, launch_file: LaunchFile, default_machine: str | None) -> str | None:
    """As `_file`, for an included file: what it adds by itself is added, or it is evaluated where it is."""
    by_parts, passed = state.by_parts, passed_to(inside, default_machine)
    if not by_parts or passed is None or len(inside.chain) > MAX_REMEMBERED_DEPTH:
        return _file(state, inside, launch_file, default_machine)
    record = _alone.answered(state.files.db, PassedArguments(inside.arguments), state.within, passed)
    if record is None:
        state.depends_on_outside = True
        return _file(state, inside, launch_file, default_machine)
    if state.absorb(record):
        inside.arguments.declared.update(record.declared)
        return record.default_machine
    # A node's name is taken, say: then order matters, and all of it is evaluated in its place.
    state.by_parts = False
    after = _file(state, inside, launch_file, default_machine)
    state.by_parts = by_parts
    return after


@query
def _alone(db: Database, within: Surroundings, passed: Passed) -> Record | None:
    """What an included file adds, whatever is around it; None where that depends on more than what is passed to it."""
    state = State(within, by_parts=True, is_included=True)
    found = within.files.launch_file(passed.file, 1)
    if isinstance(found, Unreadable):
        return None
    scope = passed.scope(found.document.lines, Arguments(lambda *question: db.ask(question)))
    after = _file(state, scope, found, passed.default_machine)
    state.inputs = {passed.file: state.digest(passed.file), **state.inputs}
    return None if state.depends_on_outside or state.exhausted else state.record(scope, after)


def _check_language(state: State) -> None:
    """What roslaunch would skip or complain of in each file, whatever its context."""
    for path in state.visited:
        problems = language_problems(state.files.db, state.files, path)
        launch_file = state.files.launch_file(path, 1) if problems else None
        if launch_file is not None and not isinstance(launch_file, Unreadable):
            said = {problem.span for problem in launch_file.document.problems} | set(launch_file.extra_roots)
            for found in problems:
                if found.span not in said:
                    state.problem(found.kind, (launch_file.document.location(found.span),), fatal=False)


def _too_deep(state: State, scope: Scope, action: Action) -> bool:
    """Whether to look no further, which is said once: where includes multiply, each of thousands would say so."""
    if scope.depth <= MAX_DEPTH and state.include_count <= MAX_INCLUDES:
        return False
    if not state.exhausted:
        state.exhausted = True
        limit = f"{MAX_DEPTH} levels" if scope.depth > MAX_DEPTH else f"{MAX_INCLUDES} includes"
        state.problem(NestedTooDeeply(limit), scope.origin(action.kind_span))
        state.unknown(f"<{action.kind}>", f"there are more than {limit}", scope, action.kind_span)
    return True


def _included(
    state: State, scope: Scope, path: str, passed: Mapping[str, ArgValue], origin: tuple[Location, ...]
) -> LaunchFile | None:
    """Read the included file; None, with the reason noted, where it cannot be evaluated."""
    above = [location.file for location in scope.chain] + [scope.file]
    if path in above:
        state.depends_on_outside = True
        if state.is_included:
            return None  # what is above that it is compared with is not known here: all of this is for nothing
    if path in above and are_those_of(scope, path, passed):
        state.problem(IncludeCycle(path, (*above[above.index(path) :], path)), origin)
        return None
    found = state.read_launch_file(path)
    if not isinstance(found, Unreadable) and _is_of_ros2(state.environment, path, found):
        found = Unreadable(path, "is a launch file of ROS 2", "not-text")
    if isinstance(found, Unreadable):
        state.unreadable_include(path, found, origin)
        return None
    return found


def _is_of_ros2(environment: Environment, path: str, launch_file: LaunchFile) -> bool:
    """Whether a file speaks the language of ROS 2, in a package of it: what is wrong is the include alone."""
    if not _has_marks_of_ros2(launch_file):
        return False
    package = package_around(environment, path)
    return package is not None and package.is_ament


@derived
def _has_marks_of_ros2(launch_file: LaunchFile) -> bool:
    return ros(generation_of(launch_file.document.path, launch_file.document.text)).ament


def _check_machines(state: State) -> None:
    if any(unknown.what.startswith(_MAY_DECLARE_MACHINES) for unknown in state.unknowns):
        return
    for node in sorted(state.nodes, key=lambda node: node.kind == "test"):
        if node.machine and node.machine not in state.machines and not node.unknowns:
            attribute = node.action.attribute("machine")
            span = attribute.value.span if attribute else node.action.kind_span
            origin = (*node.origin[:-1], state.location(node.location.file, span))
            state.problem(UndefinedMachine(node.machine, tuple(sorted(state.machines))), origin)
