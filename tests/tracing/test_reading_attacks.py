"""Ways out of the reading of a Python launch file: to code that runs, to files outside of the workspace, to what other
readings share, and to work without an end. Each was tried; none may be taken."""

from __future__ import annotations

import os
import resource
import time
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.tracing.agents.fake_launch import tables
from preflight_analysis.tracing.reading.reader import Surroundings, read

SECONDS = 4
MEMORY = 400_000
"""Kilobytes that one reading may need more than what was there."""
HEAD = """\
import collections, copy, dataclasses, functools, itertools, json, math, os, pathlib, re, string, sys, textwrap, typing
import yaml
import launch, launch_ros
from launch import LaunchContext, LaunchDescription
from launch.actions import *
from launch.conditions import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import Node
C = LaunchContext()
"""
BAD = "__import__('os').mkdir(HERE + '/done')"
RUNS = (
    # The code of launch's own substitutions runs what they are given, in a run.
    *("class X(PythonExpression): pass\nX(BAD, []).perform(C)", "PythonExpression(BAD, ['os']).perform(C)"),
    *("class X(Command): pass\nX(['mkdir ', HERE, '/done']).perform(C)", "C.perform_substitution(Command(SHELL))"),
    "class X(PythonExpression):\n    def perform(self, context): return super().perform(context)\nX(BAD).perform(C)",
    "class X(Command):\n    def perform(self, context): return super().perform(context)\nX(SHELL).perform(C)",
    "class X(LocalSubstitution): pass\nX('__class__.__init__.__globals__').perform(C)",
    "class C2:\n    def perform_substitution(self, s): return s.perform(self)\nPythonExpression(BAD, []).perform(C2())",
    "launch.utilities.perform_substitutions(C, [PythonExpression(BAD, [])])",
    "PathJoinSubstitution([PythonExpression(BAD, [])]).perform(C)",
    "IfCondition(PythonExpression(BAD, [])).evaluate(C)",
    # Functions of launch that load a file, by way of what calls a function.
    *("list(map(get_launch_description_from_python_launch_file, [EVIL]))", "load_python_launch_file_as_module(EVIL)"),
    "functools.partial(get_launch_description_from_python_launch_file, EVIL)()",
    "sorted([EVIL], key=load_python_launch_file_as_module)",
    "max(EVIL, key=lambda _: load_python_launch_file_as_module(EVIL))",
    "functools.reduce(lambda a, b: b(a), [EVIL, get_launch_description_from_any_launch_file])",
    "OpaqueFunction(function=get_launch_description_from_python_launch_file, args=[EVIL])",
    "collections.defaultdict(functools.partial(load_python_launch_file_as_module, EVIL))['x']",
    "next(iter(functools.partial(load_python_launch_file_as_module, EVIL), 1))",
    "class A:\n    f = load_python_launch_file_as_module\nA.f(EVIL)",
    "class A:\n    f = property(load_python_launch_file_as_module)\nclass B(A): pass\nB().f",
    "def f(): pass\nf.call = load_python_launch_file_as_module\nf.__call__ = f.call\nf(EVIL)",
    "@load_python_launch_file_as_module\ndef f(): pass",
    "with open(HERE + '/x', 'w') as f: f.write(BAD)\neval(compile(open(HERE + '/x').read(), 'x', 'exec'))",
    # Classes that Python makes.
    *("functools.partial(type)('X', (), {'__del__': lambda s: None})", "list(map(type, ['X'], [()], [{}]))"),
    "type('X', (), {})",
    "class M(type):\n    def __call__(cls): pass\nclass A(metaclass=M): pass",
    "class A:\n    def __init_subclass__(cls): pass\nclass B(A): pass",
    "class A:\n    def __set_name__(self, owner, name): pass\nclass B:\n    a = A()",
    "class A:\n    __module__ = 'preflight_analysis.tracing.reading.files'\n    __call__ = load_python_launch_file_as_module\nA()(EVIL)",
    "class A:\n    def __class_getitem__(cls, x): return x\nA[1]",
    "class A:\n    def __reduce__(self): return (print, ('x',))\ncopy.deepcopy(A())",
    # Pickles and tags.
    "yaml.load('!!python/object/apply:os.mkdir [HERE/done]', Loader=yaml.UnsafeLoader)",
    "yaml.load('!!python/object/new:os.mkdir [HERE/done]', yaml.Loader)",
)
"""What may make the folder `done`, or a class of its own."""
REACHES = (
    # From a value to what is behind it.
    *("().__class__.__base__", "''.__class__.__mro__", "{}.__class__.__subclasses__()", "(lambda: 0).__code__"),
    *("(lambda: 0).__closure__", "(x for x in [1]).gi_frame", "(x for x in [1]).gi_code", "Node.__init__.__globals__"),
    *("Node.__subclasses__()", "launch.__dict__", "launch.__loader__", "os.sys", "os.path.os", "json.decoder"),
    *("print.__self__", "len.__self__", "[].append.__self__", "''.join.__self__", "math.pi.__class__.__base__"),
    *("getattr((), '__cl' + 'ass__').__base__", "getattr(Node, '__init__').__globals__", "vars(launch)", "dir()"),
    *(
        "'{0.__class__.__mro__}'.format(1)",
        "'{0[:].__class__.__mro__}'.format({':': 1})",
        "'{0.__init__.__globals__}'.format(C)",
    ),
    *(
        "'{x.__class__.__base__}'.format(x=1)",
        "'{x.__class__.__base__}'.format_map({'x': 1})",
        "'{:{0.__dict__}}'.format(C)",
    ),
    *(
        "str.format('{0.__class__.__mro__}', 1)",
        "list(map('{0.__class__.__mro__}'.format, [1]))",
        "f'{().__class__.__base__}'",
    ),
    *("'%(__class__)s' % C", "string.Formatter().format('{0.__class__}', 1)", "string.Template('$x').substitute(x=1)"),
    *(
        "C.around",
        "C._around",
        "C.preflight_executed",
        "pathlib.Path.files",
        "pathlib.Path._files",
        "pathlib.Path('/')._files",
    ),
    *("C.__dict__", "C.__class__.__init__.__globals__", "os.environ._around", "os.environ.__class__", "sys.modules"),
    *(
        "os.sep.__class__.__base__",
        "functools.partial(len).func.__self__",
        "copy.copy(launch)",
        "os.system.__globals__",
    ),
    *(
        "os.uname().__dict__",
        "os.uname().__class__.__init__",
        "os.uname().__reduce__()",
        "os.uname().__init__.__globals__",
    ),
    *(
        "re.compile('x').__class__",
        "re.match('x', 'x').re",
        "typing.Any.__class__.__base__",
        "typing.get_type_hints(Node)",
    ),
    *("super.__self__", "property.fget", "property(lambda s: 1).fget.__globals__", "type(type(1))", "type(1).mro()"),
    *(
        "object.__subclasses__()",
        "int.__subclasses__()",
        "Exception().__traceback__",
        "type.__getattribute__(int, '__base__')",
    ),
    *(
        "(lambda: 0).call",
        "(lambda: 0).members",
        "Node.describe.__wrapped__",
        "launch.actions.os",
        "launch.substitutions.eval",
    ),
    *("yaml.loader", "yaml.constructor", "dataclasses.sys", "dataclasses.field(default=1).default", "json.codecs"),
)
ERRORS = (
    "try:\n    1 / 0\nexcept Exception as e: x = e.__traceback__.tb_frame",
    "try:\n    1 / 0\nexcept Exception as e: x = e.with_traceback",
    "try:\n    None.x\nexcept Exception as e: x = e.obj.__class__.__base__",
    "try:\n    launch.nothing\nexcept AttributeError as e: x = e.obj",
    "class E(Exception): pass\ntry:\n    raise E\nexcept E as e: x = e.__traceback__",
    "class E(Exception): pass\ntry:\n    raise E\nexcept E as e: x = e.__dict__['preflight_frames']",
    "class E(Exception):\n    def __init__(self): self.preflight_frames = 5\nraise E",
    "class E(Exception):\n    def __str__(self): return self\nraise E",
    "class E(Exception):\n    def __str__(self): raise E\nraise E",
    *(
        "raise BaseException",
        "raise GeneratorExit",
        "raise KeyboardInterrupt",
        "raise StopIteration",
        "raise MemoryError",
    ),
    *(
        "raise RecursionError",
        "sorted([1, 2], key=lambda x: sys.exit())",
        "def f(x): raise KeyboardInterrupt\n[*map(f, [1])]",
    ),
    "class A:\n    def __str__(self): raise SystemExit\nx = LogInfo(msg=str(A()))",
    "class A:\n    def __bool__(self): raise KeyboardInterrupt\nif A(): pass",
    "class A:\n    def __eq__(self, o): raise KeyboardInterrupt\nx = A() in [1, 2]",
    "class A:\n    def __hash__(self): raise SystemExit\nx = {A(): 1}",
    "class A:\n    def __fspath__(self): raise KeyboardInterrupt\nos.path.join(A(), 'x')",
    "class A:\n    def __iter__(self): raise GeneratorExit\nLaunchDescription(A())",
    "class A:\n    def __getattr__(self, name): raise KeyboardInterrupt\nLaunchDescription([A()])",
    "class A:\n    def __getattr__(self, name): return A()\nLaunchDescription([A()])\nNode(package=A(), executable=A())",
    "class A(LaunchDescription):\n    entities = 5\nx = A()",
    "class A(Node):\n    def __init__(self): pass\nLaunchDescription([A()])",
    "class A(Action):\n    def execute(self, context): raise SystemExit\nx = A().visit(C)",
    "class A(Action):\n    condition = 5\nx = A()",
)
"""What a program raises, and what its exceptions hold."""
OUTSIDE = (
    *("open('/etc/passwd').read()", "open(SECRET).read()", "open(HERE + '/../secret').read()", "open(LINK).read()"),
    *("open(HERE + '/folder/secret').read()", "open(HERE + '/folder/../secret').read()", "open(b'/etc/passwd').read()"),
    *(
        "pathlib.Path(LINK).read_text()",
        "pathlib.Path(HERE, 'folder', 'secret').read_text()",
        "yaml.safe_load(open(LINK))",
    ),
    *(
        "open(0).read()",
        "open(pathlib.Path(SECRET)).read()",
        "FileContent(SECRET).perform(C)",
        "FileContent(LINK).perform(C)",
    ),
    *(
        "os.listdir(HERE + '/folder')",
        "os.listdir('/etc')",
        "[*pathlib.Path('/etc').iterdir()]",
        "os.path.realpath(LINK)",
    ),
    *(
        "os.path.exists('/etc/passwd')",
        "os.path.isfile('/etc/passwd')",
        "os.path.isdir('/etc')",
        "pathlib.Path('/etc').exists()",
    ),
    *(
        "os.path.exists(LINK)",
        "os.path.getsize(LINK)",
        "os.stat(SECRET)",
        "os.access('/etc/passwd', 4)",
        "os.walk('/etc')",
    ),
    *("FindExecutable(name='sh').perform(C)", "os.path.expanduser('~')", "os.environ['HOME']", "dict(os.environ)"),
    *(
        "os.path.expandvars('$HOME')",
        "os.getcwd()",
        "pathlib.Path.cwd()",
        "pathlib.Path.home()",
        "os.path.abspath('x')",
    ),
    *("ExecutableInPackage('sh', 'x').perform(C) if False else LaunchLogDir().perform(C)", "os.getenv('HOME')"),
    *("open('/proc/self/environ').read()", "open('/dev/zero').read(1)", "EnvironmentVariable('HOME').perform(C)"),
    "get_launch_description_from_frontend_launch_file(SECRET)",
    "(lambda c: [setattr(c, 'x', 1), open(c).read()])(type('P', (str,), {})(SECRET))",
    "XMLLaunchDescriptionSource(SECRET).get_launch_description(C).entities[0].preflight_location",
)
KINDS_OF_PATHS = (
    "class S(str):\n    def __str__(self): return self\n    def split(self, *a): return HERE.split('/')\nx = open(S(SECRET)).read()",
    "class P:\n    n = 0\n    def __fspath__(self):\n        P.n += 1\n        return SECRET if P.n > 1 else HERE + '/fine'\nx = open(P()).read()",
    "class P:\n    n = 0\n    def __fspath__(self):\n        P.n += 1\n        return SECRET if P.n > 2 else HERE + '/fine'\nx = open(P()).read()",
    "class P(pathlib.Path):\n    def __str__(self): return SECRET\nx = P(HERE, 'fine').read_text()",
)
SHARED = (
    *("Node.x = 1", "Node.__init__ = None", "setattr(Node, 'describe', 1)", "launch.actions.Node = 1", "launch.x = 1"),
    *(
        "os.path.join = 1",
        "os.path.exists = lambda p: True",
        "os.x = 1",
        "math.pi = 3",
        "json.loads = None",
        "sys.path = []",
    ),
    *("Node.describe.x = 1", "Command.command = 'x'", "Command.words.append(1)", "del Node.describe", "del os.sep"),
    *(
        "os.environ['PATH'] = 'x'",
        "os.environ.clear()",
        "os.environ.update(A='b')",
        "del os.environ['PATH']",
        "os.putenv('A', 'b')",
    ),
    *(
        "sys.path.append('/')",
        "sys.modules['os'] = 1",
        "sys.modules.clear()",
        "sys.argv.append('x')",
        "sys.setrecursionlimit(9)",
    ),
    *(
        "string.digits = ''",
        "collections.OrderedDict.x = 1",
        "Exception.x = 1",
        "type.x = 1",
        "LaunchDescription.entities = 1",
    ),
    *("C.launch_configurations['x'] = 1", "typing.Any = 1", "re.purge()", "yaml.SafeLoader.yaml_constructors.clear()"),
    *("yaml.add_constructor('!x', lambda l, n: 1)", "launch.logging.launch_config.level = 1", "yaml.YAMLError.x = 1"),
    *(
        "pathlib.Path.exists = lambda s: True",
        "pathlib.Path.x = 1",
        "import builtins\nbuiltins.open = None",
        "open.x = 1",
    ),
    *(
        "print.x = 1",
        "len = 5",
        "str.x = 1",
        "LaunchContext.environment = 1",
        "C.environment['PATH'] = 'x'",
        "Action.condition = 1",
    ),
    *("functools.partial.x = 1", "IfCondition.attribute = 'x'", "IfCondition.evaluate = lambda s, c: True"),
)
ENDLESS = (
    # Numbers.
    *(
        "10 ** 10 ** 10",
        "pow(10, 10 ** 9)",
        "pow(3, 10 ** 9, 7 ** 5000)",
        "1 << 10 ** 9",
        "round(5, -10 ** 9)",
        "int('9' * 10 ** 6)",
    ),
    *(
        "int('f' * 10 ** 6, 16)",
        "float('1' * 10 ** 6)",
        "math.factorial(10 ** 7)",
        "math.comb(10 ** 6, 10 ** 5)",
        "math.perm(10 ** 6)",
    ),
    *(
        "math.prod([2 ** 3999] * 40000)",
        "math.lcm(*range(1, 40000))",
        "math.pow(10, 10 ** 5)",
        "(7 ** 1000).to_bytes(10 ** 9, 'big')",
    ),
    *(
        "str(7 ** 1400) * 10 ** 5",
        "hex(1 << 3990) * 10 ** 5",
        "sum([7 ** 1400] * 49999)",
        "divmod(7 ** 1400, 3)",
        "math.isqrt(7 ** 1400)",
    ),
    "functools.reduce(lambda a, b: a * a, range(99), 7)",
    # Texts.
    *(
        "'a' * 10 ** 9",
        "'a'.center(10 ** 9)",
        "'a'.ljust(10 ** 9)",
        "'1'.zfill(10 ** 9)",
        "('\\t' * 9 ** 5).expandtabs(9999)",
    ),
    *(
        "b'a' * 10 ** 9",
        "b'a'.center(10 ** 9)",
        "b'a'.zfill(10 ** 9)",
        "bytes(10 ** 9)",
        "bytearray(10 ** 9)",
        "bytes(range(10 ** 9))",
    ),
    *(
        "'{:>1000000000}'.format(1)",
        "'{:{}}'.format(1, 10 ** 9)",
        "f'{1:1000000000}'",
        "f'{1:{10 ** 9}}'",
        "format(1, '>1000000000')",
    ),
    *(
        "'%1000000000d' % 1",
        "'%(a)1000000000d' % {'a': 1}",
        "'%((a))1000000000d' % {'(a)': 1}",
        "'%.1000000000d' % 1",
        "'%.1000000000f' % 1",
    ),
    *(
        "'%*d' % (10 ** 9, 1)",
        "'%.*d' % (10 ** 9, 1)",
        "b'%1000000000d' % 1",
        "'%(a)s' * 9 ** 5 % {'a': 'x' * 10 ** 6}",
    ),
    *(
        "('{0}' * 9 ** 5).format('x' * 10 ** 6)",
        "'%s' * 49999 % tuple(['x' * 10 ** 6] * 49999)",
        "str(['x' * 10 ** 6] * 49999)",
    ),
    *(
        "repr([['x' * 10 ** 6] * 99] * 99)",
        "','.join(['x' * 10 ** 6] * 9999)",
        "','.join({'x' * 10 ** 5 + str(i) for i in range(99)})",
    ),
    *(
        "','.join(iter(['x' * 10 ** 6] * 9999))",
        "','.join(map(str, ['x' * 10 ** 6] * 9999))",
        "('a' * 10 ** 6).replace('a', 'b' * 10 ** 6)",
    ),
    *(
        "('a' * 10 ** 6).replace('', 'b' * 10 ** 6)",
        "b'aaaa'.replace(b'', b'b' * 10 ** 6)",
        "('a' * 10 ** 6).translate({97: 'b' * 10 ** 6})",
    ),
    *(
        "textwrap.indent('a\\n' * 10 ** 5, 'b' * 10 ** 5)",
        "textwrap.fill('a ' * 10 ** 6)",
        "textwrap.dedent(' a\\n' * 10 ** 5)",
    ),
    *(
        "('ü' * 10 ** 5).encode('punycode')",
        "('ü' * 10 ** 5).encode('idna')",
        "'a'.encode('zip')",
        "b'x'.decode('unicode_escape')",
    ),
    *(
        "os.path.join(*['x' * 10 ** 6] * 9999)",
        "pathlib.Path(*['x' * 10 ** 6] * 9999)",
        "os.path.commonprefix([['x'] * 9999] * 9999)",
    ),
    *(
        "pathlib.PurePath('a' * 10 ** 5).match('*a' * 10 ** 4)",
        "os.path.normpath('/..' * 10 ** 6)",
        "json.dumps(['x' * 10 ** 6] * 9999)",
    ),
    *(
        "json.dumps([1], indent=10 ** 9)",
        "json.dumps([[[[1] * 99] * 99] * 99] * 99)",
        "yaml.dump([[[[1] * 99] * 99] * 99] * 99)",
    ),
    *(
        "f\"{'x' * 10 ** 6}\" + " + " + ".join(["f\"{'x' * 10 ** 6}\""] * 40),
        "('x' * 10 ** 6).split('x')",
        "list('x' * 10 ** 6)",
    ),
    # Collections and iterators.
    *(
        "list(range(10 ** 9))",
        "[*range(10 ** 9)]",
        "sum(range(10 ** 9))",
        "max(range(10 ** 9))",
        "set(range(10 ** 9))",
        "tuple(reversed(range(10 ** 9)))",
    ),
    *(
        "[x for x in range(10 ** 9)]",
        "list(iter(int, 1))",
        "any(iter(int, 1))",
        "dict.fromkeys(iter(int, 1))",
        "all(iter(str, 1))",
    ),
    *(
        "','.join(iter(str, 1))",
        "next(filter(None, iter(int, 1)))",
        "list(zip(iter(int, 1), iter(int, 1)))",
        "list(itertools.islice(iter(int, 1), 10 ** 9))",
    ),
    *(
        "list(itertools.product(range(999), repeat=9))",
        "7 in itertools.product(range(999), repeat=9)",
        "list(itertools.permutations(range(20)))",
    ),
    *(
        "list(itertools.count())",
        "list(itertools.cycle([1]))",
        "list(itertools.repeat(1))",
        "list(itertools.combinations(range(99), 20))",
    ),
    *(
        "list(itertools.chain(*[range(40000)] * 40000))",
        "list(itertools.zip_longest(*[range(40000)] * 40000))",
        "collections.deque([0]) * 10 ** 9",
    ),
    *(
        "[0] * 10 ** 9",
        "(0,) * 10 ** 9",
        "[[0] * 10 ** 4] * 10 ** 4 + [[0] * 10 ** 4] * 10 ** 4",
        "sum([[0] * 9999] * 9999, [])",
    ),
    *(
        "list(collections.Counter({'a': 10 ** 9}).elements())",
        "sorted([[0] * 49999] * 49999)",
        "[[0] * 49999] * 49999 == [[0] * 49999] * 49998 + [[1]]",
    ),
    *(
        "[[0] * 9999] * 9999 in [[[0] * 9999] * 9999]",
        "[[[0] * 9999] * 9999].index([[1] * 9999] * 9999)",
        "hash(((0,) * 49999,) * 49999)",
    ),
    *(
        "{((0,) * 49999,) * 49999: 1}",
        "{((0,) * 49999,) * 49999}",
        "{}.get(((0,) * 49999,) * 49999)",
        "{}[((0,) * 49999,) * 49999]",
    ),
    *(
        "set([((0,) * 49999,) * 49999])",
        "dict([(((0,) * 49999,) * 49999, 1)])",
        "{**{'a': 1}, ((0,) * 49999,) * 49999: 1}",
        "copy.deepcopy([[[0] * 999] * 999] * 999)",
    ),
    *(
        "min([[[0] * 9999] * 9999] * 2)",
        "[[[0] * 9999] * 9999].count([[0] * 9999] * 9998 + [1])",
        "functools.reduce(lambda a, b: a + a, range(99), [1])",
    ),
    # Patterns.
    *(
        "re.match('(a+)+$', 'a' * 99 + 'b')",
        "re.match('(a?){40}a{40}', 'a' * 40)",
        "re.match('a?' * 99 + 'a' * 99, 'a' * 99)",
        "re.search('(a|aa)+$', 'a' * 99 + 'b')",
    ),
    *(
        "re.match('(a|a|a)*b', 'a' * 99)",
        "re.sub('', 'y' * 10 ** 6, 'x' * 10 ** 4)",
        "re.sub('(x+)', '\\\\1' * 10 ** 5, 'x' * 10 ** 4)",
        "re.match('(?:a#)\\n+)+', 'a' * 99, re.X)",
    ),
    *(
        "re.match('(?x)(?:a#)\\n+)+', 'a' * 99)",
        "re.findall('.*.*.*.*x', 'a' * 9999)",
        "re.split('a*a*a*a*b', 'a' * 9999)",
        "re.match(r'(a*)*\\1b', 'a' * 99)",
    ),
    *(
        "re.match('(?=(a+)+$)', 'a' * 99 + 'b')",
        "re.compile('(a+)+$').match('a' * 99 + 'b')",
        "re.fullmatch('(.*a){25}', 'a' * 99)",
        "re.match('((a{0,9}){0,9}){0,9}b', 'a' * 99)",
    ),
    *(
        "re.match('(x+x+)+y', 'x' * 99)",
        "re.match('(?i)(a+)+$', 'a' * 99 + 'b')",
        "re.match('((a)|(a))*b', 'a' * 99)",
        "re.match('a{0,9}' * 20 + 'b', 'a' * 99)",
    ),
    # Data.
    *(
        "json.loads('[' * 10 ** 5)",
        "json.loads('{\"a\":' * 10 ** 5)",
        "json.loads('9' * 10 ** 6)",
        "yaml.safe_load('[' * 10 ** 5)",
        "yaml.safe_load('- ' * 10 ** 5)",
    ),
    *(
        "yaml.safe_load('{' * 10 ** 5)",
        "yaml.safe_load('? ' * 10 ** 5)",
        "yaml.safe_load('a: ' + '9' * 10 ** 5)",
        "yaml.safe_load('a: ' + '1:' * 10 ** 5 + '1')",
    ),
    "yaml.safe_load('a: &a [1, 1]\\n' + ''.join(f'b{i}: &a [*a, *a]\\n' for i in range(60)))",
    "yaml.safe_load('a0: &a0 {x: 1, y: 2}\\n' + ''.join(f'a{i + 1}: &a{i + 1}\\n  <<: [*a{i}, *a{i}]\\n' for i in range(60)))",
    "str(yaml.safe_load('a: &a [1, 1]\\n' + ''.join(f'b{i}: &a [*a, *a]\\n' for i in range(60))))",
    "yaml.safe_load('\\n'.join(' ' * i + 'a:' for i in range(500)))",
    "yaml.safe_load(('x: ' + 'a' * 99 + '\\n') * 3000)",
    # Expressions within texts.
    *(
        "PythonExpression('9 ** 9 ** 9', []).perform(C)",
        "PythonExpression('(' * 9999 + ')' * 9999, []).perform(C)",
        "PythonExpression(['1', '+1' * 10 ** 5], []).perform(C)",
    ),
    *(
        "PythonExpression('\"a\" * 9 ** 9', []).perform(C)",
        "PythonExpression('[x for x in range(9 ** 9)]', []).perform(C)",
    ),
)
ENDLESS_STATEMENTS = (
    "x = {i * (2 ** 61 - 1): 1 for i in range(40000)}",
    "x = set([i * (2 ** 61 - 1) for i in range(40000)])",
    "x = set(range(0, (2 ** 61 - 1) * 40000, 2 ** 61 - 1))",
    "x = {}\nfor i in range(40000): x[i * (2 ** 61 - 1)] = 1",
    "@dataclasses.dataclass(frozen=True)\nclass D:\n    n: int\nx = {D(i): 1 for i in range(40000)}",
    "@dataclasses.dataclass(frozen=True)\nclass D:\n    n: int\nx = {}\nfor i in range(40000): x[D(i)] = 1",
    "class D:\n    def __hash__(self): return 1\nx = {D(): 1 for i in range(40000)}",
    "x = ('a' * 10 ** 6).rfind('a' * 250000 + 'b' + 'a' * 250000)",
    "x = ('a' * 10 ** 6).rsplit('a' * 250000 + 'b' + 'a' * 250000)",
    "x = 'a' * 250000 + 'b' + 'a' * 250000 in 'a' * 10 ** 6",
    "x = ('a' * 10 ** 6).strip('b' * 500000 + 'a')",
    "x = ('a' * 10 ** 6).rpartition('a' * 250000 + 'b' + 'a' * 250000)",
    "t = 'a' * 10 ** 6\nreturned = LaunchDescription([LogInfo(msg=t) for i in range(9999)])",
    "t = TextSubstitution(text='a' * 10 ** 6)\nreturned = LogInfo(msg=[t] * 49999)",
    "t = TextSubstitution(text='a' * 10 ** 6)\nx = AnyLaunchDescriptionSource([t] * 49999).location",
    "t = TextSubstitution(text='a' * 10 ** 6)\nx = launch.utilities.perform_substitutions(C, [t] * 49999)",
    "from nav2_common.launch import ReplaceString\nr = {c: d * 9999 for c, d in zip('abcdefgh', 'bcdefghi')}\n"
    "f = ReplaceString(HERE + '/fine', {'f': 'a' * 9999, **r})\nx = f.perform(C)",
    "from nav2_common.launch import RewrittenYaml\nx = RewrittenYaml(HERE + '/a.yaml', {'a' + '.a' * 9999: '1'}).perform(C)",
    "import not_there_at_all",
    *(
        "while True: pass",
        "while True:\n    try: 1 / 0\n    except Exception: pass",
        "while True:\n    try: continue\n    finally: pass",
    ),
    *(
        "for x in itertools.count(): pass",
        "for x in iter(int, 1): pass",
        "def f(): f()\nf()",
        "f = lambda: f()\nf()",
        "class A:\n    def __getattr__(self, n): return getattr(self, n + 'x')\nA().y",
    ),
    "x = 'ab'\nwhile True: x += x",
    "x = 'ab'\nwhile True: x = f'{x}{x}'",
    "x = 'ab'\nwhile True: x = x.replace('a', 'aa')",
    "x = 'ab'\nwhile True: x = '%s%s' % (x, x)",
    "x = 'ab'\nwhile True: x = '{0}{0}'.format(x)",
    "x = 'ab'\nwhile True: x = ''.join([x, x])",
    "x = [1]\nwhile True: x += x",
    "x = [1]\nwhile True: x.extend(x)",
    "x = [1]\nwhile True: x[:0] = x",
    "x = [1]\nx[:] = range(10 ** 9)",
    "x = []\nx += range(10 ** 9)",
    "x = []\nx += iter(int, 1)",
    "x = set()\nx |= set(range(10 ** 9))",
    "x = []\nfor i in range(60): x = [x, x]\nstr(x)",
    "x = []\nfor i in range(60): x = [x, x]\nLogInfo(msg=f'{x}')",
    "x = []\nfor i in range(60): x = [x, x]\nLogInfo(msg='%s' % x)",
    "x = []\nfor i in range(60): x = [x, x]\nNode(package='a', executable='b', parameters=x)",
    "x = {}\nfor i in range(60): x = {'a': x, 'b': x}\nNode(package='a', executable='b', parameters=[x])",
    "x = []\nfor i in range(60): x = [x, x]\nx == x.copy()",
    "x = TextSubstitution(text='a')\nfor i in range(60): x = PathJoinSubstitution([x, x])\nreturned = LogInfo(msg=x)",
    "x = TextSubstitution(text='a')\nfor i in range(60): x = PathJoinSubstitution([x, x])\nx.perform(C)",
    "x = LogInfo(msg='a')\nfor i in range(60): x = GroupAction([x, x])\nreturned = x",
    "x = []\nn = Node(package='a', executable='b', parameters=[{'a': x}])\nfor i in range(60): x.append(x)\nreturned = n",
    "x = []\nfor i in range(10 ** 5): x = [x]\nstr(x)",
    "x = ()\nfor i in range(10 ** 5): x = (x,)\ny = {x: 1}",
    "x = ()\nfor i in range(10 ** 5): x = (x,)\nisinstance(1, x)",
    "x = iter([1])\nfor i in range(10 ** 5): x = map(str, x)\nnext(x)",
    "x = iter([1])\nfor i in range(10 ** 5): x = itertools.chain(x)\nnext(x)",
    "x = iter([1])\nfor i in range(10 ** 5): x = zip(x)\nnext(x)",
    "x = iter([1])\nfor i in range(10 ** 5): x = filter(None, x)\nnext(x)",
    "x = iter([1])\nfor i in range(10 ** 5): x = enumerate(x)\nnext(x)",
    "x = 1\nfor i in range(10 ** 5): x = slice(x)\ndel x",
    "x = len\nfor i in range(10 ** 5): x = staticmethod(x)\nx('a')",
    "x = len\nfor i in range(10 ** 5): x = property(x)\ndel x",
    "x = len\nfor i in range(10 ** 5): x = functools.partial(x)\nx('a')",
    "x = int\nfor i in range(10 ** 5): x = typing.List[x]\nstr(x)",
    "x = int\nfor i in range(10 ** 5): x = list[x]\nhash(x)",
    "x = int\nfor i in range(10 ** 5): x = x | None\nstr(x)",
    "x = Exception()\nfor i in range(10 ** 5):\n    try: raise Exception() from x\n    except Exception as e: x = e",
    "class N:\n    def __init__(self, n): self.n = n\nx = None\nfor i in range(10 ** 5): x = N(x)\ndel x",
    "@dataclasses.dataclass\nclass N:\n    n: object\nx = N(1)\nfor i in range(10 ** 4): x = N(x)\nx == N(x)\nstr(x)\ndataclasses.asdict(x)",
    "def g():\n    while True: yield 1\nx = list(g())",
    "def g(n):\n    yield n\n    yield from g(n)\nx = list(g(1))",
    "x = []\nwhile True: x.append('a' * 10 ** 6 + str(len(x)))",
    "x = {}\nwhile True: x[len(x)] = [0] * 49999",
    "while True: yaml.safe_load('a: 1\\n' * 10 ** 4)",
    "while True: sorted(range(40000), key=lambda x: -x)",
    "while True: [0] * 49999 == [0] * 49998 + [1]",
    "while True: open(HERE + '/fine').read()",
    "x = [x for a in range(999) for b in range(999) for c in range(999) for x in [a]]",
    "f = open(HERE + '/x', 'w')\nwhile True: f.write('a' * 10 ** 6)",
    "x = open(HERE + '/pipe').read()",
    "x = pathlib.Path(HERE, 'pipe').read_text()",
    "x = yaml.safe_load(open(HERE + '/pipe'))",
    "import pipe_module",
    "from large_module import *",
)
TEXTS = (
    *(
        "x = " + "(" * 10_000 + ")" * 10_000,
        "x = " + "-" * 10_000 + "1",
        "x = a" + ".b" * 10_000,
        "x = a" + "[0]" * 10_000,
    ),
    *(
        "x = a" + "()" * 10_000,
        "x = 1" + "+1" * 10_000,
        "x = " + "not " * 10_000 + "1",
        "x = " + "lambda: " * 5_000 + "1",
    ),
    *(
        "x = " + "[" * 150 + "]" * 150,
        "x = " + "1 if 1 else " * 5_000 + "1",
        "x = " + "f'{" * 3 + "}'" * 3,
        "x = '" + "a" * 200_000 + "'",
    ),
    *(
        "x = " + "9" * 100_000,
        "x = [" + "1," * 100_000 + "]",
        "def f(): pass\n" * 15_000,
        "\n".join(" " * i + "if 1:" for i in range(99)) + "\n" + " " * 99 + "pass",
    ),
    *(
        "x = 1 " + "< 1 " * 10_000,
        "x = " + "1 and " * 10_000 + "1",
        "x" + "=x" * 10_000 + " = 1",
        "@f\n" * 5_000 + "def g(): pass",
    ),
    *(
        "x = {" + "1:{" * 90 + "}" * 90 + "}",
        "\0",
        "\ufdd0\ufdd1 = 1",
        "x = '\\ud800'",
        "x = '\ufdd0'",
        "if 1:\n  x\n\ty",
        "x = '''",
    ),
    *(
        "global " + ", ".join(f"a{i}" for i in range(9_999)),
        "class A" + ": pass\nclass A" * 9_999 + ": pass",
        "try: pass\n" + "except A: pass\n" * 9_999,
    ),
)


