"""Makes up steps: a user who types, pastes and changes their mind, an editor that asks, programs that change files."""

from __future__ import annotations

import os
import random
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from tools.endurance.scripted_editor import AT_PLACE, OF_FILE, ScriptedEditor, Step, readable

LONGEST = 12_000
"""Of a text, in characters; a longer one is taken back to what it was."""
MAX_OPEN = 8
_VALUE = re.compile(r"\"([^\"<\n]*)\"|'([^'\n]*)'|:[ ]+([^\s#]+)")
_WORD = re.compile(r"[\w.$(){}/-]+[ ]?")
ODDITIES: Mapping[str, Sequence[str]] = {
    "xml": (
        '<node pkg="p" type="t" name="n"/>',
        '<node pkg="p" exec="e" name="n" namespace="x">\n  <param name="x" value="1"/>\n</node>',
        '<node pkg="p" type="t" name="$(anon n)" ns="a" clear_params="true"/>',
        '<param name="x" type="str" value="1"/>',
        '<param name="~y" command="echo 1"/>',
        "<rosparam>x: {y: 1}</rosparam>",
        '<rosparam command="load" file="$(dirname)/x.yaml"/>',
        '<arg name="a" default="1"/>',
        '<let name="a" value="$(var b)"/>',
        '<remap from="x" to="/y"/>',
        '<group ns="g">\n</group>',
        "<group>",
        "</group>",
        '<push_ros_namespace namespace="$(var a)"/>',
        '<group if="$(eval 1 == 1)" scoped="false">',
        '<include file="$(dirname)/new.launch" pass_all_args="true"/>',
        '<include file="$(find-pkg-share p)/launch/new.launch.xml"><arg name="a" value="1"/></include>',
        "<!-- preflight: ignore[PKG002] not built -->",
        "<![CDATA[",
        "<!--",
        "-->",
        "&amp;&é𝒳\u2028",
        "\r\n",
        "\r",
        ' if="$(arg a)"',
        ' value="$(find p)/x"',
        "$(arg a)",
        "$(eval ",
    ),
    "yaml": (
        "  - node:\n      pkg: p\n      exec: e\n      name: n\n",
        "  - arg:\n      name: a\n      default: '1'\n",
        "  - include:\n      file: $(dirname)/new.launch.yaml\n",
        "  - group:\n    - push_ros_namespace: {namespace: x}\n",
        "key: [1, 2.0, {a: b}]\n",
        "/**:\n  ros__parameters:\n    x: 1\n",
        "*alias\n",
        "&anchor ",
        "<<: *anchor\n",
        "\t",
        "? ",
        "!!binary x\n",
        "'",
        '"',
        "{",
        "]",
        "é𝒳: \u2028\n",
        "---\n",
        "| \n",
        "$(var a)",
    ),
    "py": (
        "    Node(package='p', executable='e', name='n', remappings=[('a', 'b')]),\n",
        "    DeclareLaunchArgument('a', default_value='1'),\n",
        "    LaunchConfiguration('a')",
        "def f(:\n",
        "    if x:\n",
        "(",
        ")",
        "'''",
        "'",
        "\\\n",
        "\t",
        "import os\n",
        "    return LaunchDescription([\n",
        "é𝒳 = 1\n",
        "# \u2028\n",
        "f'{a}",
    ),
}
NEW = (
    '<launch>\n  <arg name="a" default="0"/>\n  <node pkg="p" type="t" name="n"/>\n</launch>\n',
    '<launch>\n  <include file="{self}"/>\n  <param name="x" value="1"/>\n</launch>\n',
    '<launch>\n  <include file="{other}"/>\n  <include file="{self}"/>\n</launch>\n',
    "launch:\n  - include: {{file: '{other}'}}\n",
)
"""The second and the third make rings of includes."""
NO_TEXT = ("fffe3c006c00", "80818283", "00" * 40, "3c6c61756e63683ee9")


