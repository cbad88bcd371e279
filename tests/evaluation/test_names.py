import pytest
from preflight_analysis.evaluation import names


@pytest.mark.parametrize(
    ("name", "node", "full"),
    [
        ("chatter", "/talker", "/chatter"),
        ("chatter", "/robot/talker", "/robot/chatter"),
        ("/chatter", "/robot/talker", "/chatter"),
        ("~state", "/robot/talker", "/robot/talker/state"),
        ("a//b/", "/n", "/a/b"),
        ("", "/robot/n", "/robot/"),
    ],
)
def test_resolve(name: str, node: str, full: str) -> None:
    assert names.resolve(name, node) == full


def test_a_remap_applies_once_and_to_resolved_names() -> None:
    remaps = names.resolve_remaps((("chatter", "chater"), ("/robot/chater", "other"), ("~p", "q")), "/robot/n")
    assert names.resolve("chatter", "/robot/n", remaps) == "/robot/chater"
    assert names.resolve("/robot/chatter", "/robot/n", remaps) == "/robot/chater"
    assert names.resolve("~p", "/robot/n", remaps) == "/robot/q"


def test_the_namespaces_of_names() -> None:
    assert names.leaf("/a/b/c") == names.leaf("c") == "c"
    assert names.leaf("/") == ""
    assert names.with_namespaces(["/a/b/c", "/a/d", "e/f", "/"]) == {"/a/b/c", "/a/b", "/a", "/a/d", "e/f", "e", "/"}
