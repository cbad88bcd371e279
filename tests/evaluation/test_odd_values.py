"""Values at which PyYAML or a conversion raises something of its own: evaluation goes on, and so do the rules."""

from __future__ import annotations

import json
from xml.sax.saxutils import quoteattr

import pytest
from preflight_analysis.documents.json_text import dumps
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.workspace.tree_json import tree_json
from support.check import analyse, read_fixture

ODD = {
    "a date that is none": "2024-13-45",
    "no digits": "0b_",
    "a tag for something else": "!!int x",
    "a tag for nothing": "!!int ''",
    "no bool": "!!bool x",
    "no time": "!!timestamp x",
    "no base64": "!!binary é",
    "an odd list": "!!omap [1]",
    "no character": r'"\UDEADBEEF"',
    "too large for a double": "9" * 399,
    "too long to convert": "9" * 5000,
    "a large exponent": "0x1p99999",
    "large and hexadecimal": "0x" + "f" * 390,
    "too long to write": "0x" + "f" * 5000,
    "deep": "[" * 3000,
    "a circle": "&a [*a]",
    "a symbol": "\u2028",
}
INTERFACES = json.dumps({"/n": {"params": {"a": 1.5, "b": True}, "described": {"a": {"range": [0, 10]}}}})
LAUNCHES = {
    "ROS 1": """
        //- /main.launch
        <launch>
          <rosparam>a: {odd}</rosparam>
          <param name="c" type="yaml" value={quoted}/>
          <node pkg="p" type="t" name="n"><param name="a" value={quoted}/><rosparam file="/p.yaml"/></node>
        </launch>
    """,
    "XML": """
        //- /main.launch.xml
        <launch>
          <set_parameter name="c" value={quoted}/>
          <node pkg="p" exec="e" name="n" respawn={quoted}>
            <param name="a" value={quoted}/><param name="b" value={quoted} type="bool"/><param from="/p.yaml"/>
          </node>
          <node_container pkg="p" exec="e" name="box" namespace="">
            <composable_node pkg="p" plugin="x" name="part"><param from="/p.yaml"/></composable_node>
          </node_container>
          <group if={quoted}/>
        </launch>
    """,
    "YAML": """
        //- /main.launch.yaml
        launch:
          - set_parameter: {{name: c, value: {odd}}}
          - node: {{pkg: p, exec: e, name: n, param: [{{name: a, value: {odd}}}, {{from: /p.yaml}}]}}
    """,
}
PARAMETERS = """
        //- /p.yaml
        {head}
          a: {odd}
          b: [1, {odd}]
"""


@pytest.mark.parametrize("odd", ODD.values(), ids=ODD.keys())
@pytest.mark.parametrize("format_", LAUNCHES)
def test_an_odd_value_raises_nothing(format_: str, odd: str, caplog: pytest.LogCaptureFixture) -> None:
    head = "n:" if format_ == "ROS 1" else "/**:\n          ros__parameters:"
    written = odd.replace("&", "&amp;") if format_ == "ROS 1" else odd
    launch = LAUNCHES[format_].format(odd=written, quoted=quoteattr(odd))
    parameters = PARAMETERS.format(head=head, odd=odd)
    # A YAML launch file with some of it is none, and starts nothing.
    interfaces = f"        //- interfaces\n        {INTERFACES}\n" if format_ != "YAML" else ""
    context = analyse(read_fixture(launch + parameters + interfaces))
    findings = run_rules(context)
    assert dumps(tree_json(context.tree, context.documents, findings))
    assert [record.getMessage() for record in caplog.records] == []
    assert context.tree.nodes or context.tree.problems
