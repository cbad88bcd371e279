// Parameters. They belong to the client library; rclcpp publishes each that is declared on /parameter_events.
#pragma once

#include <atomic>
#include <initializer_list>
#include <map>
#include <mutex>
#include <string>

#include "cdr.hpp"
#include "endpoints.hpp"

namespace preflight {

bool starts_with_any(const std::string& text, std::initializer_list<const char*> starts) {
  for (const char* start : starts) {
    if (starts_with(text, start)) return true;
  }
  return false;
}

std::mutex events_mutex;
struct EventPublisher {
  const Handle* node = nullptr;
  const Support* support = nullptr;
};
std::map<const Handle*, EventPublisher>& event_publishers() {
  static auto* all = new std::map<const Handle*, EventPublisher>;
  return *all;
}
std::atomic<bool> any_event_publisher{false};

constexpr size_t kMostValue = 3000;

// What every way to learn of a parameter tells of it.
Event param_event(const Handle* handle, const std::string& node, const std::string& name, const Value& value) {
  bool builtin = name == "use_sim_time" || starts_with_any(name, {"qos_overrides.", "start_type_description_"});
  last_new = now();
  Event event("param");
  event.add("access", std::string("get")).add("name", "~" + name).add("optional", true).add("builtin", builtin);
  if (!node.empty()) event.add("node", node);
  event.add("of_container", is_of_container(handle));
  event.add("has_default", !value.json.empty() && !builtin);
  if (!value.json.empty() && value.json.size() <= kMostValue) event.raw("default", value.json);
  return event;
}

// What a message on /parameter_events says of parameters that are new.
void tell_declared(const void* message, const EventPublisher& by) {
  Owned owned(message, by.support);
  Reader from(owned.bytes);
  from.value<int32_t>();
  from.value<uint32_t>();
  std::string node = from.string();
  for (auto left = from.value<uint32_t>(); left > 0; --left) {
    std::string name = from.string();
    Value value = value_of(from);
    Event event = param_event(by.node, node, name, value);
    if (!value.type.empty()) event.add("type", value.type);
    event.send();
  }
}

}  // namespace preflight
