// Types of messages and services.
#pragma once

#include <string>

#include "layout.hpp"

namespace preflight {

constexpr const char* kSupports[] = {"rosidl_typesupport_fastrtps_c", "rosidl_typesupport_fastrtps_cpp",
                                     "rosidl_typesupport_introspection_c", "rosidl_typesupport_introspection_cpp"};

void reset_error() {
  auto* reset = REAL_IF_ANY("rcutils_reset_error", void());
  if (reset != nullptr) reset();
}

const Support* found(const Support* support, const char* identifier) {
  if (support == nullptr || support->find == nullptr) return nullptr;
  const Support* special = support->find(support, identifier);
  if (special == nullptr) reset_error();
  return special;
}

// `pkg/msg/Name` of a namespace such as pkg__msg, or in C++ pkg::msg. Empty where it is not known.
std::string type_of(const Support* support) {
  for (const char* identifier : kSupports) {
    const Support* special = found(support, identifier);
    if (special == nullptr || special->data == nullptr) continue;
    const auto* names = static_cast<const char* const*>(special->data);
    std::string space = text(names[0]), name = text(names[1]);
    for (const char* between : {"::", "__"}) {
      size_t at = space.rfind(between);
      if (at != std::string::npos) return space.substr(0, at) + "/" + space.substr(at + 2) + "/" + name;
    }
  }
  return "";
}

// Of the service that sends the goals of an action: pkg/action/Name_SendGoal.
std::string action_of(const std::string& goal_service) {
  const std::string end = "_SendGoal";
  bool is_one = goal_service.size() > end.size() && goal_service.substr(goal_service.size() - end.size()) == end;
  return is_one ? goal_service.substr(0, goal_service.size() - end.size()) : "";
}

}  // namespace preflight
