"""What is wrong is a value. Of one place it is said once for each kind and what that is about."""

from pathlib import Path
from types import UnionType
from typing import ClassVar, get_args, get_origin, get_type_hints

from preflight_analysis.documents.span import Location
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.problems import MalformedXml, MalformedYaml, UnsetVariable
from preflight_analysis.launch.problems import ProblemKind
from preflight_analysis.rules.registry import all_rules
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def _is_plain(hint: object) -> bool:
    """Whether values of it can be compared and hashed, and 1 is not taken for True."""
    if get_origin(hint) in (tuple, UnionType):
        return all(_is_plain(each) for each in get_args(hint))
    return hint in (str, bool, Location, type(None), ...)


def test_kinds_have_plain_fields() -> None:
    for kind in {kind for rule in all_rules() for kind in rule.problems}:
        hints = get_type_hints(kind)
        of_class = {name for name, hint in hints.items() if get_origin(hint) is ClassVar}
        assert "usually_fatal" in of_class
        assert all(_is_plain(hint) for name, hint in hints.items() if name not in of_class), kind


def test_a_problem_of_another_kind_is_another_one() -> None:
    one: ProblemKind = MalformedXml("not closed")
    assert one == MalformedXml("not closed")
    assert hash(one) == hash(MalformedXml("not closed"))
    assert one != MalformedXml("no root")
    assert one != MalformedYaml("not closed")


def test_a_place_has_one_problem_for_each_name(tmp_path: Path) -> None:
    """The text of a `<rosparam>` with substitutions is one place."""
    text = "a: $(env ONE)\nb: $(env TWO)\nc: $(env ONE)"
    path = tmp_path / "a.launch"
    path.write_text(f'<launch><rosparam subst_value="true">{text}</rosparam></launch>')
    tree = Workspace(detect_environment(None, {}, []), Sources()).static(str(path)).tree
    assert [problem.kind for problem in tree.problems] == [UnsetVariable("ONE"), UnsetVariable("TWO")]
    assert len({problem.location for problem in tree.problems}) == 1
