"""LCH017: a node on a machine that is not declared."""

import pytest
from support.check import findings_of
from support.fixes import fixed, unfixable


def test_a_machine_gets_the_name_of_the_nearest() -> None:
    machine = '<machine name="base" address="localhost"/>'
    node = '<node pkg="p" type="t" name="n" machine="{}"/>'
    assert fixed(machine + node.format("bsae"), "LCH017") == machine + node.format("base")
    assert unfixable(machine + node.format("arm"), "LCH017")


def test_a_machine_that_is_not_declared() -> None:
    (finding,) = findings_of("""
        <launch>
          <machine name="base" address="localhost"/>
          <node pkg="p" type="t" name="n" machine="bse"/>
        </launch>
    """)
    assert finding.rule == "LCH017"
    assert finding.message == "machine 'bse' is not declared; did you mean 'base'?"


@pytest.mark.silent
@pytest.mark.parametrize(
    "hidden",
    [
        '<group if="$(env UNSET)"><machine name="base" address="a"/></group>',
        '<machine unless="$(env UNSET)" name="base" address="a"/>',
        '<machine name="$(env UNSET)" address="a"/>',
    ],
)
def test_a_machine_that_may_be_declared_where_nobody_can_look(hidden: str) -> None:
    launch = f'<launch>{hidden}<node pkg="p" type="t" name="n" machine="base"/></launch>'
    assert [f.rule for f in findings_of(launch)] == ["LCH012"]
