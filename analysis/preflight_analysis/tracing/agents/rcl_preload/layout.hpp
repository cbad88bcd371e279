// The types of rcl, rmw, rosidl and rcutils as far as they are read here. Named, or the hooks that use them could not
// be seen from outside.
#pragma once

#include <string.h>

#include <cstdint>
#include <string>

#include "../preload.hpp"

namespace preflight {

bool is_watched(const char* library) {
  for (const char* start :
       {"librcl", "librmw", "librcutils", "librosidl", "liblifecycle_msgs", "libcomposition_interfaces"}) {
    if (starts_with(library, start)) return true;
  }
  return false;
}

constexpr int kOk = 0;

// rcl_node_t, rcl_publisher_t, ...: what the caller allocates has one or two pointers.
struct Handle {
  void* parts[2] = {nullptr, nullptr};
};

// rosidl_message_type_support_t and rosidl_service_type_support_t begin alike.
struct Support {
  const char* identifier;
  const void* data;
  const Support* (*find)(const Support*, const char*);
};

// rcutils_allocator_t.
struct Allocator {
  void* (*allocate)(size_t, void*);
  void (*deallocate)(void*, void*);
  void* parts[3];
};

// rcl_node_options_t begins so.
struct NodeOptions {
  Allocator allocator;
  bool global_arguments;  // whether those of the process count for the node too
};

// rmw_time_t.
struct Time {
  uint64_t seconds, nanoseconds;
};

// rmw_qos_profile_t.
struct Qos {
  int history;
  size_t depth;
  int reliability, durability;
  Time deadline, lifespan;
  int liveliness;
  Time lease;
};

// rmw_serialized_message_t.
struct Serialized {
  unsigned char* buffer = nullptr;
  size_t length = 0, capacity = 0;
  Allocator allocator;
};

// What is returned by value and passed on unread. The real ones are smaller, and returned through a hidden pointer too.
struct Options {
  Options(const Options& other) { memcpy(bytes, other.bytes, sizeof bytes); }
  ~Options() {}  // NOLINT(modernize-use-equals-default): that one would be trivial
  alignas(16) unsigned char bytes[1024];
};

// rcl_lifecycle_state_machine_t begins with its state, and that with its label and number.
struct State {
  const char* label;
  uint8_t id;
};
struct Machine {
  const State* state;
};
constexpr uint8_t kUnconfigured = 1, kInactive = 2, kActive = 3, kConfigure = 1, kActivate = 3;

// lifecycle_msgs__srv__ChangeState_Request: a transition's number, and its label as rosidl's C string.
struct ChangeState {
  uint8_t id;
  const char* label = "";
  size_t size = 0, capacity = 1;
};

// rcl_wait_set_t.
struct WaitSet {
  struct Entities {
    const void* entities;
    size_t count;
  } subscriptions, guard_conditions, timers, clients, services, events;
};

// MessageMembers of rosidl_typesupport_introspection, up to what is not the same in all distributions.
struct Members {
  const char *space, *name;
  uint32_t count;
  size_t size;
  const void* rest[4];

  // Since Jazzy there is a flag before the rest, which is no address.
  const void* const* tail() const { return rest + (reinterpret_cast<uintptr_t>(rest[0]) <= 1 ? 1 : 0); }
};

// MessageMember of the same.
struct Member {
  const char* name;
  uint8_t type;
  size_t bound;
  const void* members;
  bool flags[2];  // the first whether it is an array; since Jazzy the second
  size_t length;
  bool bounded;
  uint32_t offset;
  const void* rest[7];

  // Since Lyrical there is a flag after the rest, which is no address as the next one's name is.
  const Member* next() const {
    const Member* after = this + 1;
    bool flagged = reinterpret_cast<uintptr_t>(after->name) <= 1;
    return flagged ? reinterpret_cast<const Member*>(&after->type) : after;
  }
};
constexpr uint8_t kBoolean = 6;

struct ServiceMembers {
  const char *space, *name;
  const Members *request, *response;
};

std::string text(const char* given) { return given == nullptr ? "" : given; }

}  // namespace preflight
