"""Calls of launch in Python launch files: keywords are proposed, and their signature is shown, while they are typed."""

from __future__ import annotations

import pytest
from preflight_analysis.evaluation.ros2.actions.registry import tags
from preflight_analysis.launch.python_api import BY_NAME, PARAMETERS, Call, parameters
from preflight_analysis.queries.call_python import complete_keywords, signature_of_call
from preflight_analysis.queries.signature_items import Signature

IMPORTS = """\
import launch
import launch_ros.actions as ros
from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,  # with a comment
    ExecuteProcess as Run,
)
from launch_ros.actions import Node
from subprocess import Command
"""


def proposed(text: str) -> list[str] | None:
    """The labels at `$0` in what follows the imports."""
    text = IMPORTS + text
    found = complete_keywords(text.replace("$0", ""), text.index("$0"))
    return None if found is None else [item.label for item in found.items]


def result(text: str, label: str) -> str:
    """The text with a proposal taken."""
    offset, text = text.index("$0"), text.replace("$0", "")
    found = complete_keywords(text, offset)
    assert found is not None
    item = next(item for item in found.items if item.label == label)
    return text[: found.span.start] + item.text + text[found.span.end :]


def shown(text: str) -> Signature | None:
    text = IMPORTS + text
    return signature_of_call(text.replace("$0", ""), text.index("$0"))


def active(text: str) -> str | None:
    found = shown(text)
    assert found is not None
    return None if found.active is None else found.parameters[found.active].name


def test_the_keywords_of_a_node_those_first_that_have_to_be() -> None:
    found = proposed("Node($0)")
    assert found is not None
    assert found[:4] == ["executable", "package", "name", "namespace"]
    assert {"parameters", "remappings", "arguments", "output", "respawn", "additional_env", "condition"} < set(found)
    assert not {"cmd", "process_description"} & set(found), "which it gives itself"
    assert len(set(found)) == len(found)


def test_what_is_given_already_is_not_proposed() -> None:
    found = proposed("Node(package='p', ex$0, name='n')")
    assert found is not None
    assert "executable" in found
    assert not {"package", "name"} & set(found)


@pytest.mark.parametrize(
    "text",
    [
        "Node($0",
        "Node(package='p', $0",
        "Node(package='p',\n     $0\n     Node(package='q'),\n])",
        "LaunchDescription([\n    Node(\n        pa$0\n",
        "x = ros.Node($0)",
        "launch.actions.ExecuteProcess($0)",
        "Run(cmd=['a'], $0)",
        "Node(package='p',  # (\n     $0)",
        "LifecycleNode($0)",
        "Node(parameters=[{'a': (1, 2)}], $0)",
    ],
)
def test_half_typed_ones(text: str) -> None:
    found = proposed(text)
    assert found is not None and {"condition", "output"} <= set(found)


@pytest.mark.parametrize(
    "text",
    [
        "Node(package='$0')",
        "Node(package='p$0",
        "Node(package=$0)",
        "Node(name=fo$0)",
        "Node(parameters=[$0])",
        "Node(parameters=[{'a': $0}])",
        "Node(package=f($0))",
        "Node(1 + $0)",
        "Node()$0",
        "Node(  # $0\n)",
        "Command($0)",
        "unknown($0)",
        "self.Node($0)",
        "($0)",
        "$0",
        "ThisLaunchFileDir($0)",
    ],
)
def test_silence_elsewhere(text: str) -> None:
    assert proposed(text) is None


def test_what_is_written() -> None:
    assert result("Node(pa$0)", "package") == "Node(package=)"
    assert result("Node(pa$0 = 'p')", "package") == "Node(package = 'p')"
    assert result("Node(pa$0x='p')", "package") == "Node(package='p')"
    assert result("Node(a=1,$0)", "package") == "Node(a=1,package=)"


def test_a_keyword_says_what_it_is() -> None:
    found = complete_keywords("Node()", 5)
    assert found is not None
    said = {item.label: (item.detail, item.doc) for item in found.items}
    assert said["executable"] == ("required", "The executable of the package.")
    assert said["exec_name"] == ("= None", "What the process is called in the logs.")
    assert said["on_exit"][1].startswith("The actions that are executed when the process ends")


def test_the_signature_of_a_declaration() -> None:
    found = shown("DeclareLaunchArgument('a', default_value='b$0')")
    assert found is not None
    assert found.label == (
        "DeclareLaunchArgument(name, *, default_value=None, description=None, choices=None, condition=None)"
    )
    assert [found.label[p.start : p.end] for p in found.parameters][:2] == ["name", "default_value=None"]
    assert found.doc == "Declares an argument of this file; inside of an `<include>`: passes one on."
    assert found.parameters[1].doc == "The value where none is given. Without it one has to be."


def test_the_parameter_that_is_being_written() -> None:
    assert active("DeclareLaunchArgument($0") == "name"
    assert active("DeclareLaunchArgument('a$0', default_value='b')") == "name"
    assert active("DeclareLaunchArgument('a', $0)") is None
    assert active("DeclareLaunchArgument('a', default_value='b', choices=['a', $0'b'])") == "choices"
    assert active("Node(package='p', remappings=[('a', 'b$0')])") == "remappings"
    assert active("Node(package='p', executable='$0") == "executable"
    assert active("Node($0") is None
    assert active("Node(nonsense=$0)") is None
    assert active("SetRemap('a', $0)") == "dst"


def test_the_innermost_call_counts() -> None:
    found = shown("LaunchDescription([Node(parameters=[LaunchConfiguration($0)])])")
    assert found is not None and found.label == "LaunchConfiguration(variable_name, *, default=None)"
    found = shown("LaunchDescription([Node(), $0])")
    assert found is not None and found.label.startswith("LaunchDescription(initial_entities=None")
    assert shown("Node(parameters=[f($0)])") is None


@pytest.mark.parametrize("call", BY_NAME.values(), ids=BY_NAME)
def test_each_call_and_each_parameter_says_what_it_is(call: Call) -> None:
    found = shown(f"{call.name.split('.')[0]}.{call.name.partition('.')[2]}($0")
    if not parameters(call):
        return
    assert found is not None
    for doc in (found.doc, *(each.doc for each in found.parameters)):
        assert doc.endswith((".", "`.", ")`.")), doc


def test_what_is_said_of_parameters_is_said_of_some() -> None:
    taken = {each.name for call in BY_NAME.values() for each in parameters(call) or ()}
    classes = {call.short_name: {each.name for each in parameters(call) or ()} for call in BY_NAME.values()}
    for name in PARAMETERS:
        owner, _, parameter = name.rpartition(".")
        assert parameter in (classes[owner] if owner else taken), name
    assert tags()["node"].attributes["exec"].doc not in PARAMETERS.values()
