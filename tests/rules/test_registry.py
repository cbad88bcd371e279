"""The rules as a set: found, complete, independent of each other."""

import ast
import logging
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import preflight_analysis.rules as package
import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.failure import Failure
from preflight_analysis.findings.finding import Finding
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.model.context import Context
from preflight_analysis.rules import reference
from preflight_analysis.rules.fix_availability import fix_availability
from preflight_analysis.rules.registry import all_rules, rule_by_id, run_rules
from preflight_analysis.rules.rule import Rule
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import analyse, check, read_fixture

ROOT = Path(__file__).parents[2]
BROKEN = """
    <launch>
      <nod/>
      <param name="a" value="$(arg b)"/>
    </launch>
"""
SILENT = """
    <launch>
      <arg name="camera" default="front"/>
      <group ns="$(arg camera)" if="true">
        <node pkg="p" type="t" name="n" respawn="true" output="screen">
          <remap from="a" to="b"/>
          <param name="rate" value="10"/>
          <rosparam>{frame: map}</rosparam>
        </node>
      </group>
      <include file="/inc.launch"><arg name="rate" value="1"/></include>
    </launch>
    //- /inc.launch
    <launch>
      <arg name="rate"/>
      <machine name="base" address="localhost"/>
      <node pkg="p" type="t" name="m" machine="base" args="$(arg rate) $(optenv NOT_SET x)"/>
    </launch>
"""


def test_nothing_is_said_of_a_file_that_is_all_right() -> None:
    assert check(SILENT) == []


def test_every_kind_of_problem_has_exactly_one_rule() -> None:
    owners = Counter(kind for rule in all_rules() for kind in rule.problems)
    assert owners == dict.fromkeys(_kinds(ProblemKind), 1)


def _kinds(form: type[ProblemKind]) -> Iterator[type[ProblemKind]]:
    """Those that are nobody's form. What a dataclass with slots is made from stays in memory beside it for a while."""
    for kind in form.__subclasses__():
        if getattr(sys.modules[kind.__module__], kind.__name__) is kind:
            yield from _kinds(kind) if kind.__subclasses__() else (kind,)


def test_rules_are_sorted_and_named_as_their_files() -> None:
    rules = all_rules()
    assert [rule.id for rule in rules] == sorted({rule.id for rule in rules})
    files = {path.name[:6].upper() for path in Path(package.__path__[0]).glob("[a-z][a-z][a-z][0-9][0-9][0-9]_*.py")}
    assert files == {rule.id for rule in rules}
    assert len({rule.name for rule in rules}) == len(rules)
    for rule in rules:
        assert re.fullmatch(r"(LCH|ARG|PKG|PRM|TOP|SRV|ACT|QOS|GRF|TRC|URD|FRM|CTL|MVT|BRG|BTR|DEV)\d{3}", rule.id)
        assert re.fullmatch(r"[a-z]+(-[a-z]+)*", rule.name)
        assert all((rule.what, rule.why, rule.example, rule.instead))
    assert rule_by_id("TOP001") in rules
    assert rule_by_id("TOP999") is None


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.id)
def test_every_page_has_each_section(rule: Rule) -> None:
    headings = re.findall(r"^## (.*)$", reference.page(rule), re.MULTILINE)
    assert headings == list(reference.SECTIONS)
    assert rule.what.startswith("Checks "), "write 'Checks for ...'"
    assert rule.references
    for link in rule.references:
        found = re.fullmatch(r"\[[^\]]+\]\((https://[^\s()]+|\.\./(?P<page>\w+\.md))\)", link)
        assert found, link
        assert found["page"] is None or (ROOT / "docs" / found["page"]).is_file(), link


def test_whether_there_is_a_fix_is_read_from_the_code() -> None:
    found = {rule.id: fix_availability(rule) for rule in all_rules()}
    # Of its own finding, of a function that a rule imports, of one that makes the check, and of none.
    assert (found["PKG007"], found["SRV001"], found["PRM002"], found["PRM003"]) == (
        "sometimes",
        "sometimes",
        "sometimes",
        "never",
    )


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.id)
def test_every_rule_has_a_file_of_cases(rule: Rule) -> None:
    """Named as the module of the rule; `conftest.py` sees to it that the rule keeps silent where a test says so."""
    (module,) = Path(package.__path__[0]).glob(f"{rule.id.lower()}_*.py")
    cases = Path(__file__).with_name(f"test_{module.stem}.py")
    assert cases.is_file(), f"write {cases.name}"
    tests = [each for each in ast.parse(cases.read_text()).body if getattr(each, "name", "").startswith("test_")]
    silent = [test for test in tests if "pytest.mark.silent" in map(ast.unparse, test.decorator_list)]
    assert silent, f"no test of {cases.name} is marked silent"
    assert len(silent) < len(tests), f"in no test of {cases.name} the rule speaks"


