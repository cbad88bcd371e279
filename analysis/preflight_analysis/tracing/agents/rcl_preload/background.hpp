// What our own threads do with rcl ends before the node takes it down.
#pragma once

#include <pthread.h>

#include <csignal>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "layout.hpp"

namespace preflight {

std::mutex ours_mutex;
bool ended = false;

void end_ours() {
  std::lock_guard<std::mutex> locked(ours_mutex);
  ended = true;
}

// Whether it could still be done.
template <typename Step>
bool while_up(Step step) {
  std::lock_guard<std::mutex> locked(ours_mutex);
  if (!ended) step();
  return !ended;
}

std::set<const Handle*>& gone() {
  static auto* all = new std::set<const Handle*>;
  return *all;
}

// Likewise with a node, which may be taken down before the rest.
template <typename Step>
bool while_up(const Handle* node, Step step) {
  bool there = false;
  bool up = while_up([&] {
    there = gone().count(node) == 0;
    if (there) step();
  });
  return up && there;
}

// Our own threads take no signals: those are the node's.
template <typename Work>
void in_background(Work work) {
  static std::once_flag once;
  std::call_once(once, [] { atexit(end_ours); });
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  try {
    std::thread([work = std::move(work)] { quietly(work); }).detach();
  } catch (...) {
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void pause(double seconds) {
  timespec time{0, static_cast<long>(seconds * 1e9)};
  nanosleep(&time, nullptr);
}

}  // namespace preflight
