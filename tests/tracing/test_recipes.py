"""What a program is run with."""

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing import ros1_recipe, ros2_recipe


@pytest.mark.parametrize("sourced", [{}, {"ROS_VERSION": "1"}, {"ROS_VERSION": "2"}])
def test_programs_know_the_generation_of_ros_whatever_is_sourced(sourced: dict[str, str]) -> None:
    """Projects for both generations read `ROS_VERSION`, and raise where it is not set."""
    environment = detect_environment(None, sourced, [])
    for version, recipes in (("1", ros1_recipe), ("2", ros2_recipe)):
        assert recipes.make_command(environment, "/bin/true", (), "/").env["ROS_VERSION"] == version


def test_the_version_of_python_is_that_of_the_distribution_that_is_sourced() -> None:
    environment = detect_environment(None, {"ROS_VERSION": "1", "ROS_PYTHON_VERSION": "2"}, [])
    assert ros1_recipe.make_command(environment, "/bin/true", (), "/").env["ROS_PYTHON_VERSION"] == "2"
