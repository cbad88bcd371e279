"""Which launch files are programs in Python."""

from __future__ import annotations

import re

PYTHON_SUFFIX = ".py"
LAUNCH_FUNCTION = re.compile(r"^(?:async )?def\s+(generate_launch_description)\b", re.MULTILINE)
"""What launch calls in a Python launch file."""
_OF_ANY_FORMAT = ".launch"
"""What ROS 2 reads by what is in it."""
_XML = re.compile(r"\s*<")


def is_python(path: str, text: str) -> bool:
    """Whether a launch file is a program in Python: by its name, or by what is in a file of which the name leaves that
    open (`launch_description_sources/any_launch_file_utilities.py` of launch tries one loader after the other)."""
    if path.endswith(PYTHON_SUFFIX):
        return True
    return path.endswith(_OF_ANY_FORMAT) and _XML.match(text) is None and LAUNCH_FUNCTION.search(text) is not None
