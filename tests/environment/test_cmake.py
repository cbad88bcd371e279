"""What a package builds, as its `CMakeLists.txt` says."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import Build, Made
from preflight_analysis.environment.cmake import read_build
from support.open_buffers import disk_with


class Harness:
    """A package folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def write(self, name: str, text: str = "") -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))

    def build(self, text: str) -> Build:
        self.write("CMakeLists.txt", text)
        return read_build(str(self.folder), "demo", Disk())

    def build_for(self, generation: int, text: str) -> Build:
        self.write("CMakeLists.txt", text)
        return read_build(str(self.folder), "demo", Disk(), generation)

    def sources(self, build: Build, name: str) -> list[str] | None:
        target = build.executable(name)
        return [str(Path(s).relative_to(self.folder)) for s in build.sources(target)] if target else None


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    return Harness(tmp_path)


def test_what_catkin_simple_builds_and_installs(harness: Harness) -> None:
    harness.write("include/demo/node.h")
    harness.write("scripts/run.py")
    build = harness.build(
        """
        find_package(catkin_simple REQUIRED)
        catkin_simple(ALL_DEPS_REQUIRED)
        cs_add_library(${PROJECT_NAME} src/core.cpp)
        cs_add_executable(demo_node src/node.cpp)
        target_link_libraries(demo_node ${PROJECT_NAME})
        cs_install_scripts(scripts/run.py)
        cs_install()
        cs_export()
        """
    )
    assert harness.sources(build, "demo_node") == ["src/node.cpp", "src/core.cpp"]
    assert build.include_folders == (str(harness.folder / "include"),)
    assert list(build.programs) == ["run.py"]
    assert build.complete


def test_executables_and_the_libraries_of_the_package_they_are_linked_with(harness: Harness) -> None:
    build = harness.build(
        """
        cmake_minimum_required(VERSION 3.0.2)
        project(demo)  # a comment (with parentheses)
        find_package(catkin REQUIRED COMPONENTS roscpp)
        add_library(${PROJECT_NAME}_core SHARED src/core.cpp)
        add_library(base src/base.cc)
        target_link_libraries(${PROJECT_NAME}_core PUBLIC base ${catkin_LIBRARIES})
        add_executable(${PROJECT_NAME}_node src/node.cpp include/demo/node.h)
        target_link_libraries(${PROJECT_NAME}_node ${PROJECT_NAME}_core ${catkin_LIBRARIES})
        target_sources(demo_node PRIVATE src/more.cpp)
        #[[ add_executable(none src/none.cpp) ]]
        """
    )
    assert harness.sources(build, "demo_node") == ["src/node.cpp", "src/more.cpp", "src/core.cpp", "src/base.cc"]
    assert build.executable("none") is None
    library = build.library("libdemo_core")
    assert library is not None and library.name == "demo_core"
    assert build.library("demo_core.so") is library and build.library("other") is None


def test_programs_of_tests(harness: Harness) -> None:
    build = harness.build(
        """
        project(demo)
        if(CATKIN_ENABLE_TESTING)
          catkin_add_gtest(${PROJECT_NAME}-unit test/unit.cpp)
          add_rostest_gtest(${PROJECT_NAME}_test test/demo.test test/demo.cpp)
        endif()
        """
    )
    assert build.executable("demo-unit") is not None
    assert harness.sources(build, "demo_test") == ["test/demo.cpp"]


def test_a_program_of_cartographer_s_macro_has_the_library_of_its_project(harness: Harness) -> None:
    build = harness.build(
        """
        project(maps)
        add_library(${PROJECT_NAME} src/core.cpp)
        google_binary(map_node SRCS src/main.cc)
        """
    )
    assert harness.sources(build, "map_node") == ["src/main.cc", "src/core.cpp"]


def test_variables_lists_and_globs(harness: Harness) -> None:
    for name in ("src/b.cpp", "src/a.cpp", "src/deep/c.cpp", "src/a.hpp", "gen/x.cpp"):
        harness.write(name)
    harness.write("src/short.cc")
    build = harness.build(
        """
        project(demo)
        set(SRCS src/one.cpp
                 "src/two.cpp")
        list(APPEND SRCS src/three.cpp)
        add_executable(listed ${SRCS} ${NOT_SET})
        file(GLOB FOUND src/*.cpp)
        add_executable(globbed ${FOUND})
        file(GLOB_RECURSE ALL "${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp")
        add_executable(deep ${ALL})
        add_executable(without src/short none)
        aux_source_directory(gen GENERATED)
        add_executable(aux ${GENERATED})
        set(A ${B}) # goes round
        set(B ${A})
        add_executable(${A}named_${A} src/n.cpp)
        """
    )
    assert harness.sources(build, "listed") == ["src/one.cpp", "src/two.cpp", "src/three.cpp"]
    assert harness.sources(build, "globbed") == ["src/a.cpp", "src/b.cpp"]
    assert harness.sources(build, "deep") == ["src/a.cpp", "src/b.cpp", "src/deep/c.cpp"]
    assert harness.sources(build, "without") == ["src/short.cc"]
    assert harness.sources(build, "aux") == ["gen/x.cpp"]
    assert harness.sources(build, "named_") == ["src/n.cpp"]


