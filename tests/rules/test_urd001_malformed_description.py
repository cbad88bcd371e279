"""URD001: a robot description that is no XML, or no URDF."""

import json

import pytest
from support.check import apply, check, findings_of
from support.descriptions import said, xacro

_LAUNCH = """
    <launch>
      <param name="robot_description" command="xacro arm"/>
      {}
    </launch>
    //- commands
    {}
"""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("<robot><link></robot>", "parameter '/robot_description' is not well-formed XML: "),
        ("/p/arm.urdf", "parameter '/robot_description' is not XML: it does not begin with '<'"),
        ("<model/>", "root element of '/robot_description' is <model>, not <robot>"),
    ],
)
def test_what_no_parser_takes(text: str, said: str) -> None:
    commands = json.dumps({"xacro arm": {"output": text}})
    (found,) = [each for each in findings_of(_LAUNCH.format("", commands)) if each.rule == "URD001"]
    assert found.severity == "error"
    assert found.message.startswith(said)


@pytest.mark.silent
@pytest.mark.parametrize(
    "text",
    [
        "<robot/>",
        "<sdf/>",
        '<COLLADA xmlns="http://www.collada.org/2008/03/COLLADASchema"/>',
        " \n",
        '<?xml version="1.0"?>\n<robot/>',
    ],
)
def test_what_is_taken(text: str) -> None:
    check(_LAUNCH.format("", json.dumps({"xacro arm": {"output": text}})))


@pytest.mark.silent
@pytest.mark.parametrize("name", ["/ghost/robot_description", "arm_description"])
def test_the_name_of_the_parameter_with_the_description(name: str) -> None:
    check(f'<launch><param name="publisher/robot_description" value="{name}"/></launch>')


@pytest.mark.silent
def test_a_command_that_was_not_run() -> None:
    check(_LAUNCH.format("", "{}"))


_RAW = """
    <launch>
      <param name="robot_description" textfile="/p/arm.xacro"/>
                   ^^^^^^^^^^^^^^^^^ warning[URD001] parameter '/robot_description' is raw xacro: no command
    </launch>
    //- /p/arm.xacro
    {}
"""


@pytest.mark.parametrize(
    "text",
    [
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:base/><link name="arm"/>'
        '<joint name="j" type="fixed"><parent link="base"/><child link="arm"/></joint></robot>',
        '<robot><link name="${prefix}arm"/><link name="${prefix}base"/></robot>',
    ],
)
def test_one_that_xacro_did_not_process_is_told_once(text: str) -> None:
    fixture = _RAW.format(text)
    (found,) = check(fixture)
    said = apply(fixture, found.fixes[0].edits)["/main.launch"]
    assert """name="robot_description" command="xacro '/p/arm.xacro'"/>""" in said


def test_a_semantic_description() -> None:
    """https://github.com/robofeiathome/hera_moveit_config, before 9904221f"""
    found = findings_of("""
        <launch><param name="robot_description_semantic" textfile="/p/arm.srdf"/></launch>
        //- /p/arm.srdf
        <robot name="arm">
          <group_state name="up" group="arm">
        </robot>
    """)
    assert [(each.rule, each.severity) for each in found] == [("URD001", "error")]
    assert found[0].message.startswith("parameter '/robot_description_semantic' is not well-formed XML: ")


def test_a_prefix_that_nothing_declares() -> None:
    """https://github.com/abizovnuralem/go2_ros2_sdk: the parser of urdfdom knows no namespaces."""
    text = '<robot name="a"><xacro:include filename="b.xacro"/></robot>'
    (found,) = findings_of(_LAUNCH.format("", json.dumps({"xacro arm": {"output": text}})))
    assert (found.rule, found.severity) == ("URD001", "warning")
    assert found.message == "parameter '/robot_description' is raw xacro: no command processes it"
    other = '<robot name="a"><v:size/></robot>'
    assert findings_of(_LAUNCH.format("", json.dumps({"xacro arm": {"output": other}}))) == []


@pytest.mark.silent
def test_hyphens_in_a_comment() -> None:
    """https://github.com/jsk-ros-pkg/jsk_common: a calibrated PR2, whose comments the parser of urdfdom takes."""
    text = '<robot name="a"><!-- left -- right --><link name="base"/></robot>'
    assert findings_of(_LAUNCH.format("", json.dumps({"xacro arm": {"output": text}}))) == []


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("r.xacro", xacro('<link name="a">'), [":2 warning file is not well-formed XML: <link> is not closed"]),
        (
            "r.srdf",
            '<robot name="r"><group></robot>',
            [":1 warning file is not well-formed XML: <group> is not closed"],
        ),
        ("w.sdf", "<sdf><world></sdf>", [":1 warning file is not well-formed XML: <world> is not closed"]),
        (
            "r.xacro",
            xacro('<<<<<<< HEAD\n<link name="a"/>\n=======\n>>>>>>> other'),
            [":2 warning file has conflict markers of git, and is not XML"],
        ),
        (
            "r.xacro",
            xacro("<!-- a -- b -->"),
            [":2 warning file is not well-formed XML: '--' is not allowed in a comment"],
        ),
        ("r.urdf", '<robot name="r"><!-- a -- b --><link name="a"/></robot>', []),
        ("w.world", "<sdf><world/></sdf>", []),
        ("stage.world", "define block model\n(\n  size [1 1 1]\n)\n", []),
        (
            "r.urdf",
            '<!-- a -->\n<?xml version="1.0"?>\n<robot name="r" xmlns:xacro="x"><!-- <xacro:a/> --></robot>',
            [":2 info file is not well-formed XML: the XML declaration must be the very first thing in the file"],
        ),
        # https://github.com/abizovnuralem/go2_ros2_sdk: urdfdom takes the <robot> among several.
        ("r.urdf", '<?xml version="1.0"?>\n<xacro:property name="a"/>\n<robot name="r"><link name="a"/></robot>\n', []),
        (
            "r.urdf",
            '<robot name="r"><link name="a"/></robot>\n<robot name="s"><link></robot>',
            [":2 warning file is not well-formed XML: another element after the document element"],
        ),
        ("empty.xacro", "", []),
    ],
)
def test_a_file_for_itself(name: str, text: str, expected: list[str]) -> None:
    assert said({name: text}) == [f"{name}{each}" for each in expected]
