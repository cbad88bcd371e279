"""PKG003: several files that a node's type could mean."""

from pathlib import Path

import pytest
from support.demo_package import judge


def test_two_different_executables_of_one_name(launch: Path) -> None:
    old = launch.parent / "nodes" / "old"
    old.mkdir()
    (old / "listener").write_text("#!/bin/sh\n# another one\n")
    (old / "listener").chmod(0o755)
    (finding,) = judge(launch, "listener")
    assert (finding.rule, finding.severity) == ("PKG003", "warning")
    assert (
        "has 2 different files; 'nodes/listener' runs here, another machine may run 'nodes/old/listener'"
        in finding.message
    )


@pytest.mark.silent
def test_a_link_to_an_executable_or_a_copy_of_it_is_no_second_one(launch: Path) -> None:
    for name in ("links", "copies"):
        (launch.parent / name).mkdir()
    (launch.parent / "links" / "listener").symlink_to(launch.parent / "nodes" / "listener")
    (launch.parent / "copies" / "listener").write_text("#!/bin/sh\n")
    (launch.parent / "copies" / "listener").chmod(0o755)
    assert judge(launch, "listener") == []
