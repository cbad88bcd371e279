// What a node that is up says of its parameters. Its own services tell what it does not publish: those that were
// declared without a value, what else is declared with them, and all of a node that publishes no parameter events.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "background.hpp"
#include "messages.hpp"
#include "parameters.hpp"

namespace preflight {

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
      Event event = param_event(node, asked.node, name, values[i]);
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

}  // namespace preflight
