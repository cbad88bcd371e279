"""A value of a Python launch file that is read stands where its text is written, whatever it went through; an edit is
made there if it is right for all that the text is for."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.reading_harness import IMPORTS, ReadingHarness

HEAD = f"""{IMPORTS}

def node(executable, name, **more):
    return Node(package="bot", executable=executable, name=name, **more)


"""
_TALKER = 'Node(package="bot", executable="talker", '
BODIES = {
    "a variable": ('exe = "talkr"', 'Node(package="bot", executable=exe)', "PKG002", "talkr"),
    "a variable of the module": ("", 'Node(package="bot", executable=EXECUTABLE)', "PKG002", "talkrr"),
    "a helper": ("", 'node("talkr", "a"), node("talker", "b")', "PKG002", "talkr"),
    "a default": ('def make(exe="talkr"):\n        return node(exe, "a")', "make()", "PKG002", "talkr"),
    "a loop": (
        'found = []\n    for exe, name in [("talker", "a"), ("talkr", "b")]:\n        found.append(node(exe, name))',
        "*found",
        "PKG002",
        "talkr",
    ),
    "a comprehension": ("", '*[node(exe, "a") for exe in ("talkr",)]', "PKG002", "talkr"),
    "a branch": ('exe = "talker"\n    if SHARE:\n        exe = "talkr"', 'node(exe, "a")', "PKG002", "talkr"),
    "a dictionary": ('of = {"a": {"exe": "talkr"}}', 'node(of["a"]["exe"], "a")', "PKG002", "talkr"),
    "arguments": ('more = {"package": "bto", "executable": "talker"}', "Node(**more)", "PKG001", "bto"),
    "a parameter": ('params = {"rat": 5.0}', f"{_TALKER}parameters=[params])", "PRM013", "rat"),
    "parameters of a loop": ("", f'{_TALKER}parameters=[{{k: 5.0 for k in ("rat",)}}])', "PRM013", "rat"),
    "parameters that are added": (
        'params = {"rate": 1.0}\n    params["rat"] = 2.0',
        f"{_TALKER}parameters=[params])",
        "PRM013",
        "rat",
    ),
    "remaps": ('remaps = [("chater", "x")]', f"{_TALKER}remappings=remaps)", "TOP004", "chater"),
    "remaps of a loop": (
        'names = ("chater",)',
        f'{_TALKER}remappings=[(name, f"/x/{{name}}") for name in names])',
        "TOP004",
        "chater",
    ),
    "a path": (
        'file = os.path.join(SHARE, "config", "parms.yaml")',
        f"{_TALKER}parameters=[file])",
        "PRM002",
        'os.path.join(SHARE, "config", "parms.yaml")',
    ),
    "an f-string": ('file = f"{SHARE}/parms.yaml"', f"{_TALKER}parameters=[file])", "PRM002", "{SHARE}/parms.yaml"),
    "an argument": (
        'smi = LaunchConfiguration("smi")',
        f"{_TALKER}namespace=smi)",
        "ARG001",
        'LaunchConfiguration("smi")',
    ),
}


@pytest.fixture
def harness(tmp_path: Path) -> ReadingHarness:
    return ReadingHarness(tmp_path)


def _text(before: str, item: str) -> str:
    return f"""{HEAD}SHARE = get_package_share_directory("bot")
EXECUTABLE = "talkrr"


def generate_launch_description():
    {before or "pass"}
    return LaunchDescription([DeclareLaunchArgument("sim", default_value="a"), {item}])
"""


@pytest.mark.parametrize("way", BODIES)
def test_a_finding_stands_where_the_text_is_written(harness: ReadingHarness, way: str) -> None:
    before, item, rule, place = BODIES[way]
    analysis = harness.read(_text(before, item))
    text = analysis.documents[analysis.root].text
    found = [each for each in analysis.findings if each.rule == rule]
    assert [text[slice(*each.location.span)] for each in found] == [place]
    assert len({each.location for each in found}) == 1


SHARED = {
    "for one": ('exe = "talkr"', 'Node(package="bot", executable=exe)', True),
    "for several nodes of one package": ('pkg = "bto"', 'Node(package=pkg, executable="a"), FIND', True),
    "for a node and its namespace": ('exe = "talkr"', 'Node(package="bot", executable=exe, namespace=exe)', False),
    "through a helper to two": (
        "def both(name):\n        return node(name, name)",
        'both("talkr")',
        False,
    ),
    "for two nodes": ('remaps = [("chater", "x")]', f"{_TALKER}remappings=remaps), {_TALKER}remappings=remaps)", False),
    "in a loop": ("", '*[node(exe, name) for exe, name in [("talkr", "a")]]', True),
}


@pytest.mark.parametrize("way", SHARED)
def test_an_edit_is_right_for_all_that_a_text_is_for(harness: ReadingHarness, way: str) -> None:
    before, item, is_mended = SHARED[way]
    item = item.replace("FIND", 'LogInfo(msg=get_package_share_directory(pkg)), Node(package=pkg, executable="b")')
    analysis = harness.read(_text(before, item))
    found = [each for each in analysis.findings if each.rule in ("PKG001", "PKG002", "TOP004")]
    assert found
    assert any(fix.title.startswith("Replace") for each in found for fix in each.fixes) == is_mended
