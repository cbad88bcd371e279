// Has a container of components load the one that it was started for, as `ros2 component load` would.
//
// The request is made in the language of the container's own service (most link the type support of C++ alone): it
// comes as CDR in a file, and the middleware makes the message of it.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "asking.hpp"
#include "background.hpp"
#include "loop.hpp"
#include "messages.hpp"

namespace preflight {

constexpr const char* kLoadNode = "/_container/load_node";
constexpr const char* kLoading = "load_node";  // what the supervisor calls the wait for the answer

struct Loader {
  const Handle* node = nullptr;
  const Support* service = nullptr;
};
std::mutex loader_mutex;
Loader loader;
bool any_loader = false;

// The bytes of the request, which its file has as hexadecimal digits.
std::vector<unsigned char> load_request() {
  std::vector<unsigned char> bytes;
  int descriptor = open(getenv("PREFLIGHT_LOAD"), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return bytes;
  std::string digits;
  char part[4096];
  for (ssize_t got; (got = read(descriptor, part, sizeof part)) > 0;) digits.append(part, got);
  close(descriptor);
  for (size_t at = 0; at + 1 < digits.size(); at += 2) {
    bytes.push_back(static_cast<unsigned char>(std::stoi(digits.substr(at, 2), nullptr, 16)));
  }
  return bytes;
}

#define LOAD_NODE_MESSAGE(language, name)                                                              \
  called(REAL_IF_ANY("rosidl_typesupport_" language                                                    \
                     "__get_message_type_support_handle__composition_interfaces__srv__LoadNode_" name, \
                     const Support*()))

void tell_load(const char* state) {
  Event("state")
      .add("state", std::string(state))
      .add("kind", std::string("load"))
      .add("name", std::string(kLoading))
      .add("main", true)
      .send();
}

void tell_loaded(bool success, std::string why) {
  constexpr size_t kMostWhy = 600;  // each escaped they fit into a line
  if (why.size() > kMostWhy) {
    size_t end = kMostWhy;
    while (end > 0 && (static_cast<unsigned char>(why[end]) & 0xc0) == 0x80) --end;  // no half of a letter
    why.resize(end);
  }
  Event("loaded").add("success", success).raw("error", quoted(why)).send();
}

// Whether the container answered. `before` becomes what `turns` was then.
bool load(const Loader& asked, int& before) {
  auto* make = REAL_IF_ANY("rcl_client_init", int(Handle*, const Handle*, const Support*, const char*, const Options*));
  auto* options = REAL_IF_ANY("rcl_client_get_default_options", Options());
  auto* available = REAL_IF_ANY("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
  auto* send = REAL_IF_ANY("rcl_send_request", int(const Handle*, const void*, int64_t*));
  auto* take = REAL_IF_ANY("rcl_take_response", int(const Handle*, void*, void*));
  auto* deserialize = REAL_IF_ANY("rmw_deserialize", int(const Serialized*, const Support*, void*));
  auto* allocator = REAL_IF_ANY("rcutils_get_default_allocator", Allocator());
  const ServiceMembers* members = members_of(asked.service);
  if (!make || !options || !available || !send || !take || !deserialize || !allocator || !members) return false;
  bool in_c = found(asked.service, kSupports[2]) != nullptr;
  const Support* of_request = in_c ? LOAD_NODE_MESSAGE("c", "Request") : LOAD_NODE_MESSAGE("cpp", "Request");
  const Support* of_response = in_c ? LOAD_NODE_MESSAGE("c", "Response") : LOAD_NODE_MESSAGE("cpp", "Response");
  std::vector<unsigned char> bytes = load_request();
  if (of_request == nullptr || of_response == nullptr || bytes.empty()) return false;
  Serialized serialized;
  serialized.buffer = bytes.data();
  serialized.length = serialized.capacity = bytes.size();
  serialized.allocator = allocator();
  Message request(members->request);
  bool made = deserialize(&serialized, of_request, request.get()) == kOk;
  reset_error();  // as in `Owned`
  if (!made) return false;
  static Handle client;  // for as long as the node is there
  Options given = options();
  bool there = false;
  int64_t sequence = 0;
  int result = kOk + 1;
  while_up(asked.node,
           [&] { result = make(&client, asked.node, asked.service, ("~" + std::string(kLoadNode)).c_str(), &given); });
  if (result != kOk) return false;
  tell_load("wait");
  Message response(members->response);
  for (result = kOk + 1; result != kOk; pause(0.001)) {
    alignas(16) unsigned char header[128] = {};
    bool up = while_up(asked.node, [&] {
      if (!there && available(asked.node, &client, &there) == kOk && there) {
        loading = true;
        send(&client, request.get(), &sequence);
      }
      before = turns;
      if (there) result = take(&client, header, response.get());
      reset_error();
    });
    if (!up) return false;
  }
  Owned owned(response.get(), of_response);
  Reader from(owned.bytes);
  bool success = from.value<uint8_t>() != 0;
  tell_loaded(success, from.string());
  return true;
}

// A service that loads components was made.
void offers_to_load(const Handle* node, const Support* service) {
  if (!is_containers()) return;
  std::lock_guard<std::mutex> locked(loader_mutex);
  if (any_loader) return;
  any_loader = true;
  loader = {node, service};
  ++busy;
}

// The container is in its event loop, and answers.
void ask_to_load() {
  Loader asked;
  {
    std::lock_guard<std::mutex> locked(loader_mutex);
    if (is_containers()) std::swap(asked, loader);
  }
  if (asked.node == nullptr) return;
  in_background([asked] {
    bool answered = false;
    int before = 0;
    try {
      answered = load(asked, before);
    } catch (...) {  // what it answers is no message that we know
    }
    if (answered) {
      ask_for_parameters();  // before its container waits again, or whoever spins it does
      // Which timers there are shows when it does.
      for (double until = now() + kSoon; turns == before && now() < until;) pause(0.001);
      tell_load("resume");
    }
    no_longer_busy();
  });
}

}  // namespace preflight
