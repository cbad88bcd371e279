// Preloaded into roscpp nodes: tells endpoints, parameter calls and the way into the event loop, in the events of
// channel.py, and passes every call on as it came.
//
// No ROS header is needed, so that one source serves every ROS 1 distribution: the functions are intercepted by their
// mangled names, of the objects only the first fields of the option structs are read (their order has not changed since
// Indigo), handles that are returned by value are opaque.
#include <sys/socket.h>

#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "preload.hpp"

#define STRING "RKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"

namespace preflight {

// XML-RPC, polling of sockets, the internal callback queue, and the publisher of /rosout.
constexpr int kLibraryThreads = 4;
std::atomic<int> library_threads{kLibraryThreads};

bool is_watched(const char* library) { return starts_with(library, "libros") || starts_with(library, "libtf2"); }

struct NodeHandle {
  std::string name_space;  // resolved
  std::string given_name_space;
};

// What returns by value (Publisher, Subscriber, ServiceServer, ServiceClient, Timer) is a boost::shared_ptr inside.
// A copy constructor and destructor of its own make it be returned through a hidden pointer, as the real ones are.
struct Handle {
  Handle(const Handle& other) { memcpy(parts, other.parts, sizeof parts); }
  ~Handle() {}  // NOLINT(modernize-use-equals-default): that one would be trivial
  void* parts[2];
};

// ros::AdvertiseOptions and ros::SubscribeOptions begin alike.
struct TopicOptions {
  std::string topic;
  uint32_t queue_size;
  std::string md5;
  std::string type;
};

struct ServiceOptions {
  std::string service;
  std::string md5;
  std::string type;
};

// ros::SerializedMessage.
struct Serialized {
  void* buffer;
  void* buffer_count;
  size_t size;
  const unsigned char* start;
  void* message[2];
  const void* type;
};

// boost::function<ros::SerializedMessage()>. The lowest bit of the table's address is a flag.
struct Serializer {
  struct Table {
    void* manager;
    Serialized (*invoke)(const void* function);
  };
  uintptr_t table;
  void* function;

  // The message; its memory is never freed.
  std::string operator()() const {
    const auto* found = reinterpret_cast<const Table*>(table & ~uintptr_t{1});  // NOLINT(performance-no-int-to-ptr)
    if (found == nullptr) return "";
    Serialized made = found->invoke(&function);
    // Its length, of four bytes, stands before it.
    if (made.start == nullptr || made.size < 4) return "";
    return std::string(reinterpret_cast<const char*>(made.start), made.size - 4);
  }
};

// geometry_msgs::TransformStamped.
struct Transform {
  uint32_t sequence = 0, seconds = 0, nanoseconds = 0;
  std::string frame, child;
  double translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1};
};

struct ClientOptions {
  std::string service;
  std::string md5;
};

// After the three callbacks (boost::function, 32 bytes each), the tracked object and the queue.
constexpr size_t kLatchOffset = 224;
// The first of the callbacks, told of subscribers: a boost::function begins with a pointer, null where there is none.
constexpr size_t kConnectOffset = 136;

// Counts the threads that a library call starts as the library's, those of a call within it once.
class LibraryThreads {
 public:
  LibraryThreads() : outermost_(depth == 0) {
    quietly([this] { before_ = threads_now(); });
    ++depth;
  }
  ~LibraryThreads() {
    --depth;
    quietly([this] {
      int more = threads_now() - before_;
      if (outermost_ && more > 0) library_threads += more;
    });
  }

 private:
  bool outermost_;
  int before_ = 0;
};

std::string below(const std::string& space) { return space.empty() || space.back() != '/' ? space + "/" : space; }

// A name that was resolved through a handle, as the node could have given it to its default handle.
std::string as_given(const NodeHandle* handle, const std::string& name, const std::string& full) {
  auto* node_name = REAL_IF_ANY("_ZN3ros9this_node7getNameB5cxx11Ev", const std::string&());
  auto* node_space = REAL_IF_ANY("_ZN3ros9this_node12getNamespaceB5cxx11Ev", const std::string&());
  if (node_name == nullptr || node_space == nullptr || (!name.empty() && name[0] == '/')) return full;
  std::string own = below(node_name()), space = below(node_space());
  if (starts_with(full, own)) return "~" + full.substr(own.size());
  if (!handle->given_name_space.empty() && handle->given_name_space[0] == '/') return full;
  return starts_with(full, space) ? full.substr(space.size()) : full;
}

