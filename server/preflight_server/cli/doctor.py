"""`ros-preflight doctor`: what launch files and nodes are looked at with, and what is missing."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.report import Report, missing_json
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.sandbox import SandboxStatus

from preflight_server.cli import options
from preflight_server.cli.check import look_at
from preflight_server.cli.errors import CLEAN, FOUND, CannotDoError, require
from preflight_server.cli.launches import launches
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.paths import by_name, with_paths
from preflight_server.doctor import page

DESCRIPTION = """Report the environment that ros-preflight uses: distribution, package path, interpreter and sandbox.
Also list what the launch files of the workspace need and this machine lacks, with the commands that install it. The
command tests the sandbox, and runs Python launch files, parameter commands and xacro in it; --no-run skips that. It
runs no nodes: what they lack is known from the last `check`. The exit code is 1 if no ROS is found or no sandbox
works."""
SCHEMA = "ros-preflight/doctor/1"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser)
    parser.add_argument(
        "place",
        metavar="PLACE",
        nargs="?",
        default=".",
        help="a workspace, or a file in it (default: the current folder)",
    )


def run(args: argparse.Namespace) -> int:
    """Print what there is."""
    environment = options.environment(args, require(args.place))
    status = None if args.no_run else sandbox.probe()
    folder = args.place if os.path.isdir(args.place) else environment.workspace
    lacks = _lacks(folder, args) if folder else Report((), {})
    if args.format == "json":
        print_json(_json(environment, status, lacks, args))
    else:
        print_text(page(environment, status, lacks.missing))
    missing = bool(environment.problems) or (status is not None and not status.works)
    return FOUND if missing and args.fail_on != options.NEVER else CLEAN


def _lacks(folder: str, args: argparse.Namespace) -> Report:
    """What `check` finds missing for the launch files of a folder, without running nodes anew."""
    try:
        found = launches(argparse.Namespace(**vars(args), launch_args=[folder]))
    except CannotDoError:
        return Report((), {})  # there are no launch files
    return look_at(found, argparse.Namespace(no_run=True, jobs=args.jobs, changed_since=None))[0]


def _json(
    environment: Environment, status: SandboxStatus | None, lacks: Report, args: argparse.Namespace
) -> Mapping[str, Any]:
    homes = [environment.workspace] if environment.workspace else []
    shares = {name: package.share for name, package in environment.packages.items()}
    data = {
        "schema": SCHEMA,
        "generation": environment.generation,
        "distribution": environment.distro,
        "workspace": environment.workspace,
        "package_path": list(environment.package_path),
        "packages": by_name(shares, args, homes),
        "devel_spaces": list(environment.devel_spaces),
        "system_prefixes": list(environment.system_prefixes),
        "interpreter": environment.python,
        "ros2_interpreter": environment.ros2_python,
        "problems": list(environment.problems),
        **missing_json(lacks),
        "sandbox": None
        if status is None
        else {
            "works": status.works,
            "backend": status.backend,
            "reason": status.reason,
            "guarantees": list(status.guarantees),
        },
        "traces": str(TraceCache().folder),
    }
    return with_paths(data, args, homes)
