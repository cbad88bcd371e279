"""Records what the headers of distributions of ROS 2 say of what `rcl_preload.cpp` uses.

`python tests/tools/rcl_interface.py humble=FOLDER ...` writes `tests/tracing/rcl_interface.json`; below each folder lie
the sources of rcl, rcl_action, rcl_lifecycle, rmw, rcutils, rosidl_runtime_c, rosidl_typesupport_interface,
rosidl_typesupport_introspection_c and rosidl_typesupport_fastrtps_cpp, each in a folder with its name: in the release
repositories (`ros2-gbp/rcl-release`, ...) the tags are `release/DISTRIBUTION/PACKAGE/VERSION`. The types of functions
and the fields of structures are recorded, nothing of their text.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from support.rcl_interface import RECORD, STRUCTS, of_headers, used, versions


def main() -> None:
    """Read the headers, write the record."""
    folders = {name: Path(folder) for name, _, folder in (each.partition("=") for each in sys.argv[1:])}
    known = {name: of_headers(folder) for name, folder in folders.items()}
    functions = {name: each.functions for name, each in known.items()}
    structs = {name: each.structs for name, each in known.items()}
    shapes = {"functions": versions(functions, used().names), "structs": versions(structs, STRUCTS)}
    sources = {
        name: {path.parent.name: _version(path) for path in sorted(folder.glob("*/package.xml"))}
        for name, folder in folders.items()
    }
    lines = [f' "sources": {json.dumps(sources, indent=2)}']
    for kind, found in shapes.items():
        each = [f'  "{name}": {json.dumps(shape)}' for name, shape in found.items()]
        lines.append(f' "{kind}": {{\n' + ",\n".join(each) + "\n }")
    RECORD.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def _version(manifest: Path) -> str:
    found = re.search(r"<version>([^<]+)</version>", manifest.read_text())
    return found[1] if found is not None else "unknown"


if __name__ == "__main__":
    main()
