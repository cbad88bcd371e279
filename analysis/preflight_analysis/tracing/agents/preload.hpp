// What the libraries that are preloaded into nodes have in common: how they tell their events, those of channel.py, how
// they reach the functions that they stand in front of, and which files the node opens.
//
// Each hook is `tell, call`; what tells neither throws nor changes errno. A function that a library calls within itself
// is only seen where the library was linked without -Bsymbolic-functions; nothing relies on it.
#pragma once

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdarg.h>
#include <string.h>
#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#ifdef PREFLIGHT_PORTABLE
// Since 2.34 these are in glibc itself under a new version, which older ones lack; the old version is still there.
#ifdef __aarch64__
#define OLDEST "GLIBC_2.17"
#else
#define OLDEST "GLIBC_2.2.5"
#endif
__asm__(".symver dlsym,dlsym@" OLDEST);
__asm__(".symver dlopen,dlopen@" OLDEST);
__asm__(".symver dlclose,dlclose@" OLDEST);
__asm__(".symver dladdr,dladdr@" OLDEST);
__asm__(".symver pthread_once,pthread_once@" OLDEST);
__asm__(".symver pthread_sigmask,pthread_sigmask@" OLDEST);
// Older ones have none; 0 says to the C++ library that there may be threads, which is always right.
extern "C" __attribute__((visibility("hidden"))) char __libc_single_threaded = 0;
#endif

#define HOOK extern "C" __attribute__((visibility("default")))

// Named, or the hooks that use its types could not be seen from outside.
namespace preflight {

// A write to a FIFO of at most PIPE_BUF bytes is not torn apart by those of other threads.
constexpr size_t kMaxLine = 4096;
constexpr int kMaxEvents = 5000;
constexpr size_t kMaxName = 300;

char fifo[256];
std::atomic<int> sent{0};
std::atomic<bool> answered{false};  // the main thread, so that whatever comes may be due to it
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
  if (fifo[0] == 0 || line.size() > kMaxLine || sent.fetch_add(1) >= kMaxEvents) return;
  // Opened anew each time: the node may close descriptors that it does not know.
  int descriptor = open(fifo, O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  while (write(descriptor, line.data(), line.size()) < 0 && errno == EINTR) {
  }
  close(descriptor);
}

// A string of JSON.
std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (unsigned char c : text) {
    char escaped[8];
    if (c < 0x20 || c == '"' || c == '\\') {
      snprintf(escaped, sizeof escaped, "\\u%04x", c);
      made.append(escaped);
    } else {
      made.push_back(static_cast<char>(c));
    }
  }
  return made + "\"";
}

// A flat JSON object, by and by.
class Event {
 public:
  explicit Event(const char* kind) : text_(R"({"ev":")") { text_.append(kind).append("\""); }

  Event& raw(const char* key, const std::string& value) {
    text_.append(",\"").append(key).append("\":").append(value);
    return *this;
  }

  Event& add(const char* key, const std::string& value) { return raw(key, quoted(value.substr(0, kMaxName + 1))); }

  Event& add(const char* key, bool value) { return raw(key, value ? "true" : "false"); }

  void send() const { write_line(text_ + "}\n"); }

 private:
  std::string text_;
};

// Whether it may be one of the libraries with the functions that are intercepted, by the name of its file.
bool is_watched(const char* library);

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
        if (name == nullptr || !is_watched(name + 1)) return 0;
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

#define REAL(symbol, ...)                           \
  ([]() {                                           \
    static std::atomic<void*> known{nullptr};       \
    return real_or_die<__VA_ARGS__>(known, symbol); \
  }())

#define REAL_IF_ANY(symbol, ...)              \
  ([]() {                                     \
    static std::atomic<void*> known{nullptr}; \
    return real<__VA_ARGS__>(known, symbol);  \
  }())

void tell_woven() {
  static std::atomic<bool> woven{false};
  if (!woven.exchange(true)) Event("woven").send();
}

