"""DEV001: one of several that are alike is written otherwise."""

import pytest
from support.check import check, findings_of

_NUMBERED = """          <node pkg="p" type="t" name="n_{0}"><param name="cov_1" value="a{1}"/></node>
"""
_WHEEL = """          <node pkg="p" type="t" name="wheel_{0}"><param name="port" value="/dev/ttyUSB{1}"/></node>
"""


def _wheels(*ports: int, first: int = 1) -> str:
    return "".join(_WHEEL.format(number, port) for number, port in enumerate(ports, first))


def test_a_name_that_was_not_changed_in_a_copy() -> None:
    said = "info[DEV001] parameter 'port' of /wheel_3 is '/dev/ttyUSB2', where '2' is of another one"
    check(f"""
        <launch>
{_wheels(1, 2, 2)}{" " * 61}^^^^ {said}
{_wheels(4, first=4)}        </launch>
    """)


def test_a_number_in_the_name_of_a_parameter_is_no_number_of_a_node() -> None:
    nodes = "".join(_NUMBERED.format(number, value) for number, value in enumerate((0, 1, 2, 2)))
    assert _found(f"<launch>{nodes}</launch>") == ["parameter 'cov_1' of /n_3 is 'a2', where '2' is of another one"]


def _cameras(*left_out: str, **changed: str) -> str:
    nodes = (
        f'<node pkg="p" type="t" name="camera" ns="{side}">'
        + (f'<param name="frame" value="{changed.get(side, side)}_optical"/>' if side not in left_out else "")
        + f'<remap from="image" to="/{side}/raw"/></node>'
        for side in ("north", "east", "south", "west")
    )
    return f"<launch>{''.join(nodes)}</launch>"


def _found(text: str) -> list[str]:
    return [each.message.partition(";")[0] for each in findings_of(text) if each.rule == "DEV001"]


def test_what_the_others_have_and_one_lacks() -> None:
    assert _found(_cameras("south")) == ["parameter 'frame' of /south/camera is missing"]


def test_the_word_of_another_one() -> None:
    said = "parameter 'frame' of /west/camera is 'east_optical', where 'east' is of another one"
    assert _found(_cameras(west="east")) == [said]


def test_includes_of_one_file() -> None:
    speed = dict.fromkeys("abd", '<arg name="speed" value="2"/>')
    includes = (
        f'<include file="/arm.launch"><arg name="side" value="{side}"/><arg name="ip" value="10.0.0.{ip}"/>'
        f"{speed.get(side, '')}</include>"
        for side, ip in zip("abcd", (4, 9, 7, 8), strict=True)
    )
    declared = "".join(f'<arg name="{name}" default="1"/>' for name in ("side", "ip", "speed"))
    text = f"<launch>{''.join(includes)}</launch>\n//- /arm.launch\n<launch>{declared}</launch>"
    assert _found(text) == ["argument 'speed' of c is missing"]


@pytest.mark.silent
@pytest.mark.parametrize(
    "text",
    [
        _cameras(),
        _cameras("south", "west"),
        _cameras(south="middle"),
        f"<launch>{_wheels(1, 2, 2)}</launch>",
        f"<launch>{_wheels(1, 2, 4, 3)}</launch>",
        f"<launch>{_wheels(1, 2, 3, 9)}</launch>",
        f"<launch>{_wheels(1, 1, 1, 1)}</launch>",
    ],
    ids=["all alike", "two lack it", "a value of its own", "three", "changed on purpose", "a number of its own", "one"],
)
def test_what_is_no_slip(text: str) -> None:
    assert not _found(text)