def test_names_of_files(harness: Harness) -> None:
    build = harness.build(
        """
        add_executable(demo_a a.cpp)
        add_executable(demo_b b.cpp)
        add_executable(demo_c c.cpp)
        set_target_properties(demo_a PROPERTIES OUTPUT_NAME a PREFIX "")
        set_target_properties(demo_b PROPERTIES PREFIX "" OUTPUT_NAME b)
        set_property(TARGET demo_c PROPERTY OUTPUT_NAME c)
        """
    )
    assert [t.output for t in build.targets.values()] == ["a", "b", "c"]


def test_loops_macros_and_folders(harness: Harness) -> None:
    harness.write("below/CMakeLists.txt", "add_executable(inner inner.cpp ../src/shared.cpp)\n")
    harness.write("cmake/more.cmake", "add_executable(included src/included.cpp)\n")
    build = harness.build(
        """
        project(demo)
        macro(node name)
          add_executable(${name} src/${name}.cpp ${ARGN})
        endmacro()
        function(quiet name)
          set(HIDDEN yes)
          add_executable(${name}${SUFFIX} src/${name}.cpp)
        endfunction()
        foreach(each first second)
          node(${each} src/common.cpp)
        endforeach()
        set(KINDS x y)
        foreach(kind IN LISTS KINDS)
          quiet(${kind})
        endforeach()
        if(WIN32)
          add_executable(windows src/w.cpp)
        else()
          add_executable(linux src/l.cpp)
        endif()
        add_subdirectory(below)
        include(cmake/more.cmake)
        add_executable(last${HIDDEN} last.cpp)
        """
    )
    assert harness.sources(build, "first") == ["src/first.cpp", "src/common.cpp"]
    assert harness.sources(build, "inner") == ["below/inner.cpp", "src/shared.cpp"]
    assert {t.output for t in build.targets.values()} >= {"x", "y", "linux", "included", "last"}
    assert build.executable("windows") is None


def places(build: Build, folder: Path) -> list[tuple[str, str, str]]:
    return [(str(Path(i.source).relative_to(folder)), i.destination, i.name) for i in build.installed]


def test_what_is_installed_under_conditions_and_from_included_files(harness: Harness) -> None:
    harness.write("cmake/rules.cmake", "install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/maps DESTINATION share/demo)\n")
    build = harness.build(
        """
        project(demo)
        set(where share/${PROJECT_NAME})
        if(WIN32)
          set(where apps)
        elseif(APPLE)
          set(where Library)
        endif()
        include(cmake/rules.cmake)
        if(NOT WIN32)
          install(DIRECTORY launch/ DESTINATION ${where})
        else()
          return()
        endif()
        if(WITH_ARM AND (A OR B))
          install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/arm DESTINATION ${CMAKE_INSTALL_DATADIR}/demo)
        else()
          install(FILES no_arm.yaml DESTINATION ${where})
        endif()
        install(PROGRAMS scripts/a.launch.py DESTINATION ${where}/launch)
        ament_auto_package(USE_SCOPED_HEADER_INSTALL_DIR INSTALL_TO_SHARE config)
        """
    )
    assert places(build, harness.folder) == [
        ("cmake/maps", "share/demo", "maps"),
        ("launch", "share/demo", ""),
        ("arm", "share/demo", "arm"),
        ("no_arm.yaml", "share/demo", "no_arm.yaml"),
        ("scripts/a.launch.py", "share/demo/launch", "a.launch.py"),
        ("config", "share/${PROJECT_NAME}", "config"),
    ]
    assert build.complete


@pytest.mark.parametrize(
    ("text", "complete"),
    [
        ("", True),
        ("find_package(a)\nament_target_dependencies(b c)\nrosidl_generate_interfaces(d e)\ninclude(CTest)\n", True),
        ("generate_dcf(config)\n", False),
        (
            "macro(generate_dcf name)\n  install(DIRECTORY ${name} DESTINATION share)\nendmacro()\ngenerate_dcf(a)\n",
            True,
        ),
        ("install(DIRECTORY ${elsewhere}/launch DESTINATION share/demo)\n", False),
        ("install(CODE x)\n", False),
        ("include(../more.cmake)\n", False),
    ],
)
def test_whether_all_that_is_installed_is_known(harness: Harness, text: str, complete: bool) -> None:
    assert harness.build(f"project(demo)\n{text}ament_package()\n").complete == complete
    assert not read_build(str(harness.folder / "nothing"), "demo", Disk()).complete


