"""PRM019: a controller that is to be loaded and that its manager has no type of.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts
http://wiki.ros.org/controller_manager#Helper_scripts
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import NamedTuple

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.conditions import named_arguments
from preflight_analysis.evaluation.ros1.spawners import Asked as AskedScript
from preflight_analysis.evaluation.ros1.spawners import asked_of as asked_of_script
from preflight_analysis.evaluation.ros1.spawners import loaded_by
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.ros2.spawners import Asked, asked_of, is_spawner, type_in
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.claim import Subject, Text, as_text, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.launch.model import action_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import is_slip, nearest
from preflight_analysis.model.problems import include_chain, quoted, rename
from preflight_analysis.model.sections import FileUse, files_of, may_be_called, param_file
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER
from preflight_analysis.rules.rule import Rule

_SHOWN = 3


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from (_of_ros2 if context.tree.ros.ament else _of_ros1)(rule, context)


def _of_ros1(rule: Rule, context: Context) -> Iterator[Finding]:
    """The manager asks for `NAME/type` in its namespace, which the launch sets for others of that namespace. Where not
    all is known that the launch sets, only a slip of one of these is told."""
    params = context.tree.params
    nodes = context.tree.nodes
    loaded = {full for node in nodes for full in loaded_by(node)}
    # A remap of the manager's node gives a controller the parameters of another name.
    renamed = {names.resolve(remap.source, node.name) for node in nodes if loaded for remap in node.remaps}
    for node in nodes:
        asked = asked_of_script(node)
        if asked is None:
            continue
        namespace = asked.namespace
        types = [
            param
            for name, param in params.items()
            if name.startswith(f"{namespace}/") and name.endswith("/type") and _is_plugin(param.value)
        ]
        known = [param.name.removeprefix(f"{namespace}/").removesuffix("/type") for param in types]
        if not known:
            yield from _of_other_namespace(rule, context, node, asked, loaded)
        for controller in asked.controllers if known else ():
            full = asked.full(controller)
            if f"{full}/type" in params or full in renamed:
                continue
            near = nearest(controller, known)
            sure = context.tree.complete or (near is not None and is_slip(controller, near))
            if sure or _is_beside(node, types):
                missing = as_text(f"parameter '{full}/type' is not set, and the controller manager reads it")
                against = doubts(PARTLY_READ=not sure, DEPENDS=_is_of_one_variant(context, types))
                yield _finding(rule, context, _Lost(node, controller, missing, known, doubts=against))


def _is_beside(spawner: LaunchNode, types: Iterable[Param]) -> bool:
    """Whether the launch file of the spawner sets types itself."""
    return any(at.file == spawner.location.file for param in types for at in param.origin)


def _of_other_namespace(
    rule: Rule, context: Context, spawner: LaunchNode, asked: AskedScript, loaded: Collection[str]
) -> Iterator[Finding]:
    """Controllers whose types the launch sets in one other namespace, of which nothing is loaded."""
    params = context.tree.params
    for controller in map(asked.full, asked.controllers):
        end = f"/{names.leaf(controller)}/type"
        found = [param for name, param in params.items() if name.endswith(end) and _is_plugin(param.value)]
        if len(found) == 1 and found[0].name.removesuffix("/type") not in loaded:
            yield rule.claim(
                f"parameter '{controller}/type' is not set, and the controller manager reads it: the controller is not "
                f"loaded; did you mean '{found[0].name}'?",
                spawner.location,
                subject=Subject("controller", names.leaf(controller)),
                candidates=(found[0].name,),
                related=(Related("the type is set here", found[0].place), *include_chain(spawner.origin)),
            )


def _is_of_one_variant(context: Context, params: Iterable[Param]) -> bool:
    """Whether an argument names a file that gives the parameters: other values of it go with other controllers."""
    places = {at for param in params for at in param.origin if at.file in context.launch_files}
    tags = (action_at(context.launch_files[at.file], at.span.start) for at in places)
    files = (tag.value("file") for tag in tags if tag is not None and tag.kind.lower() == "rosparam")
    return any(named_arguments(file) for file in files if file is not None)


def _is_plugin(value: object) -> bool:
    return isinstance(value, str) and "/" in value


def _of_ros2(rule: Rule, context: Context) -> Iterator[Finding]:
    nodes = context.tree.nodes
    asked = {at: each for at, node in enumerate(nodes) if is_spawner(node) and (each := _known(context, node))}
    managers = {name: _manager(context, name) for name in dict.fromkeys(each.manager for each in asked.values())}
    for at, each in asked.items():
        manager = managers[each.manager]
        if manager is None:
            continue
        # A controller is a node, whose name has no dot; what MoveIt is told of controllers has one.
        typed = (param.name.removesuffix(".type") for param in manager.params if param.name.endswith(".type"))
        known = [name for name in typed if "." not in name]
        files = [source for source in manager.param_sources if source.path is not None]
        paths = [*map(os.path.normpath, each.files)]
        given, of_spawner = [context.documents[path] for path in paths], [*_files(context, paths)]
        for controller in each.controllers:
            if controller in known or type_in(given, controller, each.namespace) is not None:
                continue
            apart = _apart(context, controller, [*of_spawner, *files_of(context, manager)])
            apart = apart or _for_the_manager(context, controller, of_spawner)
            # A manager without any types may get them of what is not known.
            if known or apart is not None or (files and context.tree.complete):
                related = [Related(f"parameters of {manager.name}", source.origin[-1]) for source in files[:1]]
                related += [Related("the type is set here", apart[1])] if apart is not None else []
                missing = say("parameter '{name}.type' of {node} is not set", name=controller, node=manager.name)
                where = apart[0] if apart is not None else None
                yield _finding(rule, context, _Lost(nodes[at], controller, missing, known, where, related))


def _known(context: Context, spawner: LaunchNode) -> Asked | None:
    """What a spawner asks for without a type of its own; None where it may give controllers what is not known."""
    asked = asked_of(spawner)
    if asked is None or asked.plain:
        return asked
    return asked if asked.files and not asked.type and _are_known(context, asked.files) else None


def _files(context: Context, paths: Iterable[str]) -> Iterator[FileUse]:
    return filter(None, (param_file(context, path) for path in paths))


def _are_known(context: Context, files: Iterable[str]) -> bool:
    return all(os.path.normpath(path) in context.documents for path in files)


def _apart(context: Context, controller: str, files: Iterable[FileUse]) -> tuple[str, Location] | None:
    """Where the type is set for the controller itself, which neither the manager nor the spawner reads: the key of that
    section, and the place."""
    for used in files:
        for section in (each.section for each in used.sections):
            if not section.exact or names.leaf(section.pattern) != controller:
                continue
            for param in section.params:
                if param.name == "type":
                    return section.key, context.location(used.path, param.name_span)
    return None


def _for_the_manager(context: Context, controller: str, files: Iterable[FileUse]) -> tuple[str, Location] | None:
    """The same where a file of the spawner has the type as a parameter of the manager, which does not get the file."""
    for used in files:
        for section in (each.section for each in used.sections):
            for param in section.params:
                if param.name == f"{controller}.type":
                    return section.key, context.location(used.path, param.name_span)
    return None


class _Lost(NamedTuple):
    """A controller that `spawner` asks for and that is not loaded. `missing` says what is not set, `known` are those of
    which the type is set, `section` is the one that sets it in vain."""

    spawner: LaunchNode
    controller: str
    missing: Text
    known: list[str]
    section: str | None = None
    related: Sequence[Related] = ()
    doubts: Sequence[Doubt] = ()


def _finding(rule: Rule, context: Context, lost: _Lost) -> Finding:
    spawner, controller, known = lost.spawner, lost.controller, lost.known
    near = nearest(controller, known)
    some = quoted(known[:_SHOWN]) + (", ..." if len(known) > _SHOWN else "")
    if lost.section is not None:
        what = f"section '{lost.section}' sets it, which has no effect there"
    elif near is not None:
        what = f"did you mean '{near}'?"
    else:
        what = f"it has types for {some}" if known else "it has no types of controllers"
    meant = near if lost.section is None else None
    return rule.claim(
        lost.missing.followed_by(": the controller is not loaded; {what}", what=what),
        spawner.location,
        subject=Subject("controller", controller),
        kind="absent" if meant is None else "near",
        doubts=lost.doubts,
        candidates=(meant,),
        related=(*lost.related, *include_chain(spawner.origin)),
        fixes=_corrected(context, spawner, controller, meant) if meant is not None else (),
    )


def _corrected(context: Context, spawner: LaunchNode, controller: str, near: str) -> tuple[Fix, ...]:
    """The slip of a controller's name written right in the arguments of its spawner, if nothing asks for that one."""
    value = next(filter(None, map(spawner.action.value, ("args", "arguments"))), None)
    asked = {each for node in context.tree.nodes for each in _controllers(node)}
    if value is None or near in asked or not is_slip(controller, near):
        return ()
    return rename(context, context.location(spawner.location.file, value.span), controller, near)


