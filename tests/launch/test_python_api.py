"""What is declared of launch's API is what the distributions have, and is found by every name that they give it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from preflight_analysis.launch.python_api import (
    BY_NAME,
    COMMANDS,
    NODES,
    PARAMETERS,
    Call,
    Parameter,
    call_named,
    made_by,
    own_doc,
    parameters,
    positional,
)

LISTS = Path(__file__).parents[2] / "fixtures" / "ros2" / "launch_names"
_DEFAULT = re.compile(r"=(?:'[^']*'|\([^)]*\)|[^,]*)")
_ELSEWHERE = ("launch_ros.descriptions.Parameter",)
OURS_ONLY = ("launch.event_handlers.OnActionEventBase", "launch.event_handler.BaseEventHandler")
"""They are not in the lists, or differ in what no launch file writes."""


def _lists() -> dict[str, dict[str, dict[str, str | None]]]:
    found = {path.stem: json.loads(path.read_text()) for path in LISTS.glob("*.json") if path.stem != "newer"}
    newer = json.loads((LISTS / "newer.json").read_text())
    known = {name: each["names"] for name, each in found.items()}
    return {**known, **{f"{name}, new": each["names"] for name, each in newer.items() if isinstance(each, dict)}}


@pytest.mark.parametrize(
    "call", [each for name, each in BY_NAME.items() if name not in OURS_ONLY], ids=lambda c: c.name
)
def test_a_call_takes_what_it_does_in_the_newest_distribution_that_has_it(call: Call) -> None:
    module = call.name.rpartition(".")[0]
    takes = [names.get(module, {}).get(call.short_name) for names in _lists().values()]
    known = [each for each in takes if each is not None]
    above = next((each for each in BY_NAME.values() if call.inherits and each.short_name == call.of), call)
    assert not known or _DEFAULT.sub("=", above.takes) in known


@pytest.mark.parametrize("call", BY_NAME.values(), ids=lambda c: c.name)
def test_what_newer_distributions_have_alone_is_said_to_be_of_them(call: Call) -> None:
    module = call.name.rpartition(".")[0]
    lists = _lists()
    first = {"jazzy": "jazzy", "rolling": "jazzy", "kilted, new": "kilted", "rolling, new": "rolling"}
    takes = {name: names.get(module, {}).get(call.short_name) for name, names in lists.items()}
    having = [first[name] for name in first if takes.get(name) is not None]
    if takes["humble"] is None and having and call.name not in _ELSEWHERE:
        assert call.since == having[0]
    else:
        assert call.since == ""
    newest = {each.name for each in parameters(call) or ()} if takes["humble"] is not None else set()
    for name in newest & {word.split("=")[0] for word in _DEFAULT.sub("=", call.takes).split(", ")}:
        if name not in {word.rstrip("=") for word in (takes["humble"] or "").split(", ")}:
            assert (own_doc(call, name) or PARAMETERS[name]).endswith("or newer."), name


def test_the_lists_are_looked_at() -> None:
    lists = _lists()
    assert {"humble", "jazzy", "rolling", "kilted, new"} <= lists.keys()
    listed = {f"{module}.{name}" for names in lists.values() for module, found in names.items() for name in found}
    assert len(BY_NAME.keys() & listed) > 80


def test_what_a_class_hands_on_is_that_of_the_class_above() -> None:
    names = [each.name for each in parameters(BY_NAME["launch_ros.actions.ComposableNodeContainer"]) or ()]
    assert names[:3] == ["name", "namespace", "composable_node_descriptions"]
    assert {"executable", "additional_env", "respawn", "condition"} <= set(names)
    assert not {"cmd", "process_description"} & set(names)
    assert positional(BY_NAME["launch_ros.actions.SetRemap"]) == ("src", "dst")
    assert parameters(BY_NAME["launch.substitutions.AnySubstitution"]) is None
    assert parameters(BY_NAME["launch.conditions.UnlessCondition"]) == (Parameter("predicate_expression", None, True),)


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("launch.actions.LogInfo", "launch.actions.LogInfo"),
        ("launch.actions.log_info.LogInfo", "launch.actions.LogInfo"),
        ("launch.action.Action", "launch.Action"),
        ("launch.launch_description.LaunchDescription", "launch.LaunchDescription"),
        ("launch_ros.parameter_descriptions.ParameterValue", "launch_ros.descriptions.ParameterValue"),
        ("launch.event_handlers.EventHandler", "launch.EventHandler"),
        ("ament_index_python.get_package_prefix", "ament_index_python.packages.get_package_prefix"),
        ("launch.actions.Node", None),
        ("other.launch.actions.LogInfo", None),
        ("subprocess.Command", None),
        ("Node", None),
        ("", None),
    ],
)
def test_a_call_is_found_by_each_name_of_its_module(name: str, found: str | None) -> None:
    call = call_named(name)
    assert (call.name if call is not None else None) == found


def test_what_makes_an_action_and_what_it_is_called_elsewhere() -> None:
    assert made_by("executable").short_name == "ExecuteProcess"
    assert made_by("nothing").name == ""
    assert NODES["ComposableLifecycleNode"] == "composable_node"
    assert COMMANDS["get_package_share_directory"] == COMMANDS["FindPackageShare"] == "find-pkg-share"
    assert "FindPackage" not in COMMANDS
