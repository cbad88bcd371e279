// A node of rclcpp, as far as a trace can tell: each argument up to `--ros-args` is a step of what it does.
#include "rclcpp_like.hpp"

int main(int argc, char** argv) {
  start(argc, argv);
  for (int i = 1; i < argc && std::string(argv[i]) != "--ros-args"; ++i) perform(argv[i]);
  spin();
}
