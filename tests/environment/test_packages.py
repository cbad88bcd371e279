from __future__ import annotations

import os
from pathlib import Path

from preflight_analysis.environment.packages import crawl, find_packages
from support.package_folders import file, package


def shares(*path: Path) -> dict[str, str]:
    return {name: found.share for name, found in find_packages(map(str, path)).packages.items()}


def test_first_folder_of_the_path_wins_and_the_others_are_kept(tmp_path: Path) -> None:
    first = package(tmp_path / "b" / "p")
    second = package(tmp_path / "a" / "p")
    found = find_packages([str(tmp_path / "b"), str(tmp_path / "a")])
    assert found.packages["p"].share == str(first)
    assert [other.share for other in found.shadowed["p"]] == [str(second)]


def test_package_reached_twice_does_not_shadow_itself(tmp_path: Path) -> None:
    package(tmp_path / "src" / "p")
    (tmp_path / "link").symlink_to(tmp_path / "src")
    found = find_packages([str(tmp_path / "src"), str(tmp_path), str(tmp_path / "link")])
    assert list(found.packages) == ["p"]
    assert found.shadowed == {}


def test_name_is_that_of_the_manifest_and_the_search_ends_at_a_package(tmp_path: Path) -> None:
    outer = package(tmp_path / "folder", "outer")
    package(outer / "inner")
    assert shares(tmp_path) == {"outer": str(outer)}
    assert shares(outer) == {"outer": str(outer)}


def test_legacy_package_is_named_by_its_folder(tmp_path: Path) -> None:
    file(tmp_path / "old" / "manifest.xml", text='<package><depend package="roscpp"/><depend/></package>')
    found = find_packages([str(tmp_path)]).packages["old"]
    assert (found.share, found.dependencies) == (str(tmp_path / "old"), frozenset({"roscpp"}))


def test_folders_that_are_not_entered(tmp_path: Path) -> None:
    file(package(tmp_path / "ignored" / "p1").parent / "CATKIN_IGNORE")
    file(package(tmp_path / "ignored-itself") / "CATKIN_IGNORE")
    file(package(tmp_path / "flat" / "p2").parent / "rospack_nosubdirs")
    package(tmp_path / ".hidden" / "p3")
    package(tmp_path / "build" / "p4")
    package(tmp_path / "deep" / "build" / "p5")
    assert list(find_packages([str(tmp_path)], skip={"build"}).packages) == ["p5"]


def test_what_colcon_ignores_is_found_by_rospkg(tmp_path: Path) -> None:
    build_type = "<export><build_type>{}</build_type></export>"
    for marker in ("CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"):
        for tool in ("catkin", "ament_cmake", "cmake"):
            package(tmp_path / marker / f"{tool}_{marker}", body=build_type.format(tool))
        file(tmp_path / marker / marker)
    assert sorted(shares(tmp_path)) == ["catkin_AMENT_IGNORE", "catkin_COLCON_IGNORE"]
    assert list(crawl(str(tmp_path), metapackages=True)) == [], "catkin's tools know all three"


def test_what_colcon_has_made_is_not_entered(tmp_path: Path) -> None:
    package(tmp_path / "ws" / "install" / "p")
    file(tmp_path / "ws" / "install" / "COLCON_IGNORE")
    assert shares(tmp_path) == {}


def test_metapackage_is_no_package(tmp_path: Path) -> None:
    package(tmp_path / "meta", body="<export><metapackage/></export>")
    package(tmp_path / "meta" / "below")
    assert shares(tmp_path) == {}


def test_dependencies_of_all_kinds(tmp_path: Path) -> None:
    body = "<depend> a\n</depend><exec_depend>b</exec_depend><test_depend>c</test_depend><depend/><author>d</author>"
    package(tmp_path / "p", body=body)
    assert find_packages([str(tmp_path)]).packages["p"].dependencies == {"a", "b", "c"}


def test_a_package_for_both_generations_is_built_for_the_one_that_is_asked(tmp_path: Path) -> None:
    body = """<export>
      <build_type condition="$ROS_VERSION == 1">catkin</build_type>
      <build_type condition="$ROS_VERSION != 1">ament_cmake</build_type>
    </export>"""
    package(tmp_path / "p", body=body)
    package(tmp_path / "q", body="<export><build_type condition='$ROS_DISTRO == noetic'>catkin</build_type></export>")
    found = find_packages([str(tmp_path)])
    assert [found.built_for(each).packages["p"].build_type for each in (1, 2)] == ["catkin", "ament_cmake"]
    assert [found.built_for(each).packages["q"].build_type for each in (1, 2)] == ["catkin", "catkin"]


def test_links_that_form_a_cycle_end(tmp_path: Path) -> None:
    package(tmp_path / "a" / "p")
    (tmp_path / "a" / "up").symlink_to(tmp_path)
    (tmp_path / "self").symlink_to(tmp_path / "self")
    assert list(shares(tmp_path)) == ["p"]


def test_folders_that_are_not_there_hold_nothing(tmp_path: Path) -> None:
    file(tmp_path / "file")
    assert shares(tmp_path / "gone", tmp_path / "file") == {}


def test_broken_manifests_are_named_and_read_as_far_as_possible(tmp_path: Path) -> None:
    file(tmp_path / "a" / "package.xml", text="<package>\n  <name>a</name>\n  <depend>b</dep\n")
    file(tmp_path / "b" / "package.xml", text="<package/>")
    file(tmp_path / "c" / "package.xml", text="")
    (tmp_path / "d").mkdir()
    os.mkfifo(tmp_path / "d" / "package.xml")
    found = find_packages([str(tmp_path)])
    assert list(found.packages) == ["a"]
    problems = {problem.split(" ")[0].removeprefix(f"{tmp_path}/")[0]: problem for problem in found.problems}
    assert "is not well-formed XML (line 4" in problems["a"]
    assert "names no package" in problems["b"]
    assert "is not well-formed XML" in problems["c"]
    assert "is not a regular file" in problems["d"]


def test_entities_of_a_manifest_are_not_expanded(tmp_path: Path) -> None:
    file(tmp_path / "secret", text="secret")
    laughs = "".join(f'<!ENTITY e{i} "{f"&e{i - 1};" * 10}">' for i in range(1, 20))
    doctype = f'<!DOCTYPE p [<!ENTITY e0 "x">{laughs}<!ENTITY f SYSTEM "{(tmp_path / "secret").as_uri()}">]>'
    file(tmp_path / "a" / "package.xml", text=f"{doctype}<p><name>a</name><depend>&e19;&f;</depend></p>")
    assert find_packages([str(tmp_path)]).packages["a"].dependencies == frozenset()
