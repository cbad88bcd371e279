"""A Python launch file that is read can do nothing, whatever it says: no code of it runs, it comes to an end soon, and
it sees no file outside of the workspace."""

from __future__ import annotations

import random
import time
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.tracing.reading.reader import Surroundings, read

SECONDS = 5
HEAD = """\
import functools, itertools, json, math, os, pathlib, re, subprocess, sys, textwrap
import yaml
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import Node

"""
LARGE = (
    *("10 ** 10 ** 10", "1 << 10 ** 10", "pow(2, 10 ** 10)", "round(5, -10 ** 10)", "'a' * 10 ** 10", "[0] * 10 ** 10"),
    *("bytes(10 ** 10)", "(1).to_bytes(10 ** 10, 'big')", "'%9999999999d' % 1", "'%*d' % (9999999999, 1)"),
    *("'{:9999999999}'.format(1)", "'{:{}}'.format(1, 9999999999)", "f'{1:9999999999}'", "format(1, '9999999999')"),
    *("'{a:{b}}'.format_map({'a': 1, 'b': 10 ** 10})", "'a'.center(10 ** 10)", "b'a'.ljust(10 ** 10)"),
    *("list(range(10 ** 12))", "sum(range(10 ** 12))", "sorted(reversed(range(10 ** 12)))", "list(iter(int, 1))"),
    *("list(itertools.product(range(1000), repeat=9))", "7 in itertools.product(range(1000), repeat=9)"),
    *(
        "max(map(sum, itertools.product(range(1000), repeat=9)))",
        "math.factorial(10 ** 8)",
        "math.prod([2 ** 3999] * 40000)",
    ),
    *(
        "re.match('(a+)+$', 'a' * 99 + 'b')",
        "re.search('(a|aa)+$', 'a' * 99 + 'b')",
        "re.sub('a*a*a*a*a*b', '', 'a' * 9999)",
    ),
    *(
        "re.sub('a', 'b' * 99999, 'a' * 9999)",
        "('a' * 9999).replace('a', 'b' * 99999)",
        "textwrap.indent('a\\n' * 99999, 'b' * 99999)",
    ),
    *("('a' * 99999).translate({97: 'b' * 99999})", "functools.reduce(lambda a, b: a + a, range(99), 'a')"),
    *("(lambda f: f(f))(lambda f: f(f))", "'a'.join(['b' * 999999] * 9999)", "json.dumps([1] * 9, indent=10 ** 9)"),
    *("yaml.safe_load('a: &a [1, 1]\\n' + ''.join(f'b{i}: &a [*a, *a]\\n' for i in range(60)))", "[" * 150 + "]" * 150),
)
REACHING = (
    *("open('/etc/passwd').read()", "pathlib.Path('/etc/passwd').read_text()", "os.listdir('/etc')"),
    *("open(SECRET).read()", "pathlib.Path(SECRET).read_text()", "open(os.path.join(HERE, '..', 'secret')).read()"),
    *(
        "pathlib.Path(HERE, '..', 'secret').read_text()",
        "yaml.safe_load(open(SECRET))",
        "functools.partial(open, SECRET)().read()",
    ),
    *("subprocess.check_output(['cat', SECRET])", "os.popen('cat ' + SECRET).read()", "__import__('os').listdir('/')"),
    *('eval("open(SECRET).read()")', "exec('x = 1')", "().__class__.__bases__[0].__subclasses__()"),
    *(
        "'{0.__class__.__mro__}'.format('')",
        "'{0.__globals__}'.format(Node.__init__)",
        "str.format('{0.__class__.__mro__}', '')",
    ),
    *("list(map('{0.__class__.__mro__}'.format, ['']))", "getattr((), '__class__').__base__", "type('A', (), {})"),
    *("(lambda: 0).__globals__", "(lambda: 0).call", "Node.__init__.__globals__", "LaunchDescription.__mro__"),
    *("sys.modules['os'].system('true')", "os.environ['HOME']", "FileContent(SECRET).perform(None)"),
    "Command(['cat ', SECRET]).perform(None)",
)
STATEMENTS = (
    *("while True: pass", "for x in itertools.cycle([1]): pass", "def f(): f()\nf()", "sys.exit()", "raise SystemExit"),
    *(
        "raise KeyboardInterrupt",
        "x = []\nx.append(x)\nstr(x)\nLaunchDescription(x)",
        "Node.__init__ = None",
        "Node.x = 1",
    ),
    *("x = []\nfor i in range(60): x = [x, x]\nstr(x)", "x = []\nfor i in range(60): x = [x, x]\nLaunchDescription(x)"),
    *("x = 'a'\nwhile True: x += x", "x = [1]\nwhile True: x += x", "x = [1]\nwhile True: x.extend(x)"),
    *("def f():\n    while True: yield 1\nlist(f())", "class A:\n    def __del__(self): pass", "class A(type): pass"),
    *("class A:\n    def __eq__(self, other): return self == other\nA() == 1", "os.environ['PATH'] = '/nowhere'"),
    *("class A:\n    def __getattr__(self, name): return self.x\nA().y", "def f(): pass\nf.call = print\nf('x')"),
    *(
        "import ctypes\nctypes.string_at(0)",
        "import importlib\nimportlib.reload(os)",
        "sys.path.append('/')\nimport etc",
    ),
    *("try:\n    while True: pass\nexcept BaseException: pass", "try:\n    sys.exit()\nfinally:\n    x = 1"),
    *("sorted([3, 1], key=lambda x: sys.exit())", "[*map(sys.exit, [1])]", "del os.environ['PATH']"),
)


