// Preloaded into roscpp nodes: tells endpoints, parameter calls and the way into the event loop, in the events of
// channel.py, and passes every call on as it came.
//
// No ROS header is needed, so that one source serves every ROS 1 distribution: the functions are intercepted by their
// mangled names, of the objects only the first fields of the option structs are read (their order has not changed since
// Indigo), handles that are returned by value are opaque.
#include <sys/socket.h>

#include "roscpp_preload/endpoints.hpp"
#include "roscpp_preload/lacks.hpp"
#include "roscpp_preload/layout.hpp"
#include "roscpp_preload/loop.hpp"
#include "roscpp_preload/messages.hpp"
#include "roscpp_preload/names.hpp"
#include "roscpp_preload/parameters.hpp"
#include "roscpp_preload/threads.hpp"
#include "roscpp_preload/transforms.hpp"
#include "roscpp_preload/waits.hpp"

using namespace preflight;

// Endpoints. The library writes the resolved name into the options, so it is told before.

#define ADVERTISE "_ZN3ros10NodeHandle9advertiseERNS_16AdvertiseOptionsE"
HOOK Handle preflight_advertise(NodeHandle* self, TopicOptions& options) __asm__(ADVERTISE);
HOOK Handle preflight_advertise(NodeHandle* self, TopicOptions& options) {
  tell_topic("publisher", self, options);
  if (is_transforms(options.type)) quietly([&] { remember_transforms(names_of(self, options.topic).resolved); });
  return REAL(ADVERTISE, Handle(NodeHandle*, TopicOptions&))(self, options);
}

#define SUBSCRIBE "_ZN3ros10NodeHandle9subscribeERNS_16SubscribeOptionsE"
HOOK Handle preflight_subscribe(NodeHandle* self, TopicOptions& options) __asm__(SUBSCRIBE);
HOOK Handle preflight_subscribe(NodeHandle* self, TopicOptions& options) {
  tell_topic("subscriber", self, options);
  if (!from_roscpp(__builtin_return_address(0))) remember_subscription(self, options);
  return REAL(SUBSCRIBE, Handle(NodeHandle*, TopicOptions&))(self, options);
}

#define SERVICE "_ZN3ros10NodeHandle16advertiseServiceERNS_23AdvertiseServiceOptionsE"
HOOK Handle preflight_advertise_service(NodeHandle* self, ServiceOptions& options) __asm__(SERVICE);
HOOK Handle preflight_advertise_service(NodeHandle* self, ServiceOptions& options) {
  quietly([&] { endpoint("service", names_of(self, options.service), options.md5).add("type", options.type).send(); });
  return REAL(SERVICE, Handle(NodeHandle*, ServiceOptions&))(self, options);
}

#define CLIENT "_ZN3ros10NodeHandle13serviceClientERNS_20ServiceClientOptionsE"
HOOK Handle preflight_service_client(NodeHandle* self, ClientOptions& options) __asm__(CLIENT);
HOOK Handle preflight_service_client(NodeHandle* self, ClientOptions& options) {
  quietly([&] { endpoint("client", names_of(self, options.service), options.md5).send(); });
  return REAL(CLIENT, Handle(NodeHandle*, ClientOptions&))(self, options);
}

// A node opens a socket of UDP at its start, whether a topic will be unreliable or not. A sandbox that has none leaves
// it without.

#define INCOMING "_ZN3ros12TransportUDP14createIncomingEib"
HOOK bool preflight_create_incoming(void* self, int port, bool server) __asm__(INCOMING);
HOOK bool preflight_create_incoming(void* self, int port, bool server) {
  int tried = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (tried < 0 && errno == EPROTONOSUPPORT) return true;
  if (tried >= 0) close(tried);
  return REAL(INCOMING, bool(void*, int, bool))(self, port, server);
}

// Parameters. Sets and deletes are told by the master.

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

// `type` is what the value is.
#define METHOD_(id, access, type, symbol)                                                                    \
  HOOK bool id(const NodeHandle* self, const std::string& key, type* value) __asm__(symbol);                 \
  HOOK bool id(const NodeHandle* self, const std::string& key, type* value) {                                \
    return ask_param(                                                                                        \
        access, [=, &key] { return names_of(self, key); }, __builtin_return_address(0), value,               \
        [&] { return REAL(symbol, bool(const NodeHandle*, const std::string&, void*))(self, key, value); }); \
  }