struct Names {
  std::string given;
  std::string resolved;
};

// Of `name`, `namespace` and `remaps`, each once: nodes resolve names in their loops.
void tell_asked(const char* what) {
  static std::atomic<unsigned> asked{0};
  unsigned bit = 1;
  if (what[0] == 'n') bit = what[4] == 0 ? 2 : 4;
  if ((asked.fetch_or(bit) & bit) == 0) Event("asked").add("what", std::string(what)).send();
}

Names names_of(const NodeHandle* handle, const std::string& name) {
  // The namespace of a handle may have been remapped, or made of the node's own; `~` is resolved at once.
  auto* own = REAL_IF_ANY("_ZN3ros9this_node7getNameB5cxx11Ev", const std::string&());
  if (!handle->given_name_space.empty() && (own == nullptr || handle->given_name_space != own())) {
    tell_asked("name");
    tell_asked("remaps");
  }
  auto* resolve = REAL_IF_ANY("_ZNK3ros10NodeHandle11resolveNameE" STRING "b",
                              std::string(const NodeHandle*, const std::string&, bool));
  if (resolve == nullptr) return {name, ""};
  return {as_given(handle, name, resolve(handle, name, false)), resolve(handle, name, true)};
}

Names names_of(const std::string& name) {
  auto* resolve = REAL_IF_ANY("_ZN3ros5names7resolveE" STRING "b", std::string(const std::string&, bool));
  return {name, resolve == nullptr ? "" : resolve(name, true)};
}

std::atomic<double> last_new{0};  // when an endpoint was made or a parameter asked for the first time

Event endpoint(const char* role, const Names& names, const std::string& md5) {
  last_new = now();
  Event event("endpoint");
  event.add("role", std::string(role)).add("name", names.given).add("md5", md5);
  if (!names.resolved.empty()) event.add("resolved", names.resolved);
  event.add("speculative", answered || answered_here);
  return event;
}

void tell_topic(const char* role, const NodeHandle* handle, const TopicOptions& options) {
  quietly([&] {
    Event event = endpoint(role, names_of(handle, options.topic), options.md5);
    std::string qos = "{\"queue_size\":" + std::to_string(options.queue_size);
    if (role[0] == 'p') {
      bool latch = reinterpret_cast<const unsigned char*>(&options)[kLatchOffset] == 1;
      qos += std::string(",\"latch\":") + (latch ? "true" : "false");
      void* told_of_subscribers;
      memcpy(&told_of_subscribers, reinterpret_cast<const char*>(&options) + kConnectOffset,
             sizeof told_of_subscribers);
      event.add("awaits", told_of_subscribers != nullptr);
    }
    event.add("type", options.type).raw("qos", qos + "}").send();
  });
}

// Whether roscpp itself called, from the code at `place`.
bool from_roscpp(void* place) {
  Dl_info info;
  return dladdr(place, &info) != 0 && info.dli_fname != nullptr && strstr(info.dli_fname, "/libroscpp.so") != nullptr;
}

// The node, or a library of its, asks for its own name, namespace or remaps: what it does may depend on them.

void asks(const char* what, void* place) {
  if (depth == 0 && !from_roscpp(place)) quietly([&] { tell_asked(what); });
}

#define ASKS(id, symbol, what)               \
  HOOK const void* id() __asm__(symbol);     \
  HOOK const void* id() {                    \
    asks(what, __builtin_return_address(0)); \
    return REAL(symbol, const void*())();    \
  }
