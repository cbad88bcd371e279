"""The frontend for ROS 2's XML launch files (`launch_xml`): Document to LaunchFile."""

from __future__ import annotations

from preflight_analysis.documents.document import Document
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2
from preflight_analysis.launch.xml_actions import action_of


def read_ros2_xml(document: Document) -> LaunchFile:
    """The launch file in `document`. Any text gives one; without a root where the document element is no `<launch>`."""
    root = document.root
    action = action_of(root, parse_value_ros2) if root is not None and root.tag == "launch" else None
    return LaunchFile(document.path, 2, action, document)
