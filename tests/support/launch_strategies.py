"""Launch files as hypothesis makes them: every tag, attribute and substitution of roslaunch, right ones and wrong.

A case has the form of `meaning_harness.write_case`. Most of what is drawn is right: roslaunch stops at the first error,
and what comes after it is not compared.
"""

from __future__ import annotations

from collections.abc import Callable
from xml.sax.saxutils import quoteattr

from hypothesis import strategies as st

Draw = Callable[[st.SearchStrategy], str]

FILES = """\
//- base/package.xml
<package><name>base</name><version>1.0.0</version></package>
//- base/files/map.yaml
a: 1
b: {c: 2.5, d: [1, x, {e: on}]}
//- base/files/empty.yaml
//- base/files/list.yaml
- 1
- two
//- base/files/bad.yaml
a: [1
//- base/files/subst.yaml
a: $(arg a)
p: $(find base)/x
//- base/files/text.txt
 12\x20
"""
ENV = "env: SET=value NUM=3 TRUE=true"

WORDS = ("a", "b", "n", "m", "speed", "front/camera", "x1")
NAMES = (*WORDS, "/abs", "/abs/b", "~p", "~p/q", "a//b", "a/", "$(arg a)", "$(arg b)/c", "$(anon n)", "$(env SET)")
ODD_NAMES = ("", "~", "/", "~/x", "1bad", "a b", " a ", "ä", "$(anon)", "//", "~~", "a~b")
NODE_NAMES = ("n", "m", "k", "talker", "$(anon n)", "$(anon m)", "$(arg a)_n", "n_$(arg b)", "$(eval 'e' + str(a))")
SPACES = ("a", "b", "/b", "a/b", "/", "a//b", "a/", "$(arg a)", "$(arg b)/x", "/$(env SET)")
ODD_SPACES = ("", "~", "~x", "$(optenv UNSET)", "1", "a b")
FLAGS = ("true", "false", "True", "FALSE", "$(arg t)", "$(eval t)", "$(eval not t)", "$(env TRUE)")
ODD_FLAGS = ("", "1", "0", "yes", " true", "$(arg a)", "$(eval 1)")
CONDITIONS = ("true", "1", "$(arg t)", "$(eval t)", "$(eval a == 1)", "$(eval arg('b') != 'x')", " TRUE ", "0", "false")
ODD_CONDITIONS = ("", "2", "yes", "$(arg b)", "$(eval None)", "$(env UNSET)")
VALUES = (
    *("1", "-1", "+1", "007", "0x10", "1_000", "1.", ".5", "1.0e3", "1e3", "1_0.5", "nan", "inf", ".inf", "-.inf"),
    *("true", "True", " true ", "tRuE", "yes", "", " ", "a b", " x ", "[1, 2]", "{a: 1}", "text", "1.2.3", "٣", "a.b"),
    *("$(arg a)", "$(arg b)", "$(arg a).$(arg a)", "x$(arg b)y", "$(env NUM)", "$(optenv SET x)", "$(optenv UNSET)"),
    *("$(optenv UNSET some words)", "$(optenv UNSET  two  blanks )", "$(anon n)", "$(anon  m )", "$(dirname)/x"),
    *("$(find base)", "$(find base)/files", "$(find base)/files/../x y", "$(find base)$(find base)", "$(find base)\\x"),
    *("$(find base)/$(arg a)/$(find base)", "$(arg f)", "$(arg f)/x", "$$(arg a)", "$ (arg a)", "$(arg a", "$", "$()"),
    *("\n1\n", "<&>\"'", "a\tb", "# x", "$(arg  a )", "$( arg a)"),
)
ODD_VALUES = (
    *("$(arg none)", "$(arg)", "$(arg a b)", "$(env)", "$(env UNSET)", "$(env SET SET)", "$(optenv)", "$(anon)"),
    *("$(anon a b)", "$(find)", "$(find none)", "$(find none)/x", "$(find base base)", "$(nothing x)", "$(Arg a)"),
    *("$(arg $(arg a))", "$(arg (a))", "x$(eval 1)", "$(eval 1) ", "$( )", "$(dirname x)", "$(arg a)$(nothing)"),
    *("$(find none)$(env UNSET)", "$(arg none)$(find none)", "$(arg r)"),
)
EVALS = (
    *("a", "b", "t", "arg('a')", "a + 1", "str(a) + b", "'x' + str(a)", "env('SET')", "optenv('UNSET', 'd')"),
    *(
        "optenv('UNSET')",
        "find('base') + '/x'",
        "dirname() + '/y'",
        "anon('n')",
        "anon('n') + anon('m')",
        "pi",
        "2 * pi",
    ),
    *("1 / 3", "7 // 2", "-7 % 3", "2 ** 10", "1 if t else 2", "not t", "t and a", "a or b", "a == 1", "'a' in 'abc'"),
    *("1 < 2 < 3", "[1, 2][0]", "(1, 'x')", "{'k': 1}['k']", "str(1.0)", "int('7')", "float('1e3')", "list('ab')"),
    *("ceil(1.2)", "sqrt(2)", "'%s-%d' % (b, 3)", "' '.join(['a', 'b'])", "b.upper()", "'a,b'.split(',')[1]", "None"),
    *(
        "true",
        "True and false",
        "''",
        "arg('b') == 'x'",
        "'x' * 3",
        "degrees(pi)",
        "1e400",
        "a is 1",
        "e",
        "'$(arg a)'",
    ),
)
ODD_EVALS = (
    *("none", "arg('none')", "1/0", "'a' + 1", "a.b", "env('UNSET')", "find('none')", "1 +", "", "x__y"),
    *(
        "[][0]",
        "{}['k']",
        "int('x')",
        "r",
        "arg('r')",
        "a b",
        "len(1)",
        "max(1, 'x')",
        "round('x')",
        "(1",
        "sqrt(-1)",
        "a()",
    ),
)
TYPES = ("auto", "str", "string", "int", "double", "bool", "boolean", "yaml", "Int", " int ", "")
ODD_TYPES = ("float", "$(arg a)", "integer")
YAML = (
    *("a: 1", "a: 1\nb: 2", "a: {b: 1, c: {d: x}}", "{}", "", "  ", "a: {}", "a: 010", "a: 1e3", "a: yes", "a: ~"),
    *("a: deg(90)", "a: rad(pi/2)", "a: .inf", "a: -.INF", "a: .nan", "a: 1_000", "a: 12:30:45", "a: 2020-01-01"),
    *("a: !!binary aGk=", "a: [1, 2.0, x, [y]]", "a: &x {b: 1}\nc: *x", "d: {<<: {a: 1}, b: 2}", "/abs: 1", "~p: 1"),
    *(
        "a/b: 1",
        "'': 1",
        "a: 'x: y'",
        'a: "\\u263a"',
        "a: |\n  text\n  more",
        "# nothing",
        "a: 0x1F",
        "a: 0o7",
        "a: +1",
    ),
    *(
        "a: 1\na: 2",
        "a: $(arg a)",
        "a: $(find base)/x",
        "a: '$(arg b)'",
        "a: 1.",
        "a: null",
        "a: [{b: 1}]",
        "~: {p: 1}",
    ),
    *("a: !!str 1", "a: !!float 1", "a: !degrees 90", "a: !radians pi", "a: 0b11", "a: <tag/>", "a: 190:20:30.15"),
)
ODD_YAML = (
    *("1", "x", "[1, 2]", "a: [", "\ta: 1", "a: 'x", "1: x", "true: 1", "null: 2", "? [1]\n: 2", "--- a\n--- b"),
    *("a: b: c", "a: *none", "a: !!python/none x", "a: $(arg none)", "a: $(env UNSET)", "a: deg(x)", "%", "a: !none 1"),
    *("a: @x", "- 1\n- 2", "a: 2020-13-01", "2.5: 1", "a: {1: 2}", "a: !!int x"),
)
YAML_FILES = ("$(find base)/files/map.yaml", "$(find base)/files/empty.yaml", "$(find base)/files/subst.yaml")
ODD_FILES = ("$(find base)/files/bad.yaml", "$(find base)/files/list.yaml", "$(find base)/files", "none.yaml", "")
INCLUDES = ("$(dirname)/one.launch", "$(dirname)/two.launch")
ODD_INCLUDES = ("$(dirname)/none.launch", "", "$(find base)/files/text.txt", "$(dirname)", "$(find none)/x.launch")