ASKS(preflight_get_name, "_ZN3ros9this_node7getNameB5cxx11Ev", "name")
ASKS(preflight_get_namespace, "_ZN3ros9this_node12getNamespaceB5cxx11Ev", "namespace")
ASKS(preflight_get_remappings, "_ZN3ros5names13getRemappingsB5cxx11Ev", "remaps")
ASKS(preflight_get_unresolved, "_ZN3ros5names23getUnresolvedRemappingsB5cxx11Ev", "remaps")

#define RESOLVES(id, symbol, parameters, ...)                 \
  HOOK std::string id parameters __asm__(symbol);             \
  HOOK std::string id parameters {                            \
    asks("name", __builtin_return_address(0));                \
    asks("remaps", __builtin_return_address(0));              \
    return REAL(symbol, std::string parameters)(__VA_ARGS__); \
  }
RESOLVES(preflight_remap, "_ZN3ros5names5remapE" STRING, (const std::string& name), name)
RESOLVES(preflight_resolve, "_ZN3ros5names7resolveE" STRING "b", (const std::string& name, bool remap), name, remap)
RESOLVES(preflight_resolve_in, "_ZN3ros5names7resolveE" STRING "S8_b",
         (const std::string& space, const std::string& name, bool remap), space, name, remap)
RESOLVES(preflight_resolve_name, "_ZNK3ros10NodeHandle11resolveNameE" STRING "b",
         (const NodeHandle* self, const std::string& name, bool remap), self, name, remap)

std::atomic<bool> waited{false};  // for sure, where a loop may be the node's work

void tell_answered(const char* kind, const std::string& name) {
  for (const char* sure : {"service", "message", "action", "transform"}) waited = waited || strcmp(kind, sure) == 0;
  answered_here = true;
  if (in_main_thread()) answered = true;
  Event("answered").add("kind", std::string(kind)).add("name", name).send();
}

// What the node lacks while its main thread goes round in a loop (polling.py does the same for rospy).
std::mutex lacks_mutex;
struct Lacks {
  std::set<std::string> topics;  // that it subscribes to, under their final names
  std::set<std::string> fed;
  std::set<std::string> asked;                             // parameters, with the kind of access
  std::map<std::pair<std::string, void*>, double> polled;  // those that were not set, and since when from where
  std::set<std::string> given;
  std::set<std::string> there;                      // services that it was told of, under their final names
  std::set<std::pair<std::string, void*>> refused;  // other questions that were answered with no
};
Lacks& lacks() {
  static auto* all = new Lacks;  // never destroyed: nodes end in any order
  return *all;
}

// What is asked again says nothing new.
bool asked_before(const std::string& question) {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  bool before = !lacks().asked.insert(question).second;
  if (!before) last_new = now();
  return before;
}

void tell_param(const char* access, const Names& names, void* place) {
  if (asked_before(access + names.given + "\n" + names.resolved)) return;
  Event event("param");
  event.add("access", std::string(access)).add("name", names.given);
  if (!names.resolved.empty()) event.add("resolved", names.resolved);
  // Whatever is not there leaves the node's own value: nothing is mandatory in roscpp.
  event.add("optional", true).add("builtin", from_roscpp(place)).send();
}

// Milliseconds.
constexpr int kGrace = 300, kLaterGrace = 100;

int grace() { return answered || answered_here ? kLaterGrace : kGrace; }

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

// Whether the same was asked from the same place before, and the answer was no.
bool asks_again(const std::string& question, void* place) {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  return !lacks().refused.insert({question, place}).second;
}

bool told_of(const std::string& service) {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  return lacks().there.count(service) != 0;
}

void ask_for_food(const std::string& topic, const std::string& goal = "") {
  Event("feed").add("topic", topic).add("goal", goal).send();
}

bool without_time() {
  auto* simulated = REAL_IF_ANY("_ZN3ros4Time9isSimTimeEv", bool());
  auto* valid = REAL_IF_ANY("_ZN3ros4Time7isValidEv", bool());
  return simulated != nullptr && valid != nullptr && simulated() && !valid();
}

std::atomic<bool> time_given{false};

bool needs_time() { return !time_given && without_time(); }

