// Tells of topics, services and actions.
#pragma once

#include <string.h>

#include <atomic>
#include <initializer_list>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "names.hpp"

namespace preflight {

std::atomic<double> last_new{0};       // when an endpoint was made
thread_local bool in_library = false;  // what rcl makes on its own

// Where a container was started for one of its components: whether it was asked to load it. What it makes before that
// is its own.
std::atomic<bool> loading{false};
bool is_containers() {
  static const bool for_component = getenv("PREFLIGHT_LOAD") != nullptr;
  return for_component && !loading;
}

// The nodes that it made before that.
std::mutex of_container_mutex;
std::set<const Handle*>& nodes_of_container() {
  static auto* all = new std::set<const Handle*>;
  return *all;
}

bool is_of_container(const Handle* node) {
  std::lock_guard<std::mutex> locked(of_container_mutex);
  return nodes_of_container().count(node) != 0;
}

const char* word(int value, std::initializer_list<std::pair<int, const char*>> words) {
  for (const auto& each : words) {
    if (each.first == value) return each.second;
  }
  return nullptr;
}

// The policies that are settled, in JSON; what is left to the middleware is left out.
std::string told_qos(const Qos* qos) {
  if (qos == nullptr) return "{}";
  std::string policies;
  auto add = [&](const char* key, const std::string& value) {
    policies += std::string(policies.empty() ? "\"" : ",\"") + key + "\":" + value;
  };
  auto add_word = [&](const char* key, const char* value) {
    if (value != nullptr) add(key, std::string("\"") + value + "\"");
  };
  add_word("reliability", word(qos->reliability, {{1, "reliable"}, {2, "best_effort"}}));
  add_word("durability", word(qos->durability, {{1, "transient_local"}, {2, "volatile"}}));
  add_word("liveliness", word(qos->liveliness, {{1, "automatic"}, {3, "manual_by_topic"}}));
  if (qos->depth > 0 && qos->depth < 1u << 31) add("depth", std::to_string(qos->depth));
  auto add_time = [&](const char* key, Time time) {
    // Those of the middleware's "infinite" durations are longer.
    if (time.seconds < 2000000000u && (time.seconds > 0 || time.nanoseconds > 0)) {
      add(key, std::to_string(static_cast<double>(time.seconds) + static_cast<double>(time.nanoseconds) * 1e-9));
    }
  };
  add_time("deadline", qos->deadline);
  add_time("lease_duration", qos->lease);
  return "{" + policies + "}";
}

void tell_endpoint(const char* role, const Handle* node, const std::string& name, const std::string& type,
                   const Qos* qos) {
  bool service = role[0] != 'p' && strcmp(role, "subscriber") != 0;
  std::string full = expanded(node, name, service);
  last_new = now();
  Event event("endpoint");
  event.add("role", std::string(role)).add("name", as_given(node, name, full)).add("node", full_name_of(node));
  if (!full.empty()) event.add("resolved", full);
  if (!type.empty()) event.add("type", type);
  event.raw("qos", told_qos(qos)).add("builtin", in_library || is_builtin(node, role, full));
  event.add("of_container", is_of_container(node)).add("speculative", answered || answered_here).send();
}

}  // namespace preflight
