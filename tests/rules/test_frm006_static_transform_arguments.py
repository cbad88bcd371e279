"""FRM006: arguments of static transform publishers."""

from dataclasses import replace

import pytest
from preflight_analysis.rules.frm006_static_transform_arguments import RULE
from support.check import analyse, check, findings_of, read_fixture
from support.frame_launch import below

_PACKAGES = "".join(f"\n//- /{name}/package.xml\n<package><name>{name}</name></package>" for name in ("tf", "tf2_ros"))
_SAME = "both the parent and the child frame"


def _node(package: str, args: str, ros: int) -> str:
    attribute = "exec" if ros == 2 else "type"
    start = "//- /main.launch.xml\n" if ros == 2 else ""
    node = f'<node pkg="{package}" {attribute}="static_transform_publisher" name="mount" args="{args}"/>'
    return f"{start}<launch>{node}</launch>{_PACKAGES}"


def _told(package: str, args: str, ros: int) -> list[str]:
    return [
        f"{each.severity}: {each.message}" for each in findings_of(_node(package, args, ros)) if each.rule == "FRM006"
    ]


def test_a_period_that_tf2_takes_for_a_frame() -> None:
    """As in launch files of moveit_tutorials and of PyroTeam/robocup-pkg."""
    text = _node("tf2_ros", "0 0 1 0 0 0 base_link laser 100", 1)
    start = text.index("0 0 1")
    expected = below(start, len("0 0 1 0 0 0 base_link laser 100"), "error[FRM006] /mount publishes the frame '100'")
    check(text.replace("/></launch>", f"/>\n{expected}\n</launch>"))


@pytest.mark.parametrize(
    ("package", "args", "expected"),
    [
        ("tf", "0 0 1 0 0 0 base laser", "exits: static_transform_publisher of tf gets 8 arguments; the period"),
        ("tf", "0 0 1 0 0 0 1 base laser", "publishes the frame 'base' below '1': the period"),
        (
            "tf",
            "0 0 1 base laser 100",
            "gets 6 arguments; expected 'x y z yaw pitch roll frame_id child_frame_id period'",
        ),
        ("tf", "0 0 TODO 0 0 0 base laser 100", "warning: /mount uses 0 for 'TODO'"),
        ("tf", "0.0.3 0 0 0 0 0 base laser 100", "warning: /mount uses 0.0 for '0.0.3'"),
        ("tf", "0 0 1 0 0 0 base base 100", _SAME),
        ("tf2_ros", "0 0 1 0 0 0 1 base laser 100", "gets 10 arguments; tf2 has no period, remove '100'"),
        ("tf2_ros", "0 0 1 0 0 base laser", "gets 7 arguments; expected"),
        ("tf2_ros", "0 0 1 0 0 0 0 base laser", "the length of the quaternion '0 0 0 0' is not 1"),
        ("tf2_ros", "0 0 1 0 0 0 base base", _SAME),
        ("tf2_ros", "0 0 ${pi} 0 0 0 base laser", "warning: /mount uses 0 for '${pi}'"),
    ],
)
def test_ros_1(package: str, args: str, expected: str) -> None:
    (told,) = _told(package, args, 1)
    assert expected in told


_NEW = "--frame-id base --child-frame-id laser"


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        # As in https://github.com/septentrio-gnss/septentrio_gnss_driver/issues/181.
        (f"--pitch 0 -- yaw 0 {_NEW}", "exits: static_transform_publisher has no argument '--'"),
        ("--frame_id base --child-frame-id laser", "has no argument '--frame_id'; did you mean '--frame-id'?"),
        ("--frame-id base", "'--child-frame-id' is missing"),
        (f"{_NEW} --x", "'--x' lacks its value"),
        (f"{_NEW} --x left", "'left' is not a number ('--x')"),
        (f"{_NEW} --yaw 1 --qw 1", "both a quaternion ('--qw') and angles ('--yaw')"),
        (f"{_NEW} --qz 1", "the length of the quaternion '0 0 1 1' is not 1"),
        ("--frame-id base --child-frame-id base", _SAME),
        # As in yahboomcar_bringup.
        ("0 0 1 0 0 0 base laser 30", "exits: 'base' is not a number; tf2 has no period"),
        ("0 0 1 0 0 0 base", "gets 7 arguments"),
        ("0 0 1 0 0 0 0 base laser", "the length of the quaternion"),
        ("0 0 1 0 0 0 base base", _SAME),
    ],
)
def test_ros_2(args: str, expected: str) -> None:
    (told,) = _told("tf2_ros", args, 2)
    assert expected in told


@pytest.mark.silent
@pytest.mark.parametrize(
    ("package", "args", "ros"),
    [
        ("tf", "0 0 1 0 0 0 base laser 100", 1),
        ("tf", "0 0 1 0 0 0 1 base laser 100", 1),
        ("tf", "0 0 1 1.57, 0 0 base laser 100", 1),
        ("tf2_ros", "0 0 1 0 0 0 base laser", 1),
        ("tf2_ros", "0 0 1 0 0 0.707 0.707 base laser", 1),
        ("tf2_ros", "/transform", 1),
        ("tf2_ros", "0 0 1 0 0 0 base laser", 2),
        ("tf2_ros", f"--x -1 {_NEW} --ros-args -p use_sim_time:=true", 2),
        ("tf2_ros", "--help", 2),
        ("tf2_ros", "0 . 1 m a p", 2),  # of a text that is no list
        ("p", "1", 2),
    ],
)
def test_what_is_taken(package: str, args: str, ros: int) -> None:
    assert not _told(package, args, ros)


@pytest.mark.parametrize(
    ("distro", "args", "expected"),
    [
        ("foxy", _NEW, "static_transform_publisher of Foxy has no option '--frame-id'"),
        ("foxy", "0 0 1 0 0 0 base laser", None),
        ("humble", _NEW, None),
        ("kilted", "0 0 1 0 0 0 base laser", None),
        # https://github.com/moveit/moveit2_tutorials/pull/1122
        ("lyrical", "0 0 1 0 0 0 base laser", "static_transform_publisher of Lyrical takes options alone"),
        ("lyrical", _NEW, None),
    ],
)
def test_distributions(distro: str, args: str, expected: str | None) -> None:
    context = analyse(read_fixture(_node("tf2_ros", args, 2)))
    found = list(RULE.check(RULE, replace(context, environment=replace(context.environment, distro=distro))))
    assert [expected is not None and expected in each.message for each in found] == [True] * (expected is not None)
