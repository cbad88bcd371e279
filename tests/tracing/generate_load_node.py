"""Generates the code of the service `composition_interfaces/srv/LoadNode` for C++, by the generators of the
interpreter's own ROS 2.

PyPI has no composition_interfaces. Run by that interpreter: `generate_load_node.py FOLDER`.
"""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path

IDL = """
#include "rcl_interfaces/msg/Parameter.idl"
module composition_interfaces {
  module srv {
    struct LoadNode_Request {
      string package_name;
      string plugin_name;
      string node_name;
      string node_namespace;
      uint8 log_level;
      sequence<string> remap_rules;
      sequence<rcl_interfaces::msg::Parameter> parameters;
      sequence<rcl_interfaces::msg::Parameter> extra_arguments;
    };
    struct LoadNode_Response {
      boolean success;
      string error_message;
      string full_node_name;
      uint64 unique_id;
    };
  };
};
"""
GENERATORS = {
    "rosidl_generator_c": "GenerateC",
    "rosidl_generator_cpp": "GenerateCpp",
    "rosidl_typesupport_cpp": "GenerateCppTypesupport",
    "rosidl_typesupport_fastrtps_cpp": "GenerateFastRTPSCppTypesupport",
    "rosidl_typesupport_introspection_cpp": "GenerateIntrospectionCppTypesupport",
}


def main(folder: Path) -> None:
    """Write it to a folder for each generator: some have files of the same names."""
    os.environ["AMENT_PREFIX_PATH"] = sys.prefix
    (folder / "srv").mkdir(parents=True)
    (folder / "srv" / "LoadNode.idl").write_text(IDL)
    os.chdir(folder)
    for package, name in GENERATORS.items():
        generator = getattr(importlib.import_module(f"{package}.cli"), name)(package)
        place = folder / package / "composition_interfaces"
        generator.generate("composition_interfaces", ["srv/LoadNode.idl"], [f"{sys.prefix}/share"], place)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
