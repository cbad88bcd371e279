// Transforms. The node's buffer is given the identity, so that whatever it does with it then works.
#pragma once

#include <string>

#include "lacks.hpp"
#include "waits.hpp"

namespace preflight {

#define SET_TRANSFORM "_ZN3tf210BufferCore12setTransformERKN13geometry_msgs17TransformStamped_ISaIvEEE" STRING "b"

std::string frames(const std::string& target, const std::string& source) { return target + " <- " + source; }

bool give_transform(const char* kind, const void* core, const std::string& target, const std::string& source) {
  bool given = false;
  quietly([&] {
    auto* set = REAL_IF_ANY(SET_TRANSFORM, bool(const void*, const Transform&, const std::string&, bool));
    if (set == nullptr) return;
    Transform identity;
    identity.frame = target;
    identity.child = source;
    given = set(core, identity, "preflight", true);
    if (given) tell_answered(kind, frames(target, source));
  });
  return given;
}

// A transform that was not there, and is asked for again from the same place.
bool polled_transform(const void* core, const std::string& target, const std::string& source, void* place) {
  bool again = false;
  quietly([&] { again = asks_again(frames(target, source), place); });
  return again && give_transform("transforms", core, target, source);
}

// tf2_ros::Buffer is a BufferInterface, which has nothing but its table, and then a tf2::BufferCore.
const void* core_of(const void* buffer) { return static_cast<const char*>(buffer) + sizeof(void*); }

// `wait(timeout)` with the time that somebody in the sandbox may need. Simulated time does not pass.
template <typename Ask>
bool wait_for_transform(const void* buffer, const std::string& target, const std::string& source, int64_t timeout,
                        void* place, Ask ask) {
  const void* core = core_of(buffer);
  auto seconds = static_cast<int32_t>(timeout), nanoseconds = static_cast<int32_t>(timeout >> 32);
  if (seconds < 0 || (seconds == 0 && nanoseconds <= 0)) {
    return ask(timeout) || polled_transform(core, target, source, place);
  }
  give_time();
  Wait waiting("transform", frames(target, source));
  double most = grace() * 1e-3, began = now();
  if (seconds > 0 || nanoseconds > most * 1e9) timeout = static_cast<int64_t>(most * 1e9) << 32;
  if (ask(timeout)) return true;
  // Who listens in no thread of its own is refused at once.
  return now() - began > 0.01 && give_transform("transform", core, target, source);
}

}  // namespace preflight
