"""What can be written at a cursor in the value of an attribute."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation import expression
from preflight_analysis.evaluation.files import Files
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.references import NAMES
from preflight_analysis.launch.schema import Attribute, Kind
from preflight_analysis.model.context import ExecutableNames
from preflight_analysis.queries import completion_graph as from_graph
from preflight_analysis.queries.arguments import accepted, argument_values, included_file, resolved, visible
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.completion_paths import listed
from preflight_analysis.queries.cursor import Place
from preflight_analysis.queries.language import Language, language_of
from preflight_analysis.queries.param_texts import value_text
from preflight_analysis.workspace.facts import ArgDeclaration
from preflight_analysis.workspace.workspace import Analysis

_EVAL = "$(eval "
_BRACKET = re.compile(r"(?<!\\)(?:\$\(|\))")
_COMMAND_END = re.compile(r"[a-z_-]*")
_NAME_END = re.compile(r"[^\s()$\"'<>/]*")
_IDENTIFIER_END = re.compile(r"\w*")
_STRING_END = re.compile(r"[^'\"]*")
_CALL_WITH_STRING = re.compile(r"(\w+)\s*\(\s*['\"]([^'\"]*)\Z")
_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"")
_IDENTIFIER = re.compile(r"(?<![\w.])[A-Za-z_]\w*\Z|(?<![\w.])\Z")
_PATH = re.compile(r"(?:\$\([^()]*\)|[^\s$=,;]|\$(?!\())*\Z")
_PATH_END = re.compile(r"[^/\s\"'<>$]*")
_PLAIN_WORD = re.compile(r"[^\s$()=,;:]*\Z")

_FUNCTIONS = {
    "arg": "arg('$1')",
    "find": "find('$1')",
    "env": "env('$1')",
    "optenv": "optenv('$1', '$2')",
    "anon": "anon('$1')",
    "dirname": "dirname()",
}
"""roslaunch's own functions in expressions: the substitutions of the same names."""
_OPERATORS = ("and", "or", "not", "in", "if", "else")

_NOTHING = Element("", Span(0, 0), (), (), Span(0, 0), Span(0, 0))
_TAKES_ARGUMENTS: frozenset[Kind] = frozenset(
    {
        "text",
        "node",
        "condition",
        "flag",
        "integer",
        "number",
        "choice",
        "launch-file",
        "yaml-file",
        "file",
        "namespace",
    }
)


@dataclass(frozen=True, slots=True)
class Lookup:
    """What is asked beside an analysis: the texts of files, the executables of packages, and (as of `Workspace`) an
    analysis where nodes matter that have not run yet."""

    files: Files
    executables: ExecutableNames
    ahead_of_runs: Callable[[Analysis], Analysis]


@dataclass(frozen=True, slots=True)
class Asked:
    """One question: the place of the cursor in the newest text, and the facts to answer from."""

    analysis: Analysis
    launch_file: LaunchFile
    offset: int
    place: Place
    lookup: Lookup

    @property
    def language(self) -> Language:
        """The language of the file."""
        return language_of(self.launch_file)

    @property
    def file(self) -> str:
        """The path of the file."""
        return self.document.path

    @property
    def document(self) -> Document:
        """The text and its tree."""
        return self.launch_file.document

    @property
    def before(self) -> str:
        """The value up to the cursor."""
        return self.document.text[self.place.word.start : self.offset]

    @property
    def written(self) -> str:
        """The whole value as it is written."""
        return self.document.text[self.place.word.start : self.place.word.end]

    def word(self, typed: str, end: re.Pattern[str]) -> Span:
        """The word of which `typed` is before the cursor; what `end` matches after it on the line belongs to it."""
        text = self.document.text
        found = end.match(text, self.offset)
        after = text[self.offset : found.end()].split("\n", 1)[0] if found else ""
        return Span(self.offset - len(typed), self.offset + len(after))


