"""The names of the environment variables that tell the node's process what the host knows."""

from __future__ import annotations

EXPECTED = "PREFLIGHT_NODE"
"""The environment variable with the full name that the launch file gives a node of ROS 2."""
NODELET = "PREFLIGHT_NODELET"
"""The environment variable with the full name of a nodelet that is loaded under another name than its process has."""
LOAD = "PREFLIGHT_LOAD"
"""The environment variable with the file that a container of components is asked to load one by: the request in CDR, as
hexadecimal digits."""
SHARES = "PREFLIGHT_SHARES"
"""The environment variable with the folders of packages that are there as source only, a JSON object."""
DESCRIPTIONS = "PREFLIGHT_DESCRIPTIONS"
"""The environment variable with what the catalogue has of robot descriptions in packages that are not installed, as
`skeletons.Skeletons` takes it."""
INSTALLED = "PREFLIGHT_INSTALLED"
"""The environment variable with what a build will install elsewhere than it lies in the source, as `installed.install`
takes it, in JSON."""
SOURCES = "PREFLIGHT_SOURCES"
"""The environment variable with the folders of Python modules of a workspace that may not be built."""
STAND_INS = "PREFLIGHT_STAND_INS"
"""The environment variable with a file by which what a node imports and is not there has stand-ins: a JSON object with
the `generation` of ROS and the `packages` that are known, name to folder."""
DRAWN = "PREFLIGHT_DRAWN"
"""The environment variable with what a run before this one drew at random, a JSON list: see `randomness`."""
AGAIN = "PREFLIGHT_AGAIN"
"""The environment variable of a program that was started again in its own place, for rclpy's stand-in."""
