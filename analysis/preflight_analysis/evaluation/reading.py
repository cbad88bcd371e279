"""Reading launch files of all formats."""

from __future__ import annotations

from preflight_analysis.documents.reading import Text
from preflight_analysis.launch import read
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_classes import PythonClasses


def read_launch(
    source: Text,
    generation: int | None = None,
    undecided: int = 1,
    of_package: read.OfPackage = read.no_package,
    before: LaunchFile | None = None,
) -> LaunchFile:
    """The launch file of a text; see `launch.read`."""
    return read.read_launch(source, _python_classes, generation, undecided, of_package, before)


def _python_classes() -> PythonClasses:
    # Who has launch files of ROS 1 alone starts faster without.
    from preflight_analysis.evaluation.ros2.actions.registry import python_classes  # noqa: PLC0415

    return python_classes()
