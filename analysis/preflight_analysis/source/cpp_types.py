"""The types of C++'s own that the interpreter knows."""

from __future__ import annotations

from preflight_analysis.source.cpp_values import CppType

PRIMITIVES = frozenset("int bool double float char unsigned long short size_t auto".split())  # noqa: SIM905
SMART_POINTERS = frozenset({"shared_ptr", "unique_ptr", "scoped_ptr", "intrusive_ptr", "weak_ptr", "Ptr", "ConstPtr"})
LISTS = frozenset({"std::vector", "std::list", "std::set", "std::deque", "std::array", "std::initializer_list"})
MAPS = frozenset({"std::map", "std::unordered_map"})
STREAMS = frozenset({"std::stringstream", "std::ostringstream"})
STANDARD = LISTS | MAPS | STREAMS | {"std::string"}
CALLABLE = frozenset({"std::function", "boost::function"})


def standard(name: str) -> str:
    """`std::string` of `string`, where all of `std` is used."""
    return f"std::{name}" if f"std::{name}" in STANDARD else name


def pointed(type_: CppType) -> CppType:
    """What a pointer of that type points to; the type itself if it is none."""
    return type_.args[0] if type_.args and type_.name.rpartition("::")[2] in SMART_POINTERS else type_
