"""Types of services by their sums, which are genmsg's."""

from __future__ import annotations

import json
import random
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.documents.reading import read_text
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome
from preflight_analysis.tracing.service_types import Definitions, ServiceTypes
from support.package_folders import file, package
from support.tracing_harness import SYSTEM_PYTHON

SET_BOOL = "bool data # for hardware\n---\nbool success\nstring message\n"
SET_BOOL_MD5 = "09fb03525b03e7ea1fd3992bafd87e16"
EMPTY_MD5 = "d41d8cd98f00b204e9800998ecf8427e"
ORACLE = """
import json, sys
from genmsg import MsgContext
from genmsg.gentools import compute_md5
from genmsg.msg_loader import load_depends, load_srv_from_file
job = json.load(sys.stdin)
sums = {}
for type_, path in job["services"].items():
    try:
        context = MsgContext.create_default()
        spec = load_srv_from_file(context, path, type_)
        load_depends(context, spec, job["search"])
        sums[type_] = compute_md5(context, spec)
    except Exception:
        sums[type_] = None
json.dump(sums, sys.stdout)
"""
LINES = (
    "int32 x{n}",
    "  float64[9]   k{n}  # a matrix",
    "string[] names{n}",
    "# only a comment",
    "",
    "time at{n}",
    "duration[2] spans{n}",
    "Header header{n}",
    "std_msgs/Header[] headers{n}",
    "geo/Point p{n}",
    "geo/Pose[3] poses{n}",
    "Local local{n}",
    "uint8 CONSTANT{n}=3",
    "uint8   SPACED{n}  =  4 # why",
    "string TEXT{n}=a # b = c ",
    "string GAP{n} = x",
    "  string INDENTED{n}= x",
    "float32 F{n}=-1.5",
    "byte b{n}\r",
    "\tchar c{n}",
    "bool \t flag{n}",
)
WRONG = ("int32", "int32 a b", "gone/Type x", "int32\tx", "no-type x", "uint8 A=1=2", "Missing m")


def environment(*packages: Path) -> Environment:
    return detect_environment(None, {"ROS_DISTRO": "noetic", "PATH": "/usr/bin:/bin"}, [str(p) for p in packages])


@pytest.mark.ros
def test_sums_are_those_of_genmsg(tmp_path: Path) -> None:
    rng = random.Random(3)
    messages = {
        "std_msgs": {"Header": "uint32 seq\ntime stamp\nstring frame_id\n"},
        "geo": {"Point": "float64 x\nfloat64 y\n", "Pose": "uint8 A=1\nPoint position\nHeader header\n"},
        "mine": {"Local": "geo/Pose[] all\n"},
    }
    for name, definitions in messages.items():
        package(tmp_path / name)
        for type_, text in definitions.items():
            file(tmp_path / name / "msg" / f"{type_}.msg", text=text)
    services: dict[str, Path] = {}

    def add(text: str) -> None:
        name = f"S{len(services)}"
        services[f"mine/{name}"] = path = tmp_path / "mine" / "srv" / f"{name}.srv"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, newline="")

    for _ in range(150):
        lines = [line.format(n=i) for i, line in enumerate(rng.choices(LINES, k=rng.randrange(8)))]
        lines.insert(rng.randrange(len(lines) + 1), rng.choice(("---", "--- # and back", "----")))
        add("\n".join(lines) + rng.choice(("", "\n")))
    for line in WRONG:
        add(f"int32 before\n{line}\n---\n")
    add("int32 request_alone")
    add("---\nint32 a\n---\nint32 b\n")
    job = {
        "services": {type_: str(path) for type_, path in services.items()},
        "search": {name: [str(tmp_path / name / "msg")] for name in messages},
    }
    answer = subprocess.run([SYSTEM_PYTHON, "-c", ORACLE], input=json.dumps(job), capture_output=True, text=True)
    theirs = json.loads(answer.stdout)
    definitions = Definitions(environment(tmp_path).packages)
    ours = {}
    for type_, path in services.items():
        text = read_text(str(path))
        assert hasattr(text, "text")
        ours[type_] = definitions.service("mine", text.text)
    assert ours == theirs
    assert sum(md5 is None for md5 in ours.values()) == len(WRONG)


def test_messages_that_hold_each_other_have_no_sum(tmp_path: Path) -> None:
    package(tmp_path / "odd")
    file(tmp_path / "odd" / "msg" / "A.msg", text="B b\n")
    file(tmp_path / "odd" / "msg" / "B.msg", text="A[] a\n")
    assert Definitions(environment(tmp_path).packages).service("odd", "A a\n---\n") is None


def test_the_type_of_a_sum_is_found_among_the_definitions(tmp_path: Path) -> None:
    package(tmp_path / "switches")
    file(tmp_path / "switches" / "srv" / "Flip.srv", text="int8 which\n---\n")
    types = ServiceTypes(environment(tmp_path))
    package_sum = Definitions({}).service("switches", "int8 which\n---\n")
    assert package_sum is not None
    assert types.of(package_sum) == "switches/Flip"
    assert types.of("0" * 32) is None


def test_a_definition_that_is_edited_is_read_again(tmp_path: Path) -> None:
    package(tmp_path / "switches")
    flip = file(tmp_path / "switches" / "srv" / "Flip.srv", text="int8 which\n---\n")
    types = ServiceTypes(environment(tmp_path))
    text = "int8 which\nint8 how\n---\n"
    later = Definitions({}).service("switches", text)
    assert later is not None
    assert types.of(later) is None
    flip.write_text(text)
    assert types.of(later) == "switches/Flip"


def test_two_types_of_one_sum_are_none(tmp_path: Path) -> None:
    for name in ("one", "two"):
        package(tmp_path / name)
        file(tmp_path / name / "srv" / "Nothing.srv", text="---\n")
    assert ServiceTypes(environment(tmp_path)).of(EMPTY_MD5) is None


def test_generated_python_classes_name_type_and_sum(tmp_path: Path) -> None:
    generated = (
        "class Flip(object):\n  _type          = {0}mine/Flip{0}\n  _md5sum = {0}{1}{0}\n  _request_class  = X\n"
    )
    for quote, md5, name in (("'", "1" * 32, "_Flip.py"), ('"', "2" * 32, "_Flip2.py")):
        file(tmp_path / "python" / "mine" / "srv" / name, text=generated.format(quote, md5))
    variables = {"ROS_DISTRO": "noetic", "PYTHONPATH": str(tmp_path / "python")}
    types = ServiceTypes(detect_environment(None, variables, []))
    assert types.of("1" * 32) == types.of("2" * 32) == "mine/Flip"


@pytest.mark.ros
def test_debians_types() -> None:
    assert ServiceTypes(environment()).of(SET_BOOL_MD5) == "std_srvs/SetBool"


def test_only_clients_that_told_a_sum_are_named(tmp_path: Path) -> None:
    package(tmp_path / "std_srvs")
    file(tmp_path / "std_srvs" / "srv" / "SetBool.srv", text=SET_BOOL)
    types = ServiceTypes(environment(tmp_path))
    ends = (
        Endpoint("client", "a", None, SET_BOOL_MD5),
        Endpoint("client", "b", "x/Y", SET_BOOL_MD5),
        Endpoint("client", "c", None),
        Endpoint("client", "d", None, "*"),
        Endpoint("subscriber", "e", None, SET_BOOL_MD5),
    )
    named = types.name_clients(Interface("trace", Outcome("spinning"), ends))
    assert [end.type for end in named.endpoints] == ["std_srvs/SetBool", "x/Y", None, None, None]
