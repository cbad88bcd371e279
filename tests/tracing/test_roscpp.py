"""Nodes in C++: what the preloaded library tells of them, and what is left without it."""

from __future__ import annotations

import os
import shutil
import subprocess
import threading
from pathlib import Path

import pytest
from preflight_analysis.tracing import preload, preload_compile
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.intact import seal_of
from preflight_analysis.tracing.interface import Endpoint, Interface
from preflight_analysis.tracing.preload import Library
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.roslaunch_harness import launched, master_view
from support.tracing_harness import environment, own, request, trace

pytestmark = pytest.mark.ros

ROSOUT = Path("/usr/lib/rosout/rosout")
STRING_MD5 = "992ce8a1687cec8c8bd883ec73ca41d1"
SET_BOOL_MD5 = "09fb03525b03e7ea1fd3992bafd87e16"
MADE = {
    ("publisher", "chatter", "std_msgs/String"),
    ("publisher", "~state", "std_msgs/String"),
    ("publisher", "/fixed/plain", "std_msgs/String"),
    ("publisher", "arm/grip/closed", "std_msgs/String"),
    ("publisher", "/absolute", "std_msgs/String"),
    ("publisher", "~below/deep", "std_msgs/String"),
    ("subscriber", "chatter", "std_msgs/String"),
    ("service", "~enable", "std_srvs/SetBool"),
    ("client", "switch", "std_srvs/SetBool"),
}
LATE = ("publisher", "late", "std_msgs/String")


def endpoint(interface: Interface, role: str, name: str) -> Endpoint:
    (found,) = [e for e in interface.endpoints if (e.role, e.name) == (role, name)]
    return found


@pytest.mark.parametrize("mode", ["spin", "multi", "async", "rate", "duration", "pause", "thread"])
def test_a_node_is_run_until_it_spins(node: Path, mode: str) -> None:
    found = trace(node, args=(mode,))
    assert (found.outcome.status, found.notes) == ("spinning", ())
    assert own(found) == MADE | ({LATE} if mode in ("async", "pause", "thread") else set())


@pytest.mark.usefixtures("each_backend")
def test_a_node_is_seen_the_same_with_each_way_to_isolate(node: Path) -> None:
    found = trace(node)
    assert (found.outcome.status, found.notes, own(found)) == ("spinning", (), MADE)


def test_names_are_as_given_whatever_the_remaps_and_namespace(node: Path) -> None:
    moved = trace(node, "/robot/arm/n", remaps=(("chatter", "/elsewhere"), ("~state", "status"), ("/absolute", "b")))
    assert own(moved) == MADE


def test_a_remapped_namespace_of_a_handle_gives_the_final_name(node: Path) -> None:
    moved = trace(node, "/robot/n", remaps=(("arm", "/left"),))
    assert ("publisher", "/left/grip/closed", "std_msgs/String") in own(moved)


def test_endpoints_have_md5_and_qos(node: Path) -> None:
    found = trace(node)
    chatter = endpoint(found, "publisher", "chatter")
    assert (chatter.md5, chatter.qos) == (STRING_MD5, {"latch": True, "queue_size": 7})
    assert endpoint(found, "publisher", "~state").qos == {"latch": False, "queue_size": 1}
    assert endpoint(found, "subscriber", "chatter").qos == {"queue_size": 3}
    assert endpoint(found, "service", "~enable").md5 == endpoint(found, "client", "switch").md5 == SET_BOOL_MD5
    assert {(e.role, e.name) for e in found.endpoints if e.builtin} == {
        ("publisher", "/rosout"),
        ("service", "~get_loggers"),
        ("service", "~set_logger_level"),
    }


def test_parameters_as_given_and_none_mandatory(node: Path) -> None:
    found = trace(node, "/ns/node", params={"/ns/node/rate": 5.0})
    assert {(p.access, p.name) for p in found.params if not p.builtin} == {
        ("has", "~rate"),
        ("get", "~rate"),
        ("get", "text"),
        ("get", "/fixed/gains"),
        ("get", "~free"),
        ("has", "~preset"),
        ("get", "~cached"),
    }
    assert not any(p.mandatory for p in found.params)


@pytest.mark.parametrize(
    ("mode", "service"), [("service", "switch"), ("milliseconds", "switch"), ("existence", "/switch")]
)
def test_a_wait_for_a_service_is_answered_and_what_comes_then_marked(node: Path, mode: str, service: str) -> None:
    found = trace(node, args=(mode,))
    assert found.outcome.status == "spinning"
    assert found.outcome.answers == (f"it waits for the service {service}, and was told that it is there",)
    assert own(found) == MADE | {LATE}
    assert [e.name for e in found.endpoints if "made-up answer" in e.evidence.doubts] == ["late"]


def test_a_call_is_answered_after_its_wait_was(node: Path) -> None:
    found = trace(node, args=("call",))
    assert (found.outcome.status, own(found)) == ("spinning", MADE | {LATE})
    assert found.outcome.answers[1:] == ("it calls the service /switch, and was given an empty answer",)


