"""PKG002: an executable that its package does not have."""

from collections.abc import Iterator, Sequence
from os.path import relpath
from pathlib import PurePath
from typing import NamedTuple

from preflight_analysis.environment.build import LISTS, Made
from preflight_analysis.environment.git_history import Change, formerly_named
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import cmake_build, python_build
from preflight_analysis.environment.model import Package
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.context import Context, ExecutableNames
from preflight_analysis.model.files import says_not_set
from preflight_analysis.model.installed import lack_of_build, lack_of_package
from preflight_analysis.model.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.model.places import attribute_location, program_known
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.retired import was_removed
from preflight_analysis.rules.catalogued import slips
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH_NODE
from preflight_analysis.rules.rule import Rule

_NO_PROGRAMS = (".h", ".hh", ".hpp", ".c", ".cc", ".cpp", ".cxx", ".txt", ".md", ".rst", ".launch", ".xml", ".yaml")
"""Files that may be executable, by some slip, and that nobody means as one."""
_OF_PROGRAMS = ("", ".py", ".cpp", ".cc", ".cxx")
"""The ends of files that programs are, or are made of."""
_MOST = 60
"""Packages of a workspace that are looked through for an executable."""
_SPACES = {1: "devel and install spaces", 2: "install spaces"}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    executables, known = context.executables, dict[tuple[str, str], _Program]()
    for node in context.tree.nodes:
        found = node.resolved
        if node.executable.isspace() and program_known(node):
            place = attribute_location(context, node, context.tree.ros.executable)
            yield rule.claim(
                say("executable name of {node} is blank", node=node.name),
                place,
                subject=Subject("executable"),
                kind="invalid",
                related=include_chain(node.origin),
            )
            continue
        if found.path is not None or not program_known(node):
            continue
        if found.package_path is None:
            if node.kind != "composable" and node.package not in context.environment.packages:
                yield from slips(rule, context, node, "executables", context.tree.ros.executable)
            continue
        if node.kind == "composable":
            continue  # a library, of which PKG006 speaks
        wanted = node.package, node.executable
        if wanted not in known:
            known[wanted] = _program(context, *wanted)
        made_of, is_build_target, names, is_undecided = known[wanted]
        is_no_program = found.not_executable and (made_of is None or not made_of.by_build)
        if (is_undecided and not is_no_program) or was_removed(context, node):
            continue
        location = attribute_location(context, node, context.tree.ros.executable)
        chain, about = include_chain(node.origin), Subject("executable", node.executable)
        if is_no_program:
            path = found.not_executable[0]
            message = f"file '{path}' is not executable; run `chmod +x {path}`"
            if made_of is not None:
                message += ", or start it from the install space: CMakeLists.txt installs it as a program"
            no_program, installed = Subject("executable", path), made_of is not None
            yield rule.claim(
                message, location, subject=no_program, kind="invalid", doubts=doubts(UNSEEN=installed), related=chain
            )
            continue
        if is_build_target and (what := _not_installed(context, *wanted)) is not None:
            yield rule.claim(what, location, subject=about, kind="unreachable", related=chain)
            continue
        if is_build_target:
            message = _unbuilt(node.executable, node.package, made_of, found.package_path)
            lack, unbuilt = lack_of_build(context, node.package), doubts(MADE_BY_BUILD=True)
            yield rule.claim(message, location, subject=about, doubts=unbuilt, related=chain, lack=lack)
            continue
        if not names and not _is_of_workspace(context, node.package):
            # Debian has the programs of a package apart from the rest of it.
            yield rule.claim(
                f"package '{node.package}' is installed in {found.package_path} without its executables",
                location,
                subject=Subject("package", node.package),
                doubts=doubts(UNSEEN=True),
                related=chain,
                lack=lack_of_package(context, node.package),
            )
            continue
        holder = _other_package(context, executables, node)
        programs = [name for name in names if not name.endswith(_NO_PROGRAMS)]
        near = nearest(node.executable, programs) or nearest(node.executable, programs, key=_stem)
        near = near or next((name for name in programs if _plain(name) == _plain(node.executable)), None)
        change = _change_of(context, found.package_path, node.executable, programs)
        if change is not None and change.path is not None:
            near = _program_of(change.path, programs)
        meant: str | None
        if holder is not None:
            hint, meant = f"; package '{holder}' has it", holder
            fixes = rename(context, attribute_location(context, node, "pkg"), node.package, holder)
            meant_for_all = _is_literal(node, context.tree.ros.executable)
        else:
            hint, meant = did_you_mean(near) if change is None else change.told(near), near
            keys = (str, _stem, _plain)
            slip = change is not None or (
                near is not None and any(is_slip(key(node.executable), key(near)) for key in keys)
            )
            fixes = rename(context, location, node.executable, near) if near is not None and slip else ()
            meant_for_all = _is_literal(node, "pkg")
        against: tuple[Doubt, ...] = ()
        if node.executable.startswith("/dev/") or says_not_set(node.executable):
            against, hint = doubts(NOT_SET="the argument that names it"), "; set the argument that names it"
        elif near == node.executable:
            against = doubts(PARTLY_READ=True)
            hint = "; a build file names it, but how it is installed is unresolved"
        elif not names and is_ignored(context.disk, f"{found.package_path}/{LISTS}"):
            against = doubts(MADE_ELSEWHERE=True)
            hint = f"; git ignores {LISTS} of the package, so each machine may create it"
        if against:
            meant, fixes = None, ()
        yield rule.claim(
            f"executable '{node.executable}' not found in package '{node.package}' ({len(names)} executables in "
            f"{found.package_path} and the {_SPACES[context.tree.generation]}){hint}",
            location,
            subject=about,
            kind="absent" if meant is None else "near",
            doubts=(*against, *doubts(BRANCHES=bool(node.unknowns))),
            candidates=(meant,),
            related=chain,
            # What another launch starts here, with other arguments, may be there.
            fixes=fixes if meant_for_all else (),
        )


