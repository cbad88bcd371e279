"""What is missing on this machine, by which findings stand for nothing that is wrong with the robot.

This is the one place that decides that: a rule asks here, and gives its finding the `Lack`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

from preflight_analysis.catalogue.released import (
    DISTRIBUTIONS,
    debian_package,
    distributions_with,
    in_debian,
    nearest_released,
    released_words,
)
from preflight_analysis.environment.git_submodules import Submodule, left_submodule, left_submodules_below
from preflight_analysis.environment.installed_paths import installs_more, located, made_by_build, package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import LEGACY_MANIFEST
from preflight_analysis.findings.lack import INSTALL, Lack
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import is_slip, is_slip_of_words, nearest, nearest_slip
from preflight_analysis.model.said import missing_module

_CORE = frozenset({"rclpy", "rclcpp", "launch_ros"})
"""Packages of which each installation of ROS 2 has at least one."""
_PROGRAMS = {"xacro": "xacro", "rosrun": "rosbash", "rospack": "rospack", "rosparam": "rosparam"}
"""Programs that robot descriptions are made with, and their packages of ROS."""
_SET_UP = re.compile(r"ROS_(DISTRO|VERSION|PYTHON_VERSION|ROOT|ETC_DIR|PACKAGE_PATH|MASTER_URI)\Z|AMENT_PREFIX_PATH\Z")
"""Variables that a distribution's set-up script sets."""
_OF_MACHINE = re.compile(r"/(?:etc|home|media|mnt|opt|root|usr|var|Users)/")
"""Where a machine has its own files."""
_NO_PACKAGE = re.compile(
    r"type 'rosmake ([\w-]+)'|neither a launch file in package \[([\w-]+)\]|"
    r"ResourceNotFound: ([\w-]+)|resource not found: ([\w-]+)|[Pp]ackage (?:not found: )?['\"]([\w-]+)['\"]"
    r" not found|[Pp]ackage not found: ['\"]?([\w-]+)"
)
"""How rospkg, roslib, xacro and ament_index say that a package is not there."""
_NO_PROGRAM = re.compile(
    r"there is no '([\w.+-]+)'(?: on the PATH)?, which its first line names\Z|line \d+: ([\w.+-]+): command not found\Z"
    r"|: \d+: (?:/(?:usr|opt|snap)/(?:[\w.+-]+/)*)?([\w.+-]+): not found\Z"
    r"|cannot locate (rospack)\b"
)
"""How `env`, shells and roslib say it of a program."""
_NO_VARIABLE = re.compile(r"environment variable '(\w+)' is not set")
"""How roslaunch says it, which a node may start."""
_WORD = re.compile(r"[\w-]+")
_BETWEEN = re.compile(r"[/_.-]")
_TEMPLATES = (".xacro", ".in", ".em", ".erb", ".jinja", ".jinja2", ".template")
"""What the name of a file has more of which a build makes the one without it."""
_NOT_BUILT = re.compile(r"Could not find library corresponding to plugin ([\w-]+)/")
_NO_LIBRARY = re.compile(
    r"Make sure that the library '(?:[^']*/)?(?:lib)?([^'/]+?)(?:\.so)?' actually exists"
    r"|Failed to load library (?:\S*/)?lib([^\s/]+?)\.so\b"
)
"""How pluginlib says it of a package that has not been built, where a plugin has its package's name, and where not."""
_INTERPRETERS = ("python", "python2", "python3", "bash", "sh", "perl", "ruby", "node")
_NO_KEY = re.compile(r"KeyError: '(\w+)'")
_NO_LOADED = re.compile(r"KeyError: '([\w.]+)'")
_NOT_STARTED = re.compile(r"FileNotFoundError: \[Errno 2\] No such file or directory: '([\w.+-]+)'")
_NEWER_SYNTAX = (
    re.compile(r"\b[rR]?[fF][rR]?['\"][^'\"\n]*\{[^}'\"\n]*$", re.MULTILINE),
    re.compile(r"""\b[rR]?[fF][rR]?(["'])(?:\\.|(?!\1)[^\\\n])*\{(?:(?!\1)[^{}\n])*\1[^\n]*\1[^{}\n]*\}"""),
    re.compile(r"^SyntaxError: f-string expression part cannot include a backslash", re.MULTILINE),
    re.compile(r"^\s*type \w+(?:\[.*\])? = .*\n[\s^]*\nSyntaxError: invalid syntax", re.MULTILINE),
)
"""What Python reads since 3.12: within a string an expression that goes on in the next line, one with the quotes of the
string, and one with a backslash (PEP 701), and aliases of types (PEP 695)."""
_MADE = ("msg", "srv", "action", "cfg")
"""Modules of a package that its build makes."""
_LONG = 5
_SHORT = 4
"""Letters of a word."""