def chance(draw: Draw, percent: int) -> bool:
    return draw(st.integers(0, 99)) >= 100 - percent


class Writer:
    """Draws one launch file after the other. `odd` is how often, in percent, something is wrong."""

    def __init__(self, draw: Draw, odd: int) -> None:
        self._draw, self._odd = draw, odd

    def pick(self, right: tuple[str, ...], wrong: tuple[str, ...] = ()) -> str:
        return self._draw(st.sampled_from(wrong if wrong and chance(self._draw, self._odd) else right))

    def some(self, percent: int) -> bool:
        return chance(self._draw, percent)

    def value(self) -> str:
        if self.some(15):
            return f"$(eval {self.pick(EVALS, ODD_EVALS)})"
        return self.pick(VALUES, ODD_VALUES)

    def tag(self, tag: str, attributes: dict[str, str], content: str = "") -> str:
        """The element; conditions, unknown and missing attributes are added here, for all alike."""
        if self.some(12):
            attributes["if" if self.some(50) else "unless"] = self.pick(CONDITIONS, ODD_CONDITIONS)
        if self.some(self._odd):
            attributes[self.pick(("if", "nmae", "Name", "ns", "value", "respawn", "type", "command"))] = self.value()
        if attributes and self.some(self._odd // 2):
            del attributes[self.pick(tuple(attributes))]
        names = self._draw(st.permutations(list(attributes))) if self.some(20) else list(attributes)
        head = " ".join((tag, *(f"{name}={_quoted(attributes[name])}" for name in names)))
        return f"<{head}>{content}</{tag}>" if content else f"<{head}/>"

    def optional(self, attributes: dict[str, str], percent: int, **choices: Callable[[], str]) -> dict[str, str]:
        for name, choice in choices.items():
            if self.some(percent):
                attributes[name.replace("_", "-") if name in ("launch_prefix", "env_loader") else name] = choice()
        return attributes

    def arg(self) -> str:
        attributes = {"name": self.pick((*"abtfr", "new", "c$(env NUM)"), ("", "$(env UNSET)", "a b"))}
        given = self.pick(("default", "default", "value", "none"))
        if given != "none":
            attributes[given] = self.pick(("true", "false")) if attributes["name"] == "t" else self.value()
        return self.tag("arg", self.optional(attributes, 10, doc=self.value))

    def param(self) -> str:
        attributes = {"name": self.pick(NAMES, ODD_NAMES)}
        source = self.pick(("value",) * 6 + ("textfile", "binfile", "command"))
        if source in ("textfile", "binfile"):
            attributes[source] = self.pick((*YAML_FILES, "$(find base)/files/text.txt"), ODD_FILES)
        else:
            attributes[source] = self.value()
        self.optional(attributes, 30, type=lambda: self.pick(TYPES, ODD_TYPES))
        if self.some(self._odd // 3):
            attributes["textfile"] = self.pick(YAML_FILES, ODD_FILES)
        return self.tag("param", attributes)

    def rosparam(self) -> str:
        attributes: dict[str, str] = {}
        self.optional(
            attributes, 40, command=lambda: self.pick(("load", "load", "dump", "delete"), ("", "set", "Load"))
        )
        self.optional(
            attributes, 30, ns=lambda: self.pick(SPACES, ODD_SPACES), param=lambda: self.pick(NAMES, ODD_NAMES)
        )
        self.optional(attributes, 30, subst_value=lambda: self.pick(FLAGS, ODD_FLAGS))
        if attributes.get("command") == "dump" or (attributes.get("command") != "delete" and self.some(40)):
            attributes["file"] = self.pick(YAML_FILES, ODD_FILES)
            return self.tag("rosparam", attributes)
        text = self.pick(YAML, ODD_YAML if "param" not in attributes else ("1", "[1, 2]", "x", *ODD_YAML))
        escaped = text.replace("&", "&amp;").replace("<", "&lt;")
        return self.tag("rosparam", attributes, f"<![CDATA[{text}]]>" if self.some(20) else escaped)

    def remap(self) -> str:
        return self.tag("remap", {"from": self.pick(NAMES, ODD_NAMES), "to": self.pick(NAMES, ODD_NAMES)})

    def env(self) -> str:
        return self.tag("env", {"name": self.pick(("A", "B", "$(arg a)"), ("", "a=b")), "value": self.value()})

    def machine(self) -> str:
        attributes = {
            "name": self.pick(("m1", "m2", "$(anon m)"), ("",)),
            "address": self.pick(("h", "localhost", "10.0.0.1")),
        }
        self.optional(
            attributes,
            15,
            default=lambda: self.pick(("true", "false", "never", "True", ""), ("maybe",)),
            timeout=lambda: self.pick(("10", "2.5", "10.0"), ("", "0", "-1", "soon")),
            user=lambda: self.pick(("", "u")),
            password=lambda: self.pick(("", "secret")),
            env_loader=lambda: self.pick(("", "/env.sh")),
        )
        if self.some(15):
            attributes["ssh-port"] = self.pick(("22", "", " 23 ", "2_3"), ("x", "2.5"))
        if self.some(self._odd // 2):
            attributes[self.pick(("ros-root", "ros-ip"))] = self.pick(("", "x", "$(env UNSET)"))
        content = self.pick(("<env name='A' value='b'/>", "<Env/>", "<param/>")) if self.some(self._odd // 2) else ""
        return self.tag("machine", attributes, content)

    def node(self, tag: str) -> str:
        attributes = {
            "pkg": self.pick(("p", "base", "$(arg b)"), ("", " ", "$(find none)")),
            "type": self.pick(("t", "u"), ("", " ")),
        }
        name = self.pick(NODE_NAMES, ("", "a/b", "/n", "~n", "1n", "rosout", "a b", "~", "$(anon n)", "n"))
        attributes["name" if tag == "node" else "test-name"] = name
        self.optional(
            attributes,
            12,
            ns=lambda: self.pick(SPACES, ODD_SPACES),
            args=self.value,
            machine=lambda: self.pick(("", "m1", "$(optenv UNSET)"), ("none", "m2")),
            cwd=lambda: self.pick(("node", "ROS_HOME", "ros_home"), ("", "Node", "/tmp")),
            launch_prefix=self.value,
            clear_params=lambda: self.pick(("", *FLAGS), ODD_FLAGS),
        )
        if tag == "test":
            self.optional(
                attributes,
                15,
                name=lambda: self.pick(("", *NODE_NAMES)),
                retry=lambda: self.pick(("1", "", " 2 "), ("x", "1.5")),
            )
            if self.some(20):
                attributes["time-limit"] = self.pick(("60", "1.5", "", "inf"), ("0", "-1", "soon", "nan"))
            if self.some(self._odd // 2):
                attributes[self.pick(("respawn", "output", "required"))] = self.pick(FLAGS, ODD_FLAGS)
        else:
            self.optional(
                attributes,
                12,
                output=lambda: self.pick(("screen", "log", "$(arg o)"), ("", "both", "$(arg a)")),
                respawn=lambda: self.pick(FLAGS, ODD_FLAGS),
                required=lambda: self.pick(("false", "False", "$(eval not t)"), (*FLAGS, *ODD_FLAGS)),
                respawn_delay=lambda: self.pick(("1", "2.5", " 3 ", "1e1", "inf"), ("", "soon")),
            )
        inner = "".join(self._node_child() for _ in range(self._draw(st.integers(0, 3))))
        return self.tag(tag, attributes, inner)

    def _node_child(self) -> str:
        if self.some(self._odd // 2):
            return self.pick(
                ("<Param name='x' value='1'/>", "<REMAP from='a' to='b'/>", "<nothing/>", "text", "<!-- c -->")
            )
        kind = self.pick(("param", "param", "rosparam", "remap", "env"))
        return str(getattr(self, kind)())

    def include(self, files: tuple[str, ...]) -> str:
        attributes = {"file": self.pick(files, ODD_INCLUDES)}
        self.optional(
            attributes,
            25,
            ns=lambda: self.pick(SPACES, ODD_SPACES),
            pass_all_args=lambda: self.pick(FLAGS, ODD_FLAGS),
        )
        if "ns" in attributes or self.some(self._odd // 3):
            self.optional(attributes, 20, clear_params=lambda: self.pick(("", *FLAGS), ODD_FLAGS))
        inner = ""
        for _ in range(self._draw(st.integers(0, 3))):
            if self.some(self._odd):
                inner += self.pick(
                    ("<Arg name='a' value='1'/>", "<param name='x' value='1'/>", "<ENV name='A' value='1'/>", "<x/>")
                )
            else:
                inner += self.env() if self.some(20) else self.passed()
        return self.tag("include", attributes, inner)

    def passed(self) -> str:
        name = self.pick(("r", "c3", *"abtfo"), ("new", ""))
        value = {"t": ("true", "$(arg t)"), "o": ("log", "screen")}.get(name)
        given = self.pick(("value", "value", "default"), ("none",))
        attributes = {"name": name}
        if given != "none":
            attributes[given] = self.pick(value) if value else self.value()
        return self.tag("arg", attributes)

    def body(self, depth: int, files: tuple[str, ...], most: int) -> str:
        lines = []
        kinds = ("param", "param", "node", "node", "rosparam", "remap", "env", "arg", "machine", "test", "group")
        for _ in range(self._draw(st.integers(0, most))):
            kind = self.pick((*kinds, "include", "include") if files else kinds, ("unknown",))
            if kind == "group" and depth < 2:
                attributes = self.optional({}, 50, ns=lambda: self.pick(SPACES, ODD_SPACES))
                if "ns" in attributes or self.some(self._odd // 3):
                    self.optional(attributes, 15, clear_params=lambda: self.pick(("", *FLAGS), ODD_FLAGS))
                lines.append(self.tag("group", attributes, self.body(depth + 1, files, 3)))
            elif kind == "include":
                lines.append(self.include(files))
            elif kind in ("node", "test"):
                lines.append(self.node(kind))
            elif kind == "unknown":
                lines.append(
                    self.pick(("<nothing/>", "<Param/>", "<master/>", "text", "<!-- c -->", "<group/>", "<launch/>"))
                )
            elif kind != "group":
                lines.append(str(getattr(self, kind)()))
        return "\n".join(lines)

    def file(self, files: tuple[str, ...], declared: tuple[str, ...]) -> str:
        how = ("default",) if files else ("default", "default", "default", "value")
        head = "".join(
            f'<arg name="{name}" {self.pick(how)}="{value}"/>'
            for name, value in zip("abtfo", declared, strict=True)
            if not self.some(self._odd // 4)
        )
        head += self.pick(("", "", '<arg name="r"/>', '<arg name="c3" default="3"/>'))
        root = self.pick(
            ("<launch>",) * 9 + ('<launch deprecated="x">',),
            ('<launch if="0">', '<launch unless="x">', "<launch x='1'>"),
        )
        text = f"{root}{head}\n{self.body(0, files, 6)}</launch>"
        if self.some(self._odd // 8):
            text = self.pick(
                (text[:-4], f"<x>{text}</x>", text + text, text.replace("=", "", 1), "", f"<?xml version='1.0'?>{text}")
            )
        return text


def _quoted(text: str) -> str:
    # A line end in an attribute is a blank for XML.
    return quoteattr(text).replace("\n", "&#10;" if text == "\n1\n" else " ")


@st.composite
def cases(draw: Draw) -> str:
    writer = Writer(draw, draw(st.sampled_from((0, 0, 2, 8))))
    declared = ("1", "x", "true", "$(find base)/files", "screen")
    args = ("a:=2", "b:=y", "t:=false", "undeclared:=1", "_p:=1", "r:=z", "__ns:=s", "a:=", "b:=c:=d", "word", "new:=7")
    given = " ".join(writer.pick(args) for _ in range(draw(st.integers(0, 2))) if writer.some(50))
    return "\n".join(
        (
            f"args: {given}",
            ENV,
            writer.file(INCLUDES, declared),
            "//- one.launch",
            writer.file(INCLUDES[1:], ("7", "q", "false", "$(find base)", "log")),
            "//- two.launch",
            writer.file((), ("8", "w", "true", "y", "log")),
            FILES,
        )
    )
