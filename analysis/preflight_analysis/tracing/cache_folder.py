"""The folder of everything that is kept from one call to the next."""

from __future__ import annotations

import os
from pathlib import Path

import platformdirs

VARIABLE = "ROS_PREFLIGHT_CACHE_DIR"
"""Names another folder: one that a CI keeps, for instance."""


def cache_folder() -> Path:
    """The folder that the environment names, else the one in the user's cache."""
    named = os.environ.get(VARIABLE)
    return Path(os.path.abspath(named)) if named else Path(platformdirs.user_cache_dir("ros-preflight"))