class Typist:
    """Steps for the files of an editor. `names` are those that it opens, `pool` the texts that it takes pieces from."""

    def __init__(
        self,
        editor: ScriptedEditor,
        chance: random.Random,
        names: Sequence[str],
        pool: Sequence[str],
        *,
        pauses: bool = False,
    ) -> None:
        self._editor = editor
        self._pauses = pauses
        self._chance = chance
        self._names = list(names)
        self._originals = {name: readable(editor.path(name)) or "" for name in names}
        folders = sorted({os.path.dirname(name) for name in names})
        self._extra = [f"{folder}/new{suffix}" for folder in folders for suffix in (".launch", ".launch.xml")]
        self._manifests = sorted(
            {str(p.relative_to(editor.root)) for name in names for p in _above(editor, name) if p.is_file()}
        )
        self._pool = pool

    def steps(self, edits: int) -> Iterator[Step]:
        """Until so many edits were made. Each step has been carried out when the next one is asked for."""
        end = self._editor.edits + edits
        while self._editor.edits < end:
            yield from self._one()

    def _one(self) -> Iterator[Step]:
        """One thing that somebody does."""
        editor, chance = self._editor, self._chance
        opened = list(editor.texts)
        kinds = ["type", "erase", "paste", "cut", "word", "value", "undo", "revert", "many", "open", "close", "save"]
        weights = [10, 4, 8, 6, 6, 8, 6, 2, 3, 4, 2, 2, 3, 12 if self._pauses else 3]
        kind = chance.choices([*kinds, "disk", "wait"], weights)[0]
        if kind == "open" or not opened:
            if len(opened) >= MAX_OPEN:
                yield ["close", chance.choice(opened)]
            yield ["open", chance.choice([*self._names, *self._extra])]
        elif kind == "disk":
            yield from self._disk()
        elif kind == "wait":
            yield self._question(chance.choice(opened), 0, False)
            yield ["pause" if self._pauses else "wait"]
        elif kind in ("close", "save"):
            yield [kind, chance.choice(opened)]
        else:
            # Somebody stays in a file for a while.
            name = opened[-1] if chance.random() < 0.8 else chance.choice(opened)
            for edit in self._edits(kind, name):
                yield ["edit", name, *edit]
                if chance.random() < 0.15:
                    yield self._question(name, edit[-1][0], chance.random() < 0.5)

    def _edits(self, kind: str, name: str) -> Iterator[list[tuple[int, int, str]]]:
        chance, text = self._chance, self._editor.texts[name]
        if len(text) > LONGEST or kind == "revert" or not text:
            yield [(0, len(text), self._originals.get(name) or NEW[0])]
            return
        at = self._place(text)
        if kind == "type":
            yield from _typed(at, self._snippet(name)[: chance.choice((6, 20, 60))])
        elif kind == "erase":
            for count in range(chance.randrange(1, 12)):
                yield [(max(0, at - count - 1), max(0, at - count), "")]
        elif kind == "paste":
            yield [(at, at, self._snippet(name))]
        elif kind == "cut":
            yield [(at, self._place(text) if chance.random() < 0.1 else at + chance.randrange(60), "")]
        elif kind == "word":
            if words := list(_WORD.finditer(text)):
                yield [(*chance.choice(words).span(), "")]
        elif kind == "value":
            yield from self._value(name, text)
        elif kind == "undo":
            before = self._editor.undo[name]
            if before:
                yield [(0, len(text), before[-chance.randrange(1, len(before) + 1)])]
        else:  # many cursors
            word = chance.choice(_WORD.findall(text) or [" "]).strip()
            new = self._snippet(name)[:5]
            places = [each.start() for each in re.finditer(re.escape(word), text)][-6:] if word else []
            if places:
                yield [(start, start + len(word), new) for start in reversed(places)]

    def _value(self, name: str, text: str) -> Iterator[list[tuple[int, int, str]]]:
        """Another value for an attribute or a key, one that there is elsewhere."""
        mine = list(_VALUE.finditer(text))
        others = [match[match.lastindex or 0] for match in _VALUE.finditer(self._chance.choice([text, *self._pool]))]
        if mine and others:
            match = self._chance.choice(mine)
            start, end = match.span(match.lastindex or 0)
            new = self._chance.choice(others)
            if self._chance.random() < 0.5:
                yield [(start, end, new)]
            else:
                yield [(start, end, "")]
                yield from _typed(start, new[:40])

    def _place(self, text: str) -> int:
        """Mostly at the start of a line, where tags are put; else anywhere."""
        at = self._chance.randrange(len(text) + 1)
        return text.rfind("\n", 0, at) + 1 if self._chance.random() < 0.6 else at

    def _snippet(self, name: str) -> str:
        kind = {".py": "py", ".yaml": "yaml", ".yml": "yaml"}.get(Path(name).suffix, "xml")
        if self._chance.random() < 0.5:
            return self._chance.choice(ODDITIES[kind])
        texts = [self._originals[each] for each in self._names if Path(each).suffix == Path(name).suffix]
        lines = self._chance.choice(texts or self._pool).splitlines(keepends=True) or ["\n"]
        start = self._chance.randrange(len(lines))
        return "".join(lines[start : start + self._chance.choice((1, 1, 1, 2, 3, 6))])[:400]

    def _question(self, name: str, at: int, cancelled: bool) -> Step:
        others = ("workspace/symbol", "rosPreflight/tree", "rosPreflight/roots")
        # What is asked at each keystroke more often than the rest.
        often = ("completion", "hover", "documentSymbol", "semanticTokens/full", "codeAction")
        method = self._chance.choice([*AT_PLACE, *OF_FILE, *others, *often, *often])
        return ["ask", method, name, at, cancelled]

    # What happens to files

    def _disk(self) -> Iterator[Step]:
        chance = self._chance
        name = chance.choice([*self._names, *self._extra])
        other = chance.choice(self._names)
        kinds = ["write", "write", "delete", "rename", "folder", "link", "ring", "pipe", "bytes", "package", "restore"]
        kind = chance.choices(kinds, [3, 3, 3, 2, 1, 2, 2, 1, 1, 1, 8])[0]
        beside = os.path.relpath(self._editor.path(other), self._editor.path(name).parent)
        if kind == "write":
            own = os.path.basename(name)
            yield ["write", name, chance.choice(NEW).format(self=f"$(dirname)/{own}", other=f"$(dirname)/{beside}")]
        elif kind == "delete":
            yield ["delete", name]
        elif kind == "rename":
            yield ["rename", name, chance.choice([*self._extra, name + ".launch"])]
        elif kind == "folder":
            yield ["folder", name, NEW[0]]
        elif kind == "link":
            yield ["link", name, chance.choice([beside, "missing.launch", ".", ".."])]
        elif kind == "ring":
            yield ["link", name, chance.choice([os.path.basename(name), beside])]
            yield ["link", other, os.path.relpath(self._editor.path(name), self._editor.path(other).parent)]
        elif kind == "pipe":
            yield ["pipe", name]
        elif kind == "bytes":
            yield ["bytes", name, chance.choice(NO_TEXT)]
        elif kind == "package" and self._manifests:
            manifest = chance.choice(self._manifests)
            yield ["rename", manifest, manifest + ".away"]
            yield self._question(other, 0, False)
            yield ["rename", manifest + ".away", manifest]
        else:
            for odd in self._odd() or [name]:
                if odd in self._originals:
                    yield ["write", odd, self._originals[odd]]
                else:
                    yield ["delete", odd]

    def _odd(self) -> list[str]:
        """Some of the files that are not what they were."""
        odd = [name for name in self._names if readable(self._editor.path(name)) is None]
        odd += [name for name in self._extra if os.path.lexists(self._editor.path(name))]
        return self._chance.sample(odd, min(len(odd), 2))

    def restored(self, suffix: str = "") -> Iterator[Step]:
        """Everything with that suffix closed and as it was."""
        for name in [name for name in self._editor.texts if name.endswith(suffix)]:
            yield ["close", name]
        for name, text in self._originals.items():
            if not name.endswith(suffix):
                continue
            if self._editor.path(name).is_symlink() or readable(self._editor.path(name)) != text:
                yield ["write", name, text]
        for name in [*self._extra, *(name + ".launch" for name in self._names)]:
            if name.endswith(suffix):
                yield ["delete", name]


def _typed(at: int, text: str) -> Iterator[list[tuple[int, int, str]]]:
    for count, char in enumerate(text):
        yield [(at + count, at + count, char)]


def _above(editor: ScriptedEditor, name: str) -> list[Path]:
    return [parent / "package.xml" for parent in editor.path(name).parents if editor.root in parent.parents]
