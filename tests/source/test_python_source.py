"""What the text of a Python node alone tells of it."""

from __future__ import annotations

import os
import textwrap
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.source.analyse import SourceInterface
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.source.python_text import requoted
from support.source_harness import SourceHarness

HEAD = "import rospy\nfrom std_msgs.msg import String\n"


class Harness(SourceHarness):
    """Its node is a script."""

    node = '<node pkg="p" type="node.py" name="n" args="{args}">{inner}</node>'

    def write(self, name: str, text: str) -> Path:
        path = super().write(name, text)
        path.chmod(0o755)
        return path

    def read(self, text: str, inner: str = "", args: str = "") -> SourceInterface | None:
        self.write("node.py", "#!/usr/bin/env python3\n" + HEAD + textwrap.dedent(text))
        return self.again(inner, args)

    def ends(self, text: str, **more: Any) -> list[tuple[str, str, str | None]]:
        found = self.read(text, **more)
        return [(e.role, e.name, e.type) for e in found.endpoints] if found else []

    def topics(self, text: str, **more: Any) -> list[str]:
        return [name for _, name, _ in self.ends(text, **more)]


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def test_each_kind_of_end(harness: Harness) -> None:
    assert harness.ends(
        """
        import actionlib, tf2_ros, message_filters
        from rospy import Publisher as Pub
        from std_srvs.srv import SetBool, Trigger
        from nav.msg import GoAction
        import sensor_msgs.msg as sm
        Pub("a", String, queue_size=1)
        rospy.Subscriber(name="b", data_class=sm.Image, callback=None)
        message_filters.Subscriber("~c", sm.CameraInfo)
        rospy.Service("d", SetBool, lambda request: None)
        rospy.wait_for_service("e"), rospy.wait_for_service("f")
        rospy.ServiceProxy("e", Trigger)
        actionlib.SimpleActionServer("g", GoAction, auto_start=False)
        actionlib.SimpleActionClient("/h", GoAction)
        tf2_ros.TransformListener(tf2_ros.Buffer())
        rospy.wait_for_message("i", rospy.AnyMsg)
        """
    ) == [
        ("publisher", "a", "std_msgs/String"),
        ("subscriber", "b", "sensor_msgs/Image"),
        ("subscriber", "~c", "sensor_msgs/CameraInfo"),
        ("service", "d", "std_srvs/SetBool"),
        ("client", "e", "std_srvs/Trigger"),
        ("action_server", "g", "nav/GoAction"),
        ("action_client", "/h", "nav/GoAction"),
        ("subscriber", "/tf", "tf2_msgs/TFMessage"),
        ("subscriber", "/tf_static", "tf2_msgs/TFMessage"),
        ("subscriber", "i", "*"),
        ("client", "f", None),
    ]


def test_computed_names(harness: Harness) -> None:
    assert harness.topics(
        """
        BASE = "arm"
        NAMES = {"x": "joint_%d"}
        rospy.Publisher(BASE + "/state", String)
        rospy.Publisher(f"{BASE}/goal", String)
        rospy.Publisher(NAMES["x"] % 3, String)
        rospy.Publisher("{}/{}".format(BASE, "a"), String)
        for i in range(2):
            rospy.Publisher("wheel%s" % i, String)
        rospy.Publisher(rospy.get_name() + "/own", String)
        rospy.Publisher(compute(), String)
        rospy.Publisher("not a name", String)
        """
    ) == ["arm/state", "arm/goal", "joint_3", "arm/a", "wheel0", "wheel1", "/n/own"]


def test_objects_and_functions_are_followed_in_order(harness: Harness) -> None:
    assert harness.topics(
        """
        class Base(object):
            SUFFIX = "_in"
            def __init__(self, topic):
                self.topic = topic + self.SUFFIX
                self.add()
            def add(self):
                rospy.Subscriber(self.topic, String, self.heard)
            def heard(self, message):
                rospy.Publisher("late", String)
        class Node(Base):
            def __init__(self, topic="scan"):
                super().__init__(topic)
            def unused(self):
                rospy.Publisher("never", String)
        def never_called():
            rospy.Publisher("never_either", String)
        def main():
            Node()
            Node(topic="laser")
        if __name__ == "__main__":
            main()
        """
    ) == ["scan_in", "laser_in", "late"]


