// What the node subscribes to and publishes: frames, and goals of actions.
#pragma once

#include <string.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "lacks.hpp"
#include "names.hpp"

namespace preflight {

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

}  // namespace preflight