@pytest.fixture
def here(tmp_path: Path) -> Path:
    (tmp_path / "secret").write_text("hidden")
    folder = tmp_path / "workspace"
    folder.mkdir()
    (folder / "fine").write_text("fine")
    (folder / "link").symlink_to(tmp_path / "secret")
    (folder / "folder").symlink_to(tmp_path)
    os.mkfifo(folder / "pipe")
    os.mkfifo(folder / "pipe_module.py")
    (folder / "a.yaml").write_text("a: {ros__parameters: {b: 1}}")
    (folder / "CMakeLists.txt").write_text("ament_python_install_package(" * 30_000)
    (folder / "large_module.py").write_text("x = 1\n" * 200_000)
    (folder / "evil.py").write_text(
        f"import os\nos.mkdir({str(folder / 'done')!r})\ndef generate_launch_description(): pass"
    )
    return folder


def _read(here: Path, text: str) -> dict[str, Any] | None:
    job = {
        "file": str(here / "a.launch.py"),
        "text": text,
        "env": {},
        "calls": [],
        "packages": {"here": str(here)},
        "assumed": [],
    }
    before, began = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.thread_time()
    found = read(job, Surroundings(Disk(), (str(here),), (str(here),), {}, lambda: []))
    assert time.thread_time() - began < SECONDS
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MEMORY
    assert not (here / "done").exists()
    return found


