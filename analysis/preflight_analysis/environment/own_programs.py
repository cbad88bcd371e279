"""Programs that come along with the analysis, for where those of ROS are not installed."""

from __future__ import annotations

OWN_PROGRAMS = frozenset({"xacro"})
"""By the names that launch files call them."""
