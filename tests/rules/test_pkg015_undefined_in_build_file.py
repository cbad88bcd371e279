"""PKG015: `CMakeLists.txt` refers to a source, target or package that it does not have."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.packaging import CMAKE, LISTS, said

STOPS = ": CMake stops, and the package does not build"
CATKIN = {
    **CMAKE,
    "package.xml": CMAKE["package.xml"].replace("ament_cmake", "catkin"),
    "msg/Speed.msg": "",
    "setup.py": "",
}
CATKIN_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project(arm)
find_package(catkin REQUIRED COMPONENTS roscpp message_generation)
catkin_python_setup()
add_message_files(FILES Speed.msg)
generate_messages(DEPENDENCIES std_msgs)
catkin_package()
add_executable(driver src/driver.cpp)
add_dependencies(driver ${PROJECT_NAME}_generate_messages_cpp ${catkin_EXPORTED_TARGETS})
target_link_libraries(driver ${catkin_LIBRARIES})
"""
MESSAGES = """cmake_minimum_required(VERSION 3.8)
project(arm)
find_package(ament_cmake REQUIRED)
find_package(std_msgs REQUIRED)
find_package(rosidl_default_generators REQUIRED)
set(MESSAGES msg/Speed.msg)
rosidl_generate_interfaces(${PROJECT_NAME} ${MESSAGES} "srv/Stop.srv" DEPENDENCIES std_msgs)
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
endif()
ament_package()
"""
OF_MESSAGES = {**CMAKE, "msg/Speed.msg": "", "srv/Stop.srv": "---\n"}
LINKED = LISTS.replace("install(TARGETS", "ament_target_dependencies(driver rclcpp)\ninstall(TARGETS").replace(
    "add_exec", "find_package(rclcpp)\nadd_exec"
)


def _with(lists: str, *changes: tuple[str, str]) -> str:
    for old, new in changes:
        assert old in lists
        lists = lists.replace(old, new)
    return lists


@pytest.mark.parametrize(
    ("lists", "expected"),
    [
        (
            _with(LISTS, ("src/driver.cpp", "src/drver.cpp")),
            f"4 error source file 'src/drver.cpp' of target 'driver' does not exist{STOPS}; did you mean "
            "'src/driver.cpp'?",
        ),
        (
            _with(
                LISTS, ("add_exec", "set(SOURCES src/driver.cpp)\nlist(APPEND SOURCES src/planner.cpp)\nadd_exec")
            ).replace("driver src/driver.cpp", "driver ${SOURCES}"),
            f"6 error source file 'src/planner.cpp' of target 'driver' does not exist{STOPS}",
        ),
        (
            _with(LISTS, ("TARGETS driver", "TARGETS drivers")),
            f"5 error target 'drivers' of install() is not defined{STOPS}; did you mean 'driver'?",
        ),
        (
            _with(LISTS, ("install(TARGETS", "target_link_libraries(${PROJECT_NAME} m)\ninstall(TARGETS")),
            f"5 error target 'arm' of target_link_libraries() is not defined{STOPS}",
        ),
        (
            _with(LISTS, ("add_exec", "target_compile_features(driver PUBLIC cxx_std_17)\nadd_exec")),
            f"4 error target 'driver' is defined after target_compile_features() uses it{STOPS}",
        ),
        (
            _with(LISTS, ("add_exec", "find_package(arm REQUIRED)\nadd_exec")),
            f"4 error find_package() requires 'arm', the package itself, which is not built yet{STOPS}",
        ),
        (
            _with(LINKED, ("(driver rclcpp)", "(driver rclcpp std_msgs)")),
            f"6 error package 'std_msgs' of ament_target_dependencies() has no find_package(){STOPS}",
        ),
        (
            _with(LINKED, ("(driver rclcpp)", "(driver rclcp)")),
            f"6 error package 'rclcp' of ament_target_dependencies() has no find_package(){STOPS}; did you mean "
            "'rclcpp'?",
        ),
        (
            _with(LISTS, ("find_package(ament_cmake REQUIRED)\n", "")),
            f"7 error ament_package() is an unknown command without find_package(ament_cmake){STOPS}",
        ),
        (
            _with(LISTS, ("add_exec", "ament_auto_add_exec")),
            "4 error ament_auto_add_executable() is an unknown command without find_package(ament_cmake_auto)" + STOPS,
        ),
        (
            _with(LISTS, ("ament_package()", "ament_python_install_package(${PROJECT_NAME})\nament_package()")),
            f"8 error ament_python_install_package() needs a folder 'arm', which does not exist{STOPS}",
        ),
    ],
)
def test_of_ament(tmp_path: Path, lists: str, expected: str) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG015") == [f"CMakeLists.txt:{expected}"]


