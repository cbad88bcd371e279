// Preloaded into programs that use rcl, which every client library of ROS 2 stands on: tells endpoints, declared
// parameters and the way into the event loop, in the events of channel.py, and passes every call on as it came.
//
// No ROS header is needed, so that one source serves every distribution: rcl is a library of C, its handles are opaque
// and are only asked through its own functions. What is known of the inside of objects is little, has been the same
// from Humble to Kilted, and stands in rcl_preload/layout.hpp. Names are as the node gave them where the launch file's
// node would come to the same, as rclpy_weave.py tells them.
//
// A node that waits for a service gets one: it is made in the same process, through rcl, with the types of the node's
// own client, so that whatever executor the node has sees it come. In the same way lifecycle nodes are asked to
// configure and to activate.
#include "rcl_preload/asking.hpp"
#include "rcl_preload/background.hpp"
#include "rcl_preload/cdr.hpp"
#include "rcl_preload/components.hpp"
#include "rcl_preload/endpoints.hpp"
#include "rcl_preload/layout.hpp"
#include "rcl_preload/lifecycle.hpp"
#include "rcl_preload/loop.hpp"
#include "rcl_preload/messages.hpp"
#include "rcl_preload/names.hpp"
#include "rcl_preload/parameters.hpp"
#include "rcl_preload/services.hpp"
#include "rcl_preload/types.hpp"

using namespace preflight;

HOOK int rcl_init(int argc, const char* const* argv, const void* options, void* context) {
  quietly([] {});
  return REAL("rcl_init", int(int, const char* const*, const void*, void*))(argc, argv, options, context);
}

// What is made inside is the library's.
struct Library {
  bool before = in_library;
  Library() { in_library = true; }
  ~Library() { in_library = before; }
};

HOOK int rcl_node_init(Handle* self, const char* name, const char* space, void* context, const void* options) {
  auto* make = REAL("rcl_node_init", int(Handle*, const char*, const char*, void*, const void*));
  int result;
  {
    Library inside;
    result = make(self, name, space, context, options);
  }
  quietly([&] {
    {
      std::lock_guard<std::mutex> locked(ours_mutex);
      gone().erase(self);
    }
    // The client library asks for the node's name all the time: that the node does so itself cannot be told apart.
    Event("asked").add("what", std::string("name")).send();
    if (result != kOk) return;
    if (is_containers()) {
      std::lock_guard<std::mutex> locked(of_container_mutex);
      nodes_of_container().insert(self);
    }
    std::string expected = text(getenv("PREFLIGHT_NODE"));
    std::string given_by_launch = expected.substr(expected.rfind('/') + 1);
    Event("node")
        .add("name", node_name(self))
        .add("given", text(name))
        .add("space", text(space))
        .add("full", full_name_of(self))
        .add("renamed", node_name(self) == given_by_launch)
        .add("of_container", is_containers())
        .add("own_arguments_only", options != nullptr && !static_cast<const NodeOptions*>(options)->global_arguments)
        .send();
    Event("state").add("state", std::string("init")).send();
  });
  return result;
}

HOOK int rcl_node_fini(Handle* self) {
  quietly([&] {
    {
      std::lock_guard<std::mutex> locked(unasked_mutex);
      unasked().erase(self);
    }
    {
      std::lock_guard<std::mutex> locked(of_container_mutex);
      nodes_of_container().erase(self);
    }
    std::lock_guard<std::mutex> locked(ours_mutex);
    gone().insert(self);
  });
  return REAL("rcl_node_fini", int(Handle*))(self);
}

