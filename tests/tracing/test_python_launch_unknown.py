"""What a Python launch file makes of an argument that nobody gives is not known: in no way of writing it does it become
a fact."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown, unknown_text
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import ast, collections, fnmatch, functools, hashlib, itertools, json, math, operator, os, pathlib, re, shlex, string
import subprocess, textwrap
import yaml
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import *

"""
VALUES = (
    *(
        "str(x)",
        "repr(x)",
        "format(x)",
        "format(x, '>20')",
        "f'{x}'",
        "f'{x!r}'",
        "f'{x:>20}'",
        "f'{x:.3}'",
        "ascii(x)",
    ),
    *("f'/robots/{x}/base'", "'%s' % x", "'%s_%s' % (x, 1)", "'%(a)s' % {'a': x}", "'%r' % x", "'%.2s' % x"),
    *(
        "'{}'.format(x)",
        "'{a}'.format(a=x)",
        "'{0:>9}'.format(x)",
        "'{a}'.format_map({'a': x})",
        "'{}_{}'.format(1, x)",
    ),
    *("''.join([x])", "'/'.join(('a', x))", "'_'.join(each for each in ['a', x])", "x.join(['a', 'b'])"),
    *("x + '.yaml'", "'a_' + x", "x * 2", "'a' 'b' + x", "functools.reduce(operator.add, ['a', x])"),
    *("x.replace('x', 'y')", "x.replace('_', '/')", "'a_b'.replace('_', x)", "'a'.replace('a', x)"),
    *("x.strip()", "x.lstrip('a')", "x.rstrip('xyz')", "x.strip('arg_x')", "x.lower()", "x.upper()", "x.title()"),
    *("x.split('_')[0]", "x.split('_')[1]", "x.split('_')[-1]", "x.rsplit('_', 1)[-1]", "x.rsplit('_', 1)[0]"),
    *("x.split()[0]", "x.split(',')[2]", "x.partition('_')[0]", "x.partition('_')[2]", "x.rpartition('_')[2]"),
    *("x.splitlines()[0]", "str(x).split('_')[1]", "('%s' % (x,)).split('_')[1]", "str.split(x, '_')[1]"),
    *("[part for part in x.split('_')][-1]", "x.split('_', maxsplit=1)[1]", "(x + '_b').split('_')[0]"),
    *("x[0]", "x[-1]", "x[1:]", "x[:2]", "x[1:-1]", "x[::-1]", "x[2:5]", "('a' + x)[1:]", "str(x)[2:]"),
    *("x.capitalize()", "x.swapcase()", "x.casefold()", "x.center(30)", "x.ljust(30)", "x.rjust(30)", "x.zfill(30)"),
    *("x.expandtabs()", "x.removeprefix('a')", "x.removesuffix('x')", "x.translate({97: 'b'})", "x.encode().decode()"),
    *("os.path.join('/a', x)", "os.path.join(x, 'a')", "os.path.join('/a', x, 'b.yaml')", "os.path.basename(x)"),
    *(
        "os.path.dirname(x)",
        "os.path.abspath(x)",
        "os.path.realpath(x)",
        "os.path.expanduser(x)",
        "os.path.normpath(x)",
    ),
    *("os.path.splitext(x)[0]", "os.path.splitext(x + '.yaml')[0]", "os.path.split(x)[1]", "os.path.relpath(x, '/a')"),
    *("os.path.expandvars(x)", "os.fspath(x)", "os.sep.join(['', 'a', x])", "os.path.basename('/a/' + x + '.yaml')"),
    *("str(pathlib.Path(x))", "str(pathlib.Path('/a') / x)", "str(pathlib.Path('/a', x, 'b'))", "pathlib.Path(x).name"),
    *("pathlib.Path('/a/' + x).stem", "str(pathlib.Path('/a/' + x).with_suffix('.b'))", "pathlib.Path(x).as_posix()"),
    *("pathlib.Path(x).parts[-1]", "str(pathlib.Path(x) / 'a')", "str(pathlib.Path('/a').joinpath(x))"),
    *("yaml.safe_load(x)", "yaml.safe_load('a: ' + x)['a']", "yaml.dump({'a': x})", "json.dumps({'a': x})"),
    *("json.loads(json.dumps({'a': x}))['a']", "ast.literal_eval(x)", "yaml.safe_load(yaml.dump([x]))[0]", "eval(x)"),
    *("open(x).read()", "open('/a/' + x).readlines()[0]", "pathlib.Path(x).read_text()", "next(iter(open(x)))"),
    *("re.sub('_', '/', x)", "re.sub('a', x, 'a')", "re.split('_', x)[1]", "re.findall(r'\\w+', x)[0]"),
    *("re.match(r'(\\w+)', x).group(1)", "re.search('x', x)[0]", "re.compile('_').sub('/', x)", "re.escape(x)"),
    *("re.compile('_').split(x)[1]", "re.compile(r'\\w+').findall(x)[0]", "re.compile('(x)').search(x).group(1)"),
    *("sorted([x, 'b'])[0]", "min(x, 'b')", "max([x, 'a'])", "sorted([x])[0]", "list(reversed([x]))[0]"),
    *("int(x)", "float(x)", "int(x) + 1", "2 * float(x)", "float(x) / 3", "int(float(x))", "sum([int(x), 2])"),
    *("round(float(x), 2)", "abs(float(x))", "math.radians(float(x))", "math.sqrt(float(x))", "math.pi * float(x)"),
    *("min(int(x), 3)", "str(int(x))", "-float(x)", "divmod(int(x), 2)[0]", "f'{float(x):.2f}'", "'%d' % int(x)"),
    *("len(x)", "len(str(x))", "x.count('a')", "x.find('_')", "x.index('a')", "ord(x[0])", "int(x, 16)", "hash(x)"),
    *("list(x)[0]", "tuple(x)[0]", "[c for c in x][0]", "next(iter(x))", "dict(a=x)['a']", "{'a': x}.get('a')"),
    *("''.join(reversed(x))", "''.join(c for c in x)", "''.join(sorted(x))", "list(map(str.upper, [x]))[0]"),
    *("list(map(str, [x]))[0]", "list(map(int, [x]))[0]", "list(map(float, x.split(',')))[0]", "[*x][0]"),
    *("{'ur5': 1, 'ur10': 2}[x]", "{'ur5': 1}.get(x)", "{'ur5': 1}.get(x, 3)", "{'ur5': 1}.get(str(x), 3)"),
    *("['a', 'b'][int(x)]", "('a', 'b')[int(x)]", "{x: 1}['ur5']", "{f'a_{x}': 1}['a_b']", "list({x: 1})[0]"),
    *("collections.defaultdict(int, {'a': 1})[x]", "collections.OrderedDict(a=1)[x]", "getattr(object(), x, x)"),
    *("x or 'a'", "'a' and x", "x if True else 'a'", "(lambda y: y)(x)", "[y := str(x), y][1]", "(x,)[0]"),
    *("textwrap.dedent(x)", "shlex.split(x)[0]", "shlex.quote(x)", "string.Template('$a').substitute(a=x)", "bool(x)"),
    *(
        "subprocess.check_output(['echo', x]).decode()",
        "subprocess.run(['echo', x]).stdout",
        "bytes(x, 'utf-8').decode()",
    ),
    *("hashlib.md5(x.encode()).hexdigest()", "os.popen('echo ' + x).read()", "x.__add__('a')", "str.__add__('a', x)"),
    *("str.format('{}', x)", "'a'.__add__(x)", "str.join('', [x])", "''.join(map(str, ['a', x]))", "str.lower(x)"),
    *("''.join([part.capitalize() for part in x.split('_')])", "'-'.join(x.split('_'))", "x.split('_')[:1][0]"),
    *("itertools.chain([x]).__next__()", "max(x.split('.'), key=len)", "print(x) or x", "x == 'a'", "x.isdigit()"),
    *(
        "x.lower() == 'true'",
        "x in ('true', '1')",
        "not x",
        "x != 'a'",
        "len(x) > 2",
        "int(x) > 2",
        "x.startswith('a')",
    ),
)
"""Expressions of `x`, each of which depends on it: its value is not known, or that a condition decided it is noted."""


