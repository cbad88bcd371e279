// Names of nodes, and names as a node gave them.
#pragma once

#include <cstdlib>
#include <string>

#include "types.hpp"

namespace preflight {

std::string node_name(const Handle* node) {
  auto* name = REAL_IF_ANY("rcl_node_get_name", const char*(const Handle*));
  return name == nullptr ? "" : text(name(node));
}

std::string node_space(const Handle* node) {
  auto* space = REAL_IF_ANY("rcl_node_get_namespace", const char*(const Handle*));
  return space == nullptr ? "" : text(space(node));
}

std::string full_name_of(const Handle* node) {
  std::string space = node_space(node);
  return (space == "/" ? "" : space) + "/" + node_name(node);
}

// The full name before remaps.
std::string expanded(const Handle* node, const std::string& name, bool service) {
  auto* resolve = REAL_IF_ANY("rcl_node_resolve_name", int(const Handle*, const char*, Allocator, bool, bool, char**));
  auto* allocator = REAL_IF_ANY("rcutils_get_default_allocator", Allocator());
  if (resolve == nullptr || allocator == nullptr) return "";
  Allocator memory = allocator();
  char* made = nullptr;
  if (resolve(node, name.c_str(), memory, service, true, &made) != kOk || made == nullptr) {
    reset_error();
    return "";
  }
  std::string full = made;
  memory.deallocate(made, memory.parts[2]);
  return full;
}

// The name as the node gave it, where the launch file's node would come to the same; else the full one.
std::string as_given(const Handle* node, const std::string& name, const std::string& full) {
  if (name.empty() || name[0] == '/') return name;
  std::string expected = text(getenv("PREFLIGHT_NODE"));
  size_t at = expected.rfind('/');
  if (at == std::string::npos) return full;
  std::string space = node_space(node);
  bool in_place = (space == "/" ? "" : space) == expected.substr(0, at);
  bool own = name[0] != '~' || node_name(node) == expected.substr(at + 1);
  return (in_place && own && name.find('{') == std::string::npos) || full.empty() ? name : full;
}

// What client libraries make for each node.
bool is_builtin(const Handle* node, const char* role, const std::string& full) {
  if (full == "/rosout" || full == "/parameter_events") return true;
  if (full == "/clock") return role[0] == 's';
  std::string own = full_name_of(node) + "/";
  if (!starts_with(full, own)) return false;
  for (const char* name : {"describe_parameters", "get_parameter_types", "get_parameters", "list_parameters",
                           "set_parameters", "set_parameters_atomically", "get_type_description"}) {
    if (full.substr(own.size()) == name) return true;
  }
  return false;
}

}  // namespace preflight