def test_conditions(harness: Harness) -> None:
    assert harness.topics(
        """
        if rospy.get_param("~known"):
            topic = "yes"
        else:
            topic = "no"
        rospy.Publisher(topic, String)
        if rospy.get_param("~unknown"):
            rospy.Publisher("one", String)
            other = "a"
        else:
            rospy.Publisher("two", String)
            other = "b"
        rospy.Publisher(other, String)
        if rospy.is_shutdown():
            import sys
            sys.exit(1)
        rospy.Publisher("after", String)
        """,
        inner='<param name="known" value="true"/>',
    ) == ["yes", "one", "two", "after"], "what differs by a condition that is not known is not told"


def test_only_one_side_of_a_conditional_expression_is_computed(harness: Harness) -> None:
    found = harness.read(
        """
        from std_msgs.msg import Bool
        rospy.Publisher("a", String) if rospy.is_shutdown() else rospy.Publisher("a", Bool)
        rospy.Publisher("b" if rospy.is_shutdown() else "b", String)
        rospy.Publisher("c", String) if True else rospy.Publisher("d", String)
        """
    )
    assert found is not None
    assert [(end.name, "condition" in end.evidence.doubts) for end in found.endpoints] == [
        ("a", True),
        ("a", True),
        ("b", False),
        ("c", False),
    ]


def test_the_second_part_of_an_and_or_an_or_may_not_be_computed(harness: Harness) -> None:
    found = harness.read(
        """
        a = rospy.is_shutdown() and rospy.Publisher("and", String)
        b = rospy.is_shutdown() or rospy.Publisher("or", String)
        c = True and rospy.Publisher("known", String)
        """
    )
    assert found is not None
    assert [(end.name, "condition" in end.evidence.doubts) for end in found.endpoints] == [
        ("and", True),
        ("or", True),
        ("known", False),
    ]


def test_parameters_of_the_launch_and_defaults_give_names(harness: Harness) -> None:
    text = """
        rospy.Publisher(rospy.get_param("~topic", "fallback"), String)
        space = rospy.get_param("~space", {})
        rospy.Publisher(space.get("inner", "none"), String)
        """
    assert harness.topics(text) == ["fallback", "none"]
    inner = '<param name="topic" value="given"/><param name="space/inner" value="deep"/>'
    assert harness.topics(text, inner=inner) == ["given", "deep"]
    assert harness.topics(text, args="_topic:=argued") == ["argued", "none"]


def test_uses_of_parameters(harness: Harness) -> None:
    found = harness.read(
        """
        rospy.get_param("~rate", 10)
        rospy.get_param("needed")
        rospy.has_param("/maybe")
        rospy.set_param("~made", 1)
        rospy.get_param("~computed", len(rospy.get_time()))
        """
    )
    assert found is not None
    assert [(u.name, u.access, u.default, u.has_default, u.mandatory) for u in found.params] == [
        ("~rate", "get", 10, True, False),
        ("needed", "get", None, False, True),
        ("/maybe", "has", None, False, False),
        ("~made", "set", None, False, False),
        ("~computed", "get", None, True, False),
    ]


def test_parameters_of_dynamic_reconfigure(harness: Harness) -> None:
    cfg = harness.write("cfg/Tuning.cfg", 'gen = ParameterGenerator()\ngen.add("gain", double_t, 0, "How much", 0.5)\n')
    found = harness.read(
        """
        from dynamic_reconfigure.server import Server
        from p.cfg import TuningConfig
        Server(TuningConfig, lambda config, level: config)
        """
    )
    assert found is not None
    assert [(u.name, u.default, u.source_file, u.source_line) for u in found.params] == [("~gain", 0.5, str(cfg), 2)]
    assert [e.name for e in found.endpoints][:1] == ["~set_parameters"]


def test_places(harness: Harness) -> None:
    found = harness.read('\n\nrospy.Publisher("a", String)\n')
    assert found is not None
    (end,) = found.endpoints
    assert (end.source_file, end.source_line) == (str(harness.folder / "node.py"), 6)


def test_modules_of_the_package_are_followed(harness: Harness) -> None:
    harness.write("src/p/__init__.py", "")
    harness.write("src/p/parts.py", HEAD + "from .more import TOPIC\ndef start():\n  rospy.Publisher(TOPIC, String)\n")
    harness.write("src/p/more.py", 'TOPIC = "from_module"\nif __name__ == "__main__":\n  TOPIC = "wrong"\n')
    harness.write("beside.py", HEAD + 'class Thing:\n  def __init__(self): rospy.Publisher("beside", String)\n')
    text = (
        "import beside\nimport p.parts\nfrom p import parts as again\np.parts.start()\nbeside.Thing()\nagain.start()\n"
    )
    assert harness.topics(text) == ["from_module", "beside"]


