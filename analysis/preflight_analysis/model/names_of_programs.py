"""The names in a program: see `name_index`. Who asks, and when, is not followed: `source/` does that."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.quoted import Program, Quoted
from preflight_analysis.model.entry import JOINT, Entry, Mention, in_quotes, mention

_TOPICS = {
    "Publisher": "offer",
    "Service": "offer",
    "Subscriber": "use",
    "ServiceProxy": "use",
    "advertise": "offer",
    "subscribe": "use",
    "serviceClient": "use",
    "create_publisher": "offer",
    "create_service": "offer",
    "create_subscription": "use",
    "create_client": "use",
}
_OF_PACKAGE = ("FindPackageShare", "get_package_share_directory", "get_package_share_path", "get_path", "getPath")
_NAME = re.compile(r"[~/]?\w[\w/]*")
_TYPE_BEHIND = re.compile(r"\s*,\s*([\w.]+)")
_TYPE_BEFORE = re.compile(r"\(\s*([\w.]+)\s*,\s*\Z")
_OF_TYPE = re.compile(r"[.:]")
_ASKS = re.compile(
    r"(?:.*\W)?(?:param(?:::\w+)?|getParam\w*|get_param\w*|searchParam|(?:declare|get)_(?:or_\w+_)?parameter\w*"
    r"|(?:declare|get)Parameter\w*)"
)
_ASKED_OF = re.compile(r"\(\s*(?:[\w.:>()-]+\s*,\s*)?(?:[\w.:>()-]+\s*\+\s*)?\Z")
"""Between the bracket and a name: what is asked, and what stands before the name."""
_FAR = 200
_WRITTEN = re.compile(r"[~/\w.]*\w/?")
_MACRO = re.compile(r"\b[A-Z][A-Z0-9_]{2,}\(([^()\"]*)\)")
"""What a macro is given may become a text."""
_WORD = re.compile(r"\w+")
_PART = re.compile(r"[/.]")
COMPUTED = "*"
"""A part of a name that a program computes. Above a parameter: any."""
_TERM = (
    r"""(?:(?:std::string|str)\(\s*"[^"\n]*"\s*\)|[bfru]{0,2}"[^"\n]*"|[bfru]{0,2}'[^'\n]*'"""
    r"""|[\w.:>\[\]-]+(?:\([^()"']*\))?)"""
)
_SUM = re.compile(rf"(?<![\w.:>\]\"'-]){_TERM}(?:\s*\+=?\s*{_TERM})+")
"""`"corrections." + role + ".position"`, `name += "_width"`."""
_TERMS = re.compile(_TERM)
_FORMAT = re.compile(r"\{[^{}\n]*\}|%[sd]")
"""What stands for a part in `f"initial_positions.{joint}"`, `"{}.rate"`, `"%s.rate"`."""
_TEXT = re.compile(r"""["']([^"'\n]*)["']""")
_MADE = re.compile(r"[\w./~*]+")
_ASKS_AT_ALL = re.compile(r"param", re.IGNORECASE)
_LEAST = 4
"""Letters that are known of a name that is made."""
_LOADS_YAML = re.compile(r"\byaml\.(?:\w+_)?load\b|\bYAML::Load")
_YAML_FILE = re.compile(r"[\w.-]+\.ya?ml\b")
_TREES = ("behaviortree", "BT::")
_REGISTERS = ("registerNodeType", "registerBuilder")
_CLASS = re.compile(r"\b(?:class|struct)\s+(\w+)\b[^;{}()]{0,200}\{")
_PORTS = re.compile(r"\b(?:(?P<cls>\w+)::)?providedPorts\s*\(\s*\)\s*\{")
_PORT = re.compile(r"\b(?:In|Out|Bidirectional)(?:put)?Port\b")
_MORE_PORTS = re.compile(r"\bprovided\w*Ports\s*\(|\binsert\b|\bmerge\b")
_BRACE = re.compile(r"[{}]")
_LONGEST = 20_000
"""Characters of a function."""
LIBRARY_OF_TREES = "behaviortree"


def names_of_program(program: Program) -> Iterator[Mention]:
    """Those of a source of whatever language."""
    text, loads_yaml = program.text, _LOADS_YAML.search(program.text) is not None
    for each in program.quoted:
        yield from (in_quotes(each, Entry("joint", found)) for found in JOINT.findall(each.text))
        if loads_yaml:
            yield from (in_quotes(each, Entry("yaml-file", found)) for found in _YAML_FILE.findall(each.text))
        if _WRITTEN.fullmatch(each.text):
            yield in_quotes(each, Entry("name", each.text))
            yield from (in_quotes(each, entry) for entry in _of_call(text, each))
    for given in _MACRO.finditer(text):
        start = given.start(1)
        words = _WORD.finditer(given[1])
        yield from (mention(start + word.start(), start + word.end(), Entry("name", word[0])) for word in words)
    if _ASKS_AT_ALL.search(text):
        yield from (mention(0, 0, Entry("made", name)) for name in _made(program.code))
    if any(each in text for each in _TREES):
        yield mention(0, 0, Entry("library", LIBRARY_OF_TREES))
        yield from _of_trees(program)


