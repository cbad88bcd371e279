// Names as the node gave them and as they are resolved, and who asks for them.
#pragma once

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include <atomic>
#include <string>

#include "layout.hpp"

namespace preflight {

std::string below(const std::string& space) { return space.empty() || space.back() != '/' ? space + "/" : space; }

// The full name of a nodelet that is loaded under another name than its process has; empty for any other node.
const char* nodelet_name() {
  static const char* name = getenv("PREFLIGHT_NODELET");
  return name == nullptr ? "" : name;
}

std::string own_name() {
  if (*nodelet_name() != 0) return nodelet_name();
  auto* name = REAL_IF_ANY("_ZN3ros9this_node7getNameB5cxx11Ev", const std::string&());
  return name == nullptr ? "" : name();
}

// A name that was resolved through a handle, as the node could have given it to its default handle.
std::string as_given(const NodeHandle* handle, const std::string& name, const std::string& full) {
  auto* node_space = REAL_IF_ANY("_ZN3ros9this_node12getNamespaceB5cxx11Ev", const std::string&());
  std::string node_name = own_name();
  if (node_name.empty() || node_space == nullptr || (!name.empty() && name[0] == '/')) return full;
  std::string own = below(node_name), space = below(node_space());
  if (starts_with(full, own)) return "~" + full.substr(own.size());
  if (*nodelet_name() != 0) return full;  // the namespace of the process is not the nodelet's
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
  if (!handle->given_name_space.empty() && handle->given_name_space != own_name()) {
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
  std::string resolved = resolve == nullptr ? "" : resolve(name, true);
  // What is asked for without a handle is asked for in the process's name, not in the nodelet's.
  return {*nodelet_name() != 0 && !resolved.empty() ? resolved : name, resolved};
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

}  // namespace preflight