def complete_value(asked: Asked, trigger: str | None) -> Completion | None:
    """What can be written at a place in a value."""
    before = asked.before
    if (
        asked.language.has_expressions
        and before.startswith(_EVAL)
        and not (before.endswith(")") and before.count("(") <= before.count(")"))
    ):
        return _in_expression(asked, before[len(_EVAL) :]) if trigger in (None, "'", '"', " ", "(") else None
    opened = _opened(before) if asked.language.nests else before.rfind("$(")
    if opened >= 0 and (asked.language.nests or ")" not in before[opened:]) and not before.endswith("$"):
        return _in_substitution(asked, before[opened + 2 :], whole=opened == 0)
    if before.endswith("$"):
        return _substitutions(asked)
    if trigger in (" ", ":", "$", "("):
        return None
    return _plain(asked, before, trigger)


# Substitutions


def _opened(before: str) -> int:
    """Where the innermost substitution begins that is still open; -1 if none is."""
    starts: list[int] = []
    for found in _BRACKET.finditer(before):
        if found[0] != ")":
            starts.append(found.start())
        elif starts:
            starts.pop()
    return starts[-1] if starts else -1


def _substitutions(asked: Asked) -> Completion:
    """After a lone `$`."""
    items = []
    for command, (takes, doc) in asked.language.substitutions.items():
        if command == "eval" and asked.language.has_expressions and asked.before != "$":
            continue
        text = f"$({command}{' ' if takes else ''})"
        snippet = f"\\$({command} $1)" if takes else f"\\$({command})"
        label = f"$({command}{' ' if takes else ''}{takes.lower()})"
        items.append(Item("command", label, text, doc, snippet=snippet, filter=text))
    return Completion(asked.word("$", re.compile("")), tuple(items))


def _in_substitution(asked: Asked, inner: str, *, whole: bool) -> Completion | None:
    command, blank, argument = inner.lstrip(" ").partition(" ")
    if not blank:
        span = asked.word(command, _COMMAND_END)
        following = asked.document.text[span.end : span.end + 1]
        close = ")" if following not in (")", " ") else ""
        return Completion(span, tuple(_commands(asked, whole, close, takes_blank=following != " ")))
    argument = argument.lstrip(" ")
    if command == "exec-in-pkg":
        first, blank, argument = argument.partition(" ")
        command = "find-pkg-share" if blank else command
        argument = argument if blank else first
    if " " in argument:
        return None
    span = asked.word(argument, _NAME_END)
    following = asked.document.text[span.end : span.end + 1]
    close = ")" if following != ")" and command != "optenv" else ""
    return Completion(span, tuple(_closed(_names(asked, command), close)))


def _commands(asked: Asked, whole: bool, close: str, *, takes_blank: bool) -> Iterator[Item]:
    for command, (takes, doc) in asked.language.substitutions.items():
        if command == "eval" and asked.language.has_expressions and not whole:
            continue
        blank = " " if takes and takes_blank else ""
        snippet = f"{command} $1{close}" if blank and close else None
        yield Item("command", command, command + blank + close, doc, takes.lower(), snippet=snippet)


def _names(asked: Asked, command: str) -> Iterable[Item]:
    match NAMES.get(command):
        case "package":
            return _packages(asked)
        case "argument":
            return _arguments(asked)
        case "variable":
            return _variables(asked)
    return ()


def _closed(items: Iterable[Item], close: str) -> Iterator[Item]:
    return (replace(item, text=item.text + close) for item in items)


def _packages(asked: Asked) -> Iterator[Item]:
    """The workspace's own packages first."""
    environment = asked.analysis.environment
    by_place = sorted(environment.packages.values(), key=lambda p: (not p.is_within(environment.workspace), p.name))
    return (Item("package", each.name, each.name, detail=each.share, about=("package", each.name)) for each in by_place)


def _arguments(asked: Asked) -> Iterator[Item]:
    values = argument_values(asked.analysis, asked.file)
    own = asked.place.element.span if asked.place.element is not None else None
    for declared in visible(asked.launch_file, asked.offset):
        if own is not None and own.contains(declared.span.start):
            continue
        value = values.get(declared.name)
        detail = f"= {value}" if value is not None else argument_detail(declared)
        if declared.span.start > asked.offset:
            detail = f"{detail}, declared below"
        yield Item("argument", declared.name, declared.name, argument_doc(declared), detail)


