"""genpy does without numpy in a watched node until the node imports it; that changes nothing it can see."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.tracing_harness import trace, write_node

pytestmark = pytest.mark.ros

TELL = "import sys; print(*told, file=sys.stderr); sys.exit(3)"


def _told(folder: Path, body: str) -> tuple[str, ...]:
    return trace(write_node(folder, body + "\n" + TELL)).outcome.stderr_tail


def test_numpy_is_not_imported_for_genpy_alone(tmp_path: Path) -> None:
    body = "import sys, rospy, std_msgs.msg\ntold = ['numpy' in sys.modules]"
    assert _told(tmp_path, body) == ("False",)


def test_a_node_that_imports_it_has_it(tmp_path: Path) -> None:
    for order in ("import rospy, numpy", "import numpy, rospy"):
        assert _told(tmp_path, f"{order}\ntold = [int(numpy.arange(4).sum()), numpy.__name__]") == ("6 numpy",)


def test_numbers_pass_the_check_of_types_as_ever(tmp_path: Path) -> None:
    """A value that struct refuses makes genpy look at the types of all fields."""
    body = """
import rospy
from geometry_msgs.msg import Point
from genpy import SerializationError
from genpy.message import check_type, _valid_float_types
told = [float in _valid_float_types, str in _valid_float_types, len(_valid_float_types)]
import numpy
for value in (numpy.float32(1), numpy.int8(1), 1, 1.0, 'x', None, numpy.array([1.0])):
    try:
        check_type('x', 'float64', value)
        told.append('ok')
    except SerializationError:
        told.append('wrong')
"""
    assert _told(tmp_path, body) == ("True False 3 ok ok ok ok wrong wrong wrong",)