def _of_call(text: str, each: Quoted) -> Iterator[Entry]:
    if not each.call:
        return
    role = _TOPICS.get(each.called)
    if role is not None and not each.before and _NAME.fullmatch(each.text):
        type_ = each.template
        if not type_:
            before = _TYPE_BEFORE.search(text, each.bracket, each.start) if each.nth == 1 else None
            found = _TYPE_BEHIND.match(text, each.end) if each.nth == 0 else before
            type_ = found[1] if found is not None else ""
        if type_:
            name = each.text.strip("~/")
            yield Entry("topic", name, role, type=_OF_TYPE.split(type_)[-1].strip())
    elif each.called in _OF_PACKAGE and each.nth == 0:
        yield Entry("package", each.text)
    elif _ASKS.fullmatch(each.call) and _ASKED_OF.fullmatch(text[each.bracket : each.start][-_FAR:]):
        above, leaf = parts_of(each.text)
        any_ = not above and each.text[0] in "./"
        yield Entry("parameter", leaf, role="asked", of=COMPUTED if any_ else above)


def parts_of(name: str) -> tuple[str, str]:
    """The part above a parameter's name, empty where there is none, and the name."""
    parts = _PART.split(name.strip("~/."))
    return parts[-2] if len(parts) > 1 else "", parts[-1]


def words_in(name: str) -> list[str]:
    """All parts of the name of a parameter."""
    return _PART.split(name.strip("~/."))


def _made(text: str) -> Iterator[str]:
    """The names that a text puts together of which enough is known to tell them from others."""
    sums = ("".join(map(_part, _TERMS.findall(found[0]))) for found in _SUM.finditer(text))
    for name in (*sums, *(_FORMAT.sub(COMPUTED, each) for each in _TEXT.findall(text))):
        known = name.replace(COMPUTED, "")
        if COMPUTED in name and _MADE.fullmatch(name) and sum(map(str.isalpha, known)) >= _LEAST:
            yield re.sub(r"\*+", COMPUTED, name)


def _part(term: str) -> str:
    """What a term of a sum adds to a name."""
    found = _TEXT.search(term)
    return _FORMAT.sub(COMPUTED, found[1]) if found is not None else COMPUTED


def _of_trees(program: Program) -> Iterator[Mention]:
    """https://www.behaviortree.dev/docs/tutorial-basics/tutorial_01_first_tree: `registerNodeType<Class>("Name")`,
    `registerBuilder<Class>("Name", ...)`; of BehaviorTree.ROS2 `CreateRosNodePlugin(Class, "Name")`."""
    text = program.text
    ports = [each for each in program.quoted if each.called.endswith("Port") and each.nth == 0]
    for each in program.quoted:
        if each.called in _REGISTERS and each.nth == 0:
            cls = each.template.partition(",")[0]
        elif each.called == "CreateRosNodePlugin" and each.nth == 1:
            cls = text[each.bracket + 1 : each.start].rpartition(",")[0]
        else:
            continue
        yield in_quotes(each, Entry("tree-node", each.text, of=cls.strip().rpartition("::")[2]))
    classes = [(found.start(), found[1]) for found in _CLASS.finditer(text)]
    for found in _PORTS.finditer(text):
        cls = found["cls"] or next((name for at, name in reversed(classes) if at < found.start()), "")
        end = _end_of(text, found.end())
        body, own = text[found.end() : end], [each for each in ports if found.end() < each.start < end]
        whole = len(own) == len(_PORT.findall(body)) and _MORE_PORTS.search(body) is None
        yield mention(
            *found.span("cls" if found["cls"] else 0), Entry("tree-class", cls, "closed" if whole else "open")
        )
        for each in own:
            yield in_quotes(each, Entry("tree-port", each.text, each.called, cls, " ".join(each.template.split())))


def _end_of(text: str, start: int) -> int:
    """Where the block ends that begins before `start`."""
    depth = 1
    for found in _BRACE.finditer(text, start, start + _LONGEST):
        depth += 1 if found[0] == "{" else -1
        if depth == 0:
            return found.start()
    return start