#define METHOD(access, type, symbol) METHOD_(JOIN(preflight_method_, __COUNTER__), access, type, symbol)

#define FUNCTION_(id, access, type, symbol)                                           \
  HOOK bool id(const std::string& key, type* value) __asm__(symbol);                  \
  HOOK bool id(const std::string& key, type* value) {                                 \
    return ask_param(                                                                 \
        access, [&key] { return names_of(key); }, __builtin_return_address(0), value, \
        [&] { return REAL(symbol, bool(const std::string&, void*))(key, value); });   \
  }
#define FUNCTION(access, type, symbol) FUNCTION_(JOIN(preflight_function_, __COUNTER__), access, type, symbol)

#define MAP_OF(type) "RSt3mapIS6_" type "St4lessIS6_ESaISt4pairIS7_" type "EEE"
#define EACH_TYPE(hook, start)                       \
  hook("get", void, start "RN6XmlRpc11XmlRpcValueE") \
  hook("get", void, start "RS6_")                    \
  hook("get", bool, start "Rb")                      \
  hook("get", double, start "Rd")                    \
  hook("get", float, start "Rf")                     \
  hook("get", int, start "Ri")                       \
  hook("get", void, start "RSt6vectorIS6_SaIS6_EE")  \
  hook("get", void, start "RSt6vectorIbSaIbEE")      \
  hook("get", void, start "RSt6vectorIdSaIdEE")      \
  hook("get", void, start "RSt6vectorIfSaIfEE")      \
  hook("get", void, start "RSt6vectorIiSaIiEE")      \
  hook("get", void, start MAP_OF("S6_"))             \
  hook("get", void, start MAP_OF("b"))               \
  hook("get", void, start MAP_OF("d"))               \
  hook("get", void, start MAP_OF("f"))               \
  hook("get", void, start MAP_OF("i"))

EACH_TYPE(METHOD, "_ZNK3ros10NodeHandle8getParamE" STRING)
EACH_TYPE(METHOD, "_ZNK3ros10NodeHandle14getParamCachedE" STRING)
EACH_TYPE(FUNCTION, "_ZN3ros5param3getE" STRING)
EACH_TYPE(FUNCTION, "_ZN3ros5param9getCachedE" STRING)
METHOD("has", void, "_ZNK3ros10NodeHandle8hasParamE" STRING)
FUNCTION("has", void, "_ZN3ros5param3hasE" STRING)

// `nodelet standalone` loads its nodelet under the name of the process.

#define LOAD \
  "_ZN7nodelet6Loader4loadE" STRING "S8_RKSt3mapIS6_S6_St4lessIS6_ESaISt4pairIS7_S6_EEERKSt6vectorIS6_SaIS6_EE"
HOOK bool preflight_load(void* self, const std::string& name, const std::string& type, const void* remaps,
                         const void* argv) __asm__(LOAD);
HOOK bool preflight_load(void* self, const std::string& name, const std::string& type, const void* remaps,
                         const void* argv) {
  auto* load = REAL(LOAD, bool(void*, const std::string&, const std::string&, const void*, const void*));
  auto* process = REAL_IF_ANY("_ZN3ros9this_node7getNameB5cxx11Ev", const std::string&());
  bool is_ours = *nodelet_name() != 0 && process != nullptr && name == process();
  return load(self, is_ours ? nodelet_name() : name, type, remaps, argv);
}

// The event loop.

#define SPIN "_ZN3ros4spinEv"
HOOK void preflight_spin() __asm__(SPIN);
HOOK void preflight_spin() {
  tell_spin();
  REAL(SPIN, void())();
}

#define SPIN_WITH "_ZN3ros4spinERNS_7SpinnerE"
HOOK void preflight_spin_with(void* spinner) __asm__(SPIN_WITH);
HOOK void preflight_spin_with(void* spinner) {
  tell_spin();
  REAL(SPIN_WITH, void(void*))(spinner);
}

#define SINGLE "_ZN3ros21SingleThreadedSpinner4spinEPNS_13CallbackQueueE"
HOOK void preflight_single_spin(void* self, void* queue) __asm__(SINGLE);
HOOK void preflight_single_spin(void* self, void* queue) {
  tell_spin();
  REAL(SINGLE, void(void*, void*))(self, queue);
}