// Simulated time that nobody tells would never begin. Whether it was given now.
bool give_time() {
  bool given = false;
  quietly([&] {
    if (!needs_time() || time_given.exchange(true)) return;
    tell_answered("clock", "/clock");
    ask_for_food("/clock");
    given = true;
  });
  return given;
}

// The topics that nobody publishes.
std::set<std::string> starved() {
  std::set<std::string> found;
  auto* instance = REAL_IF_ANY("_ZN3ros12TopicManager8instanceEv", void* const*());
  auto* publishers = REAL_IF_ANY("_ZN3ros12TopicManager16getNumPublishersE" STRING, size_t(void*, const std::string&));
  if (instance == nullptr || publishers == nullptr) return found;
  std::set<std::string> topics;
  {
    std::lock_guard<std::mutex> locked(lacks_mutex);
    for (const auto& topic : lacks().topics) {
      if (lacks().fed.count(topic) == 0) topics.insert(topic);
    }
  }
  for (const auto& topic : topics) {
    if (publishers(*instance(), topic) == 0) found.insert(topic);
  }
  return found;
}

bool polls_params() {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  for (const auto& each : lacks().polled) {
    if (lacks().given.count(each.first.first) == 0 && now() - each.second < 2 * kGrace * 1e-3) return true;
  }
  return false;
}

void tell_spin() {
  if (depth > 0) return;
  quietly([] {
    static std::atomic<bool> done{false};
    if (!in_main_thread() || done.exchange(true)) return;
    int own = threads_now() - 1 - library_threads;
    Event("state").add("state", std::string("spin")).raw("threads", std::to_string(own > 0 ? own : 0)).send();
  });
}

std::atomic<int> published{0};  // messages of the main thread

// A loop of the main thread, as its sleeps and spinOnce show it. What comes twice from one place stands in a loop; a
// single sleep (`seconds` is not negative) may be a pause before more endpoints are made. A loop that does nothing
// while the node lacks messages may be waiting for them: it gets some.
class Loop {
 public:
  void turn(void* place, double seconds) {
    Place* known = find(place);
    bool again = known != nullptr && known->turns++ > 0;
    double period = 0;
    if (known != nullptr) {
      works_ = works_ || (again && published > known->published);
      known->published = published;
      period = again ? now() - known->at : 0;
      known->at = now();
    }
    if (works_ && starving_told_) {
      starving_told_ = false;
      Event("state").add("state", std::string("busy")).send();
    }
    if (told_looped_ && !starving_told_) return;
    bool starving = !works_ && (polls_params() || needs_time() || !starved().empty());
    if (again && starving && now() - last_new >= kQuiet && feed(period)) return;
    tell(again, seconds, starving);
  }

 private:
  static constexpr double kQuiet = 0.25;
  struct Place {
    void* place;
    int turns, published;
    double at;
  };

  Place* find(void* place) {
    for (int i = 0; i < count_; ++i) {
      if (places_[i].place == place) return &places_[i];
    }
    if (count_ == 64) return nullptr;
    places_[count_] = {place, 0, published, now()};
    return &places_[count_++];
  }

  void tell(bool again, double seconds, bool starving) {
    if (!again && seconds >= 0) {
      Event("state").add("state", std::string("sleep")).raw("seconds", std::to_string(seconds)).send();
    } else if (again ? !told_looped_ || (starving_told_ && !starving) : !told_idle_) {
      (again ? told_looped_ : told_idle_) = true;
      starving_told_ = starving;
      int own = threads_now() - 1 - library_threads;
      Event("state")
          .add("state", std::string(again ? "looped" : "idle"))
          .raw("threads", std::to_string(own > 0 ? own : 0))
          .add("starving", starving)
          .send();
    }
  }

  bool feed(double period) {
    std::set<std::string> topics;
    if (!give_time()) {
      topics = starved();
      if (topics.empty()) return false;
    }
    for (const auto& topic : topics) {
      tell_answered("poll", topic);
      ask_for_food(topic);
    }
    {
      std::lock_guard<std::mutex> locked(lacks_mutex);
      lacks().fed.insert(topics.begin(), topics.end());
    }
    // It may leave the loop now, and has to show another one.
    count_ = 0;
    told_idle_ = told_looped_ = starving_told_ = works_ = false;
    last_new = now();
    // Another turn takes the messages, the next one may go on.
    Event("state").add("state", std::string("fed")).raw("seconds", std::to_string(2.5 * period)).send();
    return true;
  }