def test_star_imports_give_types_where_one_package_has_it(harness: Harness) -> None:
    text = "from std_msgs.msg import *\nrospy.Publisher('a', Bool)\nrospy.Service('s', Bool, None)\n"
    assert harness.ends(text) == [("publisher", "a", "std_msgs/Bool"), ("service", "s", None)]
    both = "from std_msgs.msg import *\nfrom p.msg import *\nrospy.Publisher('a', Thing)\n"
    assert harness.ends(both) == [("publisher", "a", None)]
    harness.write("msg/Thing.msg", "")
    assert harness.ends(both + "#\n") == [("publisher", "a", "p/Thing")]


@pytest.mark.parametrize(
    "broken",
    [
        'print "python 2"',
        "try:\n    pass\nexcept rospy.ROSException, e:\n    print e",
        "def typing(:\n    pass",
        "x = (",
        "\tx = 1",
        "raise ValueError, 'old'",
    ],
)
def test_what_does_not_parse_costs_no_more_than_itself(harness: Harness, broken: str) -> None:
    assert "before" in harness.topics(f'rospy.Publisher("before", String)\n{broken}\n')


@pytest.mark.parametrize(
    "line",
    [
        """rospy.Publisher(f"{names["a"]}/out", String)""",
        """rospy.Publisher(f"{"arm" if names else "leg"}/{"out"}", String)""",
        """type Name = str; rospy.Publisher("arm/out", String)""",
    ],
)
def test_syntax_of_newer_pythons(harness: Harness, line: str) -> None:
    assert harness.topics(f'names = {{"a": "arm"}}\n{line}\n') == ["arm/out"]


@pytest.mark.parametrize(
    ("line", "other"),
    [
        ("""f"{a["b"]}" + f"{c}" """, """f"{a['b']}" + f"{c}" """),
        ("""f"{a(f"{b}.c").d} e" """, """f"{a(f'{b}.c').d} e" """),
        ("""f'{{"a"}} {", ".join(b)}'""", """f'{{"a"}} {", ".join(b)}'"""),
        ("""f"\\"{a + "b"}\\"" """, """f"\\"{a + 'b'}\\"" """),
        ("""f"{a["it's"]}" """, """f"{a["it's"]}" """),
        ("""f"{a" + "b" """, """f"{a" + "b" """),
        ("""if"a"in{"b"}: pass""", """if"a"in{"b"}: pass"""),
    ],
)
def test_quotes_within_those_of_an_f_string(line: str, other: str) -> None:
    assert requoted(line) == other


@pytest.mark.parametrize(
    "text",
    [
        "def f(): f()\nf()",
        "a = []\na.append(a)\nb = [a, a]\nrospy.Publisher(str(b), String)",
        "x = ['a'] * 10**9\nrospy.Publisher('%999999999d' % 1, String)",
        "x = 'a'\nfor i in range(60):\n  x = x + x\n  for j in range(60):\n    for k in range(60):\n      y = [x, x]",
        "x = [1]\n" + "x = [x, x, x, x, x, x]\n" * 40 + "rospy.Publisher(x, String)",
        "x = " + "(" * 150 + ")" * 150,
        "x = " + "1+" * 700 + "1",
        "while True:\n  pass",
        "class A(A): pass\nA().x\nclass B(B if 0 else A): pass",
        "rospy.Publisher(*None, **None)\nrospy.Publisher()\nrospy.get_param()",
        "lambda x=(yield): 1",
    ],
)
def test_hostile_programs_end_soon_and_raise_nothing(harness: Harness, text: str) -> None:
    assert harness.topics(f'rospy.Publisher("before", String)\n{text}\n')[:1] == ["before"]


def test_what_is_no_python_tells_nothing(harness: Harness) -> None:
    harness.write("node.py", "")
    os.chmod(harness.folder / "node.py", 0o755)
    assert harness.again() is None
    (harness.folder / "node.py").write_bytes(b"\x7fELF\0\0")
    assert harness.again() is None


def test_remembered_until_a_file_or_a_parameter_changes(harness: Harness) -> None:
    harness.write("src/p/__init__.py", 'NAME = "a"\n')
    first = harness.read('from p import NAME\nrospy.Publisher(NAME + rospy.get_param("~x", ""), String)\n')
    assert first is not None and [e.name for e in first.endpoints] == ["a"]
    assert harness.again('<param name="unread" value="1"/>') is first
    changed = harness.again('<param name="x" value="b"/>')
    assert changed is not None and [e.name for e in changed.endpoints] == ["ab"]
    harness.write("src/p/__init__.py", 'NAME = "longer"\n')
    changed = harness.again('<param name="x" value="b"/>')
    assert changed is not None and [e.name for e in changed.endpoints] == ["longerb"]


