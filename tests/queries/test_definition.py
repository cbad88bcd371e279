"""Go to definition across files and into the nodes' sources."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.queries.definition import definition
from support.workspace_harness import create_workspace


def gone_to(tmp_path: Path, text: str) -> list[str]:
    workspace = create_workspace(tmp_path, text)
    return [workspace.shown(target.location) for target in definition(workspace.context, workspace.offset, ())]


def test_an_argument_that_is_passed_leads_into_the_included_file(tmp_path: Path) -> None:
    text = """
        <launch>
          <include file="{folder}/inc.launch"%s><arg name="$0rate" value="1"/></include>
        </launch>
        //- inc.launch
        <launch>
          <arg name="rate"/>
        </launch>
        """
    assert gone_to(tmp_path / "a", text % "") == ["inc.launch:2 rate"]
    assert gone_to(tmp_path / "b", text % ' if="false"') == ["inc.launch:2 rate"]


def test_what_is_not_evaluated_goes_by_its_text(tmp_path: Path) -> None:
    text = """
        <launch>
          <arg name="rate"/>
          <group if="false">
            <include file="{folder}/%sinc.launch"/>
            <param name="a" value="$(arg %srate)" textfile="$(find %sp)/x"/>
          </group>
        </launch>
        //- inc.launch
        <launch/>
        //- p/package.xml
        <package/>
        """
    expected = ["inc.launch:1", "main.launch:2 rate", "p/package.xml:1"]
    for number, wanted in enumerate(expected):
        cursors = tuple("$0" if n == number else "" for n in range(3))
        assert gone_to(tmp_path / str(number), text % cursors) == [wanted]


def test_a_script_and_what_is_built(tmp_path: Path) -> None:
    text = """
        <launch>
          <node pkg="p" type="%sscript.py" name="a"/>
          <node pkg="p" type="%sdriver" name="b"/>
          <node pkg="p" type="%snothing" name="c"/>
          <node pkg="p" type="%sp_other" name="d"/>
        </launch>
        //- p/package.xml
        <package/>
        //- p/scripts/script.py
        #!/usr/bin/env python3
        //- p/CMakeLists.txt
        # add_executable(driver old.cpp)
        add_executable( ${PROJECT_NAME}_other other.cpp)
        add_executable(driver
          driver.cpp)
        //- p/other.cpp
        int main() {}
        """
    other = ["p/other.cpp:1", "p/CMakeLists.txt:2 ${PROJECT_NAME}_other"]
    expected = [["p/scripts/script.py:1"], ["p/CMakeLists.txt:3 driver"], [], other]
    for number, wanted in enumerate(expected):
        cursors = tuple("$0" if n == number else "" for n in range(4))
        assert gone_to(tmp_path / str(number), text % cursors) == wanted


def test_a_machine(tmp_path: Path) -> None:
    text = """
        <launch>
          <machine name="base" address="localhost"/>
          <node pkg="p" type="t" name="t" machine="ba$0se"/>
        </launch>
        """
    assert gone_to(tmp_path, text) == ['main.launch:2 <machine name="base" address="localhost"/>']


@pytest.mark.parametrize(
    ("cursor", "wanted"),
    [
        (0, ['p/scripts/t.py:1 pub = Publisher("out")']),
        (1, ['p/scripts/l.py:1 sub = Subscriber("in")', 'main.launch:5 <node pkg="p" type="l" name="annotated">']),
        (2, ['p/scripts/t.py:2 rate = get_param("~rate")']),
    ],
)
def test_remaps_and_parameters_lead_to_the_sources(tmp_path: Path, cursor: int, wanted: list[str]) -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="talker"><remap from="%sout" to="%schatter"/></node>
          <node pkg="p" type="l" name="listener"><remap from="in" to="/chatter"/></node>
          <param name="/talker/%srate" value="1"/>
          <node pkg="p" type="l" name="annotated">
            <!-- <topics><topic name="chatter" type="std_msgs/String" class="sub"/></topics> -->
          </node>
        </launch>
        //- p/scripts/t.py
        pub = Publisher("out")
        rate = get_param("~rate")
        //- p/scripts/l.py
        sub = Subscriber("in")
        //- interfaces
        {"/talker": {"publishers": {"out": "std_msgs/String"}, "params": {"~rate": 10},
                     "made": {"out": ["{folder}/p/scripts/t.py", 1], "~rate": ["{folder}/p/scripts/t.py", 2]}},
         "/listener": {"subscribers": {"in": "std_msgs/String"}, "made": {"in": ["{folder}/p/scripts/l.py", 1]}}}
        """
    assert gone_to(tmp_path, text % tuple("$0" if n == cursor else "" for n in range(3))) == wanted
