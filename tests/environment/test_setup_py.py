"""What a setup.py says, whatever stands in it."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.installed_paths import python_build
from preflight_analysis.environment.model import Package
from preflight_analysis.environment.setup_py import read_python_build
from support.open_buffers import disk_with

ENTRY = (
    "from setuptools import setup\nsetup(name='p', data_files=d, entry_points={'console_scripts': ['a = p.a:main']})\n"
)


@pytest.mark.parametrize(
    "text",
    [
        "d = ['x']\n" + "d = d + d\n" * 60,
        "d = '%999999999d' % 5\n",
        "d = '%*d' % (999999999, 5)\n",
        "x = ['a']\n" + "x = x + x\n" * 11 + "d = [[[[c for e in x] for c in x] for b in x] for a in x]\n",
        "s = 'xx'\n" + "s = f'{s}{s}'\n" * 60 + "d = [s]\n",
        "d = 5 % 0\n",
    ],
)
def test_what_would_take_all_memory_is_not_known(text: str) -> None:
    build = read_python_build("/p", "p", disk_with({"/p/setup.py": text + ENTRY}))
    assert (list(build.scripts), build.complete) == (["a"], False)


def test_patterns_do_not_leave_the_package_by_links(tmp_path: Path) -> None:
    package = tmp_path / "p"
    (package / "launch").mkdir(parents=True)
    (package / "launch" / "a.launch.py").touch()
    (package / "launch" / ".hidden").touch()
    (package / "root").symlink_to("/")
    for name in ("one", "two"):
        (package / name).symlink_to(package)
    text = "setup(data_files=[('share/p', glob('**/*.launch.py', recursive=True)), ('share/p/all', glob('launch/*'))])"
    found = read_python_build(str(package), "p", disk_with({package / "setup.py": text}))
    assert not found.complete, "links that lead into the package again and again are too many names"
    for name in ("one", "two"):
        (package / name).unlink()
    found = read_python_build(str(package), "p", disk_with({package / "setup.py": text}))
    assert found.complete
    assert found.data == {name: str(package / "launch/a.launch.py") for name in ("a.launch.py", "all/a.launch.py")}


def test_a_deeply_nested_pyproject_is_left_out(tmp_path: Path) -> None:
    for text in ("a=" + "[" * 50_000, "a=" + "{a=" * 50_000, "a." * 50_000, "[a" + ".a" * 50_000 + "]"):
        assert read_python_build(str(tmp_path), "p", disk_with({tmp_path / "pyproject.toml": text})).scripts == {}


def test_a_link_that_leads_to_itself_hides_nothing_beside_it(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "a.launch.py").touch()
    (tmp_path / "launch" / "ring").symlink_to("ring")
    text = "setup(data_files=[('share/p', glob('launch/*'))])"
    found = read_python_build(str(tmp_path), "p", disk_with({tmp_path / "setup.py": text}))
    assert sorted(found.data) == ["a.launch.py", "ring"]


def test_files_that_come_and_go_are_installed_and_are_not(tmp_path: Path) -> None:
    (tmp_path / "setup.py").write_text("setup(data_files=[('share/p/l', glob('launch/**/*.py', recursive=True))])")
    package = Package("p", str(tmp_path), str(tmp_path / "package.xml"), build_type="ament_python")
    disk = Disk()

    def data() -> Mapping[str, str]:
        disk.look()
        return python_build(disk, package).data

    assert data() == {}
    for below in ("launch", "launch/deep", "launch/deep/er"):
        (tmp_path / below).mkdir()
        (tmp_path / below / "a.launch.py").touch()
        assert data() == {"l/a.launch.py": str(tmp_path / below / "a.launch.py")}
    (tmp_path / "launch/deep/er/b.launch.py").touch()
    assert sorted(data()) == ["l/a.launch.py", "l/b.launch.py"]
    (tmp_path / "launch/deep/er/b.launch.py").unlink()
    assert sorted(data()) == ["l/a.launch.py"]


def test_programs_that_are_installed_as_they_are(tmp_path: Path) -> None:
    for name in ("one.py", "two.py"):
        (tmp_path / name).touch()
    text = "from setuptools import setup\nsetup(name='p', {})\n"
    given = "scripts=['one.py', 'gone.py'], data_files=[('lib/p', ['two.py'])]"
    found = read_python_build(str(tmp_path), "p", disk_with({tmp_path / "setup.py": text.format(given)}))
    assert dict(found.programs) == {name: str(tmp_path / name) for name in ("one.py", "two.py")}
    assert found.all_programs
    for unknown in ("scripts=named()", "entry_points=points()", "entry_points={'console_scripts': made()}", "**more"):
        disk = disk_with({tmp_path / "setup.py": text.format(unknown)})
        assert not read_python_build(str(tmp_path), "p", disk).all_programs, unknown


SETUP_OF_BOTH = """
import os
ROS_VERSION = {}
if {}:
    from catkin_pkg.python_setup import generate_distutils_setup
    setup(**generate_distutils_setup(packages=['p']))
else:
    name = 'p'
    setup(
        name=name,
        data_files=[('share/' + name, glob('launch/*.py'))],
        entry_points={{'console_scripts': ['{{}}_node = {{}}.{{other}}:main'.format(name, name, other='b')]}},
    )
"""


@pytest.mark.parametrize(
    ("value", "test"),
    [
        ("int(os.environ['ROS_VERSION'])", "ROS_VERSION == 1"),
        ('os.environ["ROS_VERSION"]', "ROS_VERSION == '1'"),
        ("os.environ.get('ROS_VERSION', '1')", "ROS_VERSION != '2'"),
        ("os.getenv('ROS_VERSION')", "__name__ == '__main__' != 1 and ROS_VERSION == '1'"),
    ],
)
def test_a_package_for_both_generations_is_that_of_ros_2(tmp_path: Path, value: str, test: str) -> None:
    for path in ("launch/a.launch.py", "p/b.py"):
        (tmp_path / path).parent.mkdir(exist_ok=True)
        (tmp_path / path).touch()
    text = SETUP_OF_BOTH.format(value, test)
    found = read_python_build(str(tmp_path), "p", disk_with({tmp_path / "setup.py": text}))
    known = " and " not in test
    assert {name: each.file for name, each in found.scripts.items()} == {"p_node": str(tmp_path / "p/b.py")}
    assert found.data == {"a.launch.py": str(tmp_path / "launch/a.launch.py")}
    assert (found.complete, found.all_programs) == (known, known)


@pytest.mark.parametrize("call", ["setup(", "_ = setup(", "done = setuptools.setup("])
def test_what_is_made_of_the_result_of_setup_does_not_matter(call: str) -> None:
    text = "import setuptools\nfrom setuptools import setup\n" + ENTRY.partition("\n")[2].replace("setup(", call, 1)
    build = read_python_build("/p", "p", disk_with({"/p/setup.py": text.replace("data_files=d, ", "")}))
    assert (list(build.scripts), build.complete, build.all_programs) == (["a"], True, True)


def test_without_a_call_of_setup_nothing_is_known_to_be_all() -> None:
    build = read_python_build("/p", "p", disk_with({"/p/setup.py": "import own_setup\nown_setup.run()\n"}))
    assert (build.complete, build.all_programs) == (False, False)