def test_scripts(harness: Harness) -> None:
    build = harness.build(
        """
        catkin_install_python(PROGRAMS scripts/a.py scripts/b.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
        install(PROGRAMS scripts/c.py DESTINATION bin RENAME c)
        install(TARGETS x RUNTIME DESTINATION bin)
        """
    )
    assert set(build.programs) == {"a.py", "b.py", "c"}
    assert build.made_of("b.py") == Made(str(harness.folder / "scripts/b.py"), True)
    assert build.made_of("c") == Made(str(harness.folder / "scripts/c.py"), False)
    assert build.made_of("x") is None


def test_programs_in_folders_and_lists_of_files(harness: Harness) -> None:
    for name, mode in (("a.py", 0o755), ("deep/b.py", 0o755), ("data.txt", 0o644)):
        harness.write(f"scripts/{name}")
        (harness.folder / "scripts" / name).chmod(mode)
    harness.write("tool.py")
    (harness.folder / "tool.py").chmod(0o755)
    installed = "install(DIRECTORY scripts/ DESTINATION {0}) install(FILES tool.py DESTINATION {0})"
    build = harness.build(f"project(demo)\n{installed.format('lib/${PROJECT_NAME}')}")
    assert set(build.programs) == {"a.py", "b.py", "tool.py"}
    assert harness.build(f"project(demo)\n{installed.format('share/${PROJECT_NAME}')}").programs == {}
    assert harness.build("project(demo)\ninstall(DIRECTORY / ../.. DESTINATION lib/demo)").programs == {}


def test_scripts_that_get_the_permission_to_be_executed(harness: Harness) -> None:
    for name in ("a.py", "deep/b.sh", "data.txt"):
        harness.write(f"scripts/{name}")
    share = "${CATKIN_PACKAGE_SHARE_DESTINATION}"
    installed = f'install(DIRECTORY scripts/ DESTINATION {share} FILES_MATCHING PATTERN "*" PERMISSIONS OWNER_EXECUTE)'
    build = harness.build(f"{installed}\ninstall(DIRECTORY / DESTINATION {share} PERMISSIONS OWNER_EXECUTE)")
    assert set(build.programs) == {"a.py", "b.sh"}
    assert build.made_of("a.py") == Made(str(harness.folder / "scripts/a.py"), False)
    build = harness.build(f"install(FILES tool.py a.txt DESTINATION {share} PERMISSIONS OWNER_READ WORLD_EXECUTE)")
    assert set(build.programs) == {"tool.py"}


def test_an_executable_of_several_files_is_told_by_the_one_with_its_name(harness: Harness) -> None:
    build = harness.build(
        "add_executable(Driver a.cpp driver.cpp)\nadd_executable(b a.cpp main.cpp)\nadd_executable(c)"
    )
    assert build.made_of("Driver") == Made(str(harness.folder / "driver.cpp"), True)
    assert build.made_of("b") == Made(str(harness.folder / "main.cpp"), True)
    assert build.made_of("c") is None


@pytest.mark.parametrize(
    "text",
    [
        "add_subdirectory(.)\nadd_executable(a a.cpp)",
        "include(CMakeLists.txt)\nadd_executable(a a.cpp)",
        "macro(m)\n m()\n m()\nendmacro()\nadd_executable(a a.cpp)\nm()",
        "set(x aaaaaaaaaa)\n" + "set(x ${x}${x}${x}${x})\n" * 60 + "add_executable(a a.cpp)",
        "add_executable(a a.cpp)\nadd_executable(b b.cpp",
        "add_executable(a a.cpp)\n" + "foreach(x 1 2 3 4 5 6 7 8 9)\n" * 30 + "set(y 1)\n" + "endforeach()\n" * 30,
        "add_executable(a a.cpp))))\nendmacro()",
        'add_executable(a a.cpp)\nset(x "',
        "add_executable()\nset()\nfile(GLOB)\nset_target_properties()\nforeach()\nendforeach()\n"
        "add_executable(a a.cpp)",
    ],
)
def test_odd_files_end_soon_and_raise_nothing(harness: Harness, text: str) -> None:
    assert harness.sources(harness.build(text), "a") == ["a.cpp"]


PIECES = [*'()"#[]=${};\\ \nab', "set", "foreach", "endforeach", "macro", "add_executable", "add_subdirectory"]


