"""Compiles the C++ tutorials of `fixtures/ros1/cpp_tutorials`, all in one go: the compiler needs seconds for ROS's
headers and next to nothing for each node. The nodes are links to one program, which is the one that it is called as."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

from support.tracing_harness import ROS1_FIXTURES, SYSTEM_PYTHON

SOURCE = ROS1_FIXTURES / "cpp_tutorials"
_LIBRARIES = ("roscpp", "rostime", "roscpp_serialization", "rosconsole", "boost_system", "boost_thread", "pthread")
_GENERATOR = "/usr/lib/gencpp/gen_cpp.py"
_TEMPLATES = "/usr/share/gencpp"
_BY_NAME = """
int main(int argc, char** argv) {{
  std::string called = argv[0];
  called = called.substr(called.rfind('/') + 1);
{calls}
  return 127;
}}
"""


def compiled(folder: Path) -> Path:
    """The package, built below `folder`."""
    package = folder / "cpp_tutorials"
    shutil.copytree(SOURCE, package)
    include = package / "include" / "cpp_tutorials"
    subprocess.run(
        [SYSTEM_PYTHON, _GENERATOR, str(package / "srv/TwoInts.srv"), "-p", "cpp_tutorials", "-o", str(include),
         "-e", _TEMPLATES],
        check=True,
    )  # fmt: skip
    sources = sorted((package / "src").glob("*.cpp"))
    headers = sorted({line for source in sources for line in re.findall(r"^#include .*$", source.read_text(), re.M)})
    nodes = [
        f'namespace {source.stem} {{\n#define main run\n#include "{source}"\n#undef main\n}}' for source in sources
    ]
    calls = "\n".join(f'  if (called == "{source.stem}") return {source.stem}::run(argc, argv);' for source in sources)
    whole = package / "all.cpp"
    whole.write_text("\n".join((*headers, "#include <string>", *nodes, _BY_NAME.format(calls=calls))))
    program = package / "all"
    libraries = [f"-l{name}" for name in _LIBRARIES]
    command = ["g++", "-w", "-std=c++17", f"-I{package / 'include'}", str(whole), "-o", str(program), *libraries]
    subprocess.run(command, check=True)
    for source in sources:
        os.link(program, package / source.stem)
    return package
