"""What parameters in dictionaries of Python launch files come to; the answers are those of launch_ros 0.28."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.check import interface_from_json
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

REFUSED = "refused"
CASES: dict[str, object] = {
    # Plain values stay what they are.
    "'a'": "a",
    "'False'": "False",
    "'1'": "1",
    "'1.5'": "1.5",
    "''": "",
    "True": True,
    "1": 1,
    "1.0": 1.0,
    "[True, False]": [True, False],
    "[1, 2]": [1, 2],
    "(1, 2)": [1, 2],
    "[1.5, 2.5]": [1.5, 2.5],
    "[1, 2.5]": [1.0, 2.5],
    "[1.5, 2]": [1.5, 2.0],
    "['a', 'b']": ["a", "b"],
    "['True', '2', '3.5']": ["True", "2", "3.5"],
    "[True, 1]": REFUSED,
    "[1, True]": [1, True],
    "[True, 1.5]": REFUSED,
    "['a', 1]": REFUSED,
    "[]": REFUSED,
    "None": REFUSED,
    "{1, 2}": REFUSED,
    "[{1}]": REFUSED,
    "[None]": REFUSED,
    # A substitution is read as YAML.
    "T('a')": "a",
    "T('off')": False,
    "T('2')": 2,
    "T('2.5')": 2.5,
    "T('')": "",
    "T('[2, 3]')": [2, 3],
    "T('[2.0, 3.0]')": [2.0, 3.0],
    "T('[true, no]')": [True, False],
    """T("['True', '1', 'a']")""": ["True", "1", "a"],
    "T('[1, 2.5]')": REFUSED,
    "T('[1, true]')": [1, True],
    "T('[true, 1]')": REFUSED,
    "T('[]')": REFUSED,
    "T('[[1], [2]]')": REFUSED,
    "T('{a: 1}')": REFUSED,
    "T('a : b : c')": REFUSED,
    "T('null')": REFUSED,
    # Texts and substitutions in one list are one text.
    "[T('a'), T('b')]": "ab",
    "[T('a'), 'b']": "ab",
    "['b', T('a')]": "ba",
    "['1', T('2')]": 12,
    # Lists in a list are its items, and each of them is read as YAML.
    "[[T('a')], [T('b')]]": ["a", "b"],
    "[[T('a'), T('b')], T('c')]": ["ab", "c"],
    "[[T('a')], 'b']": ["a", "b"],
    "['a', [T('b')]]": ["a", "b"],
    "[[T('True')], [T('False')]]": [True, False],
    "[[T('1')], [T('2')]]": [1, 2],
    "[[T('1.0')], [T('2.0')]]": [1.0, 2.0],
    "[['1'], ['2']]": [1, 2],
    "[[T('1')], 2]": [1, 2],
    "['1', [T('2')]]": REFUSED,
    "[T('1'), [T('2')]]": [1, 2],
    "[[T('1')], [T('2.5')]]": REFUSED,
    "[[T('True')], [T('1')], [T('1.5')]]": REFUSED,
    "[[T('')], [T('a')]]": REFUSED,
    "[[T('[a]')], [T('[b]')]]": REFUSED,
    "[[T('{')], [T('a')]]": REFUSED,
    "[True, 1, T('a')]": REFUSED,
    "[T('a'), True, 1]": REFUSED,
    "[True, 1, [T('a')]]": REFUSED,
    "[[T('a')], True, 1]": REFUSED,
    "[True, T('false')]": [True, False],
    "[1, T('2')]": [1, 2],
    "[1.5, [T('2')]]": REFUSED,
    # With a type.
    "V(T('{a: 1}'), value_type=str)": "{a: 1}",
    "V(T('[1, 2.5]'), value_type=str)": "[1, 2.5]",
    "V(T('a : b : c'), value_type=str)": "a : b : c",
    "V(T(''), value_type=str)": "",
    "V(T('1'), value_type=float)": 1.0,
    "V(T('1'), value_type=bool)": True,
    "V(T('yes'), value_type=bool)": True,
    "V(T('1.5'), value_type=int)": REFUSED,
    "V(T('[1, 2]'), value_type=List[int])": [1, 2],
    "V(T('[1, 2]'), value_type=list[int])": [1, 2],
    "V(T('[1, 2]'), value_type=List[float])": REFUSED,
    "V(T('1.5'))": 1.5,
    "V(T(''))": "",
    "V(1, value_type=float)": REFUSED,
    "V(1, value_type=int)": 1,
    "V(True, value_type=int)": True,
    "V('1')": "1",
    "V([1, 2])": [1, 2],
    "V([1, 2], value_type=List[int])": [1, 2],
    "V([1, 2], value_type=List[float])": REFUSED,
    "V([1, 2.5], value_type=List[float])": [1.0, 2.5],
    "V([1, 2], value_type=int)": REFUSED,
    "V(['a', [T('b')]])": ["a", "b"],
    "V(['a', [T('b')]], value_type=List[str])": ["a", "b"],
    "V(['a', [T('b')]], value_type=List[int])": REFUSED,
    """V([[T("['a']")], [T("['b']")]], value_type=List[str])""": ["['a']", "['b']"],
    "V([[T('1')], [T('2')]], value_type=List[int])": [1, 2],
    "V([1, [T('2')]])": [1, 2],
    "V([1, [T('2.5')]])": REFUSED,
    "V([True, 1])": REFUSED,
    "V([None])": REFUSED,
    "V(None)": REFUSED,
    "V(1, value_type=dict)": REFUSED,
}
TEXT = """\
from typing import List
from launch import LaunchDescription
from launch.substitutions import TextSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue as V

