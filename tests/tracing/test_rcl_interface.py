"""What `rcl_preload.cpp` uses of rcl is that of each distribution: of those with wheels by their headers, of all by
`rcl_interface.json`, which has the types of functions and the fields of structures."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from preflight_analysis.tracing import preload_compile
from support.rcl_interface import (
    DISTRIBUTIONS,
    RECORD,
    STRUCTS,
    Fields,
    Types,
    of_headers,
    recorded,
    table,
    used,
)
from support.ros2_harness import ROOT, ros2_prefix

pytestmark = pytest.mark.ros
PARTS = preload_compile.RCL.source.parent / "rcl_preload"
NOT_RECORDED = {("lyrical", "message_type_support_callbacks_t")}
"""Of packages whose sources were not at hand."""
BY_VALUE = {
    "rcl_ret_t": "int",
    "rmw_ret_t": "int",
    "rcl_allocator_t": "Allocator",
    "rcutils_allocator_t": "Allocator",
    "rcl_client_options_t": "Options",
    "rcl_service_options_t": "Options",
}


def passed(types: Types) -> Types:
    """How values of these types are passed."""
    plain = (each.replace("const", "").replace(" ", "") for each in types)
    return tuple("pointer" if each.endswith("*") else BY_VALUE.get(each, each) for each in plain)


@pytest.mark.parametrize("distribution", ["kilted", "jazzy"])
def test_the_headers_of_the_wheels_say_what_is_recorded(distribution: str) -> None:
    found, known = of_headers(ros2_prefix(distribution) / "include"), recorded()[distribution]
    assert {name: found.functions.get(name) for name in known.functions} == known.functions
    assert {name: found.structs.get(name) for name in known.structs} == known.structs
    assert used().names & set(found.functions) == set(known.functions)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_functions_are_declared_as_they_are(distribution: str) -> None:
    functions = recorded()[distribution].functions
    for name, types in functions.items():
        expected = passed(types)
        if name in used().hooks:
            # One that takes more than an older one hands that on.
            assert passed(used().hooks[name])[: len(types) - 1] == expected[1:], name
        for declared in used().calls.get(name, ()):
            assert passed(declared)[: len(types)] == expected, name


def test_a_hook_passes_on_what_it_is_given() -> None:
    for name, taken in used().hooks.items():
        assert {passed(each[1:]) for each in used().calls[name]} == {passed(taken)}, name


def test_every_function_is_one_of_rcl() -> None:
    known = recorded()
    unknown = [name for name in used().names if not any(name in each.functions for each in known.values())]
    assert unknown == []


def test_every_structure_is_known_of_every_distribution() -> None:
    known = recorded()
    lacking = {(each, name) for each in DISTRIBUTIONS for name in STRUCTS if name not in known[each].structs}
    assert lacking == NOT_RECORDED


SCALARS = {"bool", "int", "size_t", "uint8_t", "uint32_t", "uint64_t", "int64_t", "unsigned int"}
BYTES = {"int8_t[16]": 16, "uint8_t[RMW_GID_STORAGE_SIZE]": 16}
OWN = {"struct rmw_time_s": "rmw_time_t", "rcl_allocator_t": "rcutils_allocator_t"}
SAME = """
#define AT(own, field, of_theirs, theirs) \\
  static_assert(offsetof(preflight::own, field) == offsetof(real::of_theirs, theirs))
