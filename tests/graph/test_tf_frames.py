"""Frames that nodes broadcast, by their arguments."""

import pytest
from preflight_analysis.graph.tf_frames import frames_of
from preflight_analysis.tracing.interface import NOT_RUN, Frame
from support.check import analyse, read_fixture


def frames(package: str, args: str) -> tuple[Frame, ...]:
    node = f'<node pkg="{package}" type="static_transform_publisher" name="n" args="{args}"/>'
    text = f"<launch>{node}</launch>\n//- /tf/package.xml\n<package><name>tf</name></package>\n"
    text += "//- /tf2_ros/package.xml\n<package><name>tf2_ros</name></package>"
    (made,) = analyse(read_fixture(text)).tree.nodes
    return frames_of(made, NOT_RUN)


@pytest.mark.parametrize(
    ("package", "args", "expected"),
    [
        ("tf2_ros", "0 0 1 0 0 0 base laser", (Frame("base", "laser", static=True),)),
        ("tf2_ros", "0 0 1 0 0 0 1 base laser", (Frame("base", "laser", static=True),)),
        ("tf", "0 0 1 0 0 0 /base /laser 100", (Frame("/base", "/laser"),)),
        ("tf", "0 0 1 0 0 0 1 base laser 100", (Frame("base", "laser"),)),
        ("tf2_ros", "0 0 base laser", ()),
        ("tf2_ros", "'0 0", ()),
        ("tf2_ros", "0 0 0 0 0 0 base laser 100", (Frame("base", "laser", static=True),)),
        ("tf2_ros", "0 0 0 0 0 0 $(unknown of it) laser", ()),
        ("tf2_ros", "", ()),
        ("tf", "", ()),
        ("p", "0 0 1 0 0 0 base laser", ()),
    ],
)
def test_a_static_transform_publisher(package: str, args: str, expected: tuple[Frame, ...]) -> None:
    assert frames(package, args) == expected
