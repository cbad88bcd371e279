"""What a node of ROS 2 says of the parameter that it ends for."""

import pytest
from preflight_analysis.tracing.interface import Outcome, ParamUse
from preflight_analysis.tracing.refusals import refused_param


@pytest.mark.parametrize(
    ("line", "type_", "mandatory"),
    [
        (
            "what():  parameter 'rate' has invalid type: Wrong parameter type, parameter {rate} is of type {double}, "
            "setting it to {integer} is not allowed.",
            "double",
            False,
        ),
        ("what():  parameter 'rate' has invalid type: expected [double_array] got [integer]", "double array", False),
        ("what():  parameter 'rate' has invalid type: expected [double] got [not set]", None, True),
        (
            "rclpy.exceptions.InvalidParameterTypeException: Trying to set parameter 'rate' to '5' of type 'INTEGER', "
            "expecting type 'DOUBLE': rate",
            "double",
            False,
        ),
        (
            "rclpy.exceptions.InvalidParameterTypeException: Trying to set parameter 'rate' to 'of type ''' of type "
            "'STRING', expecting type 'INTEGER_ARRAY': rate",
            "integer array",
            False,
        ),
    ],
)
def test_the_parameter_that_a_node_ends_for(line: str, type_: str | None, mandatory: bool) -> None:
    found = refused_param(Outcome("crashed", 1, stderr_tail=(line,)))
    assert found == ParamUse("~rate", "get", type=type_, mandatory=mandatory, refused=line.removeprefix("what():  "))
    assert refused_param(Outcome("spinning", stderr_tail=(line,))) is None


@pytest.mark.parametrize("line", ["", "KeyError: 'rate'", "Trying to set parameter 'rate' to '5'"])
def test_a_node_that_ends_for_something_else(line: str) -> None:
    assert refused_param(Outcome("crashed", 1, stderr_tail=(line,))) is None
