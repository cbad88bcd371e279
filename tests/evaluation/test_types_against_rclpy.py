"""What type a value has that reaches a node of ROS 2, and what comes of it, beside what real rclpy does."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml
from preflight_analysis.evaluation.ros2 import rcl_yaml
from preflight_analysis.evaluation.ros2.param_files import read_made_param_file
from preflight_analysis.evaluation.ros2.rcl_yaml import as_passed
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.ros2_harness import ros2_prefix

pytestmark = pytest.mark.ros

DEFAULTS: dict[str, Any] = {
    "bool": True,
    "integer": 1,
    "double": 1.5,
    "string": "x",
    "bools": [True],
    "integers": [1],
    "doubles": [1.5],
    "strings": ["x"],
}
VALUES = (
    *("1", "1.0", "1.", ".5", "1e3", "1E5", "1.5e-3", "0o17", "0x1F", "010", "09", "08", "1_000", "0b11", "-0x1", "+1"),
    *("-5", "1e", "e5", "1d", "99999999999999999999", "1e400", "0x1p3", ".inf", ".nan", "-.INF", "inf", "nan", "1,000"),
    *("true", "True", "tRue", "yes", "on", "off", "y", "n", "Y", "abc", "~", "null", "infinity", "12:30:00"),
    *("2020-01-01", '"1"', "'true'", '"on"', '""', "'1e3'", "!!str 1", '!!int "5"', "!!str true", "!!float 1"),
    *("[1, 2]", "[1.0, 2.0]", "[1, 2.0]", "[1.0, 2]", "[]", "[true, false]", "[true, 1]", "[a, b]", "[a, 1]"),
    *('["1", "2"]', '["1", 2]', "[yes, no]", "[on, 1]", '[""]', "[~]", "[.inf, 1.0]", "[[1], [2]]", "[1,]", '["a", b]'),
    *("[!!str 1, a]", "[1, 99999999999999999999]", ""),
)
LAUNCH = [
    *(
        ("1", ""),
        ("1.0", ""),
        ("1e3", ""),
        ("1.0e+3", ""),
        ("true", ""),
        ("on", ""),
        ("y", ""),
        ("abc", ""),
        ("1", "str"),
    ),
    *(("1e3", "str"), ("y", "str"), ("on", "str"), ("5", "float"), ("1", "bool"), ("[1, 2]", ""), ("[1.0, 2.0]", "")),
    *(
        ("[a, b]", ""),
        ("[x, y, z]", ""),
        ("[a, 'on']", ""),
        ("['1', '2']", ""),
        ("08", ""),
        ("inf", ""),
        ("12:30:00", "str"),
        ("1_000", ""),
        ("n", ""),
    ),
]
"""Values and types of a `<param>`."""
PYTHON: list[Any] = [True, 1, 1.0, 1e16, "y", "1e3", "on", "", "5", "null", "a b", ["a", "b"], ["a", "y"], [1.0, 2.0]]
ASK = """
import json, sys, warnings
warnings.simplefilter("ignore")
import rclpy
from rclpy.context import Context
for path, default in json.load(sys.stdin):
    context = Context()
    try:
        rclpy.init(args=["--ros-args", "--params-file", path], context=context)
    except Exception:
        print(json.dumps(["refused", None]))
        continue
    node = rclpy.create_node("n", context=context, start_parameter_services=False, enable_rosout=False)
    try:
        value = node.declare_parameter("p", default).value
        print(json.dumps(["taken", list(value) if hasattr(value, "tolist") else value]))
    except Exception as error:
        print(json.dumps([type(error).__name__, None]))
    node.destroy_node()
    context.shutdown()
