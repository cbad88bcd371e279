"""A condition of a Python launch file that is not known: both branches are read, what they make depends on it, and what
they give differently is not known."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from preflight_analysis.evaluation.ros2.python_branches import together
from preflight_analysis.queries.symbols import symbols
from preflight_analysis.workspace.workspace import Analysis
from support.reading_harness import IMPORTS, ReadingHarness

HEAD = f"""{IMPORTS}
unknown = os.environ["NOT_SET_ANYWHERE"]


def n(name, **more):
    return Node(package="bot", executable="talker", name=name, **more)


"""


@pytest.fixture
def harness(tmp_path: Path) -> ReadingHarness:
    return ReadingHarness(tmp_path)


def _names(analysis: Analysis) -> list[str]:
    return [node.name for node in analysis.tree.nodes]


def _left_out(analysis: Analysis) -> list[tuple[str, str, list[str]]]:
    """Names of the actions that are left out, with their conditions."""
    return [
        (each.condition, each.written.text, [v.text for c in each.action.walk() if (v := c.value("name")) is not None])
        for each in analysis.tree.not_taken
    ]


def _said(analysis: Analysis, rule: str) -> list[tuple[str, str, str]]:
    """The findings of a rule in the launch file: confidence, the word that it stands at, and their condition."""
    text = analysis.documents[analysis.root].text
    found = [each for each in analysis.findings if each.rule == rule and each.location.file == analysis.root]
    return [(each.confidence, text[slice(*each.location.span)], each.condition) for each in found]


def test_what_each_branch_makes_depends_on_the_condition(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def generate_launch_description():
    ld = LaunchDescription([n("always")])
    if unknown == "r1":
        ld.add_action(Node(package="bto", executable="talker", name="one"))
    else:
        ld.add_action(Node(package="bot", executable="talkr", name="other"))
    return ld
"""
    )
    assert _names(analysis) == ["/always", "/other"]
    assert _left_out(analysis) == [("if", "$(unknown == 'r1')", ["one"])]
    assert _said(analysis, "PKG001") == [("possible", "bto", "unknown == 'r1' is true")]
    assert _said(analysis, "PKG002") == [("likely", "talkr", "unknown == 'r1' is false")]


WAYS = {
    "early return": 'if unknown == "r1":\n        return LaunchDescription([n("one")])\n    found = [n("other")]',
    "an expression": 'found = [n("one") if unknown == "r1" else n("other")]',
    "and": 'found = [n("other"), *((unknown == "r1" and [n("one")]) or [])]',
    "or": 'found = [n("other"), *([] if (False or unknown != "r1") else [n("one")])]',
    "not in": 'found = [n("other")]\n    if not (unknown not in ("r2", "r3")):\n        found += [n("one")]',
    "a comprehension": 'found = [n(name) for name in ("r1", "other") if name == "other" or unknown.endswith(name)]',
    "a function": 'def is_one():\n        return unknown == "r1"\n    found = [n("other")] + [n("one")] * is_one()',
    "a match": 'found = [n("other")]\n    match unknown:\n        case "r1":\n            found.append(n("one"))',
    "a collection": 'import no_such as m\n    found = [n("other"), *(n("one") for each in m.robots())]',
}


@pytest.mark.parametrize("way", WAYS)
def test_ways_to_ask(harness: ReadingHarness, way: str) -> None:
    analysis = harness.read(
        f"{HEAD}def generate_launch_description():\n    {WAYS[way]}\n    return LaunchDescription(found)\n"
    )
    names = {name for *_, left_out in _left_out(analysis) for name in left_out}
    assert names or any(each.reason == "the actions here depend on it" for each in analysis.tree.unknowns)
    assert len({*names, *(name.lstrip("/") for name in _names(analysis))}) == 2


