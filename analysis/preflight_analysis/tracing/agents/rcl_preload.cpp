// Preloaded into programs that use rcl, which every client library of ROS 2 stands on: tells endpoints, declared
// parameters and the way into the event loop, in the events of channel.py, and passes every call on as it came.
//
// No ROS header is needed, so that one source serves every distribution: rcl is a library of C, its handles are opaque
// and are only asked through its own functions. What is known of the inside of objects is little, has been the same
// from Humble to Kilted, and stands in the structs below. Names are as the node gave them where the launch file's node
// would come to the same, as rclpy_weave.py tells them.
//
// A node that waits for a service gets one: it is made in the same process, through rcl, with the types of the node's
// own client, so that whatever executor the node has sees it come. In the same way lifecycle nodes are asked to
// configure and to activate.
#include <pthread.h>

#include <cmath>
#include <csignal>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <type_traits>
#include <vector>

#include "preload.hpp"

// Named, or the hooks that use its types could not be seen from outside.
namespace preflight {

bool is_watched(const char* library) {
  for (const char* start : {"librcl", "librmw", "librcutils", "librosidl", "liblifecycle_msgs"}) {
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
constexpr uint8_t kUnconfigured = 1, kInactive = 2, kConfigure = 1, kActivate = 3;

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
};
constexpr uint8_t kBoolean = 6;

struct ServiceMembers {
  const char *space, *name;
  const Members *request, *response;
};

std::string text(const char* given) { return given == nullptr ? "" : given; }

// Types

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

// Names

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

// Endpoints

std::atomic<double> last_new{0};       // when an endpoint was made
thread_local bool in_library = false;  // what rcl makes on its own

const char* word(int value, std::initializer_list<std::pair<int, const char*>> words) {
  for (const auto& each : words) {
    if (each.first == value) return each.second;
  }
  return nullptr;
}

// The policies that are settled, in JSON; what is left to the middleware is left out.
std::string told_qos(const Qos* qos) {
  if (qos == nullptr) return "{}";
  std::string told;
  auto add = [&](const char* key, const std::string& value) {
    told += std::string(told.empty() ? "\"" : ",\"") + key + "\":" + value;
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
  return "{" + told + "}";
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
  event.add("speculative", answered || answered_here).send();
}

// Parameters. They belong to the client library; rclcpp publishes each that is declared on /parameter_events.

// Of a message in CDR, little-endian; what does not fit throws.
class Reader {
 public:
  explicit Reader(const Serialized& message) : at_(message.buffer), end_(message.buffer + message.length) {
    constexpr unsigned char kLittleEndian[] = {0, 1};
    if (message.length < 4 || memcmp(at_, kLittleEndian, sizeof kLittleEndian) != 0) throw std::exception();
    at_ += 4;
    begin_ = at_;
  }

  template <typename Value>
  Value value() {
    at_ += (sizeof(Value) - (at_ - begin_) % sizeof(Value)) % sizeof(Value);
    Value read;
    memcpy(&read, bytes(sizeof read), sizeof read);
    return read;
  }

  std::string string() {
    auto length = value<uint32_t>();
    const auto* start = reinterpret_cast<const char*>(bytes(length));
    return std::string(start, length == 0 ? 0 : length - 1);
  }

  template <typename Read>
  std::string list(Read read) {
    std::string made;
    for (auto left = value<uint32_t>(); left > 0; --left) made += (made.empty() ? "" : ",") + read();
    return "[" + made + "]";
  }

 private:
  const unsigned char* bytes(size_t count) {
    if (static_cast<size_t>(end_ - at_) < count || at_ > end_) throw std::exception();
    return (at_ += count) - count;
  }

  const unsigned char *begin_ = nullptr, *at_, *end_;
};

// The types of rcl_interfaces/msg/ParameterType by their number.
constexpr const char* kTypes[] = {"",           "bool",       "integer",       "double",       "string",
                                  "byte array", "bool array", "integer array", "double array", "string array"};

struct Value {
  std::string type, json;  // empty where it has none, or one that JSON has not
};

// rcl_interfaces/msg/ParameterValue.
Value value_of(Reader& from) {
  bool whole = true;
  auto boolean = [&] { return std::string(from.value<uint8_t>() != 0 ? "true" : "false"); };
  auto integer = [&] { return std::to_string(from.value<int64_t>()); };
  auto number = [&] {
    auto value = from.value<double>();
    whole = whole && std::isfinite(value);
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    return strpbrk(text, ".en") != nullptr ? std::string(text) : std::string(text) + ".0";
  };
  auto string = [&] { return quoted(from.string()); };
  auto byte = [&] { return std::to_string(from.value<uint8_t>()); };
  auto type = from.value<uint8_t>();
  const std::string values[] = {"",
                                boolean(),
                                integer(),
                                number(),
                                string(),
                                from.list(byte),
                                from.list(boolean),
                                from.list(integer),
                                from.list(number),
                                from.list(string)};
  if (type >= sizeof values / sizeof *values) return {};
  return {kTypes[type], whole || (type != 3 && type != 8) ? values[type] : ""};
}

// The next range of a descriptor, of `from_value`, `to_value` and `step`.
template <typename Number>
std::string json_of(Reader& from) {
  std::string made;
  for (int i = 0; i < 3; ++i) {
    char text[400] = "null";  // what JSON has not
    auto number = static_cast<double>(from.value<Number>());
    const char* format = std::is_same_v<Number, double> ? "%.17g" : "%.0f";
    if (std::isfinite(number)) snprintf(text, sizeof text, format, number);
    made += (made.empty() ? "" : ",") + std::string(text);
  }
  return "[" + made + "]";
}

bool starts_with_any(const std::string& text, std::initializer_list<const char*> starts) {
  for (const char* start : starts) {
    if (starts_with(text, start)) return true;
  }
  return false;
}

std::mutex events_mutex;
std::map<const Handle*, const Support*>& event_publishers() {
  static auto* all = new std::map<const Handle*, const Support*>;
  return *all;
}
std::atomic<bool> any_event_publisher{false};

// The CDR of a message; without a buffer where it cannot be had.
struct Owned {
  Serialized bytes;
  Owned(const void* message, const Support* support) {
    auto* serialize = REAL_IF_ANY("rmw_serialize", int(const void*, const Support*, Serialized*));
    auto* allocator = REAL_IF_ANY("rcutils_get_default_allocator", Allocator());
    if (serialize == nullptr || allocator == nullptr || support == nullptr) return;
    bytes.allocator = allocator();
    int result = serialize(message, support, &bytes);
    reset_error();  // of type supports that it tried before it found the right one: the next error would complain of it
    if (result != kOk) bytes.length = 0;
  }
  ~Owned() { free(bytes.buffer); }
  Owned(const Owned&) = delete;
};

constexpr size_t kMostValue = 3000;

// What every way to learn of a parameter tells of it.
Event param_event(const std::string& node, const std::string& name, const Value& value) {
  bool builtin = name == "use_sim_time" || starts_with_any(name, {"qos_overrides.", "start_type_description_"});
  last_new = now();
  Event event("param");
  event.add("access", std::string("get")).add("name", "~" + name).add("optional", true).add("builtin", builtin);
  if (!node.empty()) event.add("node", node);
  event.add("has_default", !value.json.empty() && !builtin);
  if (!value.json.empty() && value.json.size() <= kMostValue) event.raw("default", value.json);
  return event;
}

// What a message on /parameter_events says of parameters that are new.
void tell_declared(const void* message, const Support* support) {
  Owned owned(message, support);
  Reader from(owned.bytes);
  from.value<int32_t>();
  from.value<uint32_t>();
  std::string node = from.string();
  for (auto left = from.value<uint32_t>(); left > 0; --left) {
    std::string name = from.string();
    Value value = value_of(from);
    Event event = param_event(node, name, value);
    if (!value.type.empty()) event.add("type", value.type);
    event.send();
  }
}

// What our own threads do with rcl ends before the node takes it down.
std::mutex ours_mutex;
bool ended = false;

void end_ours() {
  std::lock_guard<std::mutex> locked(ours_mutex);
  ended = true;
}

// Whether it could still be done.
template <typename Step>
bool while_up(Step step) {
  std::lock_guard<std::mutex> locked(ours_mutex);
  if (!ended) step();
  return !ended;
}

std::set<const Handle*>& gone() {
  static auto* all = new std::set<const Handle*>;
  return *all;
}

// Likewise with a node, which may be taken down before the rest.
template <typename Step>
bool while_up(const Handle* node, Step step) {
  bool there = false;
  bool up = while_up([&] {
    there = gone().count(node) == 0;
    if (there) step();
  });
  return up && there;
}

// Our own threads take no signals: those are the node's.
template <typename Work>
void in_background(Work work) {
  static std::once_flag once;
  std::call_once(once, [] { atexit(end_ours); });
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    std::thread([work = std::move(work)] { quietly(work); }).detach();
  } catch (...) {
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void pause(double seconds) {
  timespec time{0, static_cast<long>(seconds * 1e9)};
  nanosleep(&time, nullptr);
}

// A message, as its own type support makes it.
class Message {
 public:
  explicit Message(const Members* members) : members_(members), memory_(members->size) {
    reinterpret_cast<void (*)(void*, int)>(const_cast<void*>(members->tail()[1]))(memory_.data(), 0);
  }
  ~Message() { reinterpret_cast<void (*)(void*)>(const_cast<void*>(members_->tail()[2]))(memory_.data()); }
  Message(const Message&) = delete;

  void* get() { return memory_.data(); }

  // Yes to each yes or no: a service that fails leads nowhere.
  void agree() {
    const auto* member = static_cast<const Member*>(members_->tail()[0]);
    bool flagged = members_->tail() != members_->rest;
    for (uint32_t i = 0; i < members_->count; ++i, ++member) {
      if (member->type == kBoolean && !member->flags[flagged]) memory_[member->offset] = 1;
    }
  }

 private:
  const Members* members_;
  std::vector<unsigned char> memory_;
};

const ServiceMembers* members_of(const Support* support) {
  for (const char* identifier : {kSupports[2], kSupports[3]}) {
    // It has to be the language of the node's own: of the other one there is none.
    const Support* special = found(support, identifier);
    const auto* members = special == nullptr ? nullptr : static_cast<const ServiceMembers*>(special->data);
    constexpr size_t kMost = 1 << 20;
    if (members != nullptr && members->request->size < kMost && members->response->size < kMost) return members;
  }
  return nullptr;
}

// What a node that is up says of its parameters. Its own services tell what it does not publish: those that were
// declared without a value, what else is declared with them, and all of a node that publishes no parameter events.

// rosidl's strings and lists in C.
struct CString {
  const char* data;
  size_t size, capacity;
};
struct CList {
  CString* data;
  size_t size, capacity;
};

// The request of ListParameters, and in its first field those of DescribeParameters and GetParameters.
struct AskParameters {
  CList names{nullptr, 0, 0};
  uint64_t depth = 0;
};

// A client of one of the services of parameters of a node, in its own process.
class Asking {
 public:
  Asking(const Handle* node, const Support* service, const Support* response, const char* name)
      : response_(response), members_(members_of(service)) {
    auto* make =
        REAL_IF_ANY("rcl_client_init", int(Handle*, const Handle*, const Support*, const char*, const Options*));
    auto* options = REAL_IF_ANY("rcl_client_get_default_options", Options());
    if (make == nullptr || options == nullptr || members_ == nullptr || response == nullptr) return;
    Options given = options();
    made_ = make(&client_, node, service, (std::string("~/") + name).c_str(), &given) == kOk;
  }

  // Calls it, and reads what it answers; whether it did until then.
  template <typename Read>
  bool ask(const Handle* node, const AskParameters& request, double until, Read read) {
    auto* available = REAL_IF_ANY("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
    auto* send = REAL_IF_ANY("rcl_send_request", int(const Handle*, const void*, int64_t*));
    auto* take = REAL_IF_ANY("rcl_take_response", int(const Handle*, void*, void*));
    if (!made_ || available == nullptr || send == nullptr || take == nullptr) return false;
    bool there = false;
    int64_t sequence = 0;
    Message response(members_->response);
    for (int result = kOk + 1; now() < until; pause(0.001)) {
      alignas(16) unsigned char header[128] = {};
      bool up = while_up(node, [&] {
        if (!there && available(node, &client_, &there) == kOk && there) send(&client_, &request, &sequence);
        if (there) result = take(&client_, header, response.get());
        reset_error();
      });
      if (!up) return false;
      if (result != kOk) continue;
      Owned owned(response.get(), response_);
      Reader from(owned.bytes);
      read(from);
      return true;
    }
    return false;
  }

 private:
  const Support* response_;
  const ServiceMembers* members_;
  Handle client_;
  bool made_ = false;
};

#define SUPPORT(kind, name) \
  REAL_IF_ANY("rosidl_typesupport_c__get_" kind "_type_support_handle__rcl_interfaces__srv__" name, const Support*())
#define ASKING(node, type, name) \
  std::make_shared<Asking>(node, called(SUPPORT("service", type)), called(SUPPORT("message", type "_Response")), name)

const Support* called(const Support* (*support)()) { return support == nullptr ? nullptr : support(); }

struct Asked {
  std::string node;
  std::shared_ptr<Asking> list, describe, get;
};

void tell_parameters(const Handle* node, const Asked& asked) {
  double until = now() + 1.5;
  std::vector<std::string> names;
  bool listed = asked.list->ask(node, {}, until, [&](Reader& from) {
    for (auto left = from.value<uint32_t>(); left > 0; --left) names.push_back(from.string());
  });
  std::vector<CString> strings;
  strings.reserve(names.size());
  for (const std::string& name : names) strings.push_back({name.c_str(), name.size(), name.size() + 1});
  AskParameters request;
  request.names = {strings.data(), strings.size(), strings.size()};
  std::vector<Value> values;
  if (!listed || names.empty()) return;
  // One that was declared without a value has none, and rclcpp answers nothing at all then.
  asked.get->ask(node, request, until, [&](Reader& from) {
    for (auto left = from.value<uint32_t>(); left > 0; --left) values.push_back(value_of(from));
  });
  values.resize(names.size());
  asked.describe->ask(node, request, until, [&](Reader& from) {
    auto count = from.value<uint32_t>();
    for (uint32_t i = 0; i < count && i < names.size(); ++i) {
      std::string name = from.string();
      auto type = from.value<uint8_t>();
      from.string();
      from.string();
      bool read_only = from.value<uint8_t>() != 0, dynamic = from.value<uint8_t>() != 0;
      std::string doubles = from.list([&] { return json_of<double>(from); });
      std::string integers = from.list([&] { return json_of<int64_t>(from); });
      Event event = param_event(asked.node, name, values[i]);
      event.add("described", true).add("read_only", read_only).add("dynamic", dynamic);
      if (type > 0 && type < sizeof kTypes / sizeof *kTypes && !dynamic) event.add("type", std::string(kTypes[type]));
      const std::string& range = type == 3 ? doubles : integers;
      if ((type == 2 || type == 3) && range != "[]") event.raw("range", range.substr(1, range.size() - 2));
      event.send();
    }
  });
}

// Nodes with services of parameters that were not asked yet.
std::mutex unasked_mutex;
std::set<const Handle*>& unasked() {
  static auto* all = new std::set<const Handle*>;
  return *all;
}

// The event loop

std::atomic<int> busy{0};  // lifecycle nodes that are on their way, and calls that are going to be answered
std::mutex turns_mutex;
std::string held;  // the state that is to be told once they are through
std::set<std::string> told_states;

void no_longer_busy();

// A node is up now, and answers.
void ask_for_parameters() {
  std::set<const Handle*> nodes;
  {
    std::lock_guard<std::mutex> locked(unasked_mutex);
    nodes.swap(unasked());
  }
  for (const Handle* node : nodes) {
    Asked asked{full_name_of(node), ASKING(node, "ListParameters", "list_parameters"),
                ASKING(node, "DescribeParameters", "describe_parameters"),
                ASKING(node, "GetParameters", "get_parameters")};
    ++busy;
    in_background([node, asked] {
      try {
        tell_parameters(node, asked);
      } catch (...) {  // what it answers is no message that we know
      }
      no_longer_busy();
    });
  }
}

void tell_state(const std::string& state, bool main) {
  Event("state").add("state", state).raw("threads", main ? "0" : "1").send();
}

void tell_turn(const WaitSet* waited_for, int64_t timeout) {
  static std::atomic<int> turns{0};
  bool main = in_main_thread();
  bool works = waited_for->subscriptions.count + waited_for->timers.count + waited_for->clients.count +
                   waited_for->services.count >
               0;
  if (!main && !works) return;  // rclcpp has a thread that looks for changes of the graph
  if (works) ask_for_parameters();
  // Whoever waits without end in the main thread is there. Else it may be a wait before more is made.
  std::string state = main && (timeout < 0 || turns.fetch_add(1) > 0) ? "looped" : "idle";
  std::lock_guard<std::mutex> locked(turns_mutex);
  if (told_states.count(state + (main ? "" : "*")) != 0) return;
  if (busy > 0) {
    if (held != "looped") held = state;
    return;
  }
  told_states.insert(state + (main ? "" : "*"));
  tell_state(state, main);
}

// Whatever loop the node is in, it may leave soon, and has to show one again.
void tell_moving(const char* seconds = "0.3") {
  std::lock_guard<std::mutex> locked(turns_mutex);
  Event("state").add("state", std::string("fed")).raw("seconds", seconds).send();
  told_states.clear();
}

void tell_answered(const char* kind, const std::string& name) {
  Event("answered").add("kind", std::string(kind)).add("name", name).send();
  // The middleware has to bring it, and the machine may be busy.
  tell_moving("1.0");
}

void tell_answered_here(const char* kind, const std::string& name) {
  answered_here = true;
  if (in_main_thread()) answered = true;
  tell_answered(kind, name);
}

void no_longer_busy() {
  std::lock_guard<std::mutex> locked(turns_mutex);
  if (--busy != 0 || held.empty()) return;
  tell_state(held, true);
  held.clear();
}

// Lifecycle nodes

struct Managed {
  Handle client;
  const Machine* machine;
};

thread_local const Handle* change_state_node = nullptr;  // of the service that a state machine made

// Whether the transition was made, within seconds.
bool changed(Managed& managed, uint8_t transition) {
  auto* send = REAL_IF_ANY("rcl_send_request", int(const Handle*, const void*, int64_t*));
  auto* take = REAL_IF_ANY("rcl_take_response", int(const Handle*, void*, void*));
  if (send == nullptr || take == nullptr) return false;
  ChangeState request{transition};
  int64_t sequence = 0;
  int result = kOk + 1;
  while_up([&] { result = send(&managed.client, &request, &sequence); });
  if (result != kOk) return false;
  for (double until = now() + 3; now() < until; pause(0.002)) {
    alignas(16) unsigned char header[128] = {}, response[128] = {};
    if (!while_up([&] { result = take(&managed.client, header, response); })) return false;
    if (result == kOk) return response[0] != 0;
    reset_error();
  }
  return false;
}

uint8_t state_of(const Machine* machine) { return machine->state == nullptr ? 0 : machine->state->id; }

// Has it do what a manager would ask of it.
void bring_up(const Handle* node, std::shared_ptr<Managed> managed) {
  auto* available = REAL_IF_ANY("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
  bool there = false;
  for (double until = now() + 2; available != nullptr && !there && now() < until; pause(0.002)) {
    if (!while_up([&] { available(node, &managed->client, &there); })) break;
  }
  bool configured = there && (state_of(managed->machine) != kUnconfigured || changed(*managed, kConfigure));
  bool active = configured && (state_of(managed->machine) != kInactive || changed(*managed, kActivate));
  if (!active) {
    // What it would have made is not known.
    Event event("answered");
    event.add("kind", std::string("transition")).add("name", std::string(configured ? "activate" : "configure")).send();
  }
  no_longer_busy();
}

void manage(const Handle* node, const Machine* machine) {
  auto* support = REAL_IF_ANY("rosidl_typesupport_c__get_service_type_support_handle__lifecycle_msgs__srv__ChangeState",
                              const Support*());
  auto* make = REAL_IF_ANY("rcl_client_init", int(Handle*, const Handle*, const Support*, const char*, const Options*));
  auto* options = REAL_IF_ANY("rcl_client_get_default_options", Options());
  if (support == nullptr || make == nullptr || options == nullptr) return;
  auto managed = std::make_shared<Managed>();
  managed->machine = machine;
  Options given = options();
  if (make(&managed->client, node, support(), "~/change_state", &given) != kOk) return;
  ++busy;
  in_background([node, managed] { bring_up(node, managed); });
}

// Waits for services

// Seconds.
double grace() { return answered || answered_here ? 0.1 : 0.3; }

struct Wanted {
  const Handle* node;
  const Support* support;
  std::string name;
  int asked = 0;
  double since = 0;
  bool made = false, offered = false;

  // Whether whoever asks again and again has waited long enough.
  bool is_over() {
    if (made) return true;
    if (asked++ == 0) since = now();
    if (asked >= kAsked && now() - since >= grace()) return true;
    if (asked <= kAsked) tell_moving();
    return false;
  }

  static constexpr int kAsked = 3;
};
std::mutex clients_mutex;
std::map<const Handle*, Wanted>& clients() {
  static auto* all = new std::map<const Handle*, Wanted>;  // never destroyed: nodes end in any order
  return *all;
}

// Answers each call of a service of ours.
void serve(std::shared_ptr<Handle> service, const ServiceMembers* members, const std::string& name) {
  auto* take = REAL_IF_ANY("rcl_take_request", int(const Handle*, void*, void*));
  auto* send = REAL_IF_ANY("rcl_send_response", int(const Handle*, void*, void*));
  if (take == nullptr || send == nullptr) return;
  auto once = [&] {
    alignas(16) unsigned char header[128] = {};
    Message request(members->request);
    if (take(service.get(), header, request.get()) == kOk) {
      tell_answered("call", name);
      Message response(members->response);
      response.agree();
      send(service.get(), header, response.get());
      no_longer_busy();
    }
    reset_error();
  };
  while (while_up(once)) pause(0.003);
}

// Makes the service that a client of the node waits for; whether that could be done.
bool offer(const Wanted& wanted, const std::string& full) {
  auto* make =
      REAL_IF_ANY("rcl_service_init", int(Handle*, const Handle*, const Support*, const char*, const Options*));
  auto* options = REAL_IF_ANY("rcl_service_get_default_options", Options());
  const ServiceMembers* members = members_of(wanted.support);
  if (make == nullptr || options == nullptr || members == nullptr) return false;
  auto service = std::make_shared<Handle>();
  Options given = options();
  if (make(service.get(), wanted.node, wanted.support, wanted.name.c_str(), &given) != kOk) return false;
  in_background([service, members, full] { serve(service, members, full); });
  return true;
}

// Whether the node asks for a service again and again that nobody offers, and is to be told that it is there.
bool gives_service(const Handle* client, bool (*ready)(const Handle* node, const Handle* client)) {
  bool give = false;
  quietly([&] {
    std::unique_lock<std::mutex> locked(clients_mutex);
    auto known = clients().find(client);
    if (known == clients().end()) return;
    Wanted& wanted = known->second;
    give = wanted.is_over();
    if (!give || wanted.made) return;
    wanted.made = true;
    Wanted copy = wanted;
    locked.unlock();
    std::string full = expanded(copy.node, copy.name, true);
    tell_answered_here("services", full);
    if (!offer(copy, full)) return;
    locked.lock();
    known = clients().find(client);
    if (known != clients().end()) known->second.offered = true;
    locked.unlock();
    for (double until = now() + 0.5; !ready(copy.node, client) && now() < until;) pause(0.002);
  });
  return give;
}

// Waits for action servers are only told that there is one.
bool gives_action(const Handle* node, const Handle* client) {
  bool give = false;
  quietly([&] {
    auto* name = REAL_IF_ANY("rcl_action_client_get_action_name", const char*(const Handle*));
    std::lock_guard<std::mutex> locked(clients_mutex);
    Wanted& wanted = clients()[client];
    give = wanted.is_over();
    if (!give || wanted.made) return;
    wanted.made = true;
    if (name != nullptr) tell_answered_here("action", expanded(node, text(name(client)), true));
  });
  return give;
}

}  // namespace preflight

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
    std::string expected = text(getenv("PREFLIGHT_NODE"));
    std::string given_by_launch = expected.substr(expected.rfind('/') + 1);
    Event("node")
        .add("name", node_name(self))
        .add("given", text(name))
        .add("space", text(space))
        .add("full", full_name_of(self))
        .add("renamed", node_name(self) == given_by_launch)
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
  if (strcmp(role, "service") == 0 && expanded(node, name, true) == full_name_of(node) + "/list_parameters") {
    std::lock_guard<std::mutex> locked(unasked_mutex);
    unasked().insert(node);
  }
  if (role[0] == 'p' && expanded(node, name, false) == "/parameter_events") {
    std::lock_guard<std::mutex> locked(events_mutex);
    event_publishers()[self] = support;
    any_event_publisher = true;
  }
}

template <typename Handle>
const Qos* actual(const char* function, const Handle* self) {
  std::atomic<void*> known{nullptr};
  auto* qos = real<const Qos*(const Handle*)>(known, function);
  return qos == nullptr ? nullptr : qos(self);
}

}  // namespace preflight

ENDPOINT(rcl_publisher_init, "publisher", actual("rcl_publisher_get_actual_qos", self))
ENDPOINT(rcl_subscription_init, "subscriber", actual("rcl_subscription_get_actual_qos", self))
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
      const Support* support = nullptr;
      {
        std::lock_guard<std::mutex> locked(events_mutex);
        auto known = event_publishers().find(self);
        if (known != event_publishers().end()) support = known->second;
      }
      if (support != nullptr) tell_declared(message, support);
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

HOOK int rcl_lifecycle_state_machine_init(Machine* self, Handle* node, const void* notify, const void* change,
                                          const void* state, const void* states, const void* transitions,
                                          const void* graph, const void* options) {
  using Make =
      int(Machine*, Handle*, const void*, const void*, const void*, const void*, const void*, const void*, const void*);
  auto* make = REAL("rcl_lifecycle_state_machine_init", Make);
  int result;
  {
    Library inside;
    change_state_node = nullptr;
    result = make(self, node, notify, change, state, states, transitions, graph, options);
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
  if (depth == 0 && wait_set != nullptr) quietly([&] { tell_turn(wait_set, timeout); });
  return REAL("rcl_wait", int(WaitSet*, int64_t))(wait_set, timeout);
}

HOOK int rcl_shutdown(void* context) {
  end_ours();
  if (in_main_thread()) quietly([] { Event("state").add("state", std::string("ending")).send(); });
  return REAL("rcl_shutdown", int(void*))(context);
}