def argument_detail(declared: ArgDeclaration) -> str:
    """Whether an argument has to be given, or what it is otherwise."""
    return "required" if declared.required else f"default: {declared.default or declared.value or repr('')}"


def argument_doc(declared: ArgDeclaration) -> str:
    """What its author says of an argument, what it may be, and what it is where it is not passed."""
    lines = [escaped(declared.doc)] if declared.doc else []
    if declared.choices:
        lines.append(f"One of {', '.join(map(code, declared.choices))}")
    if not declared.required and declared.value is None:
        lines.append(f"Default: {value_text(declared.default or '')}")
    return "\n\n".join(lines)


def _variables(asked: Asked) -> Iterator[Item]:
    environment = asked.analysis.environment
    variables = {*environment.variables, *environment.withheld}
    # roslaunch's own variables are what is asked for most; those of the shell may hold secrets, so no values.
    return (Item("variable", name, name) for name in sorted(variables, key=lambda n: (not n.startswith("ROS"), n)))


# Expressions


def _in_expression(asked: Asked, written: str) -> Completion | None:
    call = _CALL_WITH_STRING.search(written)
    outside = _QUOTED.sub("", written)
    if "'" in outside or '"' in outside:
        if call is None:
            return None
        return Completion(asked.word(call[2], _STRING_END), tuple(_names(asked, call[1])))
    name = _IDENTIFIER.search(written)
    if name is None:
        return None
    return Completion(asked.word(name[0], _IDENTIFIER_END), tuple(_expression_names(asked)))


def _expression_names(asked: Asked) -> Iterator[Item]:
    for item in _arguments(asked):
        if item.label.isidentifier() and item.label not in expression.NAMES and item.label not in _FUNCTIONS:
            yield item
    for name, call in _FUNCTIONS.items():
        plain = re.sub(r"\$\d", "", call)
        yield Item(
            "function", name, plain, asked.language.substitutions[name][1], snippet=call if plain != call else None
        )
    for name in _OPERATORS:
        yield Item("constant", name, name)
    for name, called in expression.NAMES.items():
        if called:
            yield Item("function", name, f"{name}()", snippet=f"{name}($1)")
        else:
            yield Item("constant", name, name)


# Anything else


def _plain(asked: Asked, before: str, trigger: str | None) -> Completion | None:
    element, attribute = asked.place.element, _attribute(asked)
    if element is None or attribute is None:
        return None
    kind = attribute.kind
    path = _PATH.search(before)
    if path is not None and "/" in path[0] and kind in _TAKES_ARGUMENTS and kind != "namespace":
        return _path(asked, path[0], kind)
    if trigger == "/" and kind not in ("remap-from", "remap-to"):
        return None
    word = _PLAIN_WORD.search(before)
    typed = word[0] if word is not None else ""
    one_word = typed == before and "$" not in asked.written
    whole = list(_of_attribute(asked, attribute)) if one_word or kind not in _TAKES_ARGUMENTS else []
    if kind not in _TAKES_ARGUMENTS:
        return Completion(asked.place.word, tuple(whole)) if "$" not in asked.written else None
    if trigger is not None and kind in ("text", "node"):
        return None  # what can stand anywhere is only shown to those who ask
    pieces = list(_pieces(asked, kind))
    span = asked.place.word if whole else asked.word(typed, _NAME_END)
    return Completion(span, (*whole, *pieces))


def _path(asked: Asked, written: str, kind: Kind) -> Completion | None:
    folder, _, typed = written.rpartition("/")
    where = resolved(asked.analysis, asked.file, f"{folder}/")
    if where is None or not where.startswith("/"):
        return None
    items = listed(asked.analysis.context, folder, where, asked.language.suffixes.get(kind, ()))
    return Completion(asked.word(typed, _PATH_END), tuple(items))


