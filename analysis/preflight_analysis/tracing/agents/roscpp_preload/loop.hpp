// The event loop, and loops of the main thread.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <string>

#include "lacks.hpp"
#include "parameters.hpp"
#include "threads.hpp"

namespace preflight {

void tell_spin() {
  if (depth > 0) return;
  quietly([] {
    static std::atomic<bool> done{false};
    if (!in_main_thread() || done.exchange(true)) return;
    int own = threads_now() - 1 - library_threads;
    Event("state").add("state", std::string("spin")).raw("threads", std::to_string(own > 0 ? own : 0)).send();
  });
}

std::atomic<int> published{0};  // messages of the main thread

// A loop of the main thread, as its sleeps and spinOnce show it. What comes twice from one place stands in a loop; a
// single sleep (`seconds` is not negative) may be a pause before more endpoints are made, and so may the second where a
// wait was answered before it: a loop over what the node waits for comes to its end. A loop that does nothing while the
// node lacks messages may be waiting for them: it gets some.
class Loop {
 public:
  void turn(void* place, double seconds) {
    Place* known = find(place);
    bool again = known != nullptr && known->iterations++ > 0;
    if (again && seconds >= 0 && known->waits_over != waits_over && !waited_in_turn_) {
      waited_in_turn_ = true;
      again = false;
    }
    double period = 0;
    if (known != nullptr) {
      known->waits_over = waits_over;
      works_ = works_ || (again && published > known->published);
      known->published = published;
      period = again ? now() - known->at : 0;
      known->at = now();
    }
    if (works_ && starving_sent_) {
      starving_sent_ = false;
      Event("state").add("state", std::string("busy")).send();
    }
    if (sent_looped_ && !starving_sent_) return;
    bool starving = !works_ && (polls_params() || needs_time() || !starved().empty());
    if (again && starving && now() - last_new >= kQuiet && feed(period)) return;
    report(again, seconds, starving);
  }

 private:
  static constexpr double kQuiet = 0.25;
  struct Place {
    void* place;
    int iterations, published, waits_over;
    double at;
  };

  Place* find(void* place) {
    for (int i = 0; i < count_; ++i) {
      if (places_[i].place == place) return &places_[i];
    }
    if (count_ == 64) return nullptr;
    places_[count_] = {place, 0, published, waits_over, now()};
    return &places_[count_++];
  }

  void report(bool again, double seconds, bool starving) {
    if (!again && seconds >= 0) {
      Event("state").add("state", std::string("sleep")).raw("seconds", std::to_string(seconds)).send();
    } else if (again ? !sent_looped_ || (starving_sent_ && !starving) : !sent_idle_) {
      (again ? sent_looped_ : sent_idle_) = true;
      starving_sent_ = starving;
      int own = threads_now() - 1 - library_threads;
      Event("state")
          .add("state", std::string(again ? "looped" : "idle"))
          .raw("threads", std::to_string(own > 0 ? own : 0))
          .add("starving", starving)
          .send();
    }
  }

  bool feed(double period) {
    std::set<std::string> topics;
    if (!give_time()) {
      topics = starved();
      if (topics.empty()) return false;
    }
    for (const auto& topic : topics) {
      tell_answered("poll", topic);
      ask_for_food(topic);
    }
    {
      std::lock_guard<std::mutex> locked(lacks_mutex);
      lacks().fed.insert(topics.begin(), topics.end());
    }
    // It may leave the loop now, and has to show another one.
    count_ = 0;
    sent_idle_ = sent_looped_ = starving_sent_ = works_ = false;
    last_new = now();
    // Another turn takes the messages, the next one may go on.
    Event("state").add("state", std::string("fed")).raw("seconds", std::to_string(2.5 * period)).send();
    return true;
  }

  Place places_[64];
  int count_ = 0;
  bool sent_idle_ = false, sent_looped_ = false, starving_sent_ = false, works_ = false;
  bool waited_in_turn_ = false;
};

void tell_turn(void* place, double seconds) {
  if (depth > 0) return;
  quietly([&] {
    static Loop loop;
    if (in_main_thread() && !from_roscpp(place)) loop.turn(place, seconds);
  });
}

}  // namespace preflight
