"""The names of the environment variables that tell the node's process what the host knows."""

from __future__ import annotations

EXPECTED = "PREFLIGHT_NODE"
"""The environment variable with the full name that the launch file gives a node of ROS 2."""
SHARES = "PREFLIGHT_SHARES"
"""The environment variable with the folders of packages that are there as source only, a JSON object."""
SOURCES = "PREFLIGHT_SOURCES"
"""The environment variable with the folders of Python modules of a workspace that may not be built."""