def test_what_the_branches_set_otherwise_is_not_known(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def generate_launch_description():
    name, rate, same = "a", 1.0, "same"
    remaps = [("chatter", "a")]
    if unknown == "r1":
        name, rate, same = "b", 2.0, "same"
        remaps.append(("x", "y"))
    return LaunchDescription([
        SetLaunchConfiguration("mode", name), SetLaunchConfiguration("same", same),
        n("last", namespace=name, parameters=[{{"rate": rate, "kept": 1, same: 2}}], remappings=remaps),
        n(LaunchConfiguration("mode")), n(LaunchConfiguration("same")),
    ])
"""
    )
    last, mode, same = analysis.tree.nodes
    assert last.unknowns and mode.unknowns
    assert (same.name, same.unknowns) == ("/same", ())
    assert {param.name.rpartition("/")[2] for param in last.params if param.name} == {"kept", "same"}
    assert {each.what for each in analysis.tree.unknowns if not each.decides} == {"unknown == 'r1'"}


def test_a_condition_that_only_another_branch_meets(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def start(context):
    robot = LaunchConfiguration("robot").perform(context)
    if robot == "r1":
        if unknown == "x":
            return [n("r1x")]
        return [n("r1")]
    elif robot == "r2":
        return [n("r2")]
    return [n("none")]


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument("robot"), OpaqueFunction(function=start)])
"""
    )
    assert _names(analysis) == ["/none"]
    names = [name for *_, left_out in _left_out(analysis) for name in left_out]
    assert sorted(names) == ["r1", "r1x", "r2"]


def test_code_that_only_the_other_branch_runs(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def start(context):
    return [n("one"), Node(package="bto", executable="talker", name="two")]


def generate_launch_description():
    more = [OpaqueFunction(function=start)] if unknown == "r1" else []
    return LaunchDescription([n("always"), *more])
"""
    )
    assert _names(analysis) == ["/always"]
    assert _said(analysis, "PKG001") == [("possible", "bto", "unknown == 'r1' is true")]


def test_code_sees_what_its_branch_set(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def start(context):
    return [n(NAME)]


def generate_launch_description():
    global NAME
    NAME = "a" if unknown == "r1" else "b"
    return LaunchDescription([OpaqueFunction(function=start)])
"""
    )
    (node,) = analysis.tree.nodes
    assert node.unknowns


def test_what_a_helper_makes_for_others_too_depends_on_nothing(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD.replace('"bot"', '"bto"')}def generate_launch_description():
    more = [n("one")] if unknown == "r1" else [n("other")]
    return LaunchDescription([n("always"), *more])
"""
    )
    assert [condition for *_, condition in _said(analysis, "PKG001")] == [""]


def test_many_conditions_have_a_bound(harness: ReadingHarness) -> None:
    asked = "".join(f'    if unknown == "r{i}":\n        found.append(n("n{i}"))\n' for i in range(40))
    analysis = harness.read(
        f"{HEAD}def generate_launch_description():\n    found = []\n{asked}    return LaunchDescription(found)\n"
    )
    assert 1 < len(analysis.tree.not_taken) <= 8
    assert len([each for each in analysis.tree.unknowns if each.decides]) == 40


def test_the_outline_has_what_each_branch_makes_as_it_is_written(harness: ReadingHarness) -> None:
    analysis = harness.read(
        f"""{HEAD}def generate_launch_description():
    path = os.path.join(get_package_share_directory("bot"), "launch", "a.launch.xml")
    found = [IncludeLaunchDescription(path)]
    if unknown == "r1":
        found.append(Node(package="bot", executable="talker", name="one"))
    else:
        found.append(Node(package="bot", executable="talker", name=LaunchConfiguration("name")))
    return LaunchDescription(found)
"""
    )
    names = {each.name for each in symbols(analysis.launch_files[analysis.root])}
    assert names >= {"one", 'LaunchConfiguration("name")'}
    assert not any("$(" in f"{each.name} {each.detail}" for each in symbols(analysis.launch_files[analysis.root]))


def test_what_is_no_answer_is_left_out() -> None:
    for branches in (None, 1, ["x"], [{}], [{"if": 1}], [{"if": "a", "actions": [1, {"k": 2}], "set": [1], "env": 3}]):
        answer = {"actions": [{"k": "node", "n": "Node", "p": [1, 2], "a": {}, "c": []}], "set": {"a": "b"}}
        found = together(answer, branches, callable=True)
        assert json.dumps(found["actions"]).count('"Node"') == 1
