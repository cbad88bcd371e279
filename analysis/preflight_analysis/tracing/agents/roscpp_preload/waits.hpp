// Waits for somebody else.
#pragma once

#include <string>

#include "lacks.hpp"

namespace preflight {

// From construction to destruction the node waits for somebody else.
class Wait {
 public:
  Wait(const char* kind, const std::string& name) : outermost_(depth == 0) {
    quietly([&] {
      kind_ = kind;
      name_ = name;
      report("wait");
    });
    ++depth;
  }
  ~Wait() {
    --depth;
    quietly([&] {
      if (outermost_ && answered && in_main_thread()) ++waits_over;
      report("resume");
    });
  }

 private:
  void report(const char* state) {
    if (!outermost_) return;
    Event("state")
        .add("state", std::string(state))
        .add("kind", kind_)
        .add("name", name_)
        .add("main", in_main_thread())
        .send();
  }

  bool outermost_;
  std::string kind_, name_;
};

#define WAIT_INT "_ZN3ros7service14waitForServiceE" STRING "i"

std::string name_of_client(void* client) {
  auto* service = REAL_IF_ANY("_ZN3ros13ServiceClient10getServiceB5cxx11Ev", std::string(void*));
  return service == nullptr ? "" : service(client);
}

// A name that is asked for without a handle, as it is told.
std::string given_to_process(const std::string& name) {
  std::string given = name;
  quietly([&] { given = names_of(name).given; });
  return given;
}

// Waits for a service as long as somebody in the sandbox may need to offer it; then it is said to be there, as for
// rospy (answers.py).
bool wait_briefly(const std::string& name, const std::string& told) {
  Wait waiting("service", told);
  if (REAL(WAIT_INT, bool(const std::string&, int))(name, grace())) return true;
  quietly([&] { tell_answered("service", told); });
  return true;
}

}  // namespace preflight
