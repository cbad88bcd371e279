"""The actions of `ros_gz_bridge` and `ros_gz_sim`, for where they are not installed: each includes a launch file of its
package, as gazebosim/ros_gz has it in `actions/`."""

from __future__ import annotations

from typing import Any

from .includes import IncludeLaunchDescription, PythonLaunchDescriptionSource
from .ros_substitutions import FindPackageShare
from .substitutions import PathJoinSubstitution


class _Including(IncludeLaunchDescription):
    package = file = ""
    required: tuple[str, ...] = ()
    optional: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    """What newer versions take too, and what changes no name in ROS."""

    def __init__(self, **kwargs: Any) -> None:
        for name in self.required:
            if name not in kwargs:
                raise TypeError(f"{type(self).__name__}.__init__() missing required argument: '{name}'")
        for name in self.left_out:
            kwargs.pop(name, None)
        names = (*self.required, *self.optional)
        given = [(name, kwargs.pop(name)) for name in names if kwargs.get(name) is not None]
        path = PathJoinSubstitution([FindPackageShare(self.package), "launch", self.file])
        super().__init__(PythonLaunchDescriptionSource([path]), launch_arguments=given, **kwargs)


class RosGzBridge(_Including):
    package, file = "ros_gz_bridge", "ros_gz_bridge.launch.py"
    required = ("bridge_name", "config_file")
    optional = (
        "container_name",
        "create_own_container",
        "namespace",
        "use_composition",
        "use_respawn",
        "log_level",
    )
    left_out = ("bridge_params", "extra_bridge_params")


class GzServer(_Including):
    package, file = "ros_gz_sim", "gz_server.launch.py"
    optional = ("world_sdf_file", "world_sdf_string", "container_name", "create_own_container", "use_composition")


class GzSpawnModel(_Including):
    package, file = "ros_gz_sim", "gz_spawn_model.launch.py"
    optional = (
        "world",
        "file",
        "model_string",
        "topic",
        "entity_name",
        "allow_renaming",
        "x",
        "y",
        "z",
        "roll",
        "pitch",
        "yaw",
    )
