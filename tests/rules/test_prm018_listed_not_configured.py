"""PRM018: a plugin that is listed and not configured."""

import pytest
from support.check import check

_START = """//- /robot.launch.xml
        <launch>
          <node pkg="p" exec="e" name="costmap">
            <param from="/p/costmap.yaml"/>{more}
          </node>
        </launch>
        //- /p/costmap.yaml
        costmap:
          ros__parameters:
            rate: 1.0"""


def test_another_name_than_that_of_the_section() -> None:
    (found,) = check(f"""
        {_START.format(more="")}
            plugins: ["static_layer", "voxel_layer"]
                                       ^^^^^^^^^^^ warning[PRM018] no parameter 'voxel_layer.plugin' as the others have
            static_layer:
              plugin: "a::Static"
            obstacle_layer:
              plugin: "a::Obstacle"
    """)
    assert "'obstacle_layer' is configured and in no list" in found.message
    assert [each.message for each in found.related][:1] == ["'obstacle_layer' is configured here"]


def test_below_another_name() -> None:
    check(f"""
        {_START.format(more="")}
            follow.critics: [near, far]
                             ^^^^ warning[PRM018] no parameter 'follow.near.type'
            follow.far.type: "a::Far"
    """)


@pytest.mark.silent
def test_what_is_configured_elsewhere_or_needs_nothing() -> None:
    check(f"""
        {_START.format(more='<param name="voxel_layer.plugin" value="a::Voxel"/>')}
            plugins: ["static_layer", "voxel_layer"]
            behaviors: ["spin", "backup", "drive_on_heading", "wait"]
            critics: ["near", "far"]
            frames: ["map", "static_layer odom"]
            static_layer:
              plugin: "a::Static"
            spin:
              plugin: "a::Spin"
    """)
