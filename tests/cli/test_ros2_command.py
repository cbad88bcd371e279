"""`ros2 preflight`: what ros2cli does with an extension of its group `ros2cli.command`, done with ours.

The steps are those of `ros2cli.command.add_subparsers_on_demand` and `ros2cli.cli.main`: the root parser knows the
names of all commands, parses what it knows, has the chosen one add its arguments, and parses again.
"""

from __future__ import annotations

import argparse
import sys
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
DEMO = ROOT / "fixtures/ros1/demo"


def ros2(*argv: str) -> int:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    ((name, value),) = project["entry-points"]["ros2cli.command"].items()
    parser = argparse.ArgumentParser(prog="ros2")
    commands = parser.add_subparsers(dest=" command", required=False)
    command = commands.add_parser(name, formatter_class=argparse.RawDescriptionHelpFormatter)
    chosen = getattr(parser.parse_known_args([word for word in argv if word not in ("-h", "--help")])[0], " command")
    if chosen == name:
        extension = EntryPoint(name, value, "ros2cli.command").load()()
        extension.NAME = name
        command.set_defaults(_command=extension)
        command.description = extension.__doc__.splitlines()[0]
        extension.add_arguments(command, f"ros2 {name}")
    args = parser.parse_args([*argv])
    code: int = args._command.main(parser=parser, args=args)
    return code


def test_a_verb_is_run(capsys: pytest.CaptureFixture[str]) -> None:
    launch_file = str(DEMO / "launch/fixed.launch")
    assert ros2("preflight", "tree", launch_file, "--no-run", "--package-path", str(DEMO)) == 0
    assert "node /talker" in capsys.readouterr().out


def test_options_in_front_of_the_file_and_exit_codes(capsys: pytest.CaptureFixture[str]) -> None:
    assert ros2("preflight", "check", "--fail-on", "hint", "--no-run", str(DEMO / "launch/talker_listener.launch")) == 1
    assert ros2("preflight", "check", "nothing.launch") == 2
    assert "nothing.launch does not exist" in capsys.readouterr().err


def test_help_lists_the_verbs(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (("--help",), ()):
        with pytest.raises(SystemExit) as ended:
            ros2("preflight", *words)
        assert ended.value.code == 0
        out = capsys.readouterr().out
        assert "usage: ros2 preflight" in out
        assert "find problems in launch files" in out


def test_help_of_a_verb(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        ros2("preflight", "check", "--help")
    assert capsys.readouterr().out.startswith("usage: ros2 preflight check ")
