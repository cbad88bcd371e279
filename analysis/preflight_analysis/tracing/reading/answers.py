"""Requests for runs of Python launch files, answered by reading."""

from __future__ import annotations

import json
import posixpath
from collections.abc import Iterator, Mapping
from typing import Any

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.ament import DISTRIBUTIONS, distribution
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import interior, ros2_recipe
from preflight_analysis.tracing.reading import reader
from preflight_analysis.tracing.reading.reader import Surroundings


def answer(environment: Environment, disk: Disk, request: Mapping[str, Any]) -> dict[str, Any] | None:
    """The answer to a request (`evaluation.ros2.python_runs.parse_request`) in an environment, with what of it only a
    run tells as `unread`; None where the file is not read at all."""
    told = tell(environment, disk, request)
    found: dict[str, Any] | None = None if told is None else json.loads(told)
    return found


def tell(environment: Environment, disk: Disk, request: Mapping[str, Any]) -> str | None:
    """The same as JSON."""
    packages = {name: package.share for name, package in environment.packages.items()} | request.get("packages", {})
    folders = tuple(dict.fromkeys(_module_folders(packages, disk)))
    shares = tuple(dict.fromkeys((*packages.values(), *folders)))
    known = distribution(environment.variables, environment.ament_prefixes)
    sourced = {"ROS_DISTRO": known or DISTRIBUTIONS[-1]}
    assumed = [] if known else sorted(sourced.keys() - environment.variables.keys())
    job = {**request, "packages": packages, "assumed": assumed}
    variables = {"ROS_VERSION": "2", "ROS_PYTHON_VERSION": "3", **sourced}
    variables.update({name: value for name in variables if (value := environment.variables.get(name)) is not None})
    if environment.variables.get("HOME") == interior.home():
        variables["HOME"] = interior.home()  # that of a run, which is not always the one that counts
    around = Surroundings(
        disk,
        tuple(root.rstrip("/") for root in environment.workspace_folders),
        folders,
        variables,
        lambda: ros2_recipe.installed_for(environment, str(request["file"]), str(request["text"]), disk),
        tuple(root.rstrip("/") for root in shares),
    )
    return reader.tell(job, around)


def _module_folders(packages: Mapping[str, str], disk: Disk) -> Iterator[str]:
    """Where the packages' Python modules are installed."""
    for name, share in packages.items():
        end = posixpath.join("share", name)
        if not share.endswith("/" + end):
            continue
        library = posixpath.join(share[: -len(end)], "lib")
        for folder in disk.names(library):
            if folder.startswith("python3"):
                for kind in ("site-packages", "dist-packages"):
                    path = posixpath.join(library, folder, kind)
                    if disk.is_folder(path):
                        yield path
