// Has lifecycle nodes do what a manager would ask of them.
#pragma once

#include <memory>
#include <string>

#include "background.hpp"
#include "loop.hpp"

namespace preflight {

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

void tell_own(const char* transition) {
  Event event("transition");
  event.add("name", std::string(transition)).send();
}

// Has it do what a manager would ask of it.
void bring_up(const Handle* node, std::shared_ptr<Managed> managed) {
  auto* available = REAL_IF_ANY("rcl_service_server_is_available", int(const Handle*, const Handle*, bool*));
  bool there = false;
  for (double until = now() + 2; available != nullptr && !there && now() < until; pause(0.002)) {
    if (!while_up([&] { available(node, &managed->client, &there); })) break;
  }
  // What it did by itself, nobody has to ask of it.
  uint8_t reached = state_of(managed->machine);
  if (reached == kInactive || reached == kActive) tell_own("configure");
  if (reached == kActive) tell_own("activate");
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

}  // namespace preflight