def _controllers(node: LaunchNode) -> tuple[str, ...]:
    script = asked_of_script(node)
    asked = script if script is not None else asked_of(node) if is_spawner(node) else None
    return tuple(asked.controllers) if asked is not None else ()


def _manager(context: Context, name: str) -> LaunchNode | None:
    """The node that is the manager of this name, or makes it, whatever program has one in it. None where that is not
    one, or not all known."""
    found = [node for node in context.tree.nodes_and_simulated if node.name == name]
    if not found:
        found = [of_name(node, name, context.documents, inferred=True) for node in may_be_called(context, name)]
    return found[0] if len(found) == 1 and not found[0].unknowns else None


RULE = Rule(
    id="PRM019",
    name="controller-not-configured",
    effect="breaks",
    kind="absent",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.PARTLY_READ, Reason.DEPENDS),
    what="Checks for a controller in the arguments of a `spawner` without a type in the parameters of its controller "
    "manager, or in a `--param-file` of the spawner. Managers whose parameters are not all known are not "
    "checked.",
    why="The manager refuses to load the controller: `The 'type' param was not defined`. The spawner exits and the "
    "controller does not run.",
    example="arguments=['streaming_controller']  # the manager's file has twist_controller",
    instead="arguments=['twist_controller']",
    references=(CONTROLLER_MANAGER,),
    generations=(1, 2),
    check=_check,
    in_branches=True,
)
