"""Text of a behaviour tree file → its trees (versions 3 and 4 of BehaviorTree.CPP).

What makes a file one that cannot be loaded: VerifyXML and instantiateTree in src/xml_parsing.cpp of
BehaviorTree/BehaviorTree.CPP, tags 3.8.6 and 4.7.0.
"""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Attribute, Document, Element, SyntaxProblem
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.incremental.derived import derived

_EXPLICIT = frozenset({"Action", "Condition", "Control", "Decorator"})
SUBTREES = frozenset({"SubTree", "SubTreePlus"})
"""The tags that name another tree."""
_MODELS = "TreeNodesModel"
_UNCLOSED = ("expected </", "closes nothing", "is not closed", "</")


@dataclass(frozen=True, slots=True)
class Used:
    """A node type or a tree that is used in a tree, and where its name stands; also its attributes, how many children
    it has, and in which tree of the file it is. `tag` is that of its element: the name itself, or what kind it is."""

    name: str
    span: Span
    attributes: tuple[Attribute, ...] = ()
    children: int = 0
    tree: int = 0
    tag: str = ""
    tag_span: Span = Span(0, 0)

    def get(self, attribute: str) -> Attribute | None:
        """The attribute of that name."""
        return next((each for each in self.attributes if each.name == attribute), None)


@dataclass(frozen=True, slots=True)
class Included:
    """A file whose trees an `<include>` adds: `path` is relative to the share folder of `package`, else to the file."""

    path: str
    package: str | None
    span: Span


@dataclass(frozen=True, slots=True)
class TreeFile:
    """What a behaviour tree file has. `problems` are what the library refuses in the file by itself; `trees` the names
    of its trees, `main` the one that is asked for, `main_problems` what is wrong with that once the file itself is
    loaded, and not included by another one. `models` are the nodes that the file describes for editors, as those
    of its author."""

    problems: tuple[SyntaxProblem, ...] = ()
    main_problems: tuple[SyntaxProblem, ...] = ()
    trees: tuple[str, ...] = ()
    main: Used | None = None
    nodes: tuple[Used, ...] = ()
    subtrees: tuple[Used, ...] = ()
    includes: tuple[Included, ...] = ()
    models: tuple[str, ...] = ()
    format: str = ""


@derived
def read_trees(document: Document) -> TreeFile:
    """The trees of a file whose text the document has. Never raises; ask through `document.once`."""
    parsed = parse_xml(document.path, document.text, lines=document.lines)
    if parsed.problems:
        # The library's parser takes much that is no XML (`<` in values): only tags that do not match are sure.
        first = next((each for each in parsed.problems if any(word in each.message for word in _UNCLOSED)), None)
        return TreeFile((first,) if first is not None and len(parsed.problems) == 1 else ())
    root = parsed.root
    if root is None:
        return TreeFile((SyntaxProblem("the file has no <root>", Span(0, min(1, len(document.text)))),))
    if root.tag != "root":
        return TreeFile((SyntaxProblem(f"the document element must be <root>, not <{root.tag}>", root.tag_span),))
    return _of_root(root)


def _of_root(root: Element) -> TreeFile:
    trees = tuple(each for each in root.elements if each.tag == "BehaviorTree")
    ids = tuple(id_.name for each in trees if (id_ := _used(each, "ID")) is not None)
    main = _used(root, "main_tree_to_execute")
    includes = tuple(filter(None, map(_included, root.elements)))
    models = tuple(filter(None, (_text(each, "ID") for m in root.elements for each in m.elements if m.tag == _MODELS)))
    main_problems: list[SyntaxProblem] = []
    if not includes:
        if main is not None and main.name not in ids and len(ids) == len(trees):
            main_problems.append(SyntaxProblem(f"the file has no tree '{main.name}', its main tree", main.span))
        elif main is None and len(trees) > 1:
            text = f"<root> has {len(trees)} trees and no 'main_tree_to_execute'"
            main_problems.append(SyntaxProblem(text, root.tag_span))
        elif not trees:
            main_problems.append(SyntaxProblem("<root> has no <BehaviorTree>", root.tag_span))
    problems: list[SyntaxProblem] = []
    nodes: list[Used] = []
    subtrees: list[Used] = []
    for at, tree in enumerate(trees):
        children = tuple(tree.elements)
        if len(children) != 1:
            text = f"<BehaviorTree> must have exactly one child, not {len(children)}"
            problems.append(SyntaxProblem(text, tree.tag_span))
        for each in _below(tree):
            named = _used(each, "ID")
            if each.tag in _EXPLICIT or each.tag in SUBTREES:
                if named is None:
                    problems.append(SyntaxProblem(f"<{each.tag}> needs an attribute 'ID'", each.tag_span))
                else:
                    (subtrees if each.tag in SUBTREES else nodes).append(_of_element(named.name, named.span, each, at))
            else:
                nodes.append(_of_element(each.tag, each.tag_span, each, at))
            if each.tag in SUBTREES and any(each.elements):
                problems.append(SyntaxProblem(f"<{each.tag}> must not have children", each.tag_span))
    format_ = _used(root, "BTCPP_format")
    version = format_.name if format_ is not None else ""
    return TreeFile(
        tuple(problems), tuple(main_problems), ids, main, tuple(nodes), tuple(subtrees), includes, models, version
    )


def entry_of(attribute: Attribute) -> str | None:
    """The entry of the blackboard that a port names: `{goal}`, or `{=}` for one of the port's own name."""
    value = attribute.value.text
    if not (len(value) > len("{}") and value.startswith("{") and value.endswith("}")):
        return None
    named = value[1:-1].strip()
    return attribute.name if named == "=" else named


def _included(element: Element) -> Included | None:
    path, package = _used(element, "path"), _used(element, "ros_pkg")
    if element.tag != "include" or path is None:
        return None
    return Included(path.name, package.name if package is not None else None, path.span)


def _of_element(name: str, span: Span, element: Element, tree: int) -> Used:
    return Used(name, span, element.attributes, sum(1 for _ in element.elements), tree, element.tag, element.tag_span)


def _below(element: Element) -> Iterator[Element]:
    pending = list(element.elements)[::-1]
    while pending:
        each = pending.pop()
        yield each
        pending += list(each.elements)[::-1]


def _text(element: Element, attribute: str) -> str:
    found = element.get(attribute)
    return found.value.text if found is not None else ""


def _used(element: Element, attribute: str) -> Used | None:
    found = element.get(attribute)
    return Used(found.value.text, found.value.span) if found is not None and found.value.text else None
