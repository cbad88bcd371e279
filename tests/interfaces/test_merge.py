"""What sources of knowledge say of a node comes together."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.interfaces.merge import with_part
from preflight_analysis.interfaces.part import Part
from preflight_analysis.tracing.interface import (
    NOT_RUN,
    Endpoint,
    Evidence,
    Interface,
    Outcome,
    ParamUse,
    Source,
    together,
)
from support.package_elsewhere import analysed

SCAN = Endpoint("publisher", "scan", "sensor_msgs/LaserScan")
STATUS = Endpoint("publisher", "~status", None)
RATE = ParamUse("~rate", "get", 10, True)
SPUN = Interface("trace", Outcome("spinning"), (SCAN,))
CRASHED = replace(SPUN, outcome=Outcome("crashed", exit_code=1))


def test_a_part_adds_what_was_not_seen_and_says_from_where() -> None:
    known = with_part("/n", CRASHED, Part("source", (SCAN, STATUS), (RATE,), closed=("topics",)))
    assert known.source == "source"
    assert [(end.name, end.evidence.source) for end in known.endpoints] == [("scan", "trace"), ("~status", "source")]
    assert [(use.name, use.evidence.source) for use in known.params] == [("~rate", "source")]
    assert known.tells_all("topics")
    assert not known.tells_all("topics", "parameters")
    assert known.outcome == CRASHED.outcome


def test_a_name_is_the_same_however_it_is_written() -> None:
    same = (replace(SCAN, name="/robot/scan"), replace(STATUS, name="/robot/n/status", type="std_msgs/String"))
    known = with_part("/robot/n", replace(CRASHED, endpoints=(SCAN, STATUS)), Part("catalogue", same))
    assert [(end.name, end.type) for end in known.endpoints] == [
        ("scan", "sensor_msgs/LaserScan"),
        ("~status", "std_msgs/String"),
    ]


def test_details_do_not_decide_where_the_node_is_known_from() -> None:
    known = with_part("/n", CRASHED, Part("catalogue", (STATUS,), leads=False))
    assert (known.source, known.endpoints[1].evidence.source) == ("trace", "catalogue")
    assert with_part("/n", NOT_RUN, Part("catalogue", (STATUS,), leads=False)).source == "catalogue"


@pytest.mark.parametrize(("source", "after"), [("source", "trace"), ("similar", "trace"), ("settings", "settings")])
def test_who_adds_nothing_to_all_that_is_known_leaves_it_a_run_but_for_the_word_of_the_user(
    source: Source, after: Source
) -> None:
    answered = replace(SPUN, outcome=Outcome("spinning", answers=("a service",)))
    assert with_part("/n", answered, Part(source, (SCAN,))).source == after


def test_what_is_known_is_corrected_or_taken_away() -> None:
    corrected = ((SCAN, None), (STATUS, replace(STATUS, source_line=3)))
    known = replace(CRASHED, endpoints=(SCAN, STATUS))
    moved = replace(SCAN, name="/n2/scan")
    whole = with_part("/n", known, Part("catalogue", (moved,), corrected=corrected, leads=False))
    assert [(end.name, end.source_line) for end in whole.endpoints] == [("~status", 3), ("/n2/scan", None)]


def test_transitions_of_a_run_and_of_the_source_count() -> None:
    known = with_part(
        "/n", replace(SPUN, transitions=("configure",)), Part("source", transitions=("activate",), leads=False)
    )
    assert known.transitions == ("activate", "configure")


def test_a_whole_is_as_sure_as_its_least_sure_part() -> None:
    seen, read = Evidence().but("on demand"), Evidence("source").but("condition")
    assert together((seen, read)) == Evidence("source", doubts=("condition", "on demand"))
    assert together((seen, seen.without("on demand"))).uncertain


def test_an_annotation_is_all_that_a_node_does_whatever_its_parameters_name(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="robot_localization" type="ekf_localization_node" name="ekf">
        {annotation}
        <param name="odom3" value="/odom"/>
      </node>
    </launch>
    """
    names = []
    for annotation in ("", '<!-- <topics><topic name="imu" type="sensor_msgs/Imu" class="sub"/></topics> -->'):
        folder = tmp_path / str(len(names))
        folder.mkdir()
        graph = analysed(folder, launch.format(annotation=annotation), distro="noetic").graph
        assert graph is not None
        names.append({end.name for end in graph.interfaces[0].endpoints})
    assert "/odom" in names[0]
    assert names[1] == {"imu"}
