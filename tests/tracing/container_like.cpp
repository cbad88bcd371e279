// A container of rclcpp_components, as far as a trace can tell. A component is a library with a function that tells the
// steps of what its constructor does. With the argument `deaf` it is a container that never spins, with `none` none.
//
// After rclcpp_components: which index is read, what a component is given, the texts of errors.
#include <dlfcn.h>

#include <fstream>
#include <sstream>

#include <composition_interfaces/srv/load_node.hpp>

#include "rclcpp_like.hpp"

namespace {

using composition_interfaces::srv::LoadNode;

// The library of a class, by the first prefix that lists the package's components.
std::string library_of(const std::string& package, const std::string& plugin) {
  std::istringstream prefixes(getenv("AMENT_PREFIX_PATH"));
  for (std::string prefix; std::getline(prefixes, prefix, ':');) {
    std::ifstream listed(prefix + "/share/ament_index/resource_index/rclcpp_components/" + package);
    if (!listed) continue;
    for (std::string line; std::getline(listed, line);) {
      size_t at = line.find(';');
      if (line.substr(0, at) == plugin) return prefix + "/" + line.substr(at + 1);
    }
    throw std::runtime_error("Failed to find class with the requested plugin name.");
  }
  throw std::runtime_error("Could not find requested resource in ament index");
}

void load(const LoadNode::Request& request) {
  std::string path = library_of(request.package_name, request.plugin_name);
  void* library = dlopen(path.c_str(), RTLD_NOW);
  if (library == nullptr) throw std::runtime_error("Failed to load library: " + std::string(dlerror()));
  auto* steps = reinterpret_cast<const char* (*)()>(dlsym(library, "steps"));
  std::vector<std::string> arguments{"--ros-args"};
  auto remap = [&](const std::string& rule) { arguments.insert(arguments.end(), {"-r", rule}); };
  for (auto& rule : request.remap_rules) remap(rule);
  if (!request.node_name.empty()) remap("__node:=" + request.node_name);
  if (!request.node_namespace.empty()) remap("__ns:=" + request.node_namespace);
  std::map<std::string, ParameterValue> overrides;
  for (auto& each : request.parameters) overrides[each.name] = each.value;
  bool global = false;
  for (auto& each : request.extra_arguments) {
    bool forwards = each.name == "forward_global_arguments";
    if (!forwards && each.name != "use_intra_process_comms") {
      throw std::runtime_error("Extra component argument '" + each.name + "' is not supported");
    }
    if (each.value.type != 1)
      throw std::runtime_error("Extra component argument '" + each.name + "' must be a boolean");
    (forwards ? global : intra_process) = each.value.bool_value;
  }
  try {
    nodes.emplace_back("own", arguments, overrides, global);
    std::istringstream each(steps());
    for (std::string step; each >> step;) perform(step);
  } catch (const std::exception& problem) {
    throw std::runtime_error("Component constructor threw an exception: " + std::string(problem.what()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string mode = argc > 1 ? argv[1] : "";
  start(argc, argv);
  nodes.emplace_back("container", "", false);
  if (mode != "none") {
    nodes.back().serve<LoadNode>("~/_container/load_node", [](auto& request, auto& response) {
      try {
        load(request);
        response.full_node_name = rcl_node_get_fully_qualified_name(nodes.back().handle());
        response.success = true;
      } catch (const std::exception& problem) {
        response.error_message = problem.what();
      }
    });
  }
  nodes.back().publish("of_the_container", false);
  if (mode == "deaf") sleep(60);
  spin();
}
