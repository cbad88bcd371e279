"""PRM003: a parameter file that cannot be read."""

from pathlib import Path

import pytest
from support.check import check, findings_of


def test_a_parameter_file_that_is_a_folder(tmp_path: Path) -> None:
    (finding,) = findings_of(f'<launch><param name="a" textfile="{tmp_path}"/></launch>')
    assert finding.rule == "PRM003"


def test_a_parameter_file_whose_path_is_empty() -> None:
    """It is the current folder: launch warns that it is no file, and goes on."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="params_file" default=""/>
          <node pkg="p" exec="a" name="a"><param from="$(var params_file)"/></node>
                                                       ^^^^^^^^^^^^^^^^^^ info[PRM003] parameter file '' cannot be read: argument 'params_file' is empty
        </launch>
    """)  # noqa: E501


@pytest.mark.silent
def test_parameter_files_that_can_be_read() -> None:
    check("""
        <launch>
          <rosparam file="/a.yaml"/>
          <param name="text" textfile="/a.yaml"/>
        </launch>
        //- /a.yaml
        a: 1
    """)