def _text(here: Path, statements: str) -> str:
    names = {
        "HERE": str(here),
        "SECRET": str(here.parent / "secret"),
        "LINK": str(here / "link"),
        "EVIL": str(here / "evil.py"),
    }
    names["SHELL"] = f"mkdir {here}/done"
    given = "".join(f"{name} = {value!r}\n" for name, value in names.items())
    end = "\ndef generate_launch_description():\n    return LaunchDescription([LogInfo(msg=str(x)), *([returned] if returned else [])])\n"
    return f"{HEAD}{given}BAD = {BAD.replace('HERE', repr(str(here)))!r}\nx = returned = None\n{statements}{end}"


@pytest.mark.parametrize("statements", RUNS)
def test_no_code_runs(here: Path, statements: str) -> None:
    _read(here, _text(here, statements))
    _read(
        here,
        _text(here, f"def f(context): return [LogInfo(msg=str({statements}))]\nreturned = OpaqueFunction(function=f)"),
    )


@pytest.mark.parametrize("expression", REACHES)
def test_what_is_behind_a_value_is_not_reached(here: Path, expression: str) -> None:
    found = _read(here, _text(here, f"x = {expression}"))
    told = repr(found)
    assert not any(each in told for each in ("<class 'object'>", "builtins", "fake_launch", " at 0x", "/usr/lib"))
    assert found is None or found["unread"] or "error" in found or "<class '" in told