def T(text):
    return TextSubstitution(text=text)

def node(name, make):
    try:
        return Node(package='p', executable='x', name=name, parameters=[{'of': {'it': make()}}])
    except Exception:
        return Node(package='p', executable='x', name=name)

def generate_launch_description():
    return LaunchDescription([
"""


def test_values_are_those_of_launch_ros(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    nodes = "".join(f"        node('n{n}', lambda: {case}),\n" for n, case in enumerate(CASES))
    path = harness.write("launch/a.launch.py", f"{TEXT}{nodes}    ])\n")
    tree = harness.launch(path).tree
    assert len(tree.nodes) == len(CASES)
    found = {}
    for case, node in zip(CASES, tree.nodes, strict=True):
        values = {param.name: param.value for param in node.params}
        found[case] = values.get("of.it", REFUSED)
    assert {case: repr(value) for case, value in found.items()} == {case: repr(value) for case, value in CASES.items()}


@pytest.mark.parametrize(("default", "severity"), [("''", "hint"), ("'10.0.0.1'", "error")])
def test_a_list_that_is_empty_as_a_variable_is_not_set(tmp_path: Path, default: str, severity: str) -> None:
    harness = PythonHarness(tmp_path)
    node = "        node('n', lambda: []),\n"
    path = harness.write(
        "launch/a.launch.py", f"import os\nip = os.getenv('ROBOT_IP', {default})\n{TEXT}{node}    ])\n"
    )
    (finding,) = (each for each in harness.launch(path).findings if each.rule == "LCH008")
    assert (finding.severity, finding.lack is not None) == (severity, severity == "hint")


@pytest.mark.parametrize(
    ("given", "severity"), [("{'speed': 1.0, 'mass': 2.0}", "warning"), ("json.loads(SETTINGS)", "info")]
)
def test_parameters_that_a_launch_file_has_read_and_hands_over(tmp_path: Path, given: str, severity: str) -> None:
    harness = PythonHarness(tmp_path)
    text = f"""\
        import json
        from launch import LaunchDescription
        from launch_ros.actions import Node
        SETTINGS = '{{"speed": 1.0, "mass": 2.0}}'
        def generate_launch_description():
            settings = {given}
            return LaunchDescription([Node(package='p', executable='n', name='n', parameters=[settings])])
    """
    analysis = harness.launch(harness.write("launch/a.launch.py", text))
    interface = interface_from_json({"params": {"~speed": 0.5}})
    assert harness.workspace is not None
    findings = harness.workspace.with_interfaces(analysis, [interface], None).findings
    (finding,) = (each for each in findings if each.rule == "PRM013")
    assert (finding.severity, "'mass'" in finding.message) == (severity, True)