  Place places_[64];
  int count_ = 0;
  bool told_idle_ = false, told_looped_ = false, starving_told_ = false, works_ = false;
};

void tell_turn(void* place, double seconds) {
  if (depth > 0) return;
  quietly([&] {
    static Loop loop;
    if (in_main_thread() && !from_roscpp(place)) loop.turn(place, seconds);
  });
}

// From construction to destruction the node waits for somebody else.
class Wait {
 public:
  Wait(const char* kind, const std::string& name) : outermost_(depth == 0) {
    quietly([&] {
      kind_ = kind;
      name_ = name;
      tell("wait");
    });
    ++depth;
  }
  ~Wait() {
    --depth;
    quietly([&] { tell("resume"); });
  }

 private:
  void tell(const char* state) {
    if (!outermost_) return;
    Event("state")
        .add("state", std::string(state))
        .add("kind", kind_)
        .add("name", name_)
        .add("main", in_main_thread())
        .send();
  }

  bool outermost_;
  std::string kind_, name_;
};

#define WAIT_INT "_ZN3ros7service14waitForServiceE" STRING "i"

std::string name_of_client(void* client) {
  auto* service = REAL_IF_ANY("_ZN3ros13ServiceClient10getServiceB5cxx11Ev", std::string(void*));
  return service == nullptr ? "" : service(client);
}