def _launched(harness: PythonHarness, body: str) -> tuple[str, Analysis]:
    text = f"{HEAD}{body}"
    return text, harness.launch(harness.write("launch/a.launch.py", text))


def _decided(text: str, analysis: Analysis) -> set[int]:
    """The lines on which a condition is noted that is not known."""
    places = [each.location.span.start for each in analysis.tree.unknowns if each.decides]
    return {text.count("\n", 0, place) + 1 for place in places}


def test_what_is_made_of_an_argument_without_a_default_is_not_known(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    functions = "".join(f"def f{n}(x): return {each}\n" for n, each in enumerate(VALUES))
    body = f"""{functions}
def value(function, x):
    try:
        return {{'v': function(x)}}
    except Exception as error:
        return {{'raised': f'{{type(error).__name__}}: {{error}}'}}


def start(context):
    x = LaunchConfiguration('arg_x').perform(context)
    return [
        LogInfo(msg=f'{{n}} ' + repr(value(globals()[f'f{{n}}'], x)))
        for n in range({len(VALUES)})
    ]


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('arg_x'), OpaqueFunction(function=start)])
"""
    text, analysis = _launched(harness, body)
    decided = _decided(text, analysis)
    first = HEAD.count("\n")
    said = {int(words[0]): words[1] for each in _messages(analysis) if (words := each.split(" ", 1))}
    facts = {
        expression: said[n]
        for n, expression in enumerate(VALUES)
        if not is_unknown(said[n]) and first + 1 + n not in decided
    }
    assert facts == {}


def _messages(analysis: Analysis) -> list[str]:
    """What the actions of the file log."""
    outputs = [each.result.output for each in analysis.tree.commands if each.result is not None]
    actions = [action for each in outputs for action in json.loads(each)["actions"] if action["k"] == "log"]
    pieces = [action["a"]["message"] for action in actions]
    return ["".join(each if isinstance(each, str) else unknown_text(str(each["w"])) for each in one) for one in pieces]


NONE = ("f'{x}.yaml'", "str(x) + '.yaml'", "'%s.yaml' % x", "'{}.yaml'.format(x)", "'_'.join(['a', str(x)])")


@pytest.mark.parametrize(
    "asked", ["os.environ.get('ROBOT_X')", "os.getenv('ROBOT_X')", "os.environ.get('ROBOT_X', None)"]
)
def test_a_variable_that_this_machine_lacks_is_no_text(tmp_path: Path, asked: str) -> None:
    harness = PythonHarness(tmp_path)
    logged = ", ".join(f"LogInfo(msg={each})" for each in NONE)
    _, analysis = _launched(
        harness, f"x = {asked}\n\ndef generate_launch_description():\n    return LaunchDescription([{logged}])\n"
    )
    assert [each for each in _messages(analysis) if not is_unknown(each)] == []
    (found,) = [each for each in analysis.findings if "'ROBOT_X'" in each.message]
    assert not found.stops_launch


def test_none_that_no_variable_gave_is_what_it_is(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    _, analysis = _launched(
        harness, "\n\ndef generate_launch_description():\n    return LaunchDescription([LogInfo(msg=f'{None}.yaml')])\n"
    )
    assert _messages(analysis) == ["None.yaml"]


BRANCHES = {
    "a loop": "for name in ('a1', 'b2'):\n        if name in str(model):\n            series = name",
    "a match": "match f'{model}':\n        case 'a1':\n            series = 'a1'",
    "a while": "while model.startswith('/'):\n        series = 'a1'\n        model = model[1:]",
    "a conditional expression": "series = 'a1' if str(model) == 'a1' else ''",
    "a table": "series = {'a1': 'a1'}.get(str(model), '')",
    "and": "series = (model == 'a1' and 'a1') or ''",
    "a comprehension": "series = ''.join([each for each in ('a1', 'b2') if each == str(model)])",
    "any": "series = 'a1' if any(each in '%s' % model for each in ('a1', 'b2')) else ''",
    "try": "try:\n        series = {'a1': 'a1'}[f'{model}']\n    except KeyError:\n        pass",
}


@pytest.mark.parametrize("branch", BRANCHES)
def test_what_comes_after_a_condition_that_is_not_known_is_not_certain(tmp_path: Path, branch: str) -> None:
    harness = PythonHarness(tmp_path)
    body = f"""
def start(context):
    model = LaunchConfiguration('model').perform(context)
    series = ''
    {BRANCHES[branch]}
    limits = None if series != 'a1' else {{}}
    return [Node(package='p', executable='e', name='n', parameters=[{{'limits': limits}}])]


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('model'), OpaqueFunction(function=start)])
"""
    _, analysis = _launched(harness, body)
    assert [f.message for f in analysis.findings if f.rule == "LCH032"] == []


def test_arguments_that_an_action_does_not_take_are_found_whatever_is_unknown(tmp_path: Path) -> None:
    harness = PythonHarness(tmp_path)
    body = """
def start(context):
    if LaunchConfiguration('model').perform(context) == 'a1':
        pass
    return [Node(package='p', node_executable='e')]


def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('model'), OpaqueFunction(function=start)])
"""
    _, analysis = _launched(harness, body)
    assert [f.message for f in analysis.findings if f.rule == "LCH032"] == [
        "TypeError: Node.__init__() missing 1 required keyword-only argument: 'executable'"
    ]
