"""FRM004: a frame with a slash in front, which tf2 refuses."""

import pytest
from support.check import apply, check
from support.frame_launch import EKF, EKF_COLUMN, below, fixture, static


def test_a_parameter() -> None:
    said = (
        "warning[FRM004] frame '/base' begins with '/', which tf2 refuses: /ekf uses it (parameter 'base_link_frame')"
    )
    expected = below(EKF_COLUMN, 5, said)
    text = fixture(f"{static('s', 'odom', 'base')}\n{EKF.format('/base', chr(10) + expected + chr(10))}")
    (found,) = check(text)
    assert 'name="base_link_frame" value="base"' in apply(text, found.fixes[0].edits)["/main.launch.xml"]


@pytest.mark.silent
def test_what_is_taken() -> None:
    # Broadcasters take the slash off.
    check(fixture(f"{static('s', '/odom', '/base')}\n{EKF.format('base', '')}"))


@pytest.mark.silent
def test_ros_1_takes_it_off() -> None:
    node = """<node pkg="robot_localization" type="ekf_localization_node" name="ekf">
      <param name="base_link_frame" value="/base"/></node>"""
    package = "\n//- /robot_localization/package.xml\n<package><name>robot_localization</name></package>"
    check(f"<launch>{node}</launch>{package}")
