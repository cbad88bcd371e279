// Which threads are those of the library.
#pragma once

#include <atomic>

#include "../preload.hpp"

namespace preflight {

// XML-RPC, polling of sockets, the internal callback queue, and the publisher of /rosout.
constexpr int kLibraryThreads = 4;
std::atomic<int> library_threads{kLibraryThreads};

// Counts the threads that a library call starts as the library's, those of a call within it once.
class LibraryThreads {
 public:
  LibraryThreads() : outermost_(depth == 0) {
    quietly([this] { before_ = threads_now(); });
    ++depth;
  }
  ~LibraryThreads() {
    --depth;
    quietly([this] {
      int more = threads_now() - before_;
      if (outermost_ && more > 0) library_threads += more;
    });
  }

 private:
  bool outermost_;
  int before_ = 0;
};

}  // namespace preflight