#define MULTI "_ZN3ros20MultiThreadedSpinner4spinEPNS_13CallbackQueueE"
HOOK void preflight_multi_spin(void* self, void* queue) __asm__(MULTI);
HOOK void preflight_multi_spin(void* self, void* queue) {
  tell_spin();
  REAL(MULTI, void(void*, void*))(self, queue);
}

#define SHUTDOWN "_ZN3ros15waitForShutdownEv"
HOOK void preflight_wait_for_shutdown() __asm__(SHUTDOWN);
HOOK void preflight_wait_for_shutdown() {
  tell_spin();
  REAL(SHUTDOWN, void())();
}

#define ASYNC "_ZN3ros12AsyncSpinner5startEv"
HOOK void preflight_async_start(void* self) __asm__(ASYNC);
HOOK void preflight_async_start(void* self) {
  LibraryThreads counted;
  REAL(ASYNC, void(void*))(self);
}

#define TIMER(id, symbol)                                                                                            \
  HOOK Handle id(const NodeHandle* self, int64_t period, void* callback, bool once, bool start) __asm__(symbol);     \
  HOOK Handle id(const NodeHandle* self, int64_t period, void* callback, bool once, bool start) {                    \
    LibraryThreads counted;                                                                                          \
    return REAL(symbol, Handle(const NodeHandle*, int64_t, void*, bool, bool))(self, period, callback, once, start); \
  }
#define CALLBACK(event) "RKN5boost8functionIFvRKNS_" event "EEEEbb"
TIMER(preflight_timer, "_ZNK3ros10NodeHandle11createTimerENS_8DurationE" CALLBACK("10TimerEvent"))
TIMER(preflight_wall_timer, "_ZNK3ros10NodeHandle15createWallTimerENS_12WallDurationE" CALLBACK("14WallTimerEvent"))
TIMER(preflight_steady_timer,
      "_ZNK3ros10NodeHandle17createSteadyTimerENS_12WallDurationE" CALLBACK("16SteadyTimerEvent"))

#define TIMER_OPTIONS(id, symbol)                                         \
  HOOK Handle id(const NodeHandle* self, void* options) __asm__(symbol);  \
  HOOK Handle id(const NodeHandle* self, void* options) {                 \
    LibraryThreads counted;                                               \
    return REAL(symbol, Handle(const NodeHandle*, void*))(self, options); \
  }
TIMER_OPTIONS(preflight_timer_options, "_ZNK3ros10NodeHandle11createTimerERNS_12TimerOptionsE")
TIMER_OPTIONS(preflight_wall_timer_options, "_ZNK3ros10NodeHandle15createWallTimerERNS_16WallTimerOptionsE")
TIMER_OPTIONS(preflight_steady_timer_options, "_ZNK3ros10NodeHandle17createSteadyTimerERNS_18SteadyTimerOptionsE")

#define SPIN_ONCE "_ZN3ros8spinOnceEv"
HOOK void preflight_spin_once() __asm__(SPIN_ONCE);
HOOK void preflight_spin_once() {
  tell_turn(__builtin_return_address(0), -1);
  REAL(SPIN_ONCE, void())();
}

#define RATE(id, simulated, symbol)             \
  HOOK bool id(void* self) __asm__(symbol);     \
  HOOK bool id(void* self) {                    \
    tell_turn(__builtin_return_address(0), -1); \
    if (simulated) give_time();                 \
    Depth nested;                               \
    return REAL(symbol, bool(void*))(self);     \
  }
RATE(preflight_rate, true, "_ZN3ros4Rate5sleepEv")
RATE(preflight_wall_rate, false, "_ZN3ros8WallRate5sleepEv")

#define SLEEP(id, simulated, symbol)                                                            \
  HOOK bool id(const int32_t* duration) __asm__(symbol);                                        \
  HOOK bool id(const int32_t* duration) {                                                       \
    tell_turn(__builtin_return_address(0), duration[0] > 0 ? duration[0] : duration[1] * 1e-9); \
    if (simulated) give_time();                                                                 \
    Depth nested;                                                                               \
    return REAL(symbol, bool(const int32_t*))(duration);                                        \
  }
SLEEP(preflight_duration, true, "_ZNK3ros8Duration5sleepEv")
SLEEP(preflight_wall_duration, false, "_ZNK3ros12WallDuration5sleepEv")