#define ENDPOINT(function, role, qos_of)                                                        \
  HOOK int function(Handle* self, const Handle* node, const Support* support, const char* name, \
                    const Options* options) {                                                   \
    using Make = int(Handle*, const Handle*, const Support*, const char*, const Options*);      \
    int result = REAL(#function, Make)(self, node, support, name, options);                     \
    if (result == kOk && depth == 0)                                                            \
      quietly([&] { tell_endpoint(role, node, text(name), type_of(support), qos_of); });        \
    quietly([&] { made(role, self, node, support, text(name), result); });                      \
    return result;                                                                              \
  }

namespace preflight {

thread_local std::string goal_service;  // the type, while an end of an action is made

// What is remembered of an end, whoever made it.
void made(const char* role, Handle* self, const Handle* node, const Support* support, const std::string& name,
          int result) {
  if (result != kOk) return;
  if (role[0] == 'c') {
    std::lock_guard<std::mutex> locked(clients_mutex);
    clients()[self] = {node, support, name};
  }
  bool service = role[0] == 'c' || strcmp(role, "service") == 0;
  if (service && depth > 1 && goal_service.empty()) goal_service = action_of(type_of(support));
  if (in_library && name == "~/change_state") change_state_node = node;
  if (strcmp(role, "service") == 0 && ends_with(name, kLoadNode)) offers_to_load(node, support);
  bool lists = strcmp(role, "service") == 0 && expanded(node, name, true) == full_name_of(node) + "/list_parameters";
  if (lists && !is_containers()) {
    std::lock_guard<std::mutex> locked(unasked_mutex);
    unasked().insert(node);
  }
  if (role[0] == 'p' && expanded(node, name, false) == "/parameter_events") {
    std::lock_guard<std::mutex> locked(events_mutex);
    event_publishers()[self] = {node, support};
    any_event_publisher = true;
  }
}

const Qos* asked_for(const Qos* (*qos)(const Handle*), const Handle* self) {
  return qos == nullptr ? nullptr : qos(self);
}

}  // namespace preflight

#define ACTUAL_QOS(function) asked_for(REAL_IF_ANY(function, const Qos*(const Handle*)), self)

ENDPOINT(rcl_publisher_init, "publisher", ACTUAL_QOS("rcl_publisher_get_actual_qos"))
ENDPOINT(rcl_subscription_init, "subscriber", ACTUAL_QOS("rcl_subscription_get_actual_qos"))
ENDPOINT(rcl_service_init, "service", nullptr)
ENDPOINT(rcl_client_init, "client", nullptr)

HOOK int rcl_publisher_fini(Handle* self, Handle* node) {
  quietly([&] {
    std::lock_guard<std::mutex> locked(events_mutex);
    event_publishers().erase(self);
  });
  return REAL("rcl_publisher_fini", int(Handle*, Handle*))(self, node);
}

HOOK int rcl_publish(const Handle* self, const void* message, void* allocation) {
  if (any_event_publisher && depth == 0) {
    quietly([&] {
      EventPublisher by;
      {
        std::lock_guard<std::mutex> locked(events_mutex);
        auto known = event_publishers().find(self);
        if (known != event_publishers().end()) by = known->second;
      }
      if (by.support != nullptr) tell_declared(message, by);
    });
  }
  return REAL("rcl_publish", int(const Handle*, const void*, void*))(self, message, allocation);
}

// rclcpp publishes its parameter events for those alone that listen, where messages stay within the process.
HOOK int rcl_publisher_get_subscription_count(const Handle* self, size_t* count) {
  int result = REAL("rcl_publisher_get_subscription_count", int(const Handle*, size_t*))(self, count);
  if (result == kOk && any_event_publisher && depth == 0) {
    quietly([&] {
      std::lock_guard<std::mutex> locked(events_mutex);
      *count += event_publishers().count(self);
    });
  }
  return result;
}

HOOK int rcl_client_fini(Handle* self, Handle* node) {
  quietly([&] {
    std::lock_guard<std::mutex> locked(clients_mutex);
    clients().erase(self);
  });
  return REAL("rcl_client_fini", int(Handle*, Handle*))(self, node);
}

// The ends of actions. The topics and services that they are made of are not told.

#define ACTION(role, node, name, call)                                                             \
  int result;                                                                                      \
  {                                                                                                \
    Depth nested;                                                                                  \
    result = call;                                                                                 \
  }                                                                                                \
  quietly([&] {                                                                                    \
    if (result == kOk && depth == 1) tell_endpoint(role, node, text(name), goal_service, nullptr); \
    if (depth == 1) goal_service.clear();                                                          \
  });                                                                                              \
  return result;

HOOK int rcl_action_client_init(Handle* self, Handle* node, const void* support, const char* name,
                                const void* options) {
  auto* make = REAL("rcl_action_client_init", int(Handle*, Handle*, const void*, const char*, const void*));
  ACTION("action_client", node, name, make(self, node, support, name, options))
}

HOOK int rcl_action_server_init(Handle* self, Handle* node, void* clock, const void* support, const char* name,
                                const void* options) {
  auto* make = REAL("rcl_action_server_init", int(Handle*, Handle*, void*, const void*, const char*, const void*));
  ACTION("action_server", node, name, make(self, node, clock, support, name, options))
}

HOOK int rcl_action_server_init2(Handle* self, Handle* node, const void* timer, const void* support, const char* name,
                                 const void* options) {
  auto* make =
      REAL("rcl_action_server_init2", int(Handle*, Handle*, const void*, const void*, const char*, const void*));
  ACTION("action_server", node, name, make(self, node, timer, support, name, options))
}

// Since Lyrical there is a clock after the node, so what stands where differs. Whichever it is is passed on: in older
// ones the last word is one of the caller's that nobody reads.
HOOK int rcl_lifecycle_state_machine_init(Machine* self, Handle* node, const void* clock_or_notify, const void* a,
                                          const void* b, const void* c, const void* d, const void* e, const void* f,
                                          const void* since_lyrical) {
  using Make = int(Machine*, Handle*, const void*, const void*, const void*, const void*, const void*, const void*,
                   const void*, const void*);
  auto* make = REAL("rcl_lifecycle_state_machine_init", Make);
  int result;
  {
    Library inside;
    change_state_node = nullptr;
    result = make(self, node, clock_or_notify, a, b, c, d, e, f, since_lyrical);
  }
  quietly([&] {
    if (result == kOk && change_state_node != nullptr) manage(change_state_node, self);
  });
  return result;
}

// Who looks at the graph may do more, or something else, once others are there.

#define LOOKS(function, types, ...)                                          \
  quietly([&] {                                                              \
    if (depth == 1) Event("asked").add("what", std::string("graph")).send(); \
  });                                                                        \
  return REAL(#function, int types)(__VA_ARGS__);

HOOK int rcl_get_topic_names_and_types(const Handle* node, Allocator* memory, bool raw, void* found) {
  LOOKS(rcl_get_topic_names_and_types, (const Handle*, Allocator*, bool, void*), node, memory, raw, found)
}

HOOK int rcl_get_service_names_and_types(const Handle* node, Allocator* memory, void* found) {
  LOOKS(rcl_get_service_names_and_types, (const Handle*, Allocator*, void*), node, memory, found)
}

HOOK int rcl_get_node_names(const Handle* node, Allocator memory, void* found, void* spaces) {
  LOOKS(rcl_get_node_names, (const Handle*, Allocator, void*, void*), node, memory, found, spaces)
}

HOOK int rcl_get_node_names_with_enclaves(const Handle* node, Allocator memory, void* found, void* spaces,
                                          void* enclaves) {
  LOOKS(rcl_get_node_names_with_enclaves, (const Handle*, Allocator, void*, void*, void*), node, memory, found, spaces,
        enclaves)
}

#define LOOKS_AT_TOPICS_OF(function)                                                                                   \
  HOOK int function(const Handle* node, Allocator* memory, bool raw, const char* of, const char* space, void* found) { \
    LOOKS(function, (const Handle*, Allocator*, bool, const char*, const char*, void*), node, memory, raw, of, space,  \
          found)                                                                                                       \
  }
LOOKS_AT_TOPICS_OF(rcl_get_publisher_names_and_types_by_node)
LOOKS_AT_TOPICS_OF(rcl_get_subscriber_names_and_types_by_node)

#define LOOKS_AT_SERVICES_OF(function)                                                                            \
  HOOK int function(const Handle* node, Allocator* memory, const char* of, const char* space, void* found) {      \
    LOOKS(function, (const Handle*, Allocator*, const char*, const char*, void*), node, memory, of, space, found) \
  }
LOOKS_AT_SERVICES_OF(rcl_get_service_names_and_types_by_node)
LOOKS_AT_SERVICES_OF(rcl_get_client_names_and_types_by_node)

#define COUNTS(function)                                                      \
  HOOK int function(const Handle* node, const char* name, size_t* count) {    \
    LOOKS(function, (const Handle*, const char*, size_t*), node, name, count) \
  }
COUNTS(rcl_count_publishers)
COUNTS(rcl_count_subscribers)
COUNTS(rcl_count_clients)
COUNTS(rcl_count_services)

#define LOOKS_AT_ENDS(function)                                                                            \
  HOOK int function(const Handle* node, Allocator* memory, const char* name, bool raw, void* found) {      \
    LOOKS(function, (const Handle*, Allocator*, const char*, bool, void*), node, memory, name, raw, found) \
  }
LOOKS_AT_ENDS(rcl_get_publishers_info_by_topic)
LOOKS_AT_ENDS(rcl_get_subscriptions_info_by_topic)
LOOKS_AT_ENDS(rcl_get_clients_info_by_service)
LOOKS_AT_ENDS(rcl_get_servers_info_by_service)

HOOK int rcl_service_server_is_available(const Handle* node, const Handle* client, bool* available) {
  auto* ask = REAL("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
  int result = ask(node, client, available);
  if (result != kOk || depth > 0 || *available) return result;
  *available = gives_service(client, [](const Handle* node, const Handle* client) {
    auto* ask = REAL("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
    bool there = false;
    return ask(node, client, &there) != kOk || there;
  });
  return result;
}

HOOK int rcl_action_server_is_available(const Handle* node, const Handle* client, bool* available) {
  int result;
  {
    Depth nested;
    result = REAL("rcl_action_server_is_available", int(const Handle*, const Handle*, bool*))(node, client, available);
  }
  if (result == kOk && depth == 0 && !*available) *available = gives_action(node, client);
  return result;
}

HOOK int rcl_send_request(const Handle* self, const void* request, int64_t* sequence) {
  quietly([&] {
    std::lock_guard<std::mutex> locked(clients_mutex);
    auto known = clients().find(self);
    if (known != clients().end() && known->second.offered) ++busy;
  });
  return REAL("rcl_send_request", int(const Handle*, const void*, int64_t*))(self, request, sequence);
}

HOOK int rcl_wait(WaitSet* wait_set, int64_t timeout) {
  if (depth == 0 && wait_set != nullptr) {
    quietly([&] {
      if (wait_set->services.count > 0) ask_to_load();
      tell_turn(wait_set, timeout);
    });
  }
  return REAL("rcl_wait", int(WaitSet*, int64_t))(wait_set, timeout);
}

HOOK int rcl_shutdown(void* context) {
  end_ours();
  if (in_main_thread()) quietly([] { Event("state").add("state", std::string("ending")).send(); });
  return REAL("rcl_shutdown", int(void*))(context);
}
