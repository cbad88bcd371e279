// Waits for services.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "background.hpp"
#include "loop.hpp"
#include "messages.hpp"

namespace preflight {

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
