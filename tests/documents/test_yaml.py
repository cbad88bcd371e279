"""YAML is read as PyYAML's own parser reads it, which is launch's, whichever parser did it."""

import random
from pathlib import Path

import pytest
import yaml
from preflight_analysis.documents.yaml import parse_yaml

FIXTURES = Path(__file__).parent.parent.parent / "fixtures" / "ros2"
SIGNS = "\t\n :-[]{},&*!|>'\"#%@`?~$()x1.\u00e9\u2028\x85\ufeff\x0c\x00\\"


def shape(root: yaml.Node | None) -> list[object]:
    """Every node with its tag, value and place. The place of a value that is not written at all is left out."""
    found: list[object] = []
    todo = [root] if root is not None else []
    seen: set[int] = set()
    while todo:
        node = todo.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        children = [n for pair in node.value for n in pair] if isinstance(node, yaml.MappingNode) else node.value
        if isinstance(node, yaml.ScalarNode):
            place = (node.start_mark.index, node.end_mark.index) if node.value or node.style else None
            found.append((node.tag, node.value, bool(node.style), place))
        else:
            found.append((node.tag, len(children), node.start_mark.index))
            todo += children
    return found


def test_a_damaged_file_is_read_as_pyyaml_reads_it() -> None:
    texts = [path.read_text() for path in sorted(FIXTURES.rglob("*.yaml"))]
    texts = [text for text in texts if 0 < len(text) < 2_000]
    assert len(texts) > 10
    chance = random.Random(20)
    read = 0
    for _ in range(1_500):
        text = chance.choice(texts)
        for _ in range(chance.choice((0, 1, 1, 2))):
            at = chance.randrange(len(text) + 1)
            text = text[:at] + chance.choice((chance.choice(SIGNS), "")) + text[at + chance.choice((0, 1)) :]
        parsed = parse_yaml("a.yaml", text)
        try:
            expected = yaml.compose(text, Loader=yaml.SafeLoader)
        except yaml.YAMLError:
            assert parsed.document.problems, text
        else:
            assert not parsed.document.problems, text
            assert shape(parsed.node) == shape(expected), text
            read += 1
    assert read > 300


@pytest.mark.parametrize("text", ["a:\t1", "- |# no\n  x", "{a: ?b}", "\ufeffa: 1\n\ufeff", "a: !!str 1", "a: !x 1"])
def test_what_the_parsers_disagree_on_is_left_to_pyyaml(text: str) -> None:
    try:
        expected = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.YAMLError:
        assert parse_yaml("a.yaml", text).document.problems
    else:
        assert shape(parse_yaml("a.yaml", text).node) == shape(expected)


@pytest.mark.parametrize("depth", [100, 1_000, 1_990, 100_000])
@pytest.mark.parametrize("pair", [("[", "]"), ("{a: ", "}"), ("- ", "a")])
def test_no_depth_ends_the_process(pair: tuple[str, str], depth: int) -> None:
    opened, closed = pair
    parsed = parse_yaml("a.yaml", opened * depth + closed * (depth if closed != "a" else 1))
    problems = [problem.message for problem in parsed.document.problems]
    assert (problems, parsed.node is None) == (([], False) if depth == 100 else (["nested too deeply"], True))


@pytest.mark.parametrize(("text", "problems"), [("[" * 310 + "]" * 310, 1), ("- " * 310 + "a", 0)])
def test_as_deep_as_only_lists_below_each_other_may_be(text: str, problems: int) -> None:
    assert len(parse_yaml("a.yaml", text).document.problems) == problems


@pytest.mark.parametrize("text", [r'a: "\UDEADBEEF"', r'"\U00110000": 1', f"%YAML {'9' * 5000}.1\n---\na: 1\n"])
def test_what_pyyaml_has_no_words_for(text: str) -> None:
    """It raises something else than a YAMLError, without a place."""
    assert parse_yaml("", text).document.problems
