// What the node lacks, and is given: time, messages, answers.
#pragma once

#include <string.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "endpoints.hpp"

namespace preflight {

std::atomic<bool> waited{false};  // for sure, where a loop may be the node's work

std::atomic<int> waits_over{0};  // of the main thread, once it got a made-up answer

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

// Milliseconds.
constexpr int kGrace = 300, kLaterGrace = 100;

int grace() { return answered || answered_here ? kLaterGrace : kGrace; }

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

// Of these one message is waited for.
void ask_for_message(const std::string& topic) {
  Event("feed").add("topic", topic).add("awaited", true).send();
  std::lock_guard<std::mutex> locked(lacks_mutex);
  lacks().fed.insert(topic);
}

bool was_fed(const std::string& topic) {
  std::lock_guard<std::mutex> locked(lacks_mutex);
  return lacks().fed.count(topic) != 0;
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

}  // namespace preflight