@pytest.mark.parametrize("statements", ERRORS)
def test_what_is_raised_goes_no_further(here: Path, statements: str) -> None:
    told = repr(_read(here, _text(here, statements)))
    assert "traceback object" not in told
    assert "frame object" not in told


@pytest.mark.parametrize("expression", OUTSIDE)
def test_what_is_outside_is_not_looked_at(here: Path, expression: str) -> None:
    found = _read(here, _text(here, f"x = {expression}"))
    told = repr(found)
    assert "hidden" not in told
    assert "root:" not in told
    assert found is None or found["unread"] or "error" in found or found["missed"]
    if found is not None and "error" not in found and found["unread"]:
        assert found["actions"][0]["a"]["message"] not in (["True"], ["False"])


@pytest.mark.parametrize("statements", KINDS_OF_PATHS)
def test_paths_of_the_programs_own_are_looked_at_as_they_are(here: Path, statements: str) -> None:
    assert "hidden" not in repr(_read(here, _text(here, statements)))


CONTROL = """
x = [os.path.join('a', 'b'), math.pi > 3, json.loads('[1]'), string.digits, sorted([2, 1]), str(pathlib.Path('a')), len('a')]
x += [Node(package='p', executable='e').describe(), os.path.exists(HERE + '/none'), list(yaml.safe_load('a: 1'))]
x += [Command('x').describe(), os.environ.get('A'), len(C.launch_configurations), IfCondition('true').evaluate(C)]
returned = Node(package='p', executable='e')
"""