def test_a_wait_for_an_action_server_is_answered(node: Path) -> None:
    found = trace(node, "/ns/node", args=("action",))
    assert found.outcome.status == "spinning"
    assert found.outcome.answers == ("it waits for the action server /ns/move, and was told that it is there",)
    topics = {("publisher", "move/goal"), ("publisher", "move/cancel")}
    topics |= {("subscriber", f"move/{name}") for name in ("status", "feedback", "result")}
    assert {
        (e.role, e.name) for e in found.endpoints if not e.builtin and "made-up answer" not in e.evidence.doubts
    } >= topics
    assert [e.name for e in found.endpoints if "made-up answer" in e.evidence.doubts] == ["late"]


def test_a_service_that_comes_is_waited_for(node: Path) -> None:
    found = trace(node, args=("own_service",))
    assert (found.outcome.status, found.outcome.answers) == ("spinning", ())
    assert not any("made-up answer" in e.evidence.doubts for e in found.endpoints)


def test_a_crash_is_the_nodes_own(node: Path) -> None:
    found = trace(node, args=("invalid",))
    assert (found.outcome.status, found.outcome.signal) == ("crashed", "SIGABRT")
    assert "Using ~ names with NodeHandle methods is not allowed" in "\n".join(found.outcome.stderr_tail)
    assert own(found) >= MADE
    assert trace(node, args=("leave",)).outcome.exit_code == 3


def test_a_node_whose_name_is_not_known_is_not_run_if_that_ends_it(node: Path) -> None:
    """`$(arg robot)` without a default stays in a namespace as it is written, and roscpp refuses it."""
    outcome = trace(node, "/$(arg robot)/n").outcome
    assert (outcome.status, outcome.reason) == ("not-run", "its name is not known: '/$(arg robot)/n'")


def test_traced_interfaces_equal_the_real_masters_view(package: Path, tmp_path: Path) -> None:
    launch_file = tmp_path / "compiled.launch"
    launch_file.write_text(
        """
        <launch>
          <node name="plain" pkg="compiled" type="node"/>
          <group ns="robot">
            <remap from="chatter" to="/talk"/>
            <node name="moved" pkg="compiled" type="node" args="rate">
              <remap from="~state" to="status"/>
              <remap from="arm" to="/left"/>
            </node>
          </group>
          <node name="relay" pkg="compiled" type="relay" args="talk again"/>
          <node name="mux" pkg="compiled" type="mux" args="out talk again"/>
        </launch>
        """
    )
    for tool in ("relay", "mux"):
        if not (package / tool).exists():
            (package / tool).symlink_to(f"/usr/lib/topic_tools/{tool}")
    real = launched(launch_file, tmp_path, package)
    requests = [
        TraceRequest(
            each["name"],
            each["package"],
            each["executable"],
            tuple(each["args"]),
            tuple((source, target) for source, target in each["remaps"]),
            real["params"],
        )
        for each in real["nodes"]
    ]
    tracer = Tracer(environment(package), None)
    interfaces = [tracer.trace(each, threading.Event()) for each in requests]
    assert {i.outcome.status for i in interfaces} == {"spinning"}
    assert master_view(requests, interfaces) == real["shown"]


def test_the_cache_knows_the_trace_until_name_or_remaps_change(node: Path, tmp_path: Path) -> None:
    tracer = Tracer(environment(node.parent), TraceCache(tmp_path))
    os.utime(node, (0, 0))
    asked = request(node, remaps=(("chatter", "talk"),))
    assert not tracer.trace(asked, threading.Event()).cached
    assert tracer.lookup(asked)
    assert not tracer.lookup(request(node))
    assert not tracer.lookup(request(node, "/other", remaps=asked.remaps))


def test_the_library_is_compiled_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    planned = Library(tmp_path).planned().path
    assert planned is not None
    assert not os.path.exists(planned)
    assert Library(tmp_path).build().path == planned
    assert {path.name for path in tmp_path.iterdir()} == {os.path.basename(planned), seal_of(Path(planned)).name}
    monkeypatch.setattr(preload, "compile_library", lambda *_: pytest.fail("compiled again"))
    assert Library(tmp_path).build().path == planned


@pytest.mark.parametrize("is_prebuilt", [False, True])
@pytest.mark.parametrize("how", ["lost", "cut", "changed", "seal lost"])
def test_a_library_that_is_not_whole_is_made_again(
    tmp_path: Path, prebuilt: Path, monkeypatch: pytest.MonkeyPatch, how: str, is_prebuilt: bool
) -> None:
    """By a process that made it or used it, but for a content of the same size, and by any other."""
    monkeypatch.setattr(preload, "compile_library", lambda _, __, path: shutil.copy(prebuilt, path))
    library = Library(tmp_path, prebuilt if is_prebuilt else tmp_path / "absent")
    path = Path(str(library.build().path))
    content = path.read_bytes()
    if how == "lost":
        path.unlink()
    elif how == "cut":
        path.write_bytes(content[:5000])
    elif how == "changed":
        path.write_bytes(content[:5000] + b"X" * 500 + content[5500:])
    else:
        seal_of(path).unlink()
    for each in (library, Library(tmp_path, prebuilt if is_prebuilt else tmp_path / "absent")):
        if each is not library or how in ("lost", "cut"):
            assert each.build().path == str(path)
            assert path.read_bytes() == content
    assert seal_of(path).is_file()


