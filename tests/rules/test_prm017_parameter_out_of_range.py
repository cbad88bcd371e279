"""PRM017: a parameter outside of the range that its node declares (ROS 2)."""

import pytest
from support.check import check


def test_a_parameter_out_of_its_range() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="11"/>
                         ^^^^ error[PRM017] parameter 'rate' is 11, out of range: /a declares 0 to 10 and exits
            <param name="even" value="3"/>
                         ^^^^ error[PRM017] parameter 'even' is 3, between the steps: /a declares 0 to 10 in steps of
            <param name="last" value="10"/>
            <param name="part" value="0.3"/>
            <param name="over" value="1.01"/>
                         ^^^^ error[PRM017] parameter 'over' is 1.01, out of range: /a declares 0.0 to 1.0 and exits
            <param name="fixed" value="3"/>
            <param name="any" value="3"/>
            <param name="dense" value="3.3"/>
          </node>
        </launch>
        //- interfaces
        {"/a": {"params": {"~rate": 5, "~even": 2, "~last": 0, "~part": 0.1, "~over": 1.0, "~fixed": 1, "~any": 1,
                           "~dense": 1.0},
                "described": {"~rate": {"range": [0, 10]}, "~even": {"range": [0, 10, 2]},
                              "~last": {"range": [0, 10, 3]},
                              "~part": {"range": [0.0, 1.0, 0.1], "type": "double"}, "~fixed": {"read_only": true},
                              "~over": {"range": [0.0, 1.0]}, "~any": {"dynamic": true, "range": [0, 1]},
                              "~dense": {"range": [0.0, 10.0, 1e-320]}}}}
    """)


@pytest.mark.silent
def test_parameters_in_their_range() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param name="last" value="10"/>
            <param name="step" value="4"/>
            <param name="any" value="3"/>
          </node>
        </launch>
        //- interfaces
        {"/a": {"params": {"~last": 0, "~step": 0, "~any": 1},
                "described": {"~last": {"range": [0, 10, 3]}, "~step": {"range": [0, 10, 2]}}}}
    """)
