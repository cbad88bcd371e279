"""Requests for runs of Python launch files, answered by reading."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.reading.files import Disk
from preflight_analysis.tracing.reading.reader import read


def answer(environment: Environment, disk: Disk, request: Mapping[str, Any]) -> dict[str, Any] | None:
    """The answer to a request (`evaluation.ros2.python_runs.parse_request`) in an environment, with what of it only a
    run tells as `unread`; None where the file is not read at all."""
    packages = {name: package.share for name, package in environment.packages.items()} | request.get("packages", {})
    folders = tuple(dict.fromkeys(_module_folders(packages, disk)))
    roots = tuple(dict.fromkeys((*environment.workspace_folders, *packages.values(), *folders)))
    job = {**request, "packages": packages}
    return read(job, disk, tuple(root.rstrip("/") for root in roots), folders, {})


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
