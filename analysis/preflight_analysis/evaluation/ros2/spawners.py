"""Controllers of ros2_control: what spawners ask of a controller manager.

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#helper-scripts. A spawner tells the
manager the parameter files of its controllers and their types (`NAME.type`, `ros2controlcli`'s and the spawner's
`set_controller_parameters`), and may add arguments for ROS.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.param_files import EVERY, Section, read_param_file
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param, ParamSource, Remap
from preflight_analysis.evaluation.words import words_of

PACKAGE = "controller_manager"
MANAGER = (PACKAGE, "ros2_control_node")
"""Package and executable of the node that has a manager, and controllers beside it."""
LOAD_CONTROLLER = "controller_manager_msgs/srv/LoadController"
"""The type of the service by which a manager is asked for controllers: what offers it is one."""
SPAWN = frozenset(
    {
        ("ros_gz_sim", "create"),
        ("ros_ign_gazebo", "create"),
        ("gazebo_ros", "spawn_entity.py"),
    }
)
"""What puts a robot description into a simulator: package and executable."""
_SPAWNERS = ("spawner", "spawner.py")
_HARDWARE_SPAWNERS = ("hardware_spawner", "hardware_spawner.py")
_MANAGER = ("-c", "--controller-manager")
_FILE = ("-p", "--param-file")
_TYPE = ("-t", "--controller-type")
_ROS_ARGS = "--controller-ros-args"
_NAMESPACE = ("-n", "--namespace")
"""Until Jazzy: the namespace of the manager, where its name does not begin with a slash."""
_CONTROLLER = "--controller"
"""Before the name of a controller that has options of its own."""
_WITH_VALUE = ("--controller-manager-timeout", "--switch-timeout", "--service-call-timeout")
_WITHOUT_VALUE = (
    "--load-only", "--stopped", "--inactive", "-u", "--unload-on-kill", "--activate-as-group", "--switch-asap",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Asked:
    """What a spawner asks for. `manager` is the manager's full name, `namespace` that of the spawner, in which it looks
    for controllers in its files; `plain`: all else it has are options that give the controllers nothing."""

    manager: str
    controllers: tuple[str, ...]
    files: tuple[str, ...] = ()
    type: str | None = None
    remaps: tuple[tuple[str, str], ...] = ()
    plain: bool = True
    namespace: str = "/"


def is_spawner(node: LaunchNode) -> bool:
    """Whether it is the helper script that loads controllers."""
    return node.package == PACKAGE and node.executable in _SPAWNERS


def is_hardware_spawner(node: LaunchNode) -> bool:
    """Whether it is the helper script that configures and activates hardware components."""
    return node.package == PACKAGE and node.executable in _HARDWARE_SPAWNERS


def asked_of(spawner: LaunchNode) -> Asked | None:
    """What the arguments of a spawner say; None where they are not all known. That of hardware names components in the
    place of controllers."""
    if spawner.unknowns or "$(" in spawner.args:
        return None
    manager, type_, plain, caller = PACKAGE, None, True, spawner.name
    controllers: list[str] = []
    files: list[str] = []
    remaps: list[tuple[str, str]] = []
    words = iter(words_of(spawner.args))
    for word in words:
        option, equals, value = word.partition("=") if word.startswith("--") else (word, "", "")
        if option in _MANAGER:
            manager = value if equals else next(words, manager)
        elif option in _FILE:
            files.append(value if equals else next(words, ""))
            plain = False
        elif option in _TYPE:
            type_, plain = value if equals else next(words, ""), False
        elif option in _NAMESPACE:
            space = value if equals else next(words, "")
            caller = f"{names.resolve(space, '/')}/{PACKAGE}" if space else caller
        elif option == _CONTROLLER:
            controllers.append(value if equals else next(words, ""))
        elif option == _ROS_ARGS:
            remaps += _remaps(value if equals else next(words, ""), words)
            plain = False
        elif option == "--ros-args":
            break
        elif option in _WITH_VALUE:
            if not equals:
                next(words, None)
        elif word.startswith("-"):
            plain = plain and word in _WITHOUT_VALUE
        else:
            controllers.append(word)
    return Asked(
        names.resolve(manager, caller),
        tuple(filter(None, controllers)),
        tuple(filter(None, files)),
        type_ or None,
        tuple(remaps),
        plain,
        names.parent(caller),
    )


def _remaps(first: str, words: Iterator[str]) -> list[tuple[str, str]]:
    """The remaps of arguments for ROS, which are one word, or its parts where the command line has lost the quotes."""
    found: list[tuple[str, str]] = []
    given = first.split()
    while given and given[-1] in ("--ros-args", "-r", "--remap"):
        given.append(next(words, ""))
    for word in given:
        source, sign, target = word.partition(":=")
        if sign and source and target:
            found.append((source, target))
    return found


def with_spawned(tree: LaunchTree, documents: Mapping[str, Document]) -> LaunchTree:
    """The tree whose managers have what spawners set for them beyond the launch file's parameters; the same one where
    that is nothing."""
    asked = [(node, each) for node in tree.nodes if is_spawner(node) and (each := asked_of(node)) and not each.plain]
    if not asked:
        return tree
    nodes = [_with_asked(node, asked, documents) for node in tree.nodes]
    simulated = [_with_asked(node, asked, documents) for node in tree.simulated]
    if all(map(_is, (*nodes, *simulated), (*tree.nodes, *tree.simulated))):
        return tree
    return replace(tree, nodes=tuple(nodes), simulated=tuple(simulated))


def _is(one: object, other: object) -> bool:
    return one is other


def _with_asked(
    manager: LaunchNode, asked: Sequence[tuple[LaunchNode, Asked]], documents: Mapping[str, Document]
) -> LaunchNode:
    """A node with what is asked of it: types are its parameters, files and remaps those of its process."""
    if not any(each.manager == manager.name for _, each in asked):
        return manager
    params, sources, remaps = list(manager.params), list(manager.param_sources), list(manager.remaps)
    for spawner, each in asked:
        if each.manager != manager.name:
            continue
        given = {path: documents[path] for path in map(os.path.normpath, each.files) if path in documents}
        # Of the file nothing is for the manager: it hands it on.
        sources += [ParamSource(path, (), spawner.origin) for path in given]
        for controller in each.controllers:
            name = f"{controller}.type"
            type_ = each.type or type_in(given.values(), controller, each.namespace)
            if type_ is not None and not any(param.name == name for param in params):
                params.append(Param(name, type_, spawner.origin, manager.name))
            remaps += [
                Remap(f"{controller}:{source}", target, spawner.origin, spawner.location, spawner.location, True)
                for source, target in each.remaps
            ]
    return manager._replace(params=tuple(params), param_sources=tuple(sources), remaps=tuple(remaps))


def type_in(files: Iterable[Document], controller: str, namespace: str) -> str | None:
    """The type that a spawner in a namespace finds for a controller in the files that it is given."""
    found = [
        param.value
        for document in files
        for section in read_param_file(document).sections
        if _is_for(section, controller, namespace)
        for param in section.params
        if param.name == "type" and isinstance(param.value, str)
    ]
    return found[-1] if found else None


def _is_for(section: Section, controller: str, namespace: str) -> bool:
    """Whether a spawner takes a section for that of a controller. It looks for keys of the file itself and of `/**`, so
    that it does not find a namespace with the controller below it, which a node's own parameters may have
    (`get_parameter_from_param_files`, controller_manager_services.py of ros2_control, jazzy)."""
    own = names.join(namespace, controller)
    if section.key in (EVERY, f"{EVERY}/{controller}", f"{EVERY}{own}"):
        return True
    return len(section.spans) == 1 and section.key in ((own, controller) if namespace == "/" else (own,))
