"""Which of several values of a parameter a node of ROS 2 gets: what the tree says beside what real rclpy does."""

import itertools
import json
import subprocess
from pathlib import Path

import pytest
import yaml
from support.check import analyse, read_fixture
from support.ros2_harness import ros2_prefix

pytestmark = pytest.mark.ros

ASK = """
import json, sys, rclpy
from rclpy.context import Context
for space, arguments in json.load(sys.stdin):
    context = Context()
    rclpy.init(args=["--ros-args", *arguments], context=context)
    node = rclpy.create_node("n", namespace=space, context=context, start_parameter_services=False, enable_rosout=False)
    print(node.declare_parameter("p", 0).value)
    node.destroy_node()
    context.shutdown()
"""
KEYS = ("/**", "/*", "/a/n", "a/n", "/a/*", "/*/n", "/**/n", "/a/**", "n")
Source = dict[str, int] | int
"""A file with a value below each key, or a value in the launch file."""


def sources() -> list[tuple[tuple[Source, ...], bool]]:
    """What gives a node its parameters, and whether the launch file has its namespace."""
    one = [({key: 1},) for key in KEYS]
    two = [({a: 1, b: 2},) for a, b in itertools.permutations(KEYS, 2)]
    apart = [({a: 1}, {b: 2}) for a, b in itertools.permutations(KEYS, 2)]
    mixed: list[tuple[Source, ...]] = [
        ({"/**": 1, "/a/n": 2}, {"/**": 3}),
        ({"/a/n": 2, "/**": 1}, {"/a/n": 3}),
        ({"/**": 1}, {"/a/n": 2}, {"/**": 3}),
        ({"/a/n": 1}, {"/**": 2}, {"a/n": 3}),
        ({"/**": 1, "/a/n": 2}, 3),
        ({"/a/n": 2, "/**": 1}, 3),
        ({"/a/n": 1}, 2),
        (1, {"/a/n": 2}, {"/**": 3}),
        (1, {"/**": 2}),
        (1, {"/**": 2}, 3),
    ]
    at_root = [
        tuple({k.replace("a/", ""): v for k, v in s.items()} if isinstance(s, dict) else s for s in each)
        for each in mixed
    ]
    return [*((each, True) for each in (*one, *two, *apart, *mixed)), *((each, False) for each in at_root)]


def test_the_value_that_counts(tmp_path: Path) -> None:
    cases: list[tuple[str, list[str]]] = []
    expected = []
    for number, (given, spaced) in enumerate(sources()):
        params: list[str] = []
        arguments: list[str] = []
        files = ""
        for index, source in enumerate(given):
            # launch passes a value as a file, below the node's full name where it knows that.
            keys = source if isinstance(source, dict) else {"/a/n" if spaced else "/**": source}
            text = yaml.safe_dump({k: {"ros__parameters": {"p": v}} for k, v in keys.items()}, sort_keys=False)
            path = tmp_path / f"{number}_{index}.yaml"
            path.write_text(text)
            arguments += ["--params-file", str(path)]
            if isinstance(source, dict):
                params.append(f'<param from="{path}"/>')
                files += f"\n//- {path}\n{text}"
            else:
                params.append(f'<param name="p" value="{source}"/>')
        space = ' namespace="/a"' if spaced else ""
        launch = f'//- /a.launch.xml\n<launch><node pkg="p" exec="n" name="n"{space}>{"".join(params)}</node></launch>'
        (node,) = analyse(read_fixture(launch + files)).tree.nodes
        cases.append(("/a" if spaced else "/", arguments))
        expected.append((given, next((p.value for p in node.params if p.name == "p"), 0)))
    python = ros2_prefix() / "bin" / "python"
    done = subprocess.run([python, "-c", ASK], input=json.dumps(cases), capture_output=True, text=True, check=True)
    real = [int(line) for line in done.stdout.split()]
    assert len(real) == len(expected) > 150
    differing = [(given, mine, theirs) for (given, mine), theirs in zip(expected, real, strict=True) if mine != theirs]
    assert not differing
