"""What lost against a later setting is kept with the one that won."""

from preflight_analysis.evaluation.tree import LaunchTree
from support.check import analyse, read_fixture


def tree(text: str) -> LaunchTree:
    return analyse(read_fixture(text)).tree


def test_a_remap_keeps_those_it_replaces_in_its_own_scope_and_around_it() -> None:
    (node,) = tree("""
        <launch>
          <remap from="a" to="first"/>
          <remap from="a" to="second"/>
          <remap from="b" to="other"/>
          <node pkg="p" type="t" name="n"><remap from="a" to="third"/></node>
        </launch>
    """).nodes
    assert [(r.source, r.target) for r in node.remaps] == [("b", "other"), ("a", "third")]
    assert [[old.target for old in r.replaces] for r in node.remaps] == [[], ["first", "second"]]


def test_a_private_parameter_keeps_those_it_replaces() -> None:
    params = tree("""
        <launch>
          <param name="~rate" value="1"/>
          <node pkg="p" type="t" name="n">
            <rosparam>{rate: 2}</rosparam>
            <param name="rate" value="3"/>
            <param name="rate" value="4"/>
          </node>
        </launch>
    """).params
    assert {name: (p.value, [old.value for old in p.overrides]) for name, p in params.items()} == {
        "/n/rate": (4, [2, 1, 3])
    }


def test_clear_params_is_noted_with_its_namespace() -> None:
    uses = tree('<launch><group ns="a" clear_params="true"/><group ns="b" clear_params="false"/></launch>').uses
    assert [(use.name, use.value) for use in uses if use.kind == "clear_params"] == [("true", "/a/")]