@pytest.mark.parametrize("statements", SHARED)
def test_one_reading_changes_nothing_for_the_next(here: Path, statements: str) -> None:
    variables, expected = dict(os.environ), _read(here, _text(here, CONTROL))
    assert expected is not None
    assert not expected["unread"]
    _read(here, _text(here, statements))
    _read(here, _text(here, f"def f():\n    {statements.replace(chr(10), chr(10) + '    ')}\nf()"))
    assert dict(os.environ) == variables
    assert _read(here, _text(here, CONTROL)) == expected


def test_classes_of_launch_have_nothing_that_can_be_changed() -> None:
    tables_of = [*tables.TABLE.values(), *tables.FALLBACK.values()]
    classes = {each for names in tables_of for each in names.values() if isinstance(each, type)}
    found = {
        f"{kind.__name__}.{name}"
        for each in classes
        for kind in each.__mro__
        for name, value in vars(kind).items()
        if not name.startswith(("_", "preflight")) and isinstance(value, (list, dict, set))
    }
    assert not found


@pytest.mark.parametrize("expression", ENDLESS)
def test_an_expression_ends_soon(here: Path, expression: str) -> None:
    _read(here, _text(here, f"x = {expression}"))


@pytest.mark.parametrize("statements", ENDLESS_STATEMENTS)
def test_statements_end_soon(here: Path, statements: str) -> None:
    _read(here, _text(here, statements))


