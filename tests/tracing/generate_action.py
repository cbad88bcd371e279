"""Generates the code of the action `fib/action/Fib` for C and Python, by the generators of the interpreter's own ROS 2.

PyPI has no package with an action. Run by that interpreter: `generate_action.py FOLDER`.
"""

from __future__ import annotations

import importlib
import os
import sys
from pathlib import Path

IDL = """
module fib {
  module action {
    struct Fib_Goal { int32 order; };
    struct Fib_Result { sequence<int32> numbers; };
    struct Fib_Feedback { sequence<int32> partial; };
  };
};
"""
GENERATORS = {
    "rosidl_generator_c": "GenerateC",
    "rosidl_typesupport_c": "GenerateCTypesupport",
    "rosidl_typesupport_fastrtps_c": "GenerateFastRTPSCTypesupport",
    "rosidl_generator_py": "GeneratePython",
    "rosidl_typesupport_introspection_c": "GenerateIntrospectionCTypesupport",
}


def main(folder: Path) -> None:
    """Write it to `folder/fib`, and to `folder/introspection/fib` what has files of the same names."""
    os.environ["AMENT_PREFIX_PATH"] = sys.prefix
    (folder / "action").mkdir(parents=True)
    (folder / "action" / "Fib.idl").write_text(IDL)
    os.chdir(folder)
    for package, name in GENERATORS.items():
        generator = getattr(importlib.import_module(f"{package}.cli"), name)(package)
        place = folder / "introspection" if "introspection" in package else folder
        generator.generate("fib", ["action/Fib.idl"], [f"{sys.prefix}/share"], place / "fib")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