def test_the_library_does_nothing_in_a_program_without_roscpp(tmp_path: Path) -> None:
    built = Library(tmp_path).build().path
    assert built is not None
    done = subprocess.run(["/bin/true"], env={"LD_PRELOAD": built}, capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"", b"")


def master_alone(library: Library) -> Interface:
    tracer = Tracer(environment(), None, library)
    found = tracer.trace(request(ROSOUT, "/out", remaps=(("/rosout", "/log"),)), threading.Event())
    assert found.outcome.status == "spinning"
    assert own(found) == {
        ("subscriber", "/rosout", "rosgraph_msgs/Log"),
        ("publisher", "/rosout_agg", "rosgraph_msgs/Log"),
    }
    assert {e.name for e in found.endpoints if e.builtin} == {"~get_loggers", "~set_logger_level"}
    return found


@pytest.fixture
def no_compiler(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(preload_compile, "COMPILERS", ("no-such-compiler",))


def test_without_a_compiler_the_master_sees_the_rest(tmp_path: Path, no_compiler: None) -> None:
    found = master_alone(Library(tmp_path))
    assert found.notes == (
        "only what a ROS master sees of it is known: there is no C++ compiler to watch roscpp nodes with: "
        "apt install g++",
    )


def test_what_does_not_compile_is_tried_once(tmp_path: Path) -> None:
    source = tmp_path / "odd.cpp"
    source.write_text("#error odd\n")
    odd = preload_compile.ROSCPP._replace(source=source)
    library = Library(tmp_path / "cache", watched=odd)
    assert "does not compile" in master_alone(library).notes[0]
    source.write_text("")
    assert library.build() == library.planned()
    assert library.planned().path is None


@pytest.fixture(scope="session")
def prebuilt(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The library as it is made for a wheel."""
    made = tmp_path_factory.mktemp("wheel") / "prebuilt.so"
    compiler = preload_compile.compiler()
    assert compiler is not None
    preload_compile.compile_library(compiler, preload_compile.ROSCPP, made, portable=True)
    return made


def test_a_prebuilt_library_is_taken_from_wherever_it_is(tmp_path: Path, prebuilt: Path, no_compiler: None) -> None:
    shipped = tmp_path / "with blank" / "shipped.so"
    shipped.parent.mkdir()
    shipped.write_bytes(prebuilt.read_bytes())
    library = Library(tmp_path / "cache", shipped)
    planned = library.planned().path
    assert planned is not None
    assert not os.path.exists(planned)
    assert library.build().path == planned
    assert Path(planned).read_bytes() == prebuilt.read_bytes()
    assert set((tmp_path / "cache").iterdir()) == {Path(planned), seal_of(Path(planned))}


def lacking(tmp_path: Path) -> Path:
    """A library that needs a version which no C library has."""
    source, versions, needed = tmp_path / "a.c", tmp_path / "versions", tmp_path / "libneeded.so"
    source.write_text("int wanted(void) { return 0; }\n")
    versions.write_text("LACKING_1 { global: wanted; };\n")
    make = ["gcc", "-shared", "-fPIC", f"-Wl,--version-script={versions}", str(source), "-o", str(needed)]
    subprocess.run(make, check=True)
    user, library = tmp_path / "b.c", tmp_path / "lacking.so"
    user.write_text("int wanted(void); int use(void) { return wanted(); }\n")
    subprocess.run(["gcc", "-shared", "-fPIC", str(user), "-o", str(library), str(needed)], check=True)
    versions.write_text("OTHER_1 { global: wanted; };\n")
    subprocess.run(make, check=True)
    return library


def test_a_prebuilt_library_that_does_not_fit_is_left_for_a_compiled_one(tmp_path: Path) -> None:
    garbage = tmp_path / "garbage.so"
    garbage.write_bytes(b"no library")
    for shipped in (garbage, lacking(tmp_path)):
        library = Library(tmp_path / "cache", shipped)
        assert library.build() == library.planned()
        assert library.build().path == Library(tmp_path / "cache", tmp_path / "absent").planned().path
    assert len(list((tmp_path / "cache").glob("*.so"))) == 1


def test_without_compiler_and_fitting_library_the_reason_is_told(tmp_path: Path, no_compiler: None) -> None:
    garbage = tmp_path / "garbage.so"
    garbage.write_bytes(b"no library")
    built = Library(tmp_path / "cache", garbage).build()
    assert built.path is None
    assert "there is no C++ compiler" in str(built.reason)


def test_a_cache_folder_that_cannot_be_named_in_ld_preload_is_told(tmp_path: Path) -> None:
    assert Library(tmp_path / "with blank").build().path is None


def test_scripts_are_not_preloaded_into(tmp_path: Path) -> None:
    script = tmp_path / "script"
    script.write_text("#!/bin/sh\n")
    assert not preload.applies(str(script))
    assert not preload.applies(str(tmp_path / "absent"))
    assert preload.applies("/bin/true")