def _change_of(context: Context, folder: str, executable: str, programs: Sequence[str]) -> Change | None:
    """What git knows of the file of a program that its package does not have any more: that it has another name, under
    which it is one of `programs`, or was removed."""
    stem = _stem(executable)
    for suffix in dict.fromkeys((executable[len(stem) :], *_OF_PROGRAMS)):
        for path, change in formerly_named(context.disk, folder, f"{stem}{suffix}"):
            if path.startswith(f"{folder}/") and (
                change.path is None or _program_of(change.path, programs) is not None
            ):
                return change
    return None


def _program_of(path: str, programs: Sequence[str]) -> str | None:
    """The program that a file is, or is the source of."""
    name = PurePath(path).name
    return next((each for each in (name, _stem(name)) if each in programs), None)


def _is_literal(node: LaunchNode, attribute: str) -> bool:
    value = node.action.value(attribute)
    return value is None or value.is_literal


class _Program(NamedTuple):
    """What is known of an executable of a package, which hundreds of nodes may have."""

    made_of: Made | None
    is_build_target: bool
    names: tuple[str, ...]
    """All that the package has."""
    is_undecided: bool
    """Whether it is neither installed, nor are there build files that say what the package will have."""


def _program(context: Context, package: str, name: str) -> _Program:
    executables = context.executables
    is_build_target, names = executables.is_build_target(package, name), executables.names(package)
    has_all = executables.names_are_all(package) and (names or _is_understood(context, package))
    is_known = is_build_target or not context.tree.ros.ament or has_all
    return _Program(executables.made_of(package, name), is_build_target, names, not is_known)


def _is_understood(context: Context, package: str) -> bool:
    """Whether it is a package of the workspace of which the build files say all that it has, be that nothing."""
    known = context.environment.packages.get(package)
    if known is None or context.environment.is_installed(known):
        return False
    if known.build_type == "ament_python":
        return python_build(context.disk, known).called is not None
    return cmake_build(context.disk, known).complete


def _is_of_workspace(context: Context, package: str) -> bool:
    known = context.environment.packages.get(package)
    return known is None or _is_own(context, known)


def _other_package(context: Context, executables: ExecutableNames, node: LaunchNode) -> str | None:
    """A package that has the executable: one that another node of the launch is of, or that this one depends on; else
    the only one of the workspace."""
    packages = context.environment.packages
    wanted = {other.package for other in context.tree.nodes} | packages[node.package].dependencies
    own = {name for name in wanted - {node.package} if name in packages and _is_own(context, packages[name])}
    near = next((name for name in sorted(own) if node.executable in executables.names(name)), None)
    if near is not None:
        return near
    # Each that is asked for the first time is walked through.
    others = [each.name for each in context.environment.own_packages if each.name != node.package]
    found = [name for name in others[:_MOST] if node.executable in executables.names(name)]
    return found[0] if len(found) == 1 else None


def _not_installed(context: Context, package: str, name: str) -> str | None:
    """What is said of an executable that is built and that `CMakeLists.txt` does not install in `lib` (ROS 2)."""
    known = context.environment.packages.get(package)
    if known is None or not known.is_ament or not _is_own(context, known):
        return None
    build = cmake_build(context.disk, known)
    target = build.executable(name)
    said = build.targets_said.get(target.name) if target is not None else None
    if target is None or said is None or not said.sure or not build.complete:
        return None
    wanted = f"lib/{package}"
    places = [each.destination for each in build.installed_targets if each.name == target.name]
    if any(place == wanted for place in places):
        return None
    where = f"installs it in {places[0]}, not in {wanted}" if places else "does not install it"
    return f"executable '{name}' is not found: CMakeLists.txt of package '{package}' builds it and {where}"


def _unbuilt(name: str, package: str, made_of: Made | None, folder: str) -> str:
    lists = f"CMakeLists.txt of package '{package}'"
    if made_of is None:
        return f"executable '{name}' is not built yet: {lists} names it"
    source = relpath(made_of.source, folder)
    if made_of.by_build:
        return f"executable '{name}' is not built yet: {lists} builds it from {source}"
    return f"executable '{name}' is not installed yet: {lists} installs it from {source}"


def _is_own(context: Context, package: Package) -> bool:
    """Whether it is no package of an installed ROS, which have hundreds of executables and many of one name."""
    return not any(package.share.startswith(f"{prefix}/") for prefix in context.environment.system_prefixes)


def _stem(name: str) -> str:
    return PurePath(name).stem


def _plain(name: str) -> str:
    """Without the word that many executables end with."""
    return _stem(name).lower().removesuffix("_node")


RULE = Rule(
    id="PKG002",
    name="executable-not-found",
    effect="stops-node",
    kind="absent",
    sometimes=(
        Reason.NOT_HERE,
        Reason.MADE_BY_BUILD,
        Reason.MADE_ELSEWHERE,
        Reason.NOT_SET,
        Reason.OTHER_DISTRIBUTION,
        Reason.UNSEEN,
    ),
    what="Checks for a node whose `type` (ROS 2: `exec`) is not an executable file of its package. The finding names "
    "the nearest executable, or the package of the launch that has it.",
    why="`roslaunch` prints an error among the output of the other nodes and continues without this one. `ros2 "
    "launch` stops.",
    example='<node pkg="rospy_tutorials" type="talkr" name="talker"/>',
    instead='<node pkg="rospy_tutorials" type="talker" name="talker"/>',
    references=(
        ROSLAUNCH_NODE,
        LAUNCH_XML_DESIGN,
    ),
    check=_check,
    in_branches=True,
)
