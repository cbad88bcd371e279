// Tells of topics and services.
#pragma once

#include <string.h>

#include <atomic>
#include <string>

#include "layout.hpp"
#include "names.hpp"

namespace preflight {

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

}  // namespace preflight
