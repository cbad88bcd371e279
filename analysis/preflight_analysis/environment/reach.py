"""Which folders a run may be shown of those that the sandbox hides: the workspace's, and those that the user named.

What a workspace says of paths is not to be believed: a link that is part of a repository can lead to `~/.ssh`. So a
path counts by where it really is, and that has to lie in the workspace, or in what the process's own variables, the
package path that was asked for, or the user's interpreters lead to. Dot folders of a home folder never count, unless
the folder that was named lies in one.
"""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.documents.secrets import dot_folder, within
from preflight_analysis.environment.model import Environment

_VARIABLES = (
    "ROS_ROOT",
    "ROS_PACKAGE_PATH",
    "AMENT_PREFIX_PATH",
    "COLCON_PREFIX_PATH",
    "CMAKE_PREFIX_PATH",
    "PYTHONPATH",
    "LD_LIBRARY_PATH",
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
    "GAZEBO_PLUGIN_PATH",
    "VIRTUAL_ENV",
    "CONDA_PREFIX",
    "PATH",
)
_PYTHONS = ("python3", "python")


def may_be_shown(environment: Environment, path: str) -> bool:
    """Whether what a path leads to lies in the workspace or in what the user named."""
    return _is_in(os.path.realpath(path), (*environment.workspace_folders, *environment.named_folders))


def in_workspace(environment: Environment, path: str) -> bool:
    """Whether a path, as it is written, is one of the workspace, which may be a link to anywhere."""
    return _is_below(path, environment.workspace_folders)


def is_users_program(environment: Environment, executable: str) -> bool:
    """Whether a program was found in a folder of the user's own PATH that is not the workspace's."""
    folder = os.path.normpath(os.path.dirname(executable))
    own = _entries(environment.own_variables, "PATH")
    return not in_workspace(environment, folder) and folder in {os.path.normpath(entry) for entry in own}


def workspace_folders(workspace: str | None, around: Iterable[str | None], built: Iterable[str]) -> tuple[str, ...]:
    """The folders of a workspace, as written and as they really are. `around` are workspaces that it lies in; of one
    that is a whole home folder only the folders `built` and `src` count, as it was not asked for."""
    found = [workspace] if workspace else []
    for folder in around:
        if folder is not None and folder != workspace:
            found += [os.path.join(folder, name) for name in ("src", *sorted(built))] if is_wide(folder) else [folder]
    return _both(found)


def named_folders(
    variables: Mapping[str, str],
    folders: Iterable[str],
    interpreters: Iterable[str | None],
    workspaces: tuple[str, ...],
    underlays: Iterable[str | None],
) -> tuple[str, ...]:
    """What the user named: the folders of `variables`, the given ones, all of the `underlays` (workspaces of the
    folders in variables), and Python's interpreters but those that only a workspace has."""
    entries = [entry for name in _VARIABLES for entry in _entries(variables, name)]
    found = [entry for entry in entries if not _leads_astray(entry, workspaces)]
    found += folders
    found += [folder for folder in underlays if folder is not None and not is_wide(folder)]
    pythons = [os.path.join(entry, name) for entry in _entries(variables, "PATH") for name in _PYTHONS]
    pythons += [python for python in interpreters if python is not None and not _is_below(python, workspaces)]
    for python in (sys.executable, *filter(os.path.exists, pythons)):
        if os.path.basename(os.path.realpath(python)).startswith(("python", "pypy")):
            found += interpreter_paths(python)
    return _both(found)


def interpreter_paths(python: str) -> list[str]:
    """The interpreter and the prefixes it needs: of the virtual environment, and of what that was made from."""
    seen: list[str] = []
    at = os.path.abspath(python)
    for _ in range(16):
        seen.append(at)
        seen += _prefix(os.path.dirname(os.path.dirname(at)))
        if not os.path.islink(at):
            break
        at = os.path.normpath(os.path.join(os.path.dirname(at), os.readlink(at)))
    if python == sys.executable:  # it may be a copy, in the environment, of another
        seen += [*_prefix(sys.prefix), *_prefix(sys.base_prefix)]
    return seen


def _prefix(folder: str) -> list[str]:
    library = os.path.join(folder, "lib")
    libraries: list[str] = []
    with contextlib.suppress(OSError):
        libraries = [os.path.join(library, name) for name in os.listdir(library) if name.startswith("python3")]
    # Such a prefix has much besides Python: key rings and mail; of `/bin/python3` it is the whole disk.
    if os.path.basename(folder) == ".local" or is_wide(folder):
        return libraries
    return [folder] if libraries or os.path.isfile(os.path.join(folder, "pyvenv.cfg")) else []


def _entries(variables: Mapping[str, str], name: str) -> Iterator[str]:
    return (entry for entry in variables.get(name, "").split(os.pathsep) if os.path.isabs(entry))


def _leads_astray(entry: str, workspaces: tuple[str, ...]) -> bool:
    """Whether an entry of the workspace leads to a dot folder of a home folder: nobody has that sourced."""
    real = os.path.realpath(entry)
    return _is_below(entry, workspaces) and not _is_in(real, workspaces) and dot_folder(real) is not None


def _is_in(real: str, roots: Iterable[str]) -> bool:
    private = dot_folder(real)
    return any(within(real, root) and (private is None or within(root, private)) for root in roots)


def _is_below(path: str, folders: Iterable[str]) -> bool:
    path = os.path.normpath(path)
    return any(within(path, folder) for folder in folders)


def is_wide(folder: str) -> bool:
    """Whether a folder holds a home folder, or all temporary files."""
    real = os.path.realpath(folder)
    return any(within(place, real) for place in (_home(), "/home", "/root", "/tmp", "/var/tmp", "/run"))  # noqa: S108


def _home() -> str:
    return os.path.realpath(os.path.expanduser("~"))


def _both(folders: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(form for f in folders if f for form in (os.path.normpath(f), os.path.realpath(f))))
