// Questions for parameters. One that is not set is taken as set by who asks for it again and again.
#pragma once

#include <mutex>
#include <string>

#include "lacks.hpp"
#include "names.hpp"

namespace preflight {

void tell_param(const char* access, const Names& names, void* place) {
  if (asked_before(access + names.given + "\n" + names.resolved)) return;
  Event event("param");
  event.add("access", std::string(access)).add("name", names.given);
  if (!names.resolved.empty()) event.add("resolved", names.resolved);
  // Whatever is not there leaves the node's own value: nothing is mandatory in roscpp.
  event.add("optional", true).add("builtin", from_roscpp(place)).send();
}

// Whether a parameter that is not set is to be taken as set, for the node asks for it again and again.
bool gives_param(const Names& names, void* place, bool there) {
  bool give = false;
  quietly([&] {
    if (!in_main_thread() || from_roscpp(place)) return;
    const std::string& name = names.resolved.empty() ? names.given : names.resolved;
    std::lock_guard<std::mutex> locked(lacks_mutex);
    Lacks& known = lacks();
    if (there) return;
    if (known.given.count(name) == 0) {
      auto first = known.polled.insert({{name, place}, now()});
      if (first.second || now() - first.first->second < grace() * 1e-3) return;
      known.given.insert(name);
      tell_answered("parameter", name);
    }
    give = true;
  });
  return give;
}

// A value that is not set is the one that the node had, but for plain ones, which it may not have set itself: those are
// such as a rate or a size can be.
void made_up(double* value) { *value = 1; }
void made_up(float* value) { *value = 1; }
void made_up(int* value) { *value = 1; }
void made_up(bool* value) { *value = true; }
void made_up(void*) {}

template <typename Name, typename Value, typename Ask>
bool ask_param(const char* access, Name name, void* place, Value* value, Ask ask) {
  if (depth > 0) return ask();
  Names names;
  quietly([&] {
    names = name();
    tell_param(access, names, place);
  });
  bool there;
  {
    Depth nested;
    there = ask();
  }
  if (!gives_param(names, place, there)) return there;
  if (!there) made_up(value);
  return true;
}

bool polls_params() {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  for (const auto& each : lacks().polled) {
    if (lacks().given.count(each.first.first) == 0 && now() - each.second < 2 * kGrace * 1e-3) return true;
  }
  return false;
}

}  // namespace preflight