// Waits for a service as long as somebody in the sandbox may need to offer it; then it is said to be there, as for
// rospy (answers.py).
bool wait_briefly(const std::string& name) {
  Wait told("service", name);
  if (REAL(WAIT_INT, bool(const std::string&, int))(name, grace())) return true;
  quietly([&] { tell_answered("service", name); });
  return true;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool is_transforms(const std::string& type) { return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage"; }

// A topic that the node may wait for: not what libraries listen to, nor what has any type.
void remember_subscription(const NodeHandle* handle, const TopicOptions& options) {
  quietly([&] {
    const std::string& type = options.type;
    if (options.md5 == "*" || is_transforms(type) || starts_with(type, "actionlib_msgs/")) return;
    for (const char* part : {"ActionGoal", "ActionFeedback", "ActionResult"}) {
      if (ends_with(type, part)) return;
    }
    std::string name = names_of(handle, options.topic).resolved;
    std::lock_guard<std::mutex> locked(lacks_mutex);
    if (!name.empty()) lacks().topics.insert(name);
  });
}

// Reads a message that was serialized: numbers of the machine's own byte order, strings with their length before them.
class Reader {
 public:
  explicit Reader(const std::string& data) : data_(data) {}

  uint32_t number() {
    uint32_t value = 0;
    if (!skip(sizeof value)) return 0;
    memcpy(&value, data_.data() + at_ - sizeof value, sizeof value);
    return value;
  }

  std::string text() {
    uint32_t size = number();
    return skip(size) ? data_.substr(at_ - size, size) : "";
  }

  bool skip(size_t size) {
    good_ = good_ && size <= data_.size() - at_;
    if (good_) at_ += size;
    return good_;
  }

  bool good() const { return good_; }

 private:
  const std::string& data_;
  size_t at_ = 0;
  bool good_ = true;
};

std::mutex outgoing_mutex;
std::atomic<bool> looks_at_messages{false};
struct Outgoing {
  std::set<std::string> transforms;                      // topics
  std::set<std::pair<std::string, std::string>> frames;  // parents and children that were told
  int looked_at = 0;
};
Outgoing& outgoing() {
  static auto* all = new Outgoing;
  return *all;
}

constexpr int kMaxLookedAt = 2000;

void remember_transforms(const std::string& topic) {
  std::lock_guard<std::mutex> locked(outgoing_mutex);
  outgoing().transforms.insert(topic);
  looks_at_messages = true;
}

void tell_frames(const std::string& topic, const std::string& message) {
  Reader reader(message);
  constexpr size_t kStamp = 12, kTransform = 56;
  for (uint32_t left = reader.number(); left > 0 && reader.good(); --left) {
    reader.skip(kStamp);
    std::string parent = reader.text(), child = reader.text();
    if (!reader.skip(kTransform) || !outgoing().frames.insert({parent, child}).second) continue;
    Event("frame").add("parent", parent).add("child", child).add("static", ends_with(topic, "/tf_static")).send();
  }
}

std::mutex monitors_mutex;
std::map<const void*, std::string>& monitors() {
  static auto* all = new std::map<const void*, std::string>;
  return *all;
}
std::set<std::string>& answered_actions() {
  static auto* all = new std::set<std::string>;
  return *all;
}

// The result of a goal for a server that was made up.
void answer_goal(const std::string& action, const std::string& message) {
  Reader reader(message);
  reader.skip(12);
  reader.text();
  reader.skip(8);
  std::string goal = reader.text();
  if (!reader.good()) return;
  tell_answered("result", action);
  ask_for_food(action + "/result", goal);
}

void look_at(const void* publisher, const Serializer& message) {
  auto* topic_of = REAL_IF_ANY("_ZNK3ros9Publisher8getTopicB5cxx11Ev", std::string(const void*));
  if (topic_of == nullptr) return;
  std::string topic = topic_of(publisher);
  std::string action = ends_with(topic, "/goal") ? topic.substr(0, topic.size() - 5) : "";
  if (!action.empty()) {
    std::lock_guard<std::mutex> locked(monitors_mutex);
    if (answered_actions().count(action) != 0) answer_goal(action, message());
  }
  std::lock_guard<std::mutex> locked(outgoing_mutex);
  if (outgoing().transforms.count(topic) == 0 || outgoing().looked_at++ > kMaxLookedAt) return;
  tell_frames(topic, message());
}

// Transforms. The node's buffer is given the identity, so that whatever it does with it then works.

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
  Wait told("transform", frames(target, source));
  double most = grace() * 1e-3, began = now();
  if (seconds > 0 || nanoseconds > most * 1e9) timeout = static_cast<int64_t>(most * 1e9) << 32;
  if (ask(timeout)) return true;
  // Who listens in no thread of its own is refused at once.
  return now() - began > 0.01 && give_transform("transform", core, target, source);
}

}  // namespace preflight

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
  if (depth == 0) return wait_briefly(name);
  return REAL(WAIT_DURATION, bool(const std::string&, int64_t))(name, timeout);
}

HOOK bool preflight_wait_for_service_ms(const std::string& name, int timeout) __asm__(WAIT_INT);
HOOK bool preflight_wait_for_service_ms(const std::string& name, int timeout) {
  if (depth == 0) return wait_briefly(name);
  return REAL(WAIT_INT, bool(const std::string&, int))(name, timeout);
}

#define EXISTENCE "_ZN3ros13ServiceClient16waitForExistenceENS_8DurationE"
HOOK bool preflight_wait_for_existence(void* self, int64_t timeout) __asm__(EXISTENCE);
HOOK bool preflight_wait_for_existence(void* self, int64_t timeout) {
  std::string name;
  quietly([&] { name = name_of_client(self); });
  if (depth == 0 && !name.empty()) return wait_briefly(name);
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
  Wait told("message", names.given);
  std::string topic = options.topic;  // the library resolves it in its place
  double most = grace() * 1e-3, began = now();
  auto seconds = static_cast<int32_t>(timeout), nanoseconds = static_cast<int32_t>(timeout >> 32);
  bool shorter = (seconds == 0 && nanoseconds == 0) || seconds > 0 || nanoseconds > most * 1e9;
  wait(options, ready, handle, shorter ? static_cast<int64_t>(most * 1e9) << 32 : timeout);
  // It ends early with a message, and when the node is shut down.
  if (now() - began < 0.9 * most) return;
  quietly([&] {
    tell_answered("message", names.given);
    ask_for_food(names.resolved);
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
  Wait told("action", name);
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