@pytest.mark.parametrize(
    ("lists", "expected"),
    [
        (
            _with(MESSAGES, ("Stop.srv", "Stopp.srv")),
            [
                "7 error interface file 'srv/Stopp.srv' does not exist: rosidl_generate_interfaces() fails, and the "
                "package does not build; did you mean 'srv/Stop.srv'?",
                "7 info interface file 'srv/Stop.srv' is not listed in rosidl_generate_interfaces(): no code is "
                "generated",
            ],
        ),
        (
            _with(MESSAGES, ("DEPENDENCIES std_msgs", "DEPENDENCIES std_msgs geometry_msgs")),
            [f"7 error package 'geometry_msgs' of rosidl_generate_interfaces() has no find_package(){STOPS}"],
        ),
        (
            _with(
                MESSAGES,
                ("find_package(rosidl_default_generators REQUIRED)\n", ""),
                ("find_package(std_msgs REQUIRED)\n", ""),
                (" DEPENDENCIES std_msgs", ""),
            ),
            [
                "5 error rosidl_generate_interfaces() is an unknown command without "
                f"find_package(rosidl_default_generators){STOPS}"
            ],
        ),
    ],
)
def test_of_interfaces(tmp_path: Path, lists: str, expected: list[str]) -> None:
    found = said(tmp_path, {**OF_MESSAGES, "CMakeLists.txt": lists}, "PKG015")
    assert sorted(found) == [f"CMakeLists.txt:{each}" for each in expected]


def test_interface_files_that_are_not_listed(tmp_path: Path) -> None:
    files = {**OF_MESSAGES, "msg/Force.msg": "", "msg/Mass.msg": "", "CMakeLists.txt": MESSAGES}
    assert said(tmp_path, files, "PKG015") == [
        "CMakeLists.txt:7 info interface file 'msg/Force.msg' (and 1 more) is not listed in "
        "rosidl_generate_interfaces(): no code is generated"
    ]


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({"setup.py": None}, f"4 error catkin_python_setup() needs a 'setup.py', which does not exist{STOPS}"),
        (
            {"CMakeLists.txt": _with(CATKIN_LISTS, ("FILES Speed.msg", "FILES Sped.msg")), "msg/Speed.msg": None},
            "5 error interface file 'msg/Sped.msg' does not exist: add_message_files() fails, and the package does not "
            "build",
        ),
        (
            {
                "CMakeLists.txt": _with(
                    CATKIN_LISTS,
                    ("add_message_files(FILES Speed.msg)\n", ""),
                    ("generate_messages(DEPENDENCIES std_msgs)\n", ""),
                )
            },
            "7 error target 'arm_generate_messages_cpp' of add_dependencies() is not defined without "
            f"generate_messages(){STOPS}",
        ),
        (
            {"CMakeLists.txt": _with(CATKIN_LISTS, ("COMPONENTS roscpp", "COMPONENTS roscpp arm"))},
            f"3 error find_package() requires 'arm', the package itself, which is not built yet{STOPS}",
        ),
    ],
)
def test_of_catkin(tmp_path: Path, changed: dict[str, str | None], expected: str) -> None:
    found = said(tmp_path, {**CATKIN, "CMakeLists.txt": CATKIN_LISTS, **changed}, "PKG015")
    assert found == [f"CMakeLists.txt:{expected}"]


def test_a_file_that_git_ignores_may_be_made_elsewhere(tmp_path: Path) -> None:
    lists = _with(LISTS, ("src/driver.cpp", "src/made.cpp"))
    (text,) = said(tmp_path, {**CMAKE, "CMakeLists.txt": lists, ".gitignore": "made.cpp\n"}, "PKG015")
    assert text.startswith("CMakeLists.txt:4 info source file 'src/made.cpp'")


