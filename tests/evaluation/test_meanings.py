"""What the parameters of nodes stand for."""

from typing import Any

import pytest
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.meanings import Known, KnownMeanings, meant_by
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.knowledge.read import read_knowledge
from support.check import analyse, read_fixture

NOWHERE = Location.of_file("/a.yaml")
EVERY = KnownMeanings((), None, 2)


def meant(parameters: str, **given: Any) -> list[tuple[str, Any, str | None, bool]]:
    """Parameter, value, type and whether that is set, of each value that means something. `__` stands for a dot."""
    said = read_knowledge(f"package: p\nentries:\n- executables: [e]\n  parameters: {parameters}")
    assert not said.problems
    known = Known(said.entries[0], "p", "", True)
    names = {name.replace("__", "."): value for name, value in given.items()}
    params = [(name, Param(name, value, (NOWHERE,))) for name, value in names.items()]
    return [(each.parameter, each.value, each.type, each.param is not None) for each in meant_by(known, params, EVERY)]


def test_a_number_in_the_name() -> None:
    found = meant(
        "{odom{N}: {topic: subscriber, type: a/B}}".replace("odom{N}", '"odom{N}"'), odom0="x", odom12="y", odom="z"
    )
    assert found == [("odom0", "x", "a/B", True), ("odom12", "y", "a/B", True)]


def test_any_name() -> None:
    assert meant('{"*.topic": {topic: subscriber}}', a__topic="x", a__b__topic="y") == [("a.topic", "x", None, True)]


def test_what_a_list_names() -> None:
    asked = '{"{sources}.topic": {topic: subscriber, default: scan}}'
    given = {"a__topic": "x", "c__topic": "z"}
    assert meant(asked, sources=["a", "b"], **given) == [("a.topic", "x", None, True), ("b.topic", "scan", None, False)]
    assert meant(asked, sources="a b", **given) == [("a.topic", "x", None, True), ("b.topic", "scan", None, False)]


def test_what_a_list_below_any_name_names() -> None:
    asked = '{"map.*.{sources}.topic": {topic: subscriber}}'
    given = {"map__layer__sources": "front", "map__layer__front__topic": "x", "map__layer__rear__topic": "y"}
    assert meant(asked, **given) == [("map.layer.front.topic", "x", None, True)]


def test_the_items_of_a_list_and_what_is_within() -> None:
    items = [("joints", "a", None, True), ("joints", "b", None, True)]
    assert meant("{joints: {joint: read}}", joints=["a", "b"]) == items
    rows = [{"name": "joy", "topic": "joy_vel"}, {"name": "nav", "topic": "nav_vel"}]
    assert [value for _, value, _, _ in meant('{"topics.*.topic": {topic: subscriber}}', topics=rows)] == [
        "joy_vel",
        "nav_vel",
    ]


@pytest.mark.parametrize(
    ("type_", "given", "expected"),
    [
        ("{./kind: {scan: a/B, cloud: c/D}}", {"x__kind": "Cloud"}, "c/D"),
        ("{./kind: {scan: a/B}}", {}, None),
        ("$./kind", {"x__kind": "a/B"}, "a/B"),
        ("{stamped: {'true': a/B}}", {"stamped": True}, "a/B"),
    ],
)
def test_a_type_that_another_parameter_gives(type_: str, given: dict[str, Any], expected: str | None) -> None:
    asked = f'{{"*.topic": {{topic: subscriber, type: {type_}}}}}'
    assert meant(asked, x__topic="t", **given) == [("x.topic", "t", expected, True)]


@pytest.mark.parametrize(
    ("when", "given", "holds"),
    [
        ("{tf: true}", {"tf": True}, True),
        ("{tf: true}", {"tf": False}, False),
        ("{tf: true}", {}, False),
        ("{world: $odom}", {"world": "odom", "odom": "odom"}, True),
        ("{world: $odom}", {"world": "map", "odom": "odom"}, False),
        ('{period: "!0.0"}', {"period": 0.5}, True),
        ("{mode: [a, b]}", {"mode": "b"}, True),
    ],
)
def test_a_condition(when: str, given: dict[str, Any], holds: bool) -> None:
    assert bool(meant(f"{{x: {{frame: used, when: {when}}}}}", x="f", **given)) is holds


def test_a_default_may_be_that_of_another_parameter() -> None:
    asked = "{odom: {frame: used, default: odom}, world: {frame: used, default: $odom}}"
    assert meant(asked, odom="o") == [("odom", "o", None, True), ("world", "o", None, False)]


@pytest.mark.parametrize(
    ("package", "name", "distro", "used"),
    [
        ("robot_localization", "ekf_node", "rolling", True),
        # What several distributions have alike one that is not known has, too.
        ("robot_localization", "ekf_node", "dashing", True),
        ("robot_localization", "ekf_node", None, True),
        ("nav2_behaviors", "behavior_server", "jazzy", True),
        ("nav2_behaviors", "behavior_server", "rolling", False),
    ],
)
def test_whether_it_is_of_the_version_that_is_used(package: str, name: str, distro: str | None, used: bool) -> None:
    found = KnownMeanings((), distro, 2).of(package, "executables", name)
    assert found is not None
    assert found.is_used is used


def test_a_default_within_a_text_needs_its_value() -> None:
    asked = '{out: {topic: publisher, default: "${in}_relay"}}'
    assert meant(asked, **{"in": "scan"}) == [("out", "scan_relay", None, False)]
    assert meant(asked) == []


def test_a_name_that_is_always_the_same_with_a_text_behind_it() -> None:
    asked = '{=in: [{topic: subscriber, when: {t: raw}}, {topic: subscriber, append: "/${t}", when: {t: "!raw"}}]}'
    said = read_knowledge(f"package: p\nentries:\n- executables: [e]\n  parameters: {asked}")
    known = Known(said.entries[0], "p", "", True)

    def names(transport: str) -> list[str]:
        params = [("t", Param("t", transport, (NOWHERE,)))]
        return [f"{each.value}{each.append}" for each in meant_by(known, params, EVERY)]

    assert names("raw") == ["in"]
    assert names("theora") == ["in/theora"]


def test_what_is_given_for_a_type_and_is_none() -> None:
    asked = "{x: {topic: publisher, type: $kind}}"
    assert meant(asked, x="/t", kind="std_msgs/Bool") == [("x", "/t", "std_msgs/Bool", True)]
    assert meant(asked, x="/t", kind="{data: 1}") == []


def test_a_node_that_had_another_name() -> None:
    text = '//- /a.launch.xml\n<launch><node pkg="ros_ign_gazebo" exec="create" name="c"/></launch>'
    tree = analyse(read_fixture(text)).tree
    found = KnownMeanings((), "jazzy", 2).of_node(tree.nodes[0])
    assert found is not None
    assert (found.package, found.is_used) == ("ros_gz_sim", False)


def test_a_package_of_the_other_generation() -> None:
    assert KnownMeanings((), "noetic", 1).of("nav2_amcl", "executables", "amcl") is None


def test_the_users_own_file_counts_first() -> None:
    own = read_knowledge("package: nav2_amcl\nentries: [{executables: [amcl], parameters: {x: {frame: used}}}]")
    found = KnownMeanings((own,), "jazzy", 2).of("nav2_amcl", "executables", "amcl")
    assert found is not None
    assert [each.pattern for each in found.entry.meanings] == ["x"]