X = 'x = rospy.get_param("~x", "c")\n'


@pytest.mark.parametrize(
    "text",
    [
        X + "y = x\nrospy.loginfo('at %s and ' + x + f'{y}!', x)",
        "rospy.Rate(rospy.get_param('~x'))",
        "class A:\n  def __init__(self, x):\n    self.x = x\n  def get(self, *, y='c'): return self.x\n"
        "A(x=rospy.get_param('~x')).get()",
        "if rospy.get_time(): z = rospy.get_param('~x')\nelse: z = 1",
        "y = rospy.has_param('~x')",
    ],
)
def test_a_parameter_that_decides_nothing_is_no_reason_to_read_again(harness: Harness, text: str) -> None:
    first = harness.read(f'{text}\nrospy.Publisher("a", String)\n', '<param name="x" value="a"/>')
    assert first is not None and [use.name for use in first.params] == ["~x"]
    for value in ("b", "1", ""):
        assert harness.again(f'<param name="x" value="{value}"/>' if value else "") is first


@pytest.mark.parametrize(
    "text",
    [
        "rospy.Publisher(x, String)",
        "rospy.Publisher(f'{x}', String)",
        "rospy.Publisher('' + x, String)",
        "rospy.Publisher('%s' % x, String)",
        "rospy.Publisher('{}'.format(x), String)",
        "rospy.Publisher(str(x), String)",
        "rospy.Publisher([x][0], String)",
        "rospy.Publisher({'k': x}['k'], String)",
        "y = {}\ny['k'] = x\nrospy.Publisher(y.get('k'), String)",
        "y = []\ny.append(x)\nfor each in y: rospy.Publisher(each, String)",
        "y, z = x, 1\nrospy.Publisher(y, String)",
        "if x == 'a': rospy.Publisher('a', String)\nelse: rospy.Publisher('b' if x == 'b' else 'c', String)",
        "rospy.Publisher(x or 'd', String)",
        "rospy.Publisher('a' if x == 'a' else x, String)",
        "def f(*args, **more): rospy.Publisher(args[0], String)\nf(x, y=x)",
        "def f(*args, **more): rospy.Publisher(more['y'], String)\nf(x, y=x)",
        "def f(y='d'): return y\nrospy.Publisher(f(x), String)",
        "rospy.Publisher((lambda: x)(), String)",
        "import os\nrospy.Publisher(os.path.join('', x), String)",
        "rospy.Publisher(rospy.get_param('~gone', x), String)",
        "rospy.Publisher(rospy.resolve_name(x).replace('/', ''), String)",
        "y = x\nfor i in range(60): y = y + ''\nrospy.Publisher(y, String)",
        "try: y = x\nfinally: rospy.Publisher(y, String)",
        "if rospy.get_time(): y = x\nelse: y = rospy.get_param('~x', 'c')\nrospy.Publisher(y, String)",
        "class A:\n  y = x\nrospy.Publisher(A().y, String)",
    ],
)
def test_what_a_parameter_decides_follows_it(harness: Harness, text: str) -> None:
    for value in ("a", "b", "", "a"):
        inner = f'<param name="x" value="{value}"/>' if value else ""
        topics = harness.topics(X + text, inner=inner)
        assert topics == [value or "c"]
        assert topics == Harness(harness.folder).topics(X + text, inner=inner)


def test_a_program_does_not_change_what_the_launch_sets(harness: Harness) -> None:
    params = LaunchParams({"/n/names": ["a"], "/n/more": {"of": ["b"]}})
    harness.read(
        """
        found = rospy.get_param("~names")
        found.append("c")
        more = rospy.get_param("~more")
        more["of"].append("d")
        more["else"] = 1
        for name in found + more["of"]:
            rospy.Publisher(name, String)
        """
    )
    found = harness.analysis.read(harness.launch().nodes[0], params)
    assert found is not None and [end.name for end in found.endpoints] == ["a", "c", "b", "d"]
    assert params.values == {"/n/names": ["a"], "/n/more": {"of": ["b"]}}


def test_a_relay_of_a_devel_space_leads_to_the_script(harness: Harness) -> None:
    script = harness.write("scripts/real.py", HEAD + 'rospy.Publisher("real", String)\n')
    harness.write(
        "node.py",
        "#!/usr/bin/python3\n"
        f"python_script = '{script}'\n"
        "with open(python_script, 'r') as fh:\n    exec(compile(fh.read(), python_script, 'exec'), {})\n",
    )
    found = harness.again()
    assert found is not None and [e.name for e in found.endpoints] == ["real"]