#define FITS(theirs) static_assert(sizeof(real::theirs) <= sizeof(preflight::Handle))
FITS(rcl_node_t); FITS(rcl_publisher_t); FITS(rcl_subscription_t); FITS(rcl_client_t); FITS(rcl_service_t);
FITS(rcl_action_client_t); FITS(rcl_action_server_t);
AT(Support, identifier, rosidl_message_type_support_t, typesupport_identifier);
AT(Support, data, rosidl_message_type_support_t, data);
AT(Support, find, rosidl_message_type_support_t, func);
AT(Support, identifier, rosidl_service_type_support_t, typesupport_identifier);
AT(Support, data, rosidl_service_type_support_t, data);
AT(Support, find, rosidl_service_type_support_t, func);
AT(Allocator, allocate, rcutils_allocator_t, allocate);
AT(Allocator, deallocate, rcutils_allocator_t, deallocate);
AT(Allocator, parts[2], rcutils_allocator_t, state);
static_assert(sizeof(preflight::Allocator) == sizeof(real::rcutils_allocator_t));
AT(Time, seconds, rmw_time_t, sec); AT(Time, nanoseconds, rmw_time_t, nsec);
AT(Qos, history, rmw_qos_profile_t, history); AT(Qos, depth, rmw_qos_profile_t, depth);
AT(Qos, reliability, rmw_qos_profile_t, reliability); AT(Qos, durability, rmw_qos_profile_t, durability);
AT(Qos, deadline, rmw_qos_profile_t, deadline); AT(Qos, lifespan, rmw_qos_profile_t, lifespan);
AT(Qos, liveliness, rmw_qos_profile_t, liveliness); AT(Qos, lease, rmw_qos_profile_t, liveliness_lease_duration);
AT(Serialized, buffer, rcutils_uint8_array_t, buffer); AT(Serialized, length, rcutils_uint8_array_t, buffer_length);
AT(Serialized, capacity, rcutils_uint8_array_t, buffer_capacity);
AT(Serialized, allocator, rcutils_uint8_array_t, allocator);
static_assert(sizeof(preflight::Serialized) == sizeof(real::rcutils_uint8_array_t));
#define RETURNED_THROUGH_A_POINTER(theirs) static_assert(sizeof(real::theirs) > 16 && sizeof(real::theirs) <= 1024)
RETURNED_THROUGH_A_POINTER(rcl_client_options_t); RETURNED_THROUGH_A_POINTER(rcl_service_options_t);
AT(State, label, rcl_lifecycle_state_t, label); AT(State, id, rcl_lifecycle_state_t, id);
AT(Machine, state, rcl_lifecycle_state_machine_t, current_state);
AT(WaitSet, subscriptions.count, rcl_wait_set_t, size_of_subscriptions);
AT(WaitSet, timers.count, rcl_wait_set_t, size_of_timers);
AT(WaitSet, clients.count, rcl_wait_set_t, size_of_clients);
AT(WaitSet, services.count, rcl_wait_set_t, size_of_services);
AT(CString, data, rosidl_runtime_c__String, data); AT(CString, size, rosidl_runtime_c__String, size);
AT(CString, capacity, rosidl_runtime_c__String, capacity);
static_assert(sizeof(real::rmw_request_id_t) <= 128);
#define MEMBERS rosidl_typesupport_introspection_c__MessageMembers
AT(Members, space, MEMBERS, message_namespace_); AT(Members, name, MEMBERS, message_name_);
AT(Members, count, MEMBERS, member_count_); AT(Members, size, MEMBERS, size_of_);
AT(Members, rest[flagged], MEMBERS, members_); AT(Members, rest[flagged + 1], MEMBERS, init_function);
AT(Members, rest[flagged + 2], MEMBERS, fini_function);
#define MEMBER rosidl_typesupport_introspection_c__MessageMember
AT(Member, name, MEMBER, name_); AT(Member, type, MEMBER, type_id_); AT(Member, flags[flagged], MEMBER, is_array_);
AT(Member, length, MEMBER, array_size_); AT(Member, offset, MEMBER, offset_);
#define SERVICE rosidl_typesupport_introspection_c__ServiceMembers
AT(ServiceMembers, request, SERVICE, request_members_); AT(ServiceMembers, response, SERVICE, response_members_);
"""
AGREE = """
using Members = real::rosidl_typesupport_introspection_c__MessageMembers;
using Member = real::rosidl_typesupport_introspection_c__MessageMember;
struct Response { const char* message; bool success, many, also; };
Member member(const char* name, uint8_t type, bool array, size_t offset) {
  Member made{};
  made.name_ = name, made.type_id_ = type, made.is_array_ = array, made.offset_ = offset;
  return made;
}
Member all[] = {member("message", 16, false, offsetof(Response, message)),
                member("success", 6, false, offsetof(Response, success)),
                member("many", 6, true, offsetof(Response, many)),
                member("also", 6, false, offsetof(Response, also))};
void none(void*, int) {}
int main() {
  Members members{};
  members.member_count_ = 4, members.size_of_ = sizeof(Response), members.members_ = all;
  members.init_function = members.fini_function = reinterpret_cast<void*>(none);
  preflight::Message message(reinterpret_cast<const preflight::Members*>(&members));
  message.agree();
  auto* made = static_cast<Response*>(message.get());
  return made->message == nullptr && made->success && !made->many && made->also ? 0 : 1;
}
"""


def declaration(fields: Fields) -> str:
    """The structure, up to the first field whose own inside is not known."""
    lines = []
    for kind, name in fields:
        own = OWN.get(kind, kind)
        if kind in BYTES:
            lines.append(f"char {name}[{BYTES[kind]}];")
        elif own in STRUCTS or own in SCALARS:
            lines.append(f"{own} {name};")
        elif kind.startswith("enum "):
            lines.append(f"int {name};")
        elif kind.endswith(("*", "*)()", "_function")):
            lines.append(f"const void* {name};")
        else:
            break
    return " ".join(lines)


def compiled(distribution: str, body: str, folder: Path) -> Path:
    """A program that has both the library's own structures and those of a distribution."""
    structs = recorded()[distribution].structs
    inner = [name for name in structs if name in OWN.values()]
    declared = [f"struct {name} {{ {declaration(structs[name])} }};" for name in (*inner, *set(structs) - set(inner))]
    later = sorted(declared, key=lambda each: "rcutils_allocator_t " in each or "rmw_qos_profile_t " in each)
    late = sorted(later, key=lambda each: "rmw_qos_profile_t qos" in each)
    flagged = int(any(name == "is_key_" for _, name in structs["rosidl_typesupport_introspection_c__MessageMember"]))
    source = folder / "interface.cpp"
    namespace = "namespace real {\n" + "\n".join(late) + "\n}"
    includes = f'#include <cstddef>\n#include "{PARTS}/asking.hpp"\n'
    source.write_text(f"{includes}{namespace}\nconstexpr int flagged = {flagged};\n{body}")
    compiler = preload_compile.compiler()
    assert compiler is not None
    program = folder / "interface"
    done = subprocess.run([compiler, "-w", "-std=c++17", source, "-o", program, "-ldl", "-lpthread"],
                          capture_output=True, text=True, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    return program


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_what_is_read_of_structures_lies_where_it_is_read(distribution: str, tmp_path: Path) -> None:
    compiled(distribution, f"{SAME}\nint main() {{}}", tmp_path)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_an_answer_says_yes_wherever_it_can(distribution: str, tmp_path: Path) -> None:
    subprocess.run([compiled(distribution, AGREE, tmp_path)], check=True)


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_names_of_a_type_stand_at_the_begin_of_its_support(distribution: str) -> None:
    structs = recorded()[distribution].structs
    for name in ("message_type_support_callbacks_t", "rosidl_typesupport_introspection_c__MessageMembers"):
        if (distribution, name) not in NOT_RECORDED:
            assert structs[name][:2] == (("const char *", "message_namespace_"), ("const char *", "message_name_"))


def test_the_documentation_has_the_table() -> None:
    assert table() in (ROOT / "docs" / "tracing.md").read_text(), f"write it anew: {RECORD.name} or the hooks changed"
