// The event loop.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <string>

#include "asking.hpp"

namespace preflight {

std::atomic<int> busy{0};  // lifecycle nodes that are on their way, and calls that are going to be answered
std::mutex turns_mutex;
std::string held;  // the state that is to be told once they are through
std::set<std::string> told_states;

void no_longer_busy();

// A node is up now, and answers.
void ask_for_parameters() {
  std::set<const Handle*> nodes;
  {
    std::lock_guard<std::mutex> locked(unasked_mutex);
    nodes.swap(unasked());
  }
  for (const Handle* node : nodes) {
    Asked asked{full_name_of(node), ASKING(node, "ListParameters", "list_parameters"),
                ASKING(node, "DescribeParameters", "describe_parameters"),
                ASKING(node, "GetParameters", "get_parameters")};
    ++busy;
    in_background([node, asked] {
      try {
        tell_parameters(node, asked);
      } catch (...) {  // what it answers is no message that we know
      }
      no_longer_busy();
    });
  }
}

void tell_state(const std::string& state, bool main) {
  Event("state").add("state", state).raw("threads", main ? "0" : "1").send();
}

void tell_turn(const WaitSet* waited_for, int64_t timeout) {
  static std::atomic<int> iterations{0};
  bool main = in_main_thread();
  bool works = waited_for->subscriptions.count + waited_for->timers.count + waited_for->clients.count +
                   waited_for->services.count >
               0;
  if (!main && !works) return;  // rclcpp has a thread that looks for changes of the graph
  if (works) ask_for_parameters();
  // Whoever waits without end in the main thread is there. Else it may be a wait before more is made.
  std::string state = main && (timeout < 0 || iterations.fetch_add(1) > 0) ? "looped" : "idle";
  std::lock_guard<std::mutex> locked(turns_mutex);
  if (told_states.count(state + (main ? "" : "*")) != 0) return;
  if (busy > 0) {
    if (held != "looped") held = state;
    return;
  }
  told_states.insert(state + (main ? "" : "*"));
  tell_state(state, main);
}

// Whatever loop the node is in, it may leave soon, and has to show one again.
void tell_moving(const char* seconds = "0.3") {
  std::lock_guard<std::mutex> locked(turns_mutex);
  Event("state").add("state", std::string("fed")).raw("seconds", seconds).send();
  told_states.clear();
}

void tell_answered(const char* kind, const std::string& name) {
  Event("answered").add("kind", std::string(kind)).add("name", name).send();
  // The middleware has to bring it, and the machine may be busy.
  tell_moving("1.0");
}

void tell_answered_here(const char* kind, const std::string& name) {
  answered_here = true;
  if (in_main_thread()) answered = true;
  tell_answered(kind, name);
}

void no_longer_busy() {
  std::lock_guard<std::mutex> locked(turns_mutex);
  if (--busy != 0 || held.empty()) return;
  tell_state(held, true);
  held.clear();
}

}  // namespace preflight