"""


def real(cases: list[tuple[str, Any]]) -> list[tuple[str, Any]]:
    """What rclpy does with each file for a parameter of that default; None for what it takes from the file."""
    python = ros2_prefix() / "bin" / "python"
    done = subprocess.run([python, "-c", ASK], input=json.dumps(cases), capture_output=True, text=True, check=True)
    return [tuple(json.loads(line)) for line in done.stdout.splitlines()]


def interfaces(kinds: list[str]) -> str:
    return json.dumps({f"/{k}": {"params": {"~p": DEFAULTS[k]}} for k in kinds})


def told(launch: str, files: str) -> set[tuple[str, str]]:
    """Rule and node of all that is said of the parameters."""
    context = analyse(read_fixture(f"//- /a.launch.xml\n{launch}{files}\n//- interfaces\n{interfaces(list(DEFAULTS))}"))
    found = set()
    for finding in run_rules(context):
        for kind in DEFAULTS:
            if finding.rule == "PRM016" or f" /{kind} declares" in finding.message:
                found.add((finding.rule, kind))
    return found


def same(ours: Any, theirs: Any) -> bool:
    return repr(ours) == repr(theirs)


def test_values_of_parameter_files(tmp_path: Path) -> None:
    cases = []
    for index, text in enumerate(VALUES):
        path = tmp_path / f"{index}.yaml"
        path.write_text(f"/**:\n  ros__parameters:\n    p: {text}\n")
        cases += [(str(path), default) for default in (None, *DEFAULTS.values())]
    answers = iter(real(cases))
    nodes = [f'<node pkg="p" exec="e" name="{kind}"><param from="/v.yaml"/></node>' for kind in DEFAULTS]
    for text in VALUES:
        status, value = next(answers)
        node = yaml.compose(f"p: {text}").value[0][1]
        assert (rcl_yaml.refused(node) is not None) == (status == "refused"), text
        if status != "refused" and text != "[]":
            assert same(rcl_yaml.value(node), value), text
        said = told(f"<launch>{''.join(nodes)}</launch>", f"\n//- /v.yaml\n/**:\n  ros__parameters:\n    p: {text}\n")
        for kind in DEFAULTS:
            answer, given = next(answers)
            wrong = answer == "InvalidParameterTypeException" or (answer == "taken" and given is None)
            assert (("PRM014", kind) in said) == wrong, (text, kind, answer, said)
            assert (("PRM016", kind) in said) == (answer == "refused"), (text, kind, answer, said)


FILES = (
    *("n:\n  ros__parameters:\n", "n:\n  ros__parameters: 3\n", "n:\n  ros__parameters: {}\n"),
    *("n:\n  ros__parameters:\n    a: &x 1\n    b: *x\n", "n:\n  ros__parameters: &x\n    a: 1\n"),
    *("n:\n  ros__parameters:\n    a: {}\n    b: 1\n", "n:\n  ros__parameters:\n    b: 1\n    a: {}\n"),
    *("n:\n  ros__parameters:\n    a: [{b: 1, c: d}]\n", "n:\n  ros__parameters:\n    a: [{b: 1}, {b: 2}]\n"),
    *("n:\n  ros__parameters:\n    a: [1, {b: x}]\n", "n:\n  ros__parameters:\n    a: '*x'\n    b: a *b\n"),
)
"""Whole files, of which rcl refuses some."""


def test_files_that_rcl_refuses(tmp_path: Path) -> None:
    paths = [tmp_path / f"{index}.yaml" for index in range(len(FILES))]
    for path, text in zip(paths, FILES, strict=True):
        path.write_text(text)
    answers = real([(str(path), None) for path in paths])
    for text, (status, _) in zip(FILES, answers, strict=True):
        assert bool(read_made_param_file(text).refused) == (status == "refused"), text


def test_simulated_time(tmp_path: Path) -> None:
    """Each node declares it, as a bool, before it is there."""
    start = "import rclpy\nrclpy.init()\nrclpy.create_node('n')\n"
    for text in ("true", "off", '"true"', "yes please", "1", "[true]"):
        path = tmp_path / "v.yaml"
        path.write_text(f"/**:\n  ros__parameters:\n    use_sim_time: {text}\n")
        command = [ros2_prefix() / "bin" / "python", "-c", start, "--ros-args", "--params-file", path]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0 or "InvalidParameterTypeException" in done.stderr
        launch = '<launch><node pkg="p" exec="e" name="n"><param from="/v.yaml"/></node></launch>'
        fixture = f"//- /a.launch.xml\n{launch}\n//- /v.yaml\n{path.read_text()}//- interfaces\n{{}}"
        said = {finding.rule for finding in run_rules(analyse(read_fixture(fixture)))}
        assert ("PRM014" in said) == (done.returncode != 0), text


def test_values_of_launch_files(tmp_path: Path) -> None:
    """launch writes what it reads with PyYAML into a file for rcl."""
    cases: list[tuple[str, Any]] = []
    for index, (text, type_) in enumerate(LAUNCH):
        attribute = f' type="{type_}"' if type_ else ""
        tag = f'<param name="p" value="{text}"{attribute}/>'
        launch = f'//- /a.launch.xml\n<launch><node pkg="p" exec="e" name="n">{tag}</node></launch>'
        (node,) = analyse(read_fixture(launch)).tree.nodes
        path = tmp_path / f"{index}.yaml"
        path.write_text(yaml.dump({"/**": {"ros__parameters": {p.name: p.value for p in node.params}}}))
        cases += [(str(path), default) for default in DEFAULTS.values()]
    answers = iter(real(cases))
    for text, type_ in LAUNCH:
        attribute = f' type="{type_}"' if type_ else ""
        tag = f'<param name="p" value="{text}"{attribute}/>'
        nodes = [f'<node pkg="p" exec="e" name="{kind}">{tag}</node>' for kind in DEFAULTS]
        said = told(f"<launch>{''.join(nodes)}</launch>", "")
        for kind in DEFAULTS:
            answer, _ = next(answers)
            assert (("PRM016", kind) in said) == (answer == "refused"), (text, type_, kind, answer)
            assert (("PRM014", kind) in said) == (answer == "InvalidParameterTypeException"), (
                text,
                type_,
                kind,
                answer,
            )


def test_values_of_python_launch_files(tmp_path: Path) -> None:
    cases: list[tuple[str, Any]] = []
    for index, value in enumerate(PYTHON):
        path = tmp_path / f"{index}.yaml"
        path.write_text(yaml.dump({"/**": {"ros__parameters": {"p": value}}}))
        cases.append((str(path), None))
    for value, (status, arrived) in zip(PYTHON, real(cases), strict=True):
        passed = as_passed(value)
        mixed = isinstance(passed, list) and len({type(each) for each in passed}) > 1
        assert mixed == (status == "refused"), value
        assert mixed or same(passed, arrived), value