def test_every_file_of_cases_is_that_of_a_rule() -> None:
    modules = {path.stem for path in Path(package.__path__[0]).glob("*.py")}
    cases = Path(__file__).parent.glob("test_[a-z][a-z][a-z][0-9][0-9][0-9]_*.py")
    assert [path.name for path in cases if path.stem.removeprefix("test_") not in modules] == []


def _raise(rule: Rule, context: Context) -> Iterator[Finding]:
    raise RuntimeError("a bug")
    yield  # a generator, as checks are


@pytest.mark.breaks
def test_a_rule_that_raises_costs_that_rule_only_and_is_named(caplog: pytest.LogCaptureFixture) -> None:
    context = analyse(read_fixture(BROKEN))
    rules = [replace(rule, check=_raise) if rule.id == "LCH004" else rule for rule in all_rules()]
    failures: list[Failure] = []
    with caplog.at_level(logging.ERROR):
        assert [finding.rule for finding in run_rules(context, rules, failures)] == ["ARG001"]
    assert "LCH004" in caplog.text
    assert "a bug" in caplog.text
    (failure,) = failures
    assert (failure.rule, failure.file) == ("LCH004", "/main.launch")
    assert re.fullmatch(r"RuntimeError: a bug \(test_registry\.py:\d+\)", failure.error)


def test_a_rule_that_raises_fails_a_test() -> None:
    context = analyse(read_fixture(BROKEN))
    rules = [replace(rule, check=_raise) if rule.id == "LCH004" else rule for rule in all_rules()]
    with pytest.raises(RuntimeError, match="a bug"):
        run_rules(context, rules)


def test_findings_are_sorted_unique_and_marked_with_their_root() -> None:
    context = analyse(
        read_fixture("""
            <launch><include file="/inc.launch"/><nod/><include file="/inc.launch"/><param/></launch>
            //- /inc.launch
            <launch><nod/></launch>
        """)
    )
    findings = run_rules(context)
    places = [(finding.location.file, finding.location.span.start) for finding in findings]
    assert places == sorted(set(places))
    assert [place[0] for place in places].count("/inc.launch") == 1
    assert {finding.roots for finding in findings} == {("/main.launch",)}


def test_the_reference_in_docs_is_up_to_date() -> None:
    folder = ROOT / "docs" / "rules"
    there = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.md")}
    assert there == reference.pages(), f"run: {reference.COMMAND}"


def test_the_index_lists_every_rule() -> None:
    listed = re.findall(r"^\| \[(\w+)\]\(\1\.md\) \|", reference.pages()["index.md"], re.MULTILINE)
    assert listed == [rule.id for rule in all_rules()]


def test_the_reference_is_written_and_stale_pages_go(tmp_path: Path) -> None:
    (tmp_path / "OLD001.md").write_text("gone")
    assert reference.main([str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.iterdir()} == set(reference.pages())
    assert reference.main([]) == 2


@pytest.mark.parametrize(("build_type", "severity"), [("ament_cmake", "info"), ("catkin", "error")])
def test_what_colcon_ignores_in_a_workspace_that_it_builds(tmp_path: Path, build_type: str, severity: str) -> None:
    for name, kind in (("base", build_type), ("old", "catkin")):
        (tmp_path / "src" / name).mkdir(parents=True)
        manifest = f"<package><name>{name}</name><export><build_type>{kind}</build_type></export></package>"
        (tmp_path / "src" / name / "package.xml").write_text(manifest)
    (tmp_path / "src/old/COLCON_IGNORE").touch()
    launch = tmp_path / "src/old/a.launch"
    launch.write_text('<launch><node pkg="p" type="t" name="$(arg camra)"/></launch>')
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    found = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    assert [(f.rule, f.severity) for f in found if f.rule == "ARG001"] == [("ARG001", severity)]


@pytest.mark.parametrize(("build_type", "severity"), [("ament_cmake", "info"), ("catkin", "error")])
def test_what_a_port_to_ros_2_left_behind(tmp_path: Path, build_type: str, severity: str) -> None:
    manifest = f"<package><name>base</name><export><build_type>{build_type}</build_type></export></package>"
    (tmp_path / "package.xml").write_text(manifest)
    launch = tmp_path / "a.launch"
    launch.write_text('<launch><include file="$(find base)/launch/gone.launch"/></launch>')
    environment = detect_environment(str(tmp_path), {}, root=str(tmp_path / "nothing"))
    found = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    assert [(f.rule, f.severity) for f in found] == [("LCH013", severity)]
    assert found[0].message.endswith("(launch file of ROS 1 in a ROS 2 package)") == (severity == "info")
