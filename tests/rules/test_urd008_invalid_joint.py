"""URD008: a joint that the parser of URDF refuses."""

import pytest
from support.check import check
from support.robot_launch import of_urdf, robot

_URDF = '<link name="a"/><link name="b"/><joint name="j" {}><parent link="a"/><child link="b"/>{}</joint>'


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ('type="revolut"', "joint 'j' has the unknown type 'revolut'; did you mean 'revolute'?"),
        ("", "joint 'j' has no type"),
        ('type="prismatic"', "joint 'j' has no <limit>, which the type 'prismatic' requires"),
    ],
)
def test_what_is_refused(kind: str, said: str) -> None:
    expected = f"             ^ error[URD008] {said}"
    check(of_urdf(_URDF.format(kind, ""), robot('<joint name="j">', expected, "</joint>")))


@pytest.mark.silent
@pytest.mark.parametrize(
    ("kind", "more"), [("fixed", ""), ("continuous", ""), ("revolute", '<limit effort="1" velocity="1"/>')]
)
def test_what_is_taken(kind: str, more: str) -> None:
    check(of_urdf(_URDF.format(f'type="{kind}"', more)))