@pytest.mark.parametrize("text", TEXTS, ids=lambda text: text[:20])
def test_a_text_of_any_shape_is_read_or_not(here: Path, text: str) -> None:
    _read(here, _text(here, text))


ASKS = (
    *(
        "v.startswith('a')",
        "v == 'a'",
        "'a' in v",
        "v in ['a', 'b']",
        "v",
        "bool(v)",
        "v.isdigit()",
        "v and 1",
        "not v",
    ),
    *(
        "any([v])",
        "max([v, 'a'])",
        "[1 for x in 'a' if v]",
        "sorted([v, 'a'])",
        "v > 'a'",
        "{'a': 1}.get(v)",
        "isinstance(os.uname(), int)",
    ),
    *(
        "list(filter(None, [v]))",
        "v.endswith(('a', 'b'))",
        "os.path.exists(v) or 1",
        "(1 if v else 2)",
        "[*map(bool, [v])]",
        "1 < int(v) < 3",
    ),
)


@pytest.mark.parametrize("expression", ASKS)
def test_what_depends_on_what_is_not_known_is_noted(here: Path, expression: str) -> None:
    found = _read(here, _text(here, f"v = os.environ['NOT_SET_ANYWHERE']\nx = 1 if {expression} else 2"))
    assert found is not None
    assert found["guessed"], found