// Runs what tells; whatever goes wrong stays here.
template <typename Report>
void quietly(Report report) noexcept {
  Errno kept;
  Depth nested;
  try {
    tell_woven();
    report();
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
  char* end = stpcpy(line, R"({"ev":"files","paths":[")");
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

#define OPEN(id, symbol)                                                \
  HOOK int id(const char* path, int flags, ...) __asm__(symbol);        \
  HOOK int id(const char* path, int flags, ...) {                       \
    va_list rest;                                                       \
    va_start(rest, flags);                                              \
    mode_t mode = va_arg(rest, mode_t);                                 \
    va_end(rest);                                                       \
    tell_opened(path, flags);                                           \
    return REAL(symbol, int(const char*, int, ...))(path, flags, mode); \
  }
OPEN(preflight_open, "open")
OPEN(preflight_open64, "open64")

#define OPEN_AT(id, symbol)                                                                  \
  HOOK int id(int folder, const char* path, int flags, ...) __asm__(symbol);                 \
  HOOK int id(int folder, const char* path, int flags, ...) {                                \
    va_list rest;                                                                            \
    va_start(rest, flags);                                                                   \
    mode_t mode = va_arg(rest, mode_t);                                                      \
    va_end(rest);                                                                            \
    if (folder == AT_FDCWD || (path != nullptr && path[0] == '/')) tell_opened(path, flags); \
    return REAL(symbol, int(int, const char*, int, ...))(folder, path, flags, mode);         \
  }
OPEN_AT(preflight_openat, "openat")
OPEN_AT(preflight_openat64, "openat64")

#define OPEN_2(id, symbol)                                   \
  HOOK int id(const char* path, int flags) __asm__(symbol);  \
  HOOK int id(const char* path, int flags) {                 \
    tell_opened(path, flags);                                \
    return REAL(symbol, int(const char*, int))(path, flags); \
  }
OPEN_2(preflight_open_2, "__open_2")
OPEN_2(preflight_open64_2, "__open64_2")

#define FOPEN(id, symbol)                                                                     \
  HOOK FILE* id(const char* path, const char* mode) __asm__(symbol);                          \
  HOOK FILE* id(const char* path, const char* mode) {                                         \
    if (mode != nullptr && mode[0] == 'r' && strchr(mode, '+') == nullptr) tell_opened(path); \
    return REAL(symbol, FILE * (const char*, const char*))(path, mode);                       \
  }
FOPEN(preflight_fopen, "fopen")
FOPEN(preflight_fopen64, "fopen64")

// A program that looks for room before it writes finds that of a disk. The sandbox's own file systems are small, which
// is none of the program's concern: what it writes until its event loop fits.
constexpr uint64_t kRoom = uint64_t{16} << 30;
constexpr long kTmpfs = 0x01021994;

void make_room(const char* path, struct statvfs* found) noexcept {
  Errno kept;
  struct statfs system;
  if (path == nullptr || statfs(path, &system) != 0 || system.f_type != kTmpfs || found->f_frsize == 0) return;
  const uint64_t blocks = kRoom / found->f_frsize;
  if (found->f_bavail < blocks) found->f_blocks = found->f_bfree = found->f_bavail = blocks;
}

#define ROOM(id, symbol)                                                       \
  HOOK int id(const char* path, struct statvfs* found) __asm__(symbol);        \
  HOOK int id(const char* path, struct statvfs* found) {                       \
    int result = REAL(symbol, int(const char*, struct statvfs*))(path, found); \
    if (result == 0) make_room(path, found);                                   \
    return result;                                                             \
  }
ROOM(preflight_statvfs, "statvfs")
ROOM(preflight_statvfs64, "statvfs64")

bool in_main_thread() { return syscall(SYS_gettid) == getpid(); }

int threads_now() {
  DIR* tasks = opendir("/proc/self/task");
  if (tasks == nullptr) return 0;
  int count = 0;
  while (dirent* entry = readdir(tasks)) count += entry->d_name[0] != '.' ? 1 : 0;
  closedir(tasks);
  return count;
}

// Seconds, of a clock that only goes forward.
double now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace preflight
