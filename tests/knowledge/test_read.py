"""Files that say what parameters mean."""

import pytest
from preflight_analysis.catalogue.released import DISTRIBUTIONS
from preflight_analysis.knowledge.load import DATA, knowledge_of
from preflight_analysis.knowledge.model import Frames, Meaning
from preflight_analysis.knowledge.read import read_knowledge

PACKAGES = sorted(path.stem for path in DATA.glob("*.yaml"))
KNOWN = {distro for some in DISTRIBUTIONS.values() for distro in some}


@pytest.mark.parametrize("package", PACKAGES)
def test_what_comes_with_it_is_right(package: str) -> None:
    found = knowledge_of(package)
    assert found is not None
    assert (found.package, found.problems) == (package, ())
    assert {"repository", "branch", "commit", "files"} <= found.source.keys()
    for entry in found.entries:
        assert entry.distributions
        assert KNOWN.issuperset(entry.distributions)
    also = found.source.get("also", {})
    assert {each for entry in found.entries for each in entry.distributions}.issuperset(also)


def test_each_distribution_has_its_own_evidence() -> None:
    found = knowledge_of("robot_localization")
    assert found is not None
    assert found.evidence("humble").endswith("at 72f9e93)")
    assert found.evidence("noetic").endswith("at 7bebbed)")
    assert found.evidence("rolling") == found.evidence(None)
    assert found.evidence(None).endswith("at 1cb9533)")


def test_a_package_without_one() -> None:
    assert knowledge_of("no_such_package") is None
    assert knowledge_of("../data/robot_localization") is None


def test_a_file_of_a_user() -> None:
    found = read_knowledge(
        """
package: my_robot
entries:
  - executables: [driver]
    parameters:
      scan_topic: {topic: publisher, type: sensor_msgs/LaserScan, default: scan}
      publish_tf: {default: true}
      speed.topic: {topic: subscriber, type: {stamped: {"true": a/B, "false": c/D}}}
    broadcasts:
      - {parent: odom_frame, child: =base_link, when: {publish_tf: true}}
"""
    )
    assert (found.package, found.problems) == ("my_robot", ())
    (entry,) = found.entries
    assert entry.names == {"executables": ("driver",)}
    assert entry.meanings == (
        Meaning("scan_topic", "topic", "publisher", "sensor_msgs/LaserScan", default="scan"),
        Meaning("publish_tf", "value", default=True),
        Meaning("speed.topic", "topic", "subscriber", type_by={"stamped": {"true": "a/B", "false": "c/D"}}),
    )
    assert entry.frames == (Frames("odom_frame", "=base_link", when={"publish_tf": True}),)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("", 1, "empty file"),
        ("- 1", 1, "expected names with values"),
        ("entries: []", 1, "key 'package' is missing"),
        ("package: p\nentries: 3", 2, "invalid value of 'entries': expected a list"),
        ("package: p\nentry: []", 2, "unknown key 'entry'"),
        ("package: p\nentries:\n  - parameters: {}", 3, "an entry needs one of"),
        (
            "package: p\nentries:\n- executables: [e]\n  parameters:\n    x: {topic: reader}",
            5,
            "value of 'topic'",
        ),
        ("package: p\nentries:\n- executables: [e]\n  parameters:\n    x: {type: a/B}", 5, "'x' needs one of"),
        ("package: p\nentries:\n- executables: [e]\n  parameters:\n    x: {frame: used, joint: read}", 5, "not both"),
        ("package: p\nentries:\n- executables: [e]\n  broadcasts: [{parent: a}]", 4, "needs parent and child"),
        ("package: [", 1, ""),
        ("package: p\nsource: !!python/name:os", 2, ""),
    ],
)
def test_what_is_wrong_is_said_at_its_line(text: str, line: int, message: str) -> None:
    problem = read_knowledge(text).problems[0]
    assert problem.line == line
    assert message in problem.message


def test_aliases_of_aliases_end() -> None:
    bomb = "package: p\nsource:\n  a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n"
    bomb += "".join(f"  a{n}: &a{n} [{','.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 9))
    assert read_knowledge(bomb).problems