def whole_values(asked: Asked, kind: Kind) -> Iterator[Item]:
    """The names of a kind that there are, for the element at the cursor."""
    source, element = _BY_KIND.get(kind), asked.place.element
    if source is not None and (element is not None or kind == "package"):
        yield from source(asked, element or _NOTHING)


def _of_attribute(asked: Asked, attribute: Attribute) -> Iterator[Item]:
    yield from whole_values(asked, attribute.kind)
    for choice in attribute.choices:
        yield Item("value", choice, choice, detail="default" if choice == attribute.default else "")


def _pieces(asked: Asked, kind: Kind) -> Iterator[Item]:
    if kind in ("launch-file", "yaml-file", "file"):
        yield from _roots(asked)
    for item in _arguments(asked):
        text = f"$({asked.language.argument} {item.label})"
        yield Item(item.kind, text, text, item.doc, item.detail, filter=item.label)


def _attribute(asked: Asked) -> Attribute | None:
    place = asked.place
    if place.element is None or place.attribute is None:
        return None
    tag = asked.language.tag(place.element.tag)
    return tag.attributes.get(place.attribute.name) if tag is not None else None


def _roots(asked: Asked) -> Iterator[Item]:
    """What a path starts with: the file's own folder and package, then the other packages."""
    find = asked.language.package
    own = [p for p in asked.analysis.environment.packages.values() if asked.file.startswith(f"{p.share}/")]
    packages = sorted(_packages(asked), key=lambda item: item.label not in {p.name for p in own})
    paths = [replace(item, label=f"$({find} {item.label})/", text=f"$({find} {item.label})/") for item in packages]
    yield from paths[: len(own)]
    yield Item("folder", "$(dirname)/", "$(dirname)/", asked.language.substitutions["dirname"][1])
    yield from paths[len(own) :]


def _executables(asked: Asked, element: Element) -> Iterator[Item]:
    package = element.get("pkg")
    name = resolved(asked.analysis, asked.file, package.value.text) if package is not None else None
    for each in asked.lookup.executables.names(name or ""):
        yield Item("executable", each, each, detail=name or "", about=("executable", name or "", each))


def _components(asked: Asked, element: Element) -> Iterator[Item]:
    package = element.get("pkg")
    name = resolved(asked.analysis, asked.file, package.value.text) if package is not None else None
    for each in asked.lookup.executables.components(name or ""):
        yield Item("executable", each, each, detail=name or "", about=("component", name or "", each))


def _passed_arguments(asked: Asked, element: Element) -> Iterator[Item]:
    """The arguments of the included file, those that are not passed yet; nothing where one is being declared."""
    include = asked.place.parent
    if include is None or include.tag.lower() != "include":
        return
    target = included_file(asked.analysis, asked.lookup.files, asked.file, include)
    if target is None:
        return
    siblings = (child for child in include.elements if child.span != element.span)
    passed = {name.value.text for child in siblings if (name := child.get("name")) is not None}
    for declared in accepted(target):
        if declared.name not in passed:
            yield Item("argument", declared.name, declared.name, argument_doc(declared), argument_detail(declared))


def _machines(asked: Asked, element: Element) -> Iterator[Item]:
    for name, machine in sorted(asked.analysis.tree.machines.items()):
        yield Item("machine", name, name, detail=machine.address)


def _graph(
    source: Callable[[Analysis, str, Place, Element, str], Iterator[Item]],
) -> Callable[[Asked, Element], Iterator[Item]]:
    def items(asked: Asked, element: Element) -> Iterator[Item]:
        return source(asked.lookup.ahead_of_runs(asked.analysis), asked.file, asked.place, element, asked.before)

    return items


_BY_KIND: Mapping[Kind, Callable[[Asked, Element], Iterable[Item]]] = {
    "package": lambda asked, element: _packages(asked),
    "executable": _executables,
    "component": _components,
    "argument": _passed_arguments,
    "variable": lambda asked, element: _variables(asked),
    "machine": _machines,
    "namespace": _graph(from_graph.namespaces),
    "parameter": _graph(from_graph.parameters),
    "remap-from": _graph(from_graph.remap_sources),
    "remap-to": _graph(from_graph.remap_targets),
}