#define TIME_VALID "_ZN3ros4Time12waitForValidEv"
HOOK bool preflight_wait_for_time() __asm__(TIME_VALID);
HOOK bool preflight_wait_for_time() {
  give_time();
  return REAL(TIME_VALID, bool())();
}

#define TIME_VALID_FOR "_ZN3ros4Time12waitForValidERKNS_12WallDurationE"
HOOK bool preflight_wait_for_time_for(const void* timeout) __asm__(TIME_VALID_FOR);
HOOK bool preflight_wait_for_time_for(const void* timeout) {
  give_time();
  return REAL(TIME_VALID_FOR, bool(const void*))(timeout);
}

#define SLEEP_UNTIL "_ZN3ros4Time10sleepUntilERKS0_"
HOOK bool preflight_sleep_until(const void* end) __asm__(SLEEP_UNTIL);
HOOK bool preflight_sleep_until(const void* end) {
  give_time();
  return REAL(SLEEP_UNTIL, bool(const void*))(end);
}

// What the node publishes.

#define PUBLISH "_ZNK3ros9Publisher7publishERKN5boost8functionIFNS_17SerializedMessageEvEEERS3_"
HOOK void preflight_publish(const void* self, const Serializer& message, void* serialized) __asm__(PUBLISH);
HOOK void preflight_publish(const void* self, const Serializer& message, void* serialized) {
  if (in_main_thread()) ++published;
  if (looks_at_messages) quietly([&] { look_at(self, message); });
  REAL(PUBLISH, void(const void*, const Serializer&, void*))(self, message, serialized);
}

// Waits. A ros::Duration by value is two integers in one register; how long the node would wait does not matter.

#define WAIT_DURATION "_ZN3ros7service14waitForServiceE" STRING "NS_8DurationE"
HOOK bool preflight_wait_for_service(const std::string& name, int64_t timeout) __asm__(WAIT_DURATION);
HOOK bool preflight_wait_for_service(const std::string& name, int64_t timeout) {
  if (depth == 0) return wait_briefly(name, given_to_process(name));
  return REAL(WAIT_DURATION, bool(const std::string&, int64_t))(name, timeout);
}

HOOK bool preflight_wait_for_service_ms(const std::string& name, int timeout) __asm__(WAIT_INT);
HOOK bool preflight_wait_for_service_ms(const std::string& name, int timeout) {
  if (depth == 0) return wait_briefly(name, given_to_process(name));
  return REAL(WAIT_INT, bool(const std::string&, int))(name, timeout);
}

#define EXISTENCE "_ZN3ros13ServiceClient16waitForExistenceENS_8DurationE"
HOOK bool preflight_wait_for_existence(void* self, int64_t timeout) __asm__(EXISTENCE);
HOOK bool preflight_wait_for_existence(void* self, int64_t timeout) {
  std::string name;
  quietly([&] { name = name_of_client(self); });
  if (depth == 0 && !name.empty()) return wait_briefly(name, name);
  return REAL(EXISTENCE, bool(void*, int64_t))(self, timeout);
}

#define MESSAGE \
  "_ZN3ros5topic18waitForMessageImplERNS_16SubscribeOptionsERKN5boost8functionIFbvEEERNS_10NodeHandleENS_8DurationE"
HOOK void preflight_wait_for_message(TopicOptions& options, void* ready, NodeHandle* handle,
                                     int64_t timeout) __asm__(MESSAGE);
HOOK void preflight_wait_for_message(TopicOptions& options, void* ready, NodeHandle* handle, int64_t timeout) {
  auto* wait = REAL(MESSAGE, void(TopicOptions&, void*, NodeHandle*, int64_t));
  Names names;
  quietly([&] { names = names_of(handle, options.topic); });
  if (depth > 0 || names.resolved.empty()) {
    wait(options, ready, handle, timeout);
    return;
  }
  give_time();
  Wait waiting("message", names.given);
  std::string topic = options.topic;  // the library resolves it in its place
  double most = grace() * 1e-3, began = now();
  auto seconds = static_cast<int32_t>(timeout), nanoseconds = static_cast<int32_t>(timeout >> 32);
  bool shorter = (seconds == 0 && nanoseconds == 0) || seconds > 0 || nanoseconds > most * 1e9;
  // It may listen already, and have had all that was sent.
  if (was_fed(names.resolved)) quietly([&] { ask_for_message(names.resolved); });
  wait(options, ready, handle, shorter ? static_cast<int64_t>(most * 1e9) << 32 : timeout);
  // It ends early with a message, and when the node is shut down.
  if (now() - began < 0.9 * most) return;
  quietly([&] {
    tell_answered("message", names.given);
    ask_for_message(names.resolved);
    options.topic = topic;
  });
  wait(options, ready, handle, 0);
}

