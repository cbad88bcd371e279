// The event loop.
#pragma once

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "asking.hpp"

namespace preflight {

std::atomic<int> busy{0};   // lifecycle nodes that are on their way, and calls that are going to be answered
std::atomic<int> turns{0};  // how often an event loop has come to its wait
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
    busy += static_cast<int>(nodes.size());  // before anybody finds that there is none left to ask
  }
  for (const Handle* node : nodes) {
    Asked asked{full_name_of(node), ASKING(node, "ListParameters", "list_parameters"),
                ASKING(node, "DescribeParameters", "describe_parameters"),
                ASKING(node, "GetParameters", "get_parameters")};
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

// A timer may make more, as one does that a constructor sets for what has to wait until that is done. Those that are
// due soon have their first turn before the node counts as up.
constexpr double kSoon = 0.3;
std::mutex timers_mutex;
double first_turns_until = 0;
bool awaits_timers = false;
std::set<const void*>& known_timers() {
  static auto* all = new std::set<const void*>;
  return *all;
}

// Whether all those turns are over, at least by the clock.
bool had_turns(double late) {
  {
    std::lock_guard<std::mutex> locked(timers_mutex);
    if (!awaits_timers) return true;
    if (now() < first_turns_until + late) return false;
    awaits_timers = false;
  }
  no_longer_busy();
  return true;
}

void await_timers(const WaitSet* waited_for) {
  auto* left = REAL_IF_ANY("rcl_timer_get_time_until_next_call", int(const void*, int64_t*));
  if (left == nullptr) return;
  had_turns(0);  // whoever waits again has done what was due
  bool begins = false;
  {
    std::lock_guard<std::mutex> locked(timers_mutex);
    auto* all = static_cast<const void* const*>(waited_for->timers.entities);
    for (size_t i = 0; i < waited_for->timers.count; ++i) {
      int64_t nanoseconds = 0;
      if (all[i] == nullptr || !known_timers().insert(all[i]).second || left(all[i], &nanoseconds) != kOk) continue;
      double seconds = static_cast<double>(nanoseconds) * 1e-9;
      if (seconds >= kSoon) continue;
      first_turns_until = std::max(first_turns_until, now() + seconds);
      begins = begins || !awaits_timers;
      awaits_timers = true;
    }
  }
  reset_error();  // one that is cancelled has no time
  if (!begins) return;
  ++busy;
  in_background([] {
    while (!had_turns(kSoon)) pause(0.01);  // a timer that nobody spins
  });
}

void tell_turn(const WaitSet* waited_for, int64_t timeout) {
  static std::atomic<int> iterations{0};
  bool main = in_main_thread();
  bool works = waited_for->subscriptions.count + waited_for->timers.count + waited_for->clients.count +
                   waited_for->services.count >
               0;
  if (!main && !works) return;  // rclcpp has a thread that looks for changes of the graph
  if (works) ask_for_parameters();
  await_timers(waited_for);
  ++turns;
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
