"""Nodelets in C++ that are loaded into a manager: each is run alone, in a process that is not called as it is."""

from __future__ import annotations

import shutil
import subprocess
import threading
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Package
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.build_once import build_once
from support.tracing_harness import environment, own

pytestmark = pytest.mark.ros

SOURCE = Path(__file__).with_name("nodelet_like.cpp")
LIBRARIES = ("-lroscpp", "-lrostime", "-lroscpp_serialization", "-lrosconsole", "-lboost_system", "-lpthread")
OWN = {
    ("publisher", "~image", "std_msgs/String"),
    ("publisher", "/camera/camera_info", "std_msgs/String"),
}
LOADING = {
    ("client", "manager/load_nodelet", "nodelet/NodeletLoad"),
    ("publisher", "manager/bond", "bond/Status"),
    ("subscriber", "manager/bond", "bond/Status"),
}


def _compile(folder: Path) -> None:
    library = folder / "libnodelet_like.so"
    common = ["g++", "-w", str(SOURCE)]
    subprocess.run([*common, "-DLIBRARY", "-shared", "-fPIC", "-o", str(library), *LIBRARIES], check=True)
    linked = [f"-L{folder}", "-lnodelet_like", "-Wl,-rpath,$ORIGIN"]
    subprocess.run([*common, "-o", str(folder / "nodelet"), *linked, *LIBRARIES], check=True)


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """The executable `nodelet` of a package of that name."""
    return shutil.copytree(build_once("nodelet_like", _compile), tmp_path / "nodelet") / "nodelet"


def loaded(program: Path, *args: str, node: str = "/camera/rectify", **more: object) -> TraceRequest:
    return TraceRequest(node, "nodelet", str(program), args, **more)  # type: ignore[arg-type]


def traced(request: TraceRequest, cache: TraceCache | None = None) -> Interface:
    folder = Path(request.executable).parent
    return Tracer(environment(folder), cache).trace(request, threading.Event())


def asked(interface: Interface) -> set[str]:
    return {use.name for use in interface.params if not use.builtin}


def test_what_a_nodelet_has_by_its_own_handles_is_its_own(program: Path) -> None:
    found = traced(loaded(program, "load", "vision/Plain", "manager"))
    assert (found.outcome.status, own(found)) == ("spinning", OWN | LOADING)
    assert asked(found) == {"~rate", "/camera/shared"}
    loggers = {e.name for e in found.endpoints if e.role == "service"}
    assert loggers == {"~get_loggers", "~set_logger_level"}, "of the loader's own process"


@pytest.mark.parametrize(("manager", "space"), [("manager", "/camera"), ("/elsewhere/manager", "/elsewhere")])
def test_what_it_asks_of_its_process_is_the_managers(program: Path, manager: str, space: str) -> None:
    found = traced(loaded(program, "load", "vision/OfProcess", manager, "--no-bond"))
    assert found.outcome.status == "spinning"
    assert own(found) == OWN | {
        ("publisher", f"{manager}/of_process", "std_msgs/String"),
        ("publisher", f"{manager}/made", "std_msgs/String"),
        ("publisher", f"{space}/relative", "std_msgs/String"),
        ("client", f"{manager}/load_nodelet", "nodelet/NodeletLoad"),
    }
    assert asked(found) == {"~rate", "/camera/shared", f"{manager}/gain", f"{manager}/offset", f"{space}/level"}


@pytest.mark.parametrize(
    ("manager", "service"), [("manager", "/camera/start"), ("/elsewhere/manager", "/elsewhere/start")]
)
def test_what_it_waits_for_is_asked_in_the_managers_namespace(program: Path, manager: str, service: str) -> None:
    found = traced(loaded(program, "load", "vision/Waits", manager, "--no-bond"))
    assert found.outcome.status == "spinning"
    assert found.outcome.answers == (f"it waits for the service {service}, and was told that it is there",)
    clients = {end.name for end in found.endpoints if end.role == "client"}
    assert clients == {service, f"{manager}/load_nodelet"}
    assert ["made-up answer" in end.evidence.doubts for end in found.endpoints if end.name == "~after"] == [True]


def test_a_nodelet_without_a_manager_is_its_process(program: Path) -> None:
    found = traced(loaded(program, "standalone", "vision/OfProcess"))
    assert {("publisher", "~of_process", "std_msgs/String"), ("publisher", "~image", "std_msgs/String")} <= own(found)
    assert {"~gain", "~offset", "~rate"} <= asked(found)


def test_remaps_are_those_of_the_loader(program: Path) -> None:
    remaps = (("~image", "picture"), ("camera_info", "~info"))
    found = traced(loaded(program, "load", "vision/Plain", "manager", remaps=remaps))
    assert own(found) >= OWN, "names are kept as they were given"


def test_a_run_is_kept_for_any_manager_and_not_for_the_nodelet_alone(program: Path, tmp_path: Path) -> None:
    cache = TraceCache(tmp_path / "cache")
    first = loaded(program, "load", "vision/OfProcess", "manager", "--no-bond")
    traced(first, cache)
    tracer = Tracer(environment(program.parent), cache)
    other = tracer.lookup(loaded(program, "load", "vision/OfProcess", "other", "--no-bond"))
    assert other is not None
    assert ("publisher", "other/of_process", "std_msgs/String") in own(other)
    assert tracer.lookup(loaded(program, "standalone", "vision/OfProcess", "--no-bond")) is None
    moved = tracer.lookup(loaded(program, "load", "vision/OfProcess", "manager", "--no-bond", node="/b/rectify"))
    assert moved is None, "the name of its process was asked for"


def test_arguments_of_the_loaders_process_are_those_of_the_nodelet(program: Path) -> None:
    """`_rate:=5` sets a private parameter of the process that is given it."""
    found = traced(loaded(program, "load", "vision/OfProcess", "manager", "_rate:=5"))
    assert {("publisher", "~of_process", "std_msgs/String"), ("publisher", "~image", "std_msgs/String")} <= own(found)


DESCRIPTION = '<library path="lib/libx"><class name="{}" type="x::X" base_class_type="nodelet::Nodelet"/></library>'


@pytest.mark.parametrize(
    ("declared", "ran"),
    [("vision/Other", False), ("vision/Plain", True), ("vision/Plan", True), (None, True)],
)
def test_what_no_package_declares_is_not_run(program: Path, tmp_path: Path, declared: str | None, ran: bool) -> None:
    """The package that declares it has any name; a slip of the name is for the loader to tell, and where a description
    is missing nothing is known."""
    share = tmp_path / "vision_ros"
    share.mkdir()
    (share / "package.xml").write_text('<package><export><nodelet plugin="${prefix}/nodelets.xml"/></export></package>')
    if declared is not None:
        (share / "nodelets.xml").write_text(DESCRIPTION.format(declared))
    packages = [Package(each.name, str(each), str(each / "package.xml")) for each in (program.parent, share)]
    around = replace(environment(program.parent), packages={each.name: each for each in packages})
    found = Tracer(around, None).trace(loaded(program, "load", "vision/Plain", "manager"), threading.Event())
    assert found.outcome.status == ("spinning" if ran else "not-run")
    assert own(found) >= (OWN | LOADING if ran else LOADING)
    if not ran:
        assert (
            found.outcome.reason == "package 'vision' of nodelet 'vision/Plain' is not among those of this environment"
        )