@pytest.mark.silent
@pytest.mark.parametrize(
    "lists",
    [
        LISTS,
        LINKED,
        _with(LISTS, ("driver src/driver.cpp", "driver ${SOURCES}")),
        _with(LISTS, ("driver src/driver.cpp", "driver ${CMAKE_CURRENT_BINARY_DIR}/made.cpp src/driver.cpp")),
        _with(LISTS, ("add_exec", "file(GLOB SOURCES src/*.cpp)\nadd_exec")).replace("src/driver.cpp", "${SOURCES}"),
        _with(LISTS, ("add_exec", "if(WITH_ARM)\n  add_executable(arm src/arm.cpp)\nendif()\nadd_exec")),
        _with(LISTS, ("add_exec", "configure_file(in.cpp src/made.cpp)\nadd_exec"), ("src/driver", "src/made")),
        _with(LISTS, ("install(TARGETS", "if(BUILD_TESTING)\n  target_link_libraries(x y)\nendif()\ninstall(TARGETS")),
        _with(LISTS, ("add_exec", "add_subdirectory(lib)\nadd_exec"), ("TARGETS driver", "TARGETS driver lib")),
        _with(LISTS, ("add_exec", "include(cmake/lib.cmake)\nadd_exec"), ("TARGETS driver", "TARGETS driver lib")),
        _with(LISTS, ("add_exec", "make_library(lib)\nadd_exec"), ("TARGETS driver", "TARGETS driver lib")),
        _with(
            LISTS,
            ("add_exec", "foreach(each a b)\n  add_library(${each} src/driver.cpp)\nendforeach()\nadd_exec"),
            ("TARGETS driver", "TARGETS driver a b"),
        ),
        _with(LISTS, ("install(TARGETS", 'set(ALL "")\nlist(APPEND ALL driver)\ninstall(TARGETS')).replace(
            "TARGETS driver", "TARGETS ${ALL}"
        ),
        _with(LISTS, ("install(TARGETS", "if(NOT CUDA)\n  return()\nendif()\ninstall(TARGETS x)\ninstall(TARGETS")),
        _with(LINKED, ("(driver rclcpp)", "(driver rclcpp rcl builtin_interfaces)")),
        _with(LINKED, ("find_package(rclcpp)", "find_package(rclcpp)\nfind_package(unheard_of)")).replace(
            "(driver rclcpp)", "(driver rclcpp std_msgs)"
        ),
        _with(LINKED, ("find_package(rclcpp)", "find_package(sensor_msgs)\nfind_package(rclcpp)")).replace(
            "(driver rclcpp)", "(driver rclcpp std_msgs)"
        ),
        _with(LISTS, ("find_package(ament_cmake REQUIRED)", "find_package(arm_cmake REQUIRED)")),
        _with(LISTS, ("find_package(ament_cmake REQUIRED)", "include(cmake/all.cmake)")),
        _with(
            LISTS,
            ("find_package(ament_cmake ", "find_package(ament_cmake_auto "),
            ("add_executable", "ament_auto_find_build_dependencies()\nament_auto_add_executable"),
            ("install(TARGETS", "rosidl_generate_interfaces(arm_msgs ${FILES})\ninstall(TARGETS"),
        ),
        _with(
            LISTS,
            (
                "install(TARGETS",
                "rclcpp_components_register_node(driver PLUGIN a::B EXECUTABLE b)\ninstall(TARGETS",
            ),
            ("TARGETS driver", "TARGETS driver b"),
        ),
    ],
)
def test_nothing_to_say_of_ament(tmp_path: Path, lists: str) -> None:
    assert said(tmp_path, {**CMAKE, "CMakeLists.txt": lists}, "PKG015") == []


@pytest.mark.silent
@pytest.mark.parametrize(
    ("files", "lists"),
    [
        (OF_MESSAGES, MESSAGES),
        (OF_MESSAGES, _with(MESSAGES, ("find_package(rosidl_default_generators REQUIRED)\n", ""))),
        (OF_MESSAGES, _with(MESSAGES, ("ament_package()", "add_dependencies(arm__cpp x)\nament_package()"))),
        ({**OF_MESSAGES, "msg/New.msg": ""}, _with(MESSAGES, ("${MESSAGES}", "${MESSAGES} ${MORE}"))),
        ({**CATKIN, "msg/New.msg": ""}, _with(CATKIN_LISTS, ("(FILES Speed.msg)", "()"))),
        (CATKIN, CATKIN_LISTS),
        (
            CATKIN,
            _with(
                CATKIN_LISTS,
                ("catkin_package()", "generate_dynamic_reconfigure_options(a.cfg)\nadd_dependencies(arm_gencfg x)"),
            ),
        ),
        (
            CATKIN,
            _with(
                CATKIN_LISTS,
                ("VERSION 3.0.2", "VERSION 2.8.3"),
                ("add_message_files(FILES Speed.msg)\n", ""),
                ("generate_messages(DEPENDENCIES std_msgs)\n", ""),
            ),
        ),
    ],
)
def test_nothing_to_say_of_interfaces(tmp_path: Path, files: dict[str, str | None], lists: str) -> None:
    assert said(tmp_path, {**files, "CMakeLists.txt": lists}, "PKG015") == []
