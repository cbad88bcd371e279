// Preloaded into roscpp nodes: tells endpoints, parameter calls and the way into the event loop, in the events of
// channel.py, and passes every call on as it came.
//
// No ROS header is needed, so that one source serves every ROS 1 distribution: the functions are intercepted by their
// mangled names, of the objects only the first fields of the option structs are read (their order has not changed since
// Indigo), handles that are returned by value are opaque. Each hook is `tell, call`; what tells neither throws nor
// changes errno. A function that a library calls within itself is only seen where the library was linked without
// -Bsymbolic-functions; nothing here relies on it.
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdarg.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>

#ifdef PREFLIGHT_PORTABLE
// Since 2.34 these are in glibc itself under a new version, which older ones lack; the old version is still there.
__asm__(".symver dlsym,dlsym@GLIBC_2.2.5");
__asm__(".symver dlopen,dlopen@GLIBC_2.2.5");
__asm__(".symver dlclose,dlclose@GLIBC_2.2.5");
__asm__(".symver dladdr,dladdr@GLIBC_2.2.5");
#endif

#define HOOK extern "C" __attribute__((visibility("default")))
#define STRING "RKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE"

// Named, or the hooks that use its types could not be seen from outside.
namespace preflight {

// A write to a FIFO of at most PIPE_BUF bytes is not torn apart by those of other threads.
constexpr size_t kMaxLine = 4096;
constexpr int kMaxEvents = 5000;
constexpr size_t kMaxName = 300;
// XML-RPC, polling of sockets, the internal callback queue, and the publisher of /rosout.
constexpr int kLibraryThreads = 4;

char fifo[256];
std::atomic<int> told{0};
std::atomic<int> library_threads{kLibraryThreads};
std::atomic<bool> answered{false};           // the main thread, so that whatever comes may be due to it
thread_local bool answered_here = false;
thread_local int depth = 0;  // of hooks: what the library calls on the node's behalf is told once

__attribute__((constructor)) void remember_fifo() {
  const char* path = getenv("PREFLIGHT_EVENTS");
  if (path != nullptr && strlen(path) < sizeof fifo) strcpy(fifo, path);
}

struct Errno {
  int kept = errno;
  ~Errno() { errno = kept; }
};

struct Depth {
  Depth() { ++depth; }
  ~Depth() { --depth; }
};

void write_line(const std::string& line) {
  if (fifo[0] == 0 || line.size() > kMaxLine || told.fetch_add(1) >= kMaxEvents) return;
  // Opened anew each time: the node may close descriptors that it does not know.
  int descriptor = open(fifo, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  while (write(descriptor, line.data(), line.size()) < 0 && errno == EINTR) {
  }
  close(descriptor);
}

// A flat JSON object, by and by.
class Event {
 public:
  explicit Event(const char* kind) : text_("{\"ev\":\"") { text_.append(kind).append("\""); }

  Event& raw(const char* key, const std::string& value) {
    text_.append(",\"").append(key).append("\":").append(value);
    return *this;
  }

  Event& add(const char* key, const std::string& value) {
    std::string quoted = "\"";
    for (unsigned char c : value.substr(0, kMaxName + 1)) {
      char escaped[8];
      if (c < 0x20 || c == '"' || c == '\\') {
        snprintf(escaped, sizeof escaped, "\\u%04x", c);
        quoted.append(escaped);
      } else {
        quoted.push_back(static_cast<char>(c));
      }
    }
    return raw(key, quoted + "\"");
  }

  Event& add(const char* key, bool value) { return raw(key, value ? "true" : "false"); }

  void send() const { write_line(text_ + "}\n"); }

 private:
  std::string text_;
};

// Where libraries were loaded for one user only (plugins), RTLD_NEXT does not find them.
void* in_loaded_library(const char* symbol) {
  struct Search {
    const char* symbol;
    void* found;
  } search{symbol, nullptr};
  dl_iterate_phdr(
      [](dl_phdr_info* info, size_t, void* data) {
        auto* wanted = static_cast<Search*>(data);
        const char* name = strrchr(info->dlpi_name, '/');
        if (name == nullptr || strncmp(name, "/libros", 7) != 0) return 0;
        void* library = dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD);
        if (library == nullptr) return 0;
        wanted->found = dlsym(library, wanted->symbol);
        dlclose(library);
        return wanted->found != nullptr ? 1 : 0;
      },
      &search);
  return search.found;
}

// The library's own function; nullptr only if there is none.
template <typename Function>
Function* real(std::atomic<void*>& known, const char* symbol) {
  void* found = known.load(std::memory_order_acquire);
  if (found == nullptr) {
    Errno kept;
    found = dlsym(RTLD_NEXT, symbol);
    if (found == nullptr) found = in_loaded_library(symbol);
    known.store(found, std::memory_order_release);
  }
  return reinterpret_cast<Function*>(found);
}

// As `real`, for a hook: it is only reached by a program that linked against the function.
template <typename Function>
Function* real_or_die(std::atomic<void*>& known, const char* symbol) {
  auto* function = real<Function>(known, symbol);
  if (function == nullptr) abort();
  return function;
}

#define REAL(symbol, ...)                                                            \
  ([]() {                                                                            \
    static std::atomic<void*> known{nullptr};                                        \
    return real_or_die<__VA_ARGS__>(known, symbol);                                  \
  }())

#define REAL_IF_ANY(symbol, ...)                                                     \
  ([]() {                                                                            \
    static std::atomic<void*> known{nullptr};                                        \
    return real<__VA_ARGS__>(known, symbol);                                         \
  }())

// Runs what tells; whatever goes wrong stays here.
template <typename Tell>
void quietly(Tell tell) noexcept {
  Errno kept;
  Depth nested;
  try {
    static std::atomic<bool> woven{false};
    if (!woven.exchange(true)) Event("woven").send();
    tell();
  } catch (...) {
  }
}

// Files that the node opens to read them, whether they are there or not: what it does depends on them. It may be in a
// child that was forked or in a handler of a signal, so no memory is allocated and no lock taken.

constexpr size_t kMaxFiles = 2048, kMaxProbes = 64, kMaxPath = 1024;
std::atomic<uint64_t> opened[kMaxFiles];

bool first_time(const char* path) {
  uint64_t hash = 14695981039346656037u;
  for (const char* at = path; *at != 0; ++at) hash = (hash ^ static_cast<unsigned char>(*at)) * 1099511628211u;
  hash |= 1;
  for (size_t probe = 0; probe < kMaxProbes; ++probe) {
    uint64_t there = 0;
    if (opened[(hash + probe) % kMaxFiles].compare_exchange_strong(there, hash)) return true;
    if (there == hash) return false;
  }
  return false;
}

void tell_opened(const char* path) noexcept {
  if (fifo[0] == 0 || path == nullptr || path[0] == 0) return;
  Errno kept;
  char full[kMaxPath];
  size_t length = 0;
  if (path[0] != '/') {
    if (getcwd(full, sizeof full) == nullptr || full[0] != '/') return;
    length = strlen(full);
    full[length++] = '/';
  }
  if (length + strlen(path) >= sizeof full) return;
  strcpy(full + length, path);
  for (const char* ours : {"/proc/", "/sys/", "/dev/", "/run/"}) {
    if (strncmp(full, ours, strlen(ours)) == 0) return;
  }
  if (!first_time(full)) return;
  char line[kMaxLine];
  char* end = stpcpy(line, "{\"ev\":\"files\",\"paths\":[\"");
  for (const char* at = full; *at != 0; ++at) {
    if (end > line + sizeof line - 16 || static_cast<unsigned char>(*at) < 0x20) return;
    if (*at == '"' || *at == '\\') *end++ = '\\';
    *end++ = *at;
  }
  end = stpcpy(end, "\"]}\n");
  // Not by the functions that are watched here.
  int descriptor = static_cast<int>(syscall(SYS_openat, AT_FDCWD, fifo, O_WRONLY | O_CLOEXEC));
  if (descriptor < 0) return;
  while (write(descriptor, line, end - line) < 0 && errno == EINTR) {
  }
  close(descriptor);
}

void tell_opened(const char* path, int flags) noexcept {
  if ((flags & O_ACCMODE) == O_RDONLY && (flags & (O_CREAT | O_DIRECTORY)) == 0) tell_opened(path);
}

#define OPEN(id, symbol)                                                             \
  HOOK int id(const char* path, int flags, ...) __asm__(symbol);                     \
  HOOK int id(const char* path, int flags, ...) {                                    \
    va_list rest;                                                                    \
    va_start(rest, flags);                                                           \
    mode_t mode = va_arg(rest, mode_t);                                              \
    va_end(rest);                                                                    \
    tell_opened(path, flags);                                                        \
    return REAL(symbol, int(const char*, int, ...))(path, flags, mode);              \
  }
OPEN(preflight_open, "open")
OPEN(preflight_open64, "open64")

#define OPEN_AT(id, symbol)                                                          \
  HOOK int id(int folder, const char* path, int flags, ...) __asm__(symbol);         \
  HOOK int id(int folder, const char* path, int flags, ...) {                        \
    va_list rest;                                                                    \
    va_start(rest, flags);                                                           \
    mode_t mode = va_arg(rest, mode_t);                                              \
    va_end(rest);                                                                    \
    if (folder == AT_FDCWD || (path != nullptr && path[0] == '/')) tell_opened(path, flags); \
    return REAL(symbol, int(int, const char*, int, ...))(folder, path, flags, mode); \
  }
OPEN_AT(preflight_openat, "openat")
OPEN_AT(preflight_openat64, "openat64")

#define OPEN_2(id, symbol)                                                           \
  HOOK int id(const char* path, int flags) __asm__(symbol);                          \
  HOOK int id(const char* path, int flags) {                                         \
    tell_opened(path, flags);                                                        \
    return REAL(symbol, int(const char*, int))(path, flags);                         \
  }
OPEN_2(preflight_open_2, "__open_2")
OPEN_2(preflight_open64_2, "__open64_2")

#define FOPEN(id, symbol)                                                            \
  HOOK FILE* id(const char* path, const char* mode) __asm__(symbol);                 \
  HOOK FILE* id(const char* path, const char* mode) {                                \
    if (mode != nullptr && mode[0] == 'r' && strchr(mode, '+') == nullptr) tell_opened(path); \
    return REAL(symbol, FILE*(const char*, const char*))(path, mode);                \
  }
FOPEN(preflight_fopen, "fopen")
FOPEN(preflight_fopen64, "fopen64")

struct NodeHandle {
  std::string name_space;  // resolved
  std::string given_name_space;
};

// What returns by value (Publisher, Subscriber, ServiceServer, ServiceClient, Timer) is a boost::shared_ptr inside.
// A copy constructor and destructor of its own make it be returned through a hidden pointer, as the real ones are.
struct Handle {
  Handle(const Handle& other) { memcpy(parts, other.parts, sizeof parts); }
  ~Handle() {}
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
};

struct ClientOptions {
  std::string service;
  std::string md5;
};

// After the three callbacks (boost::function, 32 bytes each), the tracked object and the queue.
constexpr size_t kLatchOffset = 224;

bool in_main_thread() { return syscall(SYS_gettid) == getpid(); }

int threads_now() {
  DIR* tasks = opendir("/proc/self/task");
  if (tasks == nullptr) return 0;
  int count = 0;
  while (dirent* entry = readdir(tasks)) count += entry->d_name[0] != '.';
  closedir(tasks);
  return count;
}

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

bool starts_with(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

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
  const unsigned bit = what[0] == 'r' ? 1 : what[4] == 0 ? 2 : 4;
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
  auto* resolve =
      REAL_IF_ANY("_ZN3ros5names7resolveE" STRING "b", std::string(const std::string&, bool));
  return {name, resolve == nullptr ? "" : resolve(name, true)};
}

Event endpoint(const char* role, const Names& names, const std::string& md5) {
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

#define ASKS(id, symbol, what)                                                       \
  HOOK const void* id() __asm__(symbol);                                             \
  HOOK const void* id() {                                                            \
    asks(what, __builtin_return_address(0));                                         \
    return REAL(symbol, const void*())();                                            \
  }
ASKS(preflight_get_name, "_ZN3ros9this_node7getNameB5cxx11Ev", "name")
ASKS(preflight_get_namespace, "_ZN3ros9this_node12getNamespaceB5cxx11Ev", "namespace")
ASKS(preflight_get_remappings, "_ZN3ros5names13getRemappingsB5cxx11Ev", "remaps")
ASKS(preflight_get_unresolved, "_ZN3ros5names23getUnresolvedRemappingsB5cxx11Ev", "remaps")

#define RESOLVES(id, symbol, parameters, ...)                                        \
  HOOK std::string id parameters __asm__(symbol);                                    \
  HOOK std::string id parameters {                                                   \
    asks("name", __builtin_return_address(0));                                       \
    asks("remaps", __builtin_return_address(0));                                     \
    return REAL(symbol, std::string parameters)(__VA_ARGS__);                        \
  }
RESOLVES(preflight_remap, "_ZN3ros5names5remapE" STRING, (const std::string& name), name)
RESOLVES(preflight_resolve, "_ZN3ros5names7resolveE" STRING "b", (const std::string& name, bool remap), name, remap)
RESOLVES(preflight_resolve_in, "_ZN3ros5names7resolveE" STRING "S8_b",
         (const std::string& space, const std::string& name, bool remap), space, name, remap)
RESOLVES(preflight_resolve_name, "_ZNK3ros10NodeHandle11resolveNameE" STRING "b",
         (const NodeHandle* self, const std::string& name, bool remap), self, name, remap)

void tell_param(const char* access, const Names& names, void* place) {
  Event event("param");
  event.add("access", std::string(access)).add("name", names.given);
  if (!names.resolved.empty()) event.add("resolved", names.resolved);
  // Whatever is not there leaves the node's own value: nothing is mandatory in roscpp.
  event.add("optional", true).add("builtin", from_roscpp(place)).send();
}

void tell_param(const char* access, const NodeHandle* handle, const std::string& key, void* place) {
  if (depth == 0) quietly([&] { tell_param(access, names_of(handle, key), place); });
}

void tell_param(const char* access, const std::string& key, void* place) {
  if (depth == 0) quietly([&] { tell_param(access, names_of(key), place); });
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

// A sleep or spinOnce of the main thread. What comes twice from one place stands in a loop; a single sleep (`seconds`
// is not negative) may be a pause before more endpoints are made.
void tell_turn(void* place, double seconds) {
  if (depth > 0) return;
  quietly([&] {
    static void* places[64];
    static int count = 0;
    static bool looped = false, idle = false;
    if (looped || !in_main_thread() || from_roscpp(place)) return;
    bool again = false;
    for (int i = 0; i < count; ++i) again = again || places[i] == place;
    if (!again && count < 64) places[count++] = place;
    if (!again && seconds >= 0) {
      Event("state").add("state", std::string("sleep")).raw("seconds", std::to_string(seconds)).send();
    } else if (again || !idle) {
      (again ? looped : idle) = true;
      int own = threads_now() - 1 - library_threads;
      Event("state")
          .add("state", std::string(again ? "looped" : "idle"))
          .raw("threads", std::to_string(own > 0 ? own : 0))
          .send();
    }
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

// Milliseconds.
constexpr int kGrace = 300, kLaterGrace = 100;

#define WAIT_INT "_ZN3ros7service14waitForServiceE" STRING "i"

std::string name_of_client(void* client) {
  auto* service = REAL_IF_ANY("_ZN3ros13ServiceClient10getServiceB5cxx11Ev", std::string(void*));
  return service == nullptr ? "" : service(client);
}

void tell_answered(const char* kind, const std::string& name) {
  answered_here = true;
  if (in_main_thread()) answered = true;
  Event("answered").add("kind", std::string(kind)).add("name", name).send();
}

// Waits for a service as long as somebody in the sandbox may need to offer it; then it is said to be there, as for rospy
// (answers.py).
bool wait_briefly(const std::string& name) {
  Wait told("service", name);
  int grace = answered || answered_here ? kLaterGrace : kGrace;
  if (REAL(WAIT_INT, bool(const std::string&, int))(name, grace)) return true;
  quietly([&] { tell_answered("service", name); });
  return true;
}

}  // namespace preflight

using namespace preflight;

// Endpoints. The library writes the resolved name into the options, so it is told before.

#define ADVERTISE "_ZN3ros10NodeHandle9advertiseERNS_16AdvertiseOptionsE"
HOOK Handle preflight_advertise(NodeHandle* self, TopicOptions& options) __asm__(ADVERTISE);
HOOK Handle preflight_advertise(NodeHandle* self, TopicOptions& options) {
  tell_topic("publisher", self, options);
  return REAL(ADVERTISE, Handle(NodeHandle*, TopicOptions&))(self, options);
}

#define SUBSCRIBE "_ZN3ros10NodeHandle9subscribeERNS_16SubscribeOptionsE"
HOOK Handle preflight_subscribe(NodeHandle* self, TopicOptions& options) __asm__(SUBSCRIBE);
HOOK Handle preflight_subscribe(NodeHandle* self, TopicOptions& options) {
  tell_topic("subscriber", self, options);
  return REAL(SUBSCRIBE, Handle(NodeHandle*, TopicOptions&))(self, options);
}

#define SERVICE "_ZN3ros10NodeHandle16advertiseServiceERNS_23AdvertiseServiceOptionsE"
HOOK Handle preflight_advertise_service(NodeHandle* self, ServiceOptions& options) __asm__(SERVICE);
HOOK Handle preflight_advertise_service(NodeHandle* self, ServiceOptions& options) {
  quietly([&] {
    endpoint("service", names_of(self, options.service), options.md5).add("type", options.type).send();
  });
  return REAL(SERVICE, Handle(NodeHandle*, ServiceOptions&))(self, options);
}

#define CLIENT "_ZN3ros10NodeHandle13serviceClientERNS_20ServiceClientOptionsE"
HOOK Handle preflight_service_client(NodeHandle* self, ClientOptions& options) __asm__(CLIENT);
HOOK Handle preflight_service_client(NodeHandle* self, ClientOptions& options) {
  quietly([&] { endpoint("client", names_of(self, options.service), options.md5).send(); });
  return REAL(CLIENT, Handle(NodeHandle*, ClientOptions&))(self, options);
}

// Parameters. Sets and deletes are told by the master.

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

#define METHOD_(id, access, symbol)                                                                          \
  HOOK bool id(const NodeHandle* self, const std::string& key, void* value) __asm__(symbol);                 \
  HOOK bool id(const NodeHandle* self, const std::string& key, void* value) {                                \
    tell_param(access, self, key, __builtin_return_address(0));                                                                           \
    Depth nested;                                                                                            \
    return REAL(symbol, bool(const NodeHandle*, const std::string&, void*))(self, key, value);               \
  }
#define METHOD(access, symbol) METHOD_(JOIN(preflight_method_, __COUNTER__), access, symbol)

#define FUNCTION_(id, access, symbol)                                                                        \
  HOOK bool id(const std::string& key, void* value) __asm__(symbol);                                         \
  HOOK bool id(const std::string& key, void* value) {                                                        \
    tell_param(access, key, __builtin_return_address(0));                                                                                 \
    Depth nested;                                                                                            \
    return REAL(symbol, bool(const std::string&, void*))(key, value);                                        \
  }
#define FUNCTION(access, symbol) FUNCTION_(JOIN(preflight_function_, __COUNTER__), access, symbol)

#define MAP_OF(type) "RSt3mapIS6_" type "St4lessIS6_ESaISt4pairIS7_" type "EEE"
#define EACH_TYPE(hook, start)        \
  hook("get", start "RN6XmlRpc11XmlRpcValueE") \
  hook("get", start "RS6_")           \
  hook("get", start "Rb")             \
  hook("get", start "Rd")             \
  hook("get", start "Rf")             \
  hook("get", start "Ri")             \
  hook("get", start "RSt6vectorIS6_SaIS6_EE") \
  hook("get", start "RSt6vectorIbSaIbEE") \
  hook("get", start "RSt6vectorIdSaIdEE") \
  hook("get", start "RSt6vectorIfSaIfEE") \
  hook("get", start "RSt6vectorIiSaIiEE") \
  hook("get", start MAP_OF("S6_"))    \
  hook("get", start MAP_OF("b"))      \
  hook("get", start MAP_OF("d"))      \
  hook("get", start MAP_OF("f"))      \
  hook("get", start MAP_OF("i"))

EACH_TYPE(METHOD, "_ZNK3ros10NodeHandle8getParamE" STRING)
EACH_TYPE(METHOD, "_ZNK3ros10NodeHandle14getParamCachedE" STRING)
EACH_TYPE(FUNCTION, "_ZN3ros5param3getE" STRING)
EACH_TYPE(FUNCTION, "_ZN3ros5param9getCachedE" STRING)
METHOD("has", "_ZNK3ros10NodeHandle8hasParamE" STRING)
FUNCTION("has", "_ZN3ros5param3hasE" STRING)

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

#define TIMER(id, symbol)                                                                                         \
  HOOK Handle id(const NodeHandle* self, int64_t period, void* callback, bool once, bool start) __asm__(symbol);  \
  HOOK Handle id(const NodeHandle* self, int64_t period, void* callback, bool once, bool start) {                 \
    LibraryThreads counted;                                                                                       \
    return REAL(symbol, Handle(const NodeHandle*, int64_t, void*, bool, bool))(self, period, callback, once, start); \
  }
#define CALLBACK(event) "RKN5boost8functionIFvRKNS_" event "EEEEbb"
TIMER(preflight_timer, "_ZNK3ros10NodeHandle11createTimerENS_8DurationE" CALLBACK("10TimerEvent"))
TIMER(preflight_wall_timer, "_ZNK3ros10NodeHandle15createWallTimerENS_12WallDurationE" CALLBACK("14WallTimerEvent"))
TIMER(preflight_steady_timer, "_ZNK3ros10NodeHandle17createSteadyTimerENS_12WallDurationE" CALLBACK("16SteadyTimerEvent"))

#define TIMER_OPTIONS(id, symbol)                                            \
  HOOK Handle id(const NodeHandle* self, void* options) __asm__(symbol);     \
  HOOK Handle id(const NodeHandle* self, void* options) {                    \
    LibraryThreads counted;                                                  \
    return REAL(symbol, Handle(const NodeHandle*, void*))(self, options);    \
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

#define RATE(id, symbol)                             \
  HOOK bool id(void* self) __asm__(symbol);          \
  HOOK bool id(void* self) {                         \
    tell_turn(__builtin_return_address(0), -1);      \
    Depth nested;                                    \
    return REAL(symbol, bool(void*))(self);          \
  }
RATE(preflight_rate, "_ZN3ros4Rate5sleepEv")
RATE(preflight_wall_rate, "_ZN3ros8WallRate5sleepEv")

#define SLEEP(id, symbol)                                                                     \
  HOOK bool id(const int32_t* duration) __asm__(symbol);                                      \
  HOOK bool id(const int32_t* duration) {                                                     \
    tell_turn(__builtin_return_address(0), duration[0] > 0 ? duration[0] : duration[1] * 1e-9); \
    Depth nested;                                                                             \
    return REAL(symbol, bool(const int32_t*))(duration);                                      \
  }
SLEEP(preflight_duration, "_ZNK3ros8Duration5sleepEv")
SLEEP(preflight_wall_duration, "_ZNK3ros12WallDuration5sleepEv")

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
HOOK void preflight_wait_for_message(TopicOptions& options, void* ready, NodeHandle* handle, int64_t timeout)
    __asm__(MESSAGE);
HOOK void preflight_wait_for_message(TopicOptions& options, void* ready, NodeHandle* handle, int64_t timeout) {
  std::string name;
  quietly([&] { name = names_of(handle, options.topic).given; });
  Wait told("message", name);
  REAL(MESSAGE, void(TopicOptions&, void*, NodeHandle*, int64_t))(options, ready, handle, timeout);
}

// Once a wait was answered, so is the call of a service that nobody offers: with zeros, which are a response of any type,
// after a first byte that makes its first field true or small.
#define CALL "_ZN3ros13ServiceClient4callERKNS_17SerializedMessageERS1_" STRING
HOOK bool preflight_call(void* self, const void* request, Serialized& response, const std::string& md5) __asm__(CALL);
HOOK bool preflight_call(void* self, const void* request, Serialized& response, const std::string& md5) {
  if (REAL(CALL, bool(void*, const void*, Serialized&, const std::string&))(self, request, response, md5)) return true;
  bool made_up = false;
  if (!answered && !answered_here) return false;
  quietly([&] {
    static const unsigned char zeros[65536] = {1};
    auto* exists = REAL_IF_ANY("_ZN3ros13ServiceClient6existsEv", bool(void*));
    if (exists == nullptr || exists(self) || response.buffer != nullptr) return;
    // The library takes `start - buffer` off the size; the buffer stays nobody's, so that nothing is freed.
    response.start = zeros;
    response.size = sizeof zeros + reinterpret_cast<size_t>(zeros);
    made_up = true;
    tell_answered("call", name_of_client(self));
  });
  return made_up;
}

// actionlib's clients. Which action one waits for, its result topic tells.

std::mutex monitors_mutex;
std::map<const void*, std::string>& monitors() {
  static auto* all = new std::map<const void*, std::string>;  // never destroyed: nodes end in any order
  return *all;
}

#define MONITOR(id, symbol)                                                          \
  HOOK void id(void* self, void* feedback, void* result) __asm__(symbol);            \
  HOOK void id(void* self, void* feedback, void* result) {                           \
    REAL(symbol, void(void*, void*, void*))(self, feedback, result);                 \
    quietly([&] {                                                                    \
      auto* topic = REAL_IF_ANY("_ZNK3ros10Subscriber8getTopicB5cxx11Ev", std::string(void*)); \
      std::string name = topic == nullptr ? "" : topic(result);                      \
      std::lock_guard<std::mutex> locked(monitors_mutex);                            \
      monitors()[self] = name.substr(0, name.rfind('/'));                            \
    });                                                                              \
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
  const int32_t grace[2] = {0, (answered || answered_here ? kLaterGrace : kGrace) * 1000000};
  if (wait(self, grace, handle)) return true;
  quietly([&] { tell_answered("action", name); });
  return true;
}