@settings(deadline=None)
@given(st.lists(st.sampled_from(PIECES)).map("".join))
def test_any_text_is_read(text: str) -> None:
    texts = {"/nowhere/CMakeLists.txt": text}
    assert read_build("/nowhere", "demo", disk_with(texts)) == read_build("/nowhere", "demo", disk_with(texts))


@pytest.mark.parametrize("version", ["$ENV{ROS_VERSION}", '"$ENV{ROS_VERSION}"', "ROS_VERSION", "${ROS_VERSION}"])
def test_what_is_built_for_the_other_generation_alone_is_left_out(harness: Harness, version: str) -> None:
    text = f"""
        if({version} STREQUAL 1)
          add_executable(demo src/ros1.cpp)
        elseif({version} EQUAL "2")
          add_executable(demo src/ros2.cpp)
        endif()
        """
    assert harness.sources(harness.build_for(1, text), "demo") == ["src/ros1.cpp"]
    assert harness.sources(harness.build_for(2, text), "demo") == ["src/ros2.cpp"]
    assert harness.sources(harness.build(text), "demo") == ["src/ros1.cpp", "src/ros2.cpp"], "not known for which"


def test_folders_of_headers_are_those_of_the_package_that_are_there(harness: Harness) -> None:
    harness.write("a/include/a.h")
    harness.write("b/include/b.h")
    harness.write("b/CMakeLists.txt", "target_include_directories(b PRIVATE include missing)")
    build = harness.build(
        """
        include_directories(SYSTEM /usr/include ${catkin_INCLUDE_DIRS} .. .)
        add_library(a SHARED a.cpp)
        target_include_directories(a PUBLIC
          "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/a/include>" "$<INSTALL_INTERFACE:include>")
        add_subdirectory(b)
        """
    )
    assert build.include_folders == (str(harness.folder / "a/include"), str(harness.folder / "b/include"))


def test_descriptions_of_plugins(harness: Harness) -> None:
    build = harness.build("pluginlib_export_plugin_description_file(controller_interface plugins/a.xml)")
    assert build.plugin_files == (str(harness.folder / "plugins/a.xml"),)


@pytest.mark.parametrize(
    "taken_apart",
    [
        'string(REPLACE ":" ";" parts ${pair})\nlist(GET parts 0 file)\nlist(GET parts 1 name)',
        'string(REPLACE ":" ";" parts "${pair}")\nlist(GET parts -2 file)\nlist(GET parts -1 name)',
        'string(REGEX MATCH "^([^:]+):(.+)$" _ "${pair}")\nset(file ${CMAKE_MATCH_1})\nset(name ${CMAKE_MATCH_2})',
        'string(REGEX REPLACE ":.*" "" file "${pair}")\nstring(REGEX REPLACE ".*:" "" name "${pair}")',
        'string(REGEX REPLACE "(.*):(.*)" "\\\\1" file ${pair})\nstring(REGEX REPLACE "(.*):" "" name ${pair})',
    ],
)
def test_pairs_that_name_executables_and_their_files(harness: Harness, taken_apart: str) -> None:
    text = (
        f'set(PAIRS "src/a.cpp:alpha" "src/b.cpp:beta")\nforeach(pair IN LISTS PAIRS)\n{taken_apart}\n'
        "add_executable(${name} ${file})\nendforeach()\n"
    )
    build = harness.build(text)
    assert {name: harness.sources(build, name) for name in build.targets} == {
        "alpha": ["src/a.cpp"],
        "beta": ["src/b.cpp"],
    }


@pytest.mark.parametrize(("kind", "name"), [("NAME_WE", "talk"), ("NAME", "talk.node.cpp"), ("NAME_WLE", "talk.node")])
def test_executables_named_after_their_files(harness: Harness, kind: str, name: str) -> None:
    text = f"get_filename_component(name src/talk.node.cpp {kind})\nadd_executable(${{name}} src/talk.node.cpp)\n"
    assert [*harness.build(text).targets] == [name]


@pytest.mark.parametrize(
    "pattern", ["(a+)+b", "(a|aa)*b", "a*a*a*a*a*b", "a{2}", "(?=a)", "[", "(", "\\\\w+", "a" * 200, "", ")", "a**"]
)
def test_an_expression_that_is_not_followed_names_nothing(harness: Harness, pattern: str) -> None:
    text = f'string(REGEX REPLACE "{pattern}" "x" name "{"a" * 150}")\nadd_executable(n_${{name}} a.cpp)\n'
    assert len(harness.build(text).targets) == 1


def test_an_executable_whose_name_is_not_known(harness: Harness) -> None:
    assert not harness.build("add_executable(a a.cpp)\nadd_executable(${NAME_OF_OTHER} b.cpp)\n").all_named
    assert harness.build("add_executable(a a.cpp)\nadd_library(${NAME_OF_OTHER} b.cpp)\n").all_named
