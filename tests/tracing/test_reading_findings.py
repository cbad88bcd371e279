"""A Python launch file that is read tells of a mistake what the same launch in XML does, without a run."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.reading_harness import IMPORTS, ReadingHarness

HEAD = f"""{IMPORTS}
SHARE = get_package_share_directory("bot")


def node(name, **more):
    return Node(package="bot", executable="talker", name=name, **more)


def generate_launch_description():
    sim = DeclareLaunchArgument("sim", default_value="false")
    return LaunchDescription([sim, LogInfo(msg=LaunchConfiguration("sim")), ITEM])
"""
ARGUMENT = '<arg name="sim" default="false"/><log message="$(var sim)"/>'
SAME = [
    ('<node pkg="bto" exec="talker" name="a"/>', 'Node(package="bto", executable="talker", name="a")', "PKG001"),
    ('<node pkg="bot" exec="talkr" name="a"/>', 'Node(package="bot", executable="talkr", name="a")', "PKG002"),
    (
        '<node pkg="bot" exec="talker" name="a"><param from="$(find-pkg-share bot)/config/parms.yaml"/></node>',
        'node("a", parameters=[os.path.join(SHARE, "config", "parms.yaml")])',
        "PRM002",
    ),
    (
        '<node pkg="bot" exec="talker" name="a" if="$(var smi)"/>',
        'node("a", condition=IfCondition(LaunchConfiguration("smi")))',
        "ARG001",
    ),
    (
        '<include file="$(find-pkg-share bot)/launch/none.launch.xml"/>',
        'IncludeLaunchDescription(AnyLaunchDescriptionSource(f"{SHARE}/launch/none.launch.xml"))',
        "LCH013",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"><param name="rat" value="5.0"/></node>',
        'node("a", parameters=[{"rat": 5.0}])',
        "PRM013",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"><remap from="chater" to="x"/></node>',
        'node("a", remappings=[("chater", "x")])',
        "TOP004",
    ),
    (
        '<node pkg="bot" exec="talker" name="a"/><node pkg="bot" exec="talker" name="a"/>',
        'Node(package="bot", executable="talker", name="a"), Node(package="bot", executable="talker", name="a")',
        "LCH016",
    ),
]


@pytest.fixture
def harness(tmp_path: Path) -> ReadingHarness:
    return ReadingHarness(tmp_path)


def _found(harness: ReadingHarness, name: str, text: str) -> list[tuple[str, str]]:
    analysis = harness.read(text, name)
    return sorted({(each.rule, each.message) for each in analysis.findings if each.location.file == analysis.root})


@pytest.mark.parametrize(("xml", "python", "rule"), SAME, ids=[rule for *_, rule in SAME])
def test_a_mistake_is_told_as_in_xml(harness: ReadingHarness, xml: str, python: str, rule: str) -> None:
    in_xml = _found(harness, "a.launch.xml", f"<launch>\n{ARGUMENT}\n{xml}\n</launch>\n")
    in_python = _found(harness, "a.launch.py", HEAD.replace("ITEM", python))
    assert in_python == in_xml
    assert rule in [each for each, _ in in_python]


@pytest.mark.parametrize(("loader", "fails"), [("SafeLoader", True), ("UnsafeLoader", False), ("FullLoader", False)])
def test_what_only_a_loader_of_objects_reads_is_no_mistake(harness: ReadingHarness, loader: str, fails: bool) -> None:
    load = f'yaml.load("!!python/tuple [1, 2]", Loader=yaml.{loader}) and Node(package="bot", executable="talker")'
    found = _found(harness, "a.launch.py", "import yaml\n" + HEAD.replace("ITEM", load))
    assert ("LCH032" in [rule for rule, _ in found]) == fails


@pytest.mark.parametrize("text", ["x: 1", "x: !degrees 90"])
def test_a_loader_may_get_tags_of_its_own(harness: ReadingHarness, text: str) -> None:
    """https://github.com/Elite-Robots/Elite_Robots_CS_ROS2_Driver, as many of MoveIt's launch files have it."""
    program = (
        "import yaml\n"
        "def load(text):\n"
        "    try:\n"
        "        yaml.SafeLoader.add_constructor('!degrees', lambda loader, node: 1.5)\n"
        "    except Exception:\n"
        "        raise Exception('yaml support not available')\n"
        "    return yaml.safe_load(text)\n"
    )
    item = f"load('{text}') and Node(package='bot', executable='talker')"
    assert not [
        rule for rule, _ in _found(harness, "a.launch.py", program + HEAD.replace("ITEM", item)) if rule == "LCH032"
    ]


def test_an_exception_is_at_the_line_of_the_name(harness: ReadingHarness) -> None:
    text = (
        "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n    return LaunchDescription([\n"
    )
    analysis = harness.read(f"{text}        talkr,\n    ])\n")
    (found,) = [each for each in analysis.findings if each.rule == "LCH032"]
    document = analysis.documents[analysis.root]
    assert document.lines.position(found.location.span.start)[0] + 1 == 6


def test_a_name_that_is_raised_for_says_which_was_meant(harness: ReadingHarness) -> None:
    analysis = harness.read(
        "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
        "def generate_launch_description():\n    talker = Node(package='bot', executable='talker')\n"
        "    return LaunchDescription([\n        talkr,\n    ])\n"
    )
    text = analysis.documents[analysis.root].text
    (found,) = [each for each in analysis.findings if each.rule in ("LCH032", "LCH043")]
    assert found.message == "NameError: name 'talkr' is not defined; did you mean 'talker'?"
    assert text[slice(*found.location.span)] == "talkr"
    assert [fix.title for fix in found.fixes] == ["Replace 'talkr' with 'talker'"]
