"""What the command imports before it does anything: that is most of the time that it takes to start."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = (
    "preflight_analysis.evaluation",
    "preflight_analysis.rules",
    "yaml",
    "lxml",
    "pygls",
    "platformdirs",
    "hashlib",
)


def imported(*arguments: str) -> set[str]:
    """The modules that are imported when the command ends."""
    program = (
        "import runpy, sys\n"
        "try:\n    runpy.run_module('preflight_server', run_name='__main__')\n"
        "except SystemExit:\n    print('', *sys.modules, sep='\\n', file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=True)
    return set(done.stderr.split("\n"))


@pytest.mark.parametrize("option", ["--version", "--help"])
def test_version_and_help_import_none_of_the_analysis(option: str) -> None:
    modules = imported(option)
    assert "preflight_server.cli.main" in modules
    assert not modules.intersection(HEAVY)


def test_a_verb_imports_what_it_needs() -> None:
    modules = imported("rules", "TOP001")
    assert "preflight_analysis.rules.registry" in modules
    assert not modules.intersection({"preflight_server.cli.check", "pygls"})
