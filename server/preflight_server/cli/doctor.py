"""`ros-preflight doctor`: what launch files and nodes are looked at with, and what is missing."""

from __future__ import annotations

import argparse
import os
from typing import Any

from preflight_analysis.environment.detect import detect
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.sandbox import SandboxStatus

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, FOUND, CannotDoError
from preflight_server.cli.output import print_json, print_text
from preflight_server.doctor import page

DESCRIPTION = """Shows what launch files and nodes are looked at with: distribution, package path, interpreter, sandbox.
Only an empty command is run in the sandbox, to see whether it works; --no-run leaves that out. The exit code is 1 if
something is missing."""
SCHEMA = "ros-preflight/doctor/1"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_common(parser)
    parser.add_argument("place", metavar="PLACE", nargs="?", default=".", help="a workspace or a file in it")


def run(args: argparse.Namespace) -> int:
    """Print what there is."""
    if not os.path.exists(args.place):
        raise CannotDoError(f"{args.place} does not exist")
    environment = detect(os.path.abspath(args.place), package_path=options.package_path(args))
    status = None if args.no_run else sandbox.probe()
    if args.format == "json":
        print_json(_json(environment, status))
    else:
        print_text(page(environment, status))
    missing = bool(environment.problems) or (status is not None and not status.works)
    return FOUND if missing and args.fail_on != options.NEVER else CLEAN


def _json(environment: Environment, status: SandboxStatus | None) -> dict[str, Any]:
    return {
        "schema": SCHEMA,
        "generation": environment.generation,
        "distribution": environment.distro,
        "workspace": environment.workspace,
        "package_path": list(environment.package_path),
        "packages": {name: package.share for name, package in environment.packages.items()},
        "devel_spaces": list(environment.devel_spaces),
        "system_prefixes": list(environment.system_prefixes),
        "interpreter": environment.python,
        "ros2_interpreter": environment.ros2_python,
        "problems": list(environment.problems),
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