def has_ros(context: Context) -> bool:
    """Whether the ROS that the launch file is for is installed, and not only a workspace there."""
    if not context.tree.ros.ament:
        return context.environment.python is not None
    return not _CORE.isdisjoint(context.environment.packages)


def lack_of_package(context: Context, name: str) -> Lack:
    """A package that is neither installed nor in the workspace."""
    package = debian_package_of(context, name)
    return Lack("package", name, f"{INSTALL} {package}" if package is not None else None)


def debian_package_of(context: Context, name: str) -> str | None:
    """What a package of ROS is installed as, where that is known: the distribution that is used here has released it,
    or Debian has it where ROS is Debian's."""
    if _is_debians(context):
        return in_debian(name)
    known, distro = DISTRIBUTIONS[context.tree.generation], _distribution(context)
    having = distributions_with(name, context.tree.generation)
    return debian_package(name, distro) if distro and having and (distro in having or distro not in known) else None


def _is_debians(context: Context) -> bool:
    return not context.tree.ros.ament and context.environment.debians


def _distribution(context: Context) -> str | None:
    """The distribution that is used here, or the only one there still is."""
    environment, tree = context.environment, context.tree
    is_of_tree = environment.generation == tree.generation or environment.distro in DISTRIBUTIONS[tree.generation]
    return (environment.distro if is_of_tree else None) or tree.ros.default_distro


def near_package(context: Context, name: str) -> str | None:
    """A package that is here, or that a distribution has released, of whose name this is a slip. A released name is
    none."""
    return near_package_in(context.disk.db, context.environment, context.tree.generation, name)


@query
def near_package_in(db: Database, environment: Environment, generation: int, name: str) -> str | None:
    """Likewise without a launch."""
    if distributions_with(name, generation):
        return None
    near = nearest(name, environment.packages) or _near_dependency(db, environment, generation, name)
    if near is None or not is_slip_of_words(name, near):
        released = nearest_released(name, generation, 1)
        near = next((each for each in released if is_slip(name, each) and _is_meant(name, each)), None)
    return None if near is None or is_of_family_in(db, environment, generation, name, near) else near


def _near_dependency(db: Database, environment: Environment, generation: int, name: str) -> str | None:
    """The package of which it is a slip, released and not here, that a manifest of the workspace names; none for what a
    manifest names as well."""
    if name in _absent_dependencies(db, environment):
        return None
    near = nearest(name, _released_dependencies(db, environment, generation))
    return near if near is not None and _differ_in_words_of(_SHORT, name, near) else None


def is_of_family(context: Context, name: str, near: str) -> bool:
    """Whether the word by which a package's name differs from another's is in the name of a further package that the
    workspace needs and nobody knows, or of a folder around a package (`smarc_msgs` in `smarc_scenarios`): those are of
    a repository that is not here. Nobody makes the same slip twice."""
    return is_of_family_in(context.disk.db, context.environment, context.tree.generation, name, near)


def is_of_family_in(db: Database, environment: Environment, generation: int, name: str, near: str) -> bool:
    """Likewise without a launch."""
    words = set(name.split("_")) - set(near.split("_"))
    unknown = _absent_dependencies(db, environment) - _released_dependencies(db, environment, generation)
    in_other = any(not words.isdisjoint(other.split("_")) for other in unknown - {name})
    return in_other or not words.isdisjoint(words_of_folders(db, environment))


@query
def words_of_folders(db: Database, environment: Environment) -> frozenset[str]:
    """The words in the names of the folders that packages of the workspace are in."""
    folders = {os.path.dirname(package.share) for package in environment.own_packages}
    return frozenset(word for folder in folders for word in _BETWEEN.split(folder) if word)


@query
def _released_dependencies(db: Database, environment: Environment, generation: int) -> frozenset[str]:
    """What the manifests of the workspace name, and is not here but released."""
    return frozenset(name for name in _absent_dependencies(db, environment) if distributions_with(name, generation))


