"""CTL008: a `<ros2_control>` element that ros2_control refuses or does not read."""

from dataclasses import replace

import pytest
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.control_threads import hardware, launch, manager, publisher, urdf, workspace

_JOINTS = ("shoulder", "elbow")
_PLUGIN = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
_HW = '<ros2_control name="hw">'
_FOLLOWS = {"elbow": "type='continuous'><mimic joint='shoulder'/>"}
_FIXED = {"elbow": "type='fixed'>"}


def _said(
    more: str,
    types: dict[str, str] | None = None,
    distro: str | None = "jazzy",
    tags: tuple[str, ...] = (manager(None),),
) -> list[str]:
    fixture = workspace(launch(publisher(urdf(_JOINTS, more, types=types)), *tags), {})
    context = analyse(read_fixture(fixture))
    used = replace(context, environment=replace(context.environment, distro=distro))
    found = run_rules(used)
    assert {each.rule for each in found} <= {"CTL008"}
    return [f"{each.severity} {each.message}" for each in found]


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("<joint name='elbow'/>", "has no <hardware> with a <plugin>"),
        ("<hardware/>", "has no <hardware> with a <plugin>"),
        (f"{_PLUGIN}<param name='port'>1</param>", "has the element <param>, which ros2_control refuses"),
        (
            f"{_PLUGIN}<transmission name='t'><joint name='elbow'/></transmission>",
            "has no joint 'elbow', which its <transmission> names",
        ),
    ],
)
def test_what_each_version_refuses(content: str, said: str) -> None:
    more = f"<ros2_control name='hw' type='system'>{content}</ros2_control>"
    for distro in ("jazzy", "humble", None):
        assert _said(more, distro=distro) == [f'error <ros2_control name="hw"> {said}']


@pytest.mark.parametrize(
    ("types", "joints", "said"),
    [
        (_FOLLOWS, _JOINTS, f"joint 'elbow' mimics 'shoulder' and has a command interface in {_HW}"),
        (_FIXED, ("elbow",), f"joint 'elbow' of {_HW} is fixed"),
    ],
)
def test_what_newer_versions_refuse(types: dict[str, str], joints: tuple[str, ...], said: str) -> None:
    assert _said(hardware(joints), types) == [f"error {said}, which ros2_control refuses"]
    assert _said(hardware(joints), types, "humble") == []
    assert _said(hardware(joints), types, None) == [f"info {said}, which ros2_control of Jazzy and newer refuses"]


def test_a_joint_that_follows_one_of_another_element() -> None:
    more = f"<ros2_control name='hw' type='system'>{_PLUGIN}<joint name='elbow'/></ros2_control>"
    assert _said(more, _FOLLOWS) == [
        f"error joint 'elbow' mimics 'shoulder' of another element than {_HW}, which ros2_control refuses"
    ]


def test_a_joint_that_follows_none() -> None:
    more = f"<ros2_control name='hw' type='system'>{_PLUGIN}<joint name='elbow' mimic='true'/></ros2_control>"
    assert _said(more) == [
        'error joint \'elbow\' of <ros2_control name="hw"> has mimic="true", but no <mimic> in the robot, which '
        "ros2_control refuses"
    ]


def test_a_launch_that_only_shows_the_robot() -> None:
    """https://github.com/automaticaddison/mycobot_ros2: the plugin is for the simulator."""
    more = "<ros2_control name='hw' type='system'><hardware/></ros2_control>"
    assert _said(more, tags=()) == [f"info {_HW} has no <hardware> with a <plugin>"]


def test_hardware_that_a_simulated_robot_leaves_out() -> None:
    """https://github.com/ROBOTIS-GIT/open_manipulator: the end unit of omy_3m has none in Gazebo, which goes on."""
    plugin = "<gazebo><plugin filename='gz_ros2_control-system' name='p'/></gazebo>"
    more = f"<ros2_control name='hw' type='system'><gpio name='end'/></ros2_control>{plugin}"
    create = '<node pkg="ros_gz_sim" exec="create" name="create" args="-topic robot_description"/>'
    assert _said(more, tags=(create,)) == [f"info {_HW} has no <hardware> with a <plugin>"]


@pytest.mark.silent
def test_what_is_read() -> None:
    assert _said(hardware(_JOINTS)) == []
    own = hardware(_JOINTS).replace("<joint name='elbow'>", "<joint name='elbow' mimic='false'>")
    assert _said(own, _FOLLOWS) == []
