"""Find the user's ROS environment without running anything: from variables, the workspace and what is installed.

What is not sourced is found all the same, in the order that sourcing it would give: the workspace before the
installed distribution. A machine without ROS gets an environment too, in which launch files can be evaluated and
nothing can be run; its `problems` say so.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents import secrets
from preflight_analysis.environment.ament import ament_prefixes, distribution, installed_packages, rclpy_interpreter
from preflight_analysis.environment.distribution import stated_distributions
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import (
    LEGACY_MANIFEST,
    MANIFEST,
    OF_ROS1,
    FoundPackages,
    crawl,
    find_packages,
)
from preflight_analysis.environment.reach import named_folders, workspace_folders
from preflight_analysis.environment.view import by_generation, is_installed_ros1
from preflight_analysis.environment.walk import is_folder

BUILT = frozenset({"build", "devel", "install", "log", "logs", "build_isolated", "devel_isolated", "install_isolated"})
"""Folders of a workspace that its build makes: what is in them was copied from the source folder."""

SETTINGS_FILE = ".ros-preflight.yaml"

_ROS1_DISTROS = ("kinetic", "lunar", "melodic", "noetic")
_PYTHON_LIBRARY = re.compile(r"^(.*)/lib/python(3(?:\.\d+)?|2\.7)/(?:dist|site)-packages/?$")
_OF_WORKSPACES = ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH")
"""The variables that name folders of workspaces that are sourced."""
_DEBIAN_MARKS = ("rospy", "roslib", "roslaunch", "roscpp", "std_msgs", "genmsg")


@dataclass(frozen=True, slots=True)
class _Python:
    """`interpreter` is None when rospy is there and nothing that can run it is."""

    interpreter: str | None
    problem: str | None = None


def detect(
    place: str | None,
    package_path: Sequence[str] | None = None,
    variables: Mapping[str, str] | None = None,
    *,
    beside: Sequence[str] = (),
    outside: bool = True,
) -> Environment:
    """The environment of `variables` (None: this process's own) for a workspace folder, or for the workspace of a file.
    `outside`: whether its launch files may name files out of the workspace and the package paths; those in the folders
    `beside` they may.

    A folder inside of a package, as editors take that of the first file for one, is no workspace: it is like a file.
    """
    if place and os.path.isfile(place):
        place = workspace_of(place)
    elif place and any(map(_is_package, _with_parents(os.path.dirname(os.path.abspath(place))))):
        place = workspace_of(os.path.join(place, "any.launch"))
    found = detect_environment(place, os.environ if variables is None else variables, package_path)
    return replace(found, beside=tuple(map(os.path.realpath, beside)), outside=outside)


def workspace_of(file: str) -> str:
    """The folder to take as the workspace when only a file is known.

    The catkin or colcon workspace around it, else the project that it is in (what has a settings file, or in a git
    repository the nearest folder with packages in its `src`, or the repository), else the folder whose `src` it is
    below, else its package, else its own folder.
    """
    return project_of(file) or os.path.dirname(os.path.abspath(file))


def project_of(file: str) -> str | None:
    """The same, None where it is in none of these."""
    folder = os.path.dirname(os.path.abspath(file))
    if workspace := _catkin_workspace(folder) or _colcon_workspace(folder):
        return workspace
    nearest = None
    for candidate in _with_parents(folder):
        if os.path.exists(os.path.join(candidate, SETTINGS_FILE)):
            return candidate
        if nearest is None and _has_sources(candidate):
            nearest = candidate
        if os.path.exists(os.path.join(candidate, ".git")):
            return nearest or candidate
    if nearest is not None:
        return nearest
    return next((candidate for candidate in _with_parents(folder) if _is_package(candidate)), None)


def detect_environment(
    workspace: str | None,
    variables: Mapping[str, str],
    package_path: Sequence[str] | None = None,
    prefixes: Sequence[str] = (),
    *,
    root: str = "/",
) -> Environment:
    """What launch files and nodes of a workspace (a folder, or None) see, given a process's environment variables.

    `package_path`, if given, is where packages are looked for, then in the `prefixes` of ROS 2, and nowhere else.
    Otherwise it is ROS_ROOT and ROS_PACKAGE_PATH, the workspace, and the installed ROS, which comes last wherever
    ROS_PACKAGE_PATH has it; the prefixes are then found as well.
    `root` is the folder that holds `opt` and `usr`. Never raises, whatever the folders and files look like.
    """
    workspace = os.path.abspath(workspace) if workspace else None
    distro, prefix = _distribution(variables, root)
    debian = os.path.join(root, "usr")
    has_debian = any(os.path.isfile(os.path.join(debian, "share", name, MANIFEST)) for name in _DEBIAN_MARKS)
    catkin = _catkin_workspace(workspace)
    colcon = _colcon_workspace(workspace) if workspace else None
    listed = [*_split(variables.get("ROS_ROOT")), *_split(variables.get("ROS_PACKAGE_PATH"))]

    given_prefixes = tuple(prefixes)
    if package_path is not None:
        path = _unique(package_path)
    else:
        installed = [os.path.join(prefix, "share")] if prefix else []
        installed += [os.path.join(debian, "share")] if has_debian else []
        below = os.path.join(root, "opt", "ros") + os.sep
        last = {*installed, *(entry for entry in listed if os.path.abspath(entry).startswith(below))}
        path = _unique(
            [
                *(entry for entry in listed if os.path.abspath(entry) not in last),
                *_source_folders(workspace, catkin or colcon),
                *(entry for entry in listed if os.path.abspath(entry) in last),
                *installed,
            ]
        )

    devel, system = _spaces(variables, catkin, prefix, root)
    if has_debian:
        system.append(debian)
    found = find_packages(path, skip=BUILT)
    if package_path is None:
        prefixes = ament_prefixes(variables, colcon or workspace, root)
    ros2 = _is_ros2(variables, workspace, found.packages.values(), prefixes)
    found = found.built_for(2 if ros2 else 1)
    own = _own(workspace, found.packages.values())
    packages, shadowed = _in_order(found, prefixes, system, own, ros2=ros2)
    used = (
        distribution(variables, prefixes) if ros2 else distro or (_debian_distribution(debian) if has_debian else None)
    )
    said = stated_distributions(workspace, SETTINGS_FILE, BUILT, own, 2 if ros2 else 1)
    stated = None if used else said.one
    given = _with_overlays(variables, path, devel, prefix, distro, debian)
    python = _python(given, debian)
    ros2_python = rclpy_interpreter(given, prefixes, root)
    folders = workspace_folders(workspace, (catkin, colcon), BUILT)
    sourced = [e for name in _OF_WORKSPACES for e in _split(variables.get(name)) if os.path.isabs(e)]
    underlays = (folder for entry in dict.fromkeys((*sourced, *given_prefixes)) for folder in _workspaces_around(entry))
    named = named_folders(
        variables,
        [*(package_path or ()), *given_prefixes, *(os.path.join(root, *place) for place in (("opt", "ros"), ("usr",)))],
        (python.interpreter if python else None, ros2_python),
        folders,
        underlays,
    )
    problems = [
        *_path_problems(listed if package_path is None else package_path),
        *found.problems,
        *([] if ros2 else _workspace_problems(catkin or workspace, devel, found)),
        *([] if ros2 else _installation_problems(variables, python)),
    ]
    allowed = secrets.allowed_by_user()
    withheld = secrets.withheld(given, allowed)
    return Environment(
        generation=2 if ros2 else 1,
        distro=stated.name if stated else used,
        distro_by=stated.by if stated else "",
        meant_for=said.all,
        variables={name: value for name, value in given.items() if name not in withheld},
        package_path=tuple(path),
        packages=packages,
        shadowed=shadowed,
        devel_spaces=tuple(devel),
        system_prefixes=tuple(system),
        python=python.interpreter if python else None,
        workspace=workspace,
        problems=tuple(problems),
        ament_prefixes=tuple(prefixes),
        ros2_python=ros2_python,
        own_variables=dict(variables),
        workspace_folders=folders,
        named_folders=named,
        debians=prefix is None and (has_debian or _is_debian(root)),
        withheld=withheld,
        allowed_secrets=allowed,
    )


def _split(value: str | None) -> list[str]:
    return [entry for entry in (value or "").split(os.pathsep) if entry.strip()]


def _unique(folders: Iterable[str]) -> list[str]:
    """Absolute, and each only where it stands first."""
    return list(dict.fromkeys(os.path.abspath(folder) for folder in folders))


# What is installed


def _distribution(variables: Mapping[str, str], root: str) -> tuple[str | None, str | None]:
    """Name and prefix of the ROS 1 distribution: the one that is sourced, else the newest that is there."""
    opt = os.path.join(root, "opt", "ros")
    named = variables.get("ROS_DISTRO")
    if named and variables.get("ROS_VERSION") != "2":
        prefix = os.path.join(opt, named)
        return named, prefix if os.path.isdir(prefix) else None
    for name in reversed(_ROS1_DISTROS):
        if os.path.isfile(os.path.join(opt, name, "share", "catkin", MANIFEST)):
            return name, os.path.join(opt, name)
    return None, None


def _is_debian(root: str) -> bool:
    """Whether the system is Debian or made of it, but for Ubuntu, for which ROS has packages."""
    try:
        with open(os.path.join(root, "etc/os-release"), encoding="utf-8", errors="replace") as file:
            release = file.read(65536)
    except OSError:
        return False
    names = " ".join(re.findall(r"^ID(?:_LIKE)?=(.*)$", release, re.MULTILINE))
    return {"debian", "ubuntu"}.intersection(re.findall(r"\w+", names)) == {"debian"}


def _debian_distribution(debian: str) -> str | None:
    """Debian's packages have no distribution of their own; their roslaunch or rospy is that of one."""
    for package in find_packages(
        [os.path.join(debian, "share", name) for name in ("roslaunch", "rospy")]
    ).packages.values():
        version = _version(package)
        for start, name in (("1.12.", "kinetic"), ("1.13.", "lunar"), ("1.14.", "melodic")):
            if version.startswith(start):
                return name
    return "noetic"


def _version(package: Package) -> str:
    try:
        with open(package.manifest, encoding="utf-8", errors="replace") as manifest:
            found = re.search(r"<version>\s*([\d.]+)\s*</version>", manifest.read(65536))
    except OSError:
        return ""
    return found[1] if found else ""


# The workspace


def _catkin_workspace(workspace: str | None) -> str | None:
    """The catkin workspace that the folder is, or is in: opening one package of it is usual."""
    marks = (".catkin_workspace", ".catkin_tools", "devel/.catkin", "install/.catkin", "src/CMakeLists.txt")
    for folder in _with_parents(workspace) if workspace else ():
        # The `src` of a package may have a CMakeLists.txt of its own.
        if not _is_package(folder) and any(os.path.exists(os.path.join(folder, mark)) for mark in marks):
            return folder
    return None


def _colcon_workspace(folder: str) -> str | None:
    """The workspace that colcon has built, which the folder is, or is in."""
    marks = ("install/COLCON_IGNORE", "build/COLCON_IGNORE", "log/COLCON_IGNORE", "install/.colcon_install_layout")
    for candidate in _with_parents(folder):
        if any(os.path.exists(os.path.join(candidate, mark)) for mark in marks):
            return candidate
    return None


def _workspaces_around(folder: str) -> Iterator[str | None]:
    """The workspaces that a folder may belong to that is sourced: links in it lead to their sources and builds."""
    yield _catkin_workspace(folder)
    yield _colcon_workspace(folder)
    for built in (folder.rstrip("/"), os.path.dirname(folder.rstrip("/"))):
        if os.path.basename(built) in BUILT:
            yield os.path.dirname(built)


def _has_sources(folder: str) -> bool:
    """Whether it is a workspace, built or not: packages are in its `src`. The home folder is none, nor is a package."""
    if folder in (os.path.expanduser("~"), "/", "/usr", "/usr/local") or _is_package(folder):
        return False
    return next(crawl(os.path.join(folder, "src")), None) is not None


def _is_ros2(
    variables: Mapping[str, str], workspace: str | None, packages: Iterable[Package], prefixes: Sequence[str]
) -> bool:
    """Whether this is first of all a ROS 2 environment: by what is sourced, else by the packages of the workspace, else
    by what is installed."""
    if variables.get("ROS_VERSION") in ("1", "2"):
        return variables["ROS_VERSION"] == "2"
    own = _own(workspace, packages)
    ament = sum(package.is_ament for package in own)
    return (
        ament > sum(package.build_type in OF_ROS1 for package in own)
        if own
        else bool(prefixes) and not variables.get("ROS_PACKAGE_PATH")
    )


def _own(workspace: str | None, packages: Iterable[Package]) -> list[Package]:
    return [package for package in packages if package.is_within(workspace)]


def _in_order(
    found: FoundPackages, prefixes: Sequence[str], system: Sequence[str], own: Sequence[Package], *, ros2: bool
) -> tuple[dict[str, Package], dict[str, tuple[Package, ...]]]:
    """For each name the first package and the others. Generations are apart: an installed ROS 1 hides nothing of
    ROS 2, and is there at all in an environment of ROS 2 only where the workspace has packages of ROS 1."""
    built = installed_packages(prefixes)
    in_system = tuple(os.path.join(prefix, "share", "") for prefix in system)
    in_prefixes = tuple(os.path.join(prefix, "") for prefix in prefixes)
    mixed = any(package.build_type in OF_ROS1 for package in own)
    packages: dict[str, Package] = {}
    shadowed: dict[str, tuple[Package, ...]] = {}
    for name in dict.fromkeys((*found.packages, *built)):
        here = [found.packages[name], *found.shadowed.get(name, ())] if name in found.packages else []
        if ros2 and not mixed:
            here = [package for package in here if not is_installed_ros1(package, in_system, in_prefixes)]
        # What a source is built to is no other package than the source.
        if name in built and all(package.build_type in OF_ROS1 for package in here):
            here.append(built[name])
        if ros2:
            here = [*by_generation(here)]
        if here:
            packages[name] = here[0]
        if len(here) > 1:
            shadowed[name] = tuple(here[1:])
    return packages, shadowed


def _with_parents(folder: str) -> Iterator[str]:
    yield folder
    while (parent := os.path.dirname(folder)) != folder:
        folder = parent
        yield folder


def _is_package(folder: str) -> bool:
    return any(os.path.isfile(os.path.join(folder, name)) for name in (MANIFEST, LEGACY_MANIFEST))


def _source_folders(workspace: str | None, catkin: str | None) -> list[str]:
    folders = []
    for folder in dict.fromkeys((workspace, catkin)):
        if folder is None:
            continue
        source = os.path.join(folder, "src")
        # The `src` of a package holds its code.
        folders.append(source if os.path.isdir(source) and not _is_package(folder) else folder)
        installed = os.path.join(folder, "install")
        if not os.path.isdir(source) and os.path.isfile(os.path.join(installed, ".catkin")):
            folders.append(os.path.join(installed, "share"))
    return folders


def _spaces(
    variables: Mapping[str, str], catkin: str | None, prefix: str | None, root: str
) -> tuple[list[str], list[str]]:
    """Devel and install spaces, and prefixes of the system: those of the workspace come first if none is sourced."""
    sourced = [
        os.path.abspath(entry)
        for entry in _split(variables.get("CMAKE_PREFIX_PATH"))
        if os.path.isfile(os.path.join(entry, ".catkin"))
    ]
    opt = os.path.join(root, "opt", "ros") + os.sep
    devel = [entry for entry in sourced if not entry.startswith(opt)]
    system = [entry for entry in sourced if entry.startswith(opt)]
    own = [os.path.join(catkin, name) for name in ("devel", "install", "install_isolated")] if catkin else []
    if catkin:
        own[1:1] = sorted(_subfolders(os.path.join(catkin, "devel_isolated")))
    own = [space for space in own if os.path.isfile(os.path.join(space, ".catkin"))]
    if not any(space in devel for space in own):
        devel = [*own, *devel]
    if prefix:
        system.append(prefix)
    return _unique(devel), _unique(system)


def _subfolders(folder: str) -> list[str]:
    try:
        with os.scandir(folder) as entries:
            return [entry.path for entry in entries if is_folder(entry)]
    except OSError:
        return []


# What sourcing the set-up script would set


def _with_overlays(
    variables: Mapping[str, str],
    path: Sequence[str],
    devel: Sequence[str],
    prefix: str | None,
    distro: str | None,
    debian: str,
) -> dict[str, str]:
    given = dict(variables)
    # Debian's rospkg adds its own folder by itself.
    own = [folder for folder in path if folder != os.path.join(debian, "share")]
    if own or "ROS_PACKAGE_PATH" in variables:
        given["ROS_PACKAGE_PATH"] = os.pathsep.join(own)
    spaces = [*devel, *([prefix] if prefix else [])]
    _add(given, "CMAKE_PREFIX_PATH", devel, [prefix] if prefix else [])
    for variable, below in (
        ("PYTHONPATH", ("lib/python3/dist-packages", "lib/python2.7/dist-packages")),
        ("LD_LIBRARY_PATH", ("lib",)),
        ("PATH", ("bin",)),
    ):
        folders = {s: [p for b in below if os.path.isdir(p := os.path.join(s, b))] for s in spaces}
        _add(given, variable, [p for s in devel for p in folders[s]], folders[prefix] if prefix else [])
    if prefix and distro:
        given.setdefault("ROS_DISTRO", distro)
        given.setdefault("ROS_VERSION", "1")
        given.setdefault("ROS_PYTHON_VERSION", "3" if distro == "noetic" else "2")
        given.setdefault("ROS_ETC_DIR", os.path.join(prefix, "etc", "ros"))
        given.setdefault("ROS_ROOT", os.path.join(prefix, "share", "ros"))
    return given


def _add(given: dict[str, str], variable: str, before: Iterable[str], after: Iterable[str]) -> None:
    """Put folders that a variable lacks around those it has."""
    present = _split(given.get(variable))
    missing_before = [folder for folder in before if folder not in present]
    missing_after = [folder for folder in after if folder not in (*present, *missing_before)]
    if missing_before or missing_after:
        given[variable] = os.pathsep.join([*missing_before, *present, *missing_after])


def _python(given: Mapping[str, str], debian: str) -> _Python | None:
    """The interpreter of the first rospy that Python would import, None when there is no rospy."""
    system = os.path.join(debian, "bin", "python3")
    too_old = None
    for folder in (*_split(given.get("PYTHONPATH")), os.path.join(debian, "lib", "python3", "dist-packages")):
        if not os.path.isfile(os.path.join(folder, "rospy", "__init__.py")):
            continue
        library = _PYTHON_LIBRARY.match(os.path.abspath(folder))
        if library and library[2] == "2.7":
            too_old = too_old or _Python(
                None,
                f"rospy in {folder} is for Python 2.7: nodes are not run, because tracing them needs Python 3.8 or "
                "newer (ROS Noetic).",
            )
            continue
        beside = os.path.join(library[1], "bin", f"python{library[2]}") if library else system
        for interpreter in (beside, system):
            if os.access(interpreter, os.X_OK):
                return _Python(interpreter)
        return _Python(None, f"rospy is in {folder}, and the Python interpreter for it, {system}, is not there.")
    return too_old


# What is missing


def _path_problems(path: Iterable[str]) -> list[str]:
    return [f"The package path names {folder}, which is not a folder." for folder in path if not os.path.isdir(folder)]


def _workspace_problems(workspace: str | None, devel: Sequence[str], found: FoundPackages) -> list[str]:
    if workspace is None or any(space.startswith(workspace + os.sep) for space in devel):
        return []
    generated = sorted(
        package.name
        for package in found.packages.values()
        if package.is_within(workspace)
        and any(os.path.isdir(os.path.join(package.share, kind)) for kind in ("msg", "srv", "action"))
    )
    if not generated:
        return []
    return [
        f"The workspace {workspace} is not built, so the messages of {', '.join(generated)} are not there and nodes "
        "that import them crash: run `catkin_make` or `catkin build` in it."
    ]


def _installation_problems(variables: Mapping[str, str], python: _Python | None) -> list[str]:
    problems = []
    if variables.get("ROS_VERSION") == "2":
        name = variables.get("ROS_DISTRO", "")
        problems.append(f"ROS 2 {name.capitalize()} is sourced here; launch files of ROS 1 are analysed without it.")
    if python is None:
        problems.append(
            "rospy was not found, so nodes in Python are run with a stand-in for it. Install it: on Debian "
            "`apt install python3-rospy`, on Ubuntu 20.04 `apt install ros-noetic-ros-base` and "
            "`source /opt/ros/noetic/setup.bash`."
        )
    elif python.problem:
        problems.append(python.problem)
    return problems