@query
def _absent_dependencies(db: Database, environment: Environment) -> frozenset[str]:
    own = (package.dependencies for package in environment.own_packages)
    return frozenset[str]().union(*own) - environment.packages.keys()


def _is_meant(name: str, other: str) -> bool:
    """Of the thousands of released names one is always near `arm_description` or another with a short word, or with a
    word that others have (`robot_description`, `rosbot_description`). Nobody gives a package the name of another one in
    the singular (`geometry_msg`)."""
    if name.removesuffix("s") == other.removesuffix("s"):
        return True
    is_slip_of_word = not released_words().issuperset(set(name.split("_")) - set(other.split("_")))
    return is_slip_of_word and _differ_in_words_of(_LONG, name, other)


def _differ_in_words_of(length: int, name: str, other: str) -> bool:
    """Whether each word in which names differ has so many letters."""
    words, others = name.split("_"), other.split("_")
    differing = [pair for pair in zip(words, others, strict=False) if pair[0] != pair[1]]
    return len(words) != len(others) or all(len(word) >= length for pair in differing for word in pair)


def lack_of_build(context: Context, package: str) -> Lack:
    """A package that is there without what its build makes: one of the workspace is not built, of an installed one a
    part is not installed."""
    known = context.environment.packages.get(package)
    if known is not None and context.environment.is_installed(known):
        return lack_of_package(context, package)
    build = "colcon build --packages-select" if context.tree.ros.ament else "catkin build"
    if known is not None and os.path.basename(known.manifest) == LEGACY_MANIFEST:
        build = "rosmake"  # of rosbuild, which catkin does not see
    return Lack("build", package, f"{build} {package}")


def lack_of_made(context: Context, path: str) -> Lack | None:
    """A file that is there once its package is built: the build makes it, or installs it from another folder; or once
    the submodule is checked out that it is in. None for any other."""
    if (submodule := left_submodule(context.disk, path)) is not None:
        return lack_of_submodule(submodule)
    if (left := _left_package(context, path)) is not None:
        return lack_of_build(context, left.name)
    package = made_by_build(context.disk, context.environment, path)
    moved = located(context.disk, context.environment, path) != path
    if package is None and (moved or is_made_of_template(context, path)):
        package = package_around(context.environment, path)
    return lack_of_build(context, package.name) if package is not None else None


def lack_of_submodule(submodule: Submodule) -> Lack:
    """A submodule that is not checked out."""
    return Lack("submodule", submodule.path, f"git submodule update --init {submodule.path}")


def lack_of_submodule_said(context: Context, package: str, said: str) -> Lack | None:
    """The submodule in a package's folder whose name a program says before it ends."""
    known = context.environment.packages.get(package)
    below = left_submodules_below(context.disk, known.share) if known is not None else ()
    words = set(_WORD.findall(said)) if below else set[str]()
    named = (each for each in below if os.path.basename(each.path) in words)
    return next(map(lack_of_submodule, named), None)


def _left_package(context: Context, path: str) -> Package | None:
    """The package out of whose share folder a path leads by `..`, before it is built: where that is in an installation
    is another place than in the source (`install/robot/share/robot/../../../..` is the workspace)."""
    package = package_around(context.environment, path) if context.tree.ros.ament and "/../" in path else None
    if package is None or context.environment.is_installed(package):
        return None
    inside = f"{os.path.normpath(path)}/".startswith(f"{package.share.rstrip('/')}/")
    return package if not inside else None


def may_be_made(context: Context, path: str) -> bool:
    """Whether the build files of the package around a path do more than is understood (ROS 2)."""
    package = package_around(context.environment, path)
    return package is not None and package.is_ament and installs_more(context.disk, package)


def is_made_of_template(context: Context, path: str) -> bool:
    """Whether the build makes the file of one beside it, which a `CMakeLists.txt` of the package names
    (`worlds/hall.world` by `xacro_add_files(worlds/hall.world.xacro)`)."""
    package = package_around(context.environment, path)
    if package is None or not any(context.disk.exists(path + ending) for ending in _TEMPLATES):
        return False
    below = os.path.relpath(path, package.share)
    return any(context.executables.is_in_build_file(package.name, below + ending) for ending in _TEMPLATES)


def lack_of_variable(context: Context, name: str) -> Lack | None:
    """A variable that is not set; None where its name is a slip of one that is."""
    return None if near_variable(context, name) is not None else unset_variable(context, name)