@pytest.fixture
def here(tmp_path: Path) -> Path:
    (tmp_path / "secret").write_text("hidden")
    folder = tmp_path / "workspace"
    folder.mkdir()
    return folder


def _read(here: Path, body: str) -> dict[str, Any] | None:
    names = f"HERE, SECRET = {str(here)!r}, {str(here.parent / 'secret')!r}\n"
    text = HEAD + names + body
    job = {"file": str(here / "a.launch.py"), "text": text, "env": {}, "calls": [], "packages": {}, "assumed": []}
    began = time.thread_time()
    found = read(job, Surroundings(Disk(), (str(here),), (), {}, lambda: []))
    assert time.thread_time() - began < SECONDS
    return found


def _made(expression: str) -> str:
    return f"def generate_launch_description():\n    return LaunchDescription([LogInfo(msg=str({expression}))])\n"


@pytest.mark.parametrize("expression", LARGE)
def test_what_takes_long_or_becomes_large_ends(here: Path, expression: str) -> None:
    _read(here, _made(expression))


@pytest.mark.parametrize("expression", REACHING)
def test_what_is_outside_is_not_seen(here: Path, expression: str) -> None:
    found = _read(here, _made(expression))
    told = repr(found)
    assert "hidden" not in told
    assert "root:" not in told
    assert "<class 'object'>" not in told
    assert found is None or found["unread"] or "error" in found


@pytest.mark.parametrize("statements", STATEMENTS)
def test_statements_do_nothing(here: Path, statements: str) -> None:
    before = dict(vars(os_environ()))
    _read(here, statements + "\ndef generate_launch_description():\n    return LaunchDescription([])\n")
    assert dict(vars(os_environ())) == before
    found = _read(here, _made("'fine'"))
    assert found is not None
    assert [each["x"] for each in found["actions"][0]["a"]["message"]] == ["fine"]


def os_environ() -> Any:
    import os

    return os.environ


TOKENS = (
    *(
        "LaunchDescription",
        "Node",
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        ":",
        ",",
        "'a'",
        "x",
        "=",
        "lambda",
        "for",
        "in",
        "if",
    ),
    *("else", "**", "*", "+", "%", "0", "9", ".", "format", "perform", "\n", "\n    ", "def f():", "return", "x", "os"),
    *("class A:", "import", "yield", "raise", "try:", "except:", "while", "LaunchConfiguration", "open", "not", "None"),
)


@pytest.mark.parametrize("seed", range(40))
def test_any_text_is_read_or_not(here: Path, seed: int) -> None:
    """And nothing is logged, which would fail the test."""
    chosen = random.Random(seed)
    for _ in range(20):
        text = _made("x") if chosen.random() < 0.5 else "x = 1\n" + _made("x + 1")
        at = chosen.randrange(len(text))
        _read(here, text[:at] + " ".join(chosen.choices(TOKENS, k=chosen.randrange(8))) + text[at:])