// Once a wait was answered, or the same call was refused, the call of a service that nobody offers is answered: with
// zeros, which are a response of any type, after a first byte that makes its first field true or small.
#define CALL "_ZN3ros13ServiceClient4callERKNS_17SerializedMessageERS1_" STRING
HOOK bool preflight_call(void* self, const void* request, Serialized& response, const std::string& md5) __asm__(CALL);
HOOK bool preflight_call(void* self, const void* request, Serialized& response, const std::string& md5) {
  if (REAL(CALL, bool(void*, const void*, Serialized&, const std::string&))(self, request, response, md5)) return true;
  bool made_up = false;
  void* place = __builtin_return_address(0);
  quietly([&] {
    std::string name = name_of_client(self);
    if (!waited && !told_of(name) && !asks_again(name, place)) return;
    static const unsigned char zeros[65536] = {1};
    auto* exists = REAL_IF_ANY("_ZN3ros13ServiceClient6existsEv", bool(void*));
    if (exists == nullptr || exists(self) || response.buffer != nullptr) return;
    // The library takes `start - buffer` off the size; the buffer stays nobody's, so that nothing is freed.
    response.start = zeros;
    response.size = sizeof zeros + reinterpret_cast<size_t>(zeros);
    made_up = true;
    tell_answered(waited ? "call" : "calls", name);
  });
  return made_up;
}

// Whether a service is there, which nobody says it is: for who asks again it is.
bool polled_service(const std::string& name, void* place) {
  bool again = false;
  quietly([&] {
    again = asks_again(name, place);
    if (!again) return;
    tell_answered("services", name);
    std::lock_guard<std::mutex> locked(lacks_mutex);
    lacks().there.insert(names_of(name).resolved);
  });
  return again;
}

#define EXISTS "_ZN3ros13ServiceClient6existsEv"
HOOK bool preflight_client_exists(void* self) __asm__(EXISTS);
HOOK bool preflight_client_exists(void* self) {
  if (REAL(EXISTS, bool(void*))(self)) return true;
  return depth == 0 && !from_roscpp(__builtin_return_address(0)) &&
         polled_service(name_of_client(self), __builtin_return_address(0));
}

#define SERVICE_EXISTS "_ZN3ros7service6existsE" STRING "b"
HOOK bool preflight_service_exists(const std::string& name, bool print) __asm__(SERVICE_EXISTS);
HOOK bool preflight_service_exists(const std::string& name, bool print) {
  if (REAL(SERVICE_EXISTS, bool(const std::string&, bool))(name, print)) return true;
  return depth == 0 && !from_roscpp(__builtin_return_address(0)) && polled_service(name, __builtin_return_address(0));
}

// Transforms, with a fixed frame between two times or without. tf asks tf2_ros for them.

#define FRAME_PAIR "KNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"
#define CAN_WAIT "_ZNK7tf2_ros6Buffer12canTransformER" FRAME_PAIR "S8_RKN3ros4TimeENS9_8DurationEPS6_"
HOOK bool preflight_can_wait(const void* self, const std::string& target, const std::string& source, const void* time,
                             int64_t timeout, void* error) __asm__(CAN_WAIT);
HOOK bool preflight_can_wait(const void* self, const std::string& target, const std::string& source, const void* time,
                             int64_t timeout, void* error) {
  auto* can = REAL(CAN_WAIT, bool(const void*, const std::string&, const std::string&, const void*, int64_t, void*));
  if (depth > 0) return can(self, target, source, time, timeout, error);
  return wait_for_transform(self, target, source, timeout, __builtin_return_address(0), [&](int64_t longest) {
    Depth nested;
    return can(self, target, source, time, longest, error);
  });
}

#define CAN_WAIT_FIXED "_ZNK7tf2_ros6Buffer12canTransformER" FRAME_PAIR "RKN3ros4TimeES8_SC_S8_NS9_8DurationEPS6_"
HOOK bool preflight_can_wait_fixed(const void* self, const std::string& target, const void* target_time,
                                   const std::string& source, const void* source_time, const std::string& fixed,
                                   int64_t timeout, void* error) __asm__(CAN_WAIT_FIXED);