def unset_variable(context: Context, name: str) -> Lack:
    """A variable that is not set, whatever others are."""
    distro = None if _is_debians(context) else _distribution(context)
    return Lack("variable", name, f"source /opt/ros/{distro}/setup.bash" if distro and _SET_UP.match(name) else None)


def near_variable(context: Context, name: str) -> str | None:
    """A variable that is set, of whose name this is a slip."""
    return nearest_slip(name, context.environment.variables)


def lack_of_program(context: Context, program: str) -> Lack:
    """A program that is not on the PATH."""
    package = debian_package_of(context, _PROGRAMS[program]) if program in _PROGRAMS else None
    return Lack("program", program, f"{INSTALL} {package}" if package is not None else None)


def lack_of_file(context: Context, path: str) -> Lack | None:
    """A file of the system or of somebody's home: the robot may have it. None for one that the workspace or a package
    should have, or that lies where nothing does."""
    folders = [package.share for package in context.environment.packages.values()]
    folders += filter(None, [context.environment.workspace])
    inside = path.startswith(tuple(folder.rstrip("/") + "/" for folder in folders))
    home = context.environment.variables.get("HOME")
    outside = _OF_MACHINE.match(path) or (home is not None and path.startswith(home.rstrip("/") + "/"))
    return Lack("file", path) if outside and not inside else None


def lack_of_own_file(context: Context, path: str) -> Lack | None:
    """A file below the home folder of whoever runs this, which is another on the robot: what programs fetch or write
    lies there."""
    home = context.environment.variables.get("HOME")
    own = home is not None and len(home) > 1 and path.startswith(home.rstrip("/") + "/")
    return lack_of_file(context, path) if own else None


def lack_of_module(context: Context, module: str) -> Lack | None:
    """A module of Python that cannot be imported. None where the workspace should have it: one within a package that is
    there, or one whose name is a slip of a package's."""
    top, _, within = module.partition(".")
    packages = context.environment.packages
    if top in packages:
        return None if within and within.partition(".")[0] not in _MADE else lack_of_build(context, top)
    if distributions_with(top, context.tree.generation):
        return lack_of_package(context, top)
    near = nearest(top, packages)
    return None if near is not None and is_slip_of_words(top, near) else Lack("module", top)


def lack_of_python(context: Context, last: str, traceback: Iterable[str]) -> Lack | None:
    """What a program in Python lacked, by the last line of its traceback and the rest of it: a variable of the
    environment, a program that it starts."""
    whole = "\n".join(traceback)
    if (found := _NO_KEY.fullmatch(last)) and "environ" in whole:
        return lack_of_variable(context, found[1])
    if (found := _NO_LOADED.fullmatch(last)) and "sys.modules[" in whole:
        return lack_of_module(context, found[1])
    if (found := _NOT_STARTED.fullmatch(last)) and "subprocess" in whole:
        return lack_of_program(context, found[1])
    if last.startswith("ImportError") and (module := missing_module(whole)) is not None:
        return lack_of_module(context, module)  # Django says more of it
    if last.startswith("SyntaxError") and any(newer.search(whole) for newer in _NEWER_SYNTAX):
        return lack_of_program(context, "python3.12")
    return None


def lack_said(context: Context, lines: Iterable[str]) -> Lack | None:
    """What a program lacked, by what it printed before it ended."""
    for line in lines:
        if found := _NO_VARIABLE.search(line):
            return lack_of_variable(context, found[1])
        if found := _NO_PROGRAM.search(line):
            program = next(filter(None, found.groups()))
            near = nearest(program, _INTERPRETERS)
            slip = program not in _INTERPRETERS and near is not None and is_slip(program, near)
            return None if slip else lack_of_program(context, program)
        if (found := _NOT_BUILT.search(line)) and found[1] in context.environment.packages:
            return lack_of_build(context, found[1])
        if (found := _NO_LIBRARY.search(line)) and (package := _building(context, found[1] or found[2])) is not None:
            return lack_of_build(context, package)
        if (module := missing_module(line)) is not None:
            return lack_of_module(context, module)
        if found := _NO_PACKAGE.search(line):
            name = next(filter(None, found.groups()))
            wrong = name in context.environment.packages or near_package(context, name) is not None
            return None if wrong else lack_of_package(context, name)
    return None


def _building(context: Context, library: str) -> str | None:
    """The package that makes a library, as its build file says."""
    packages = context.environment.packages
    return next((name for name in packages if context.executables.is_library_target(name, library)), None)