HOOK bool preflight_can_wait_fixed(const void* self, const std::string& target, const void* target_time,
                                   const std::string& source, const void* source_time, const std::string& fixed,
                                   int64_t timeout, void* error) {
  auto* can = REAL(CAN_WAIT_FIXED, bool(const void*, const std::string&, const void*, const std::string&, const void*,
                                        const std::string&, int64_t, void*));
  if (depth > 0) return can(self, target, target_time, source, source_time, fixed, timeout, error);
  // From the source through the fixed frame to the target.
  auto ask = [&](int64_t longest) {
    Depth nested;
    return can(self, target, target_time, source, source_time, fixed, longest, error);
  };
  void* place = __builtin_return_address(0);
  if (!wait_for_transform(self, fixed, source, timeout, place, ask)) return false;
  return ask(0) || wait_for_transform(self, target, fixed, timeout, place, ask);
}

#define CAN "_ZNK3tf210BufferCore12canTransformER" FRAME_PAIR "S8_RKN3ros4TimeEPS6_"
HOOK bool preflight_can(const void* self, const std::string& target, const std::string& source, const void* time,
                        void* error) __asm__(CAN);
HOOK bool preflight_can(const void* self, const std::string& target, const std::string& source, const void* time,
                        void* error) {
  auto* can = REAL(CAN, bool(const void*, const std::string&, const std::string&, const void*, void*));
  if (can(self, target, source, time, error)) return true;
  return depth == 0 && polled_transform(self, target, source, __builtin_return_address(0));
}

#define LOOK_UP "_ZNK3tf210BufferCore15lookupTransformER" FRAME_PAIR "S8_RKN3ros4TimeE"
HOOK Transform preflight_look_up(const void* self, const std::string& target, const std::string& source,
                                 const void* time) __asm__(LOOK_UP);
HOOK Transform preflight_look_up(const void* self, const std::string& target, const std::string& source,
                                 const void* time) {
  auto* look_up = REAL(LOOK_UP, Transform(const void*, const std::string&, const std::string&, const void*));
  try {
    return look_up(self, target, source, time);
  } catch (...) {
    if (depth > 0 || !polled_transform(self, target, source, __builtin_return_address(0))) throw;
  }
  return look_up(self, target, source, time);
}

// actionlib's clients. Which action one waits for, its result topic tells.

#define MONITOR(id, symbol)                                                                    \
  HOOK void id(void* self, void* feedback, void* result) __asm__(symbol);                      \
  HOOK void id(void* self, void* feedback, void* result) {                                     \
    REAL(symbol, void(void*, void*, void*))(self, feedback, result);                           \
    quietly([&] {                                                                              \
      auto* topic = REAL_IF_ANY("_ZNK3ros10Subscriber8getTopicB5cxx11Ev", std::string(void*)); \
      std::string name = topic == nullptr ? "" : topic(result);                                \
      std::lock_guard<std::mutex> locked(monitors_mutex);                                      \
      monitors()[self] = name.substr(0, name.rfind('/'));                                      \
    });                                                                                        \
  }
MONITOR(preflight_monitor, "_ZN9actionlib17ConnectionMonitorC1ERN3ros10SubscriberES3_")

#define ACTION "_ZN9actionlib17ConnectionMonitor26waitForActionServerToStartERKN3ros8DurationERKNS1_10NodeHandleE"
HOOK bool preflight_wait_for_action(void* self, const int32_t* timeout, NodeHandle* handle) __asm__(ACTION);
HOOK bool preflight_wait_for_action(void* self, const int32_t* timeout, NodeHandle* handle) {
  auto* wait = REAL(ACTION, bool(void*, const int32_t*, NodeHandle*));
  std::string name;
  quietly([&] {
    std::lock_guard<std::mutex> locked(monitors_mutex);
    name = monitors()[self];
  });
  if (name.empty()) return wait(self, timeout, handle);
  Wait waiting("action", name);
  const int32_t shorter[2] = {0, grace() * 1000000};
  if (wait(self, shorter, handle)) return true;
  quietly([&] {
    tell_answered("action", name);
    std::lock_guard<std::mutex> locked(monitors_mutex);
    answered_actions().insert(name);
    looks_at_messages = true;
  });
  return true;
}
