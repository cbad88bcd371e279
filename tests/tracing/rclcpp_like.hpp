// Does on rcl what rclcpp 29 does, as far as a trace can tell: a client library is in no package index. What a node
// does is told in steps (see `perform`).
//
// After rclcpp: the texts of exceptions, when a parameter event is published, which values override a default, what the
// services of parameters answer, and under which name the QoS of a topic is overridden.
#pragma once

#include <unistd.h>

#include <functional>
#include <list>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <lifecycle_msgs/msg/transition.h>
#include <lifecycle_msgs/msg/transition_event.h>
#include <lifecycle_msgs/srv/change_state.h>
#include <lifecycle_msgs/srv/get_available_states.h>
#include <lifecycle_msgs/srv/get_available_transitions.h>
#include <lifecycle_msgs/srv/get_state.h>
#include <rcl/arguments.h>
#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcl/rcl.h>
#include <rcl_lifecycle/rcl_lifecycle.h>
#include <rcl_yaml_param_parser/types.h>
#include <rmw/qos_string_conversions.h>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rcl_interfaces/srv/describe_parameters.hpp>
#include <rcl_interfaces/srv/get_parameters.hpp>
#include <rcl_interfaces/srv/list_parameters.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <rosidl_typesupport_cpp/service_type_support.hpp>
#include <std_msgs/msg/string.hpp>

void *PyExc_RuntimeError, *_Py_TrueStruct;  // as in rcl_node.c

namespace rclcpp {
namespace exceptions {
#define EXCEPTION(name)                      \
  struct name : std::runtime_error {         \
    using std::runtime_error::runtime_error; \
  }
EXCEPTION(InvalidParameterTypeException);
EXCEPTION(InvalidParameterValueException);
EXCEPTION(UninitializedStaticallyTypedParameterException);
EXCEPTION(ParameterUninitializedException);
EXCEPTION(InvalidTopicNameError);
}  // namespace exceptions
}  // namespace rclcpp

namespace {

using namespace rclcpp::exceptions;
using rcl_interfaces::msg::ParameterDescriptor;
using rcl_interfaces::msg::ParameterValue;

constexpr const char* kTypes[] = {"not set",    "bool",       "integer",       "double",       "string",
                                  "byte_array", "bool_array", "integer_array", "double_array", "string_array"};

rcl_context_t context = rcl_get_zero_initialized_context();
bool intra_process = false, event_publisher = true;

void check(rcl_ret_t result) {
  if (result == RCL_RET_OK) return;
  std::string why = rcl_get_error_string().str;
  rcl_reset_error();
  throw std::runtime_error(why);
}

template <typename Made>
const rosidl_message_type_support_t* type() {
  return rosidl_typesupport_cpp::get_message_type_support_handle<Made>();
}

ParameterValue value_of(const rcl_variant_t& given) {
  ParameterValue value;
  auto all = [](auto* from, auto& to) { to.assign(from->values, from->values + from->size); };
  if (given.bool_value) value.type = 1, value.bool_value = *given.bool_value;
  if (given.integer_value) value.type = 2, value.integer_value = *given.integer_value;
  if (given.double_value) value.type = 3, value.double_value = *given.double_value;
  if (given.string_value) value.type = 4, value.string_value = given.string_value;
  if (given.integer_array_value) value.type = 7, all(given.integer_array_value, value.integer_array_value);
  if (given.double_array_value) value.type = 8, all(given.double_array_value, value.double_array_value);
  return value;
}

struct Parameter {
  ParameterDescriptor descriptor;
  ParameterValue value;
};

class Node {
 public:
  // `space` is the namespace that the code gives it; `local` whether name and namespace are arguments of the node's
  // own, as Nav2 makes the node of a costmap.
  Node(const std::string& name, const std::string& space, bool local) {
    rcl_node_options_t options = rcl_node_get_default_options();
    std::string node_rule = "__node:=" + name, space_rule = "__ns:=" + space;
    const char* arguments[] = {"--ros-args", "-r", node_rule.c_str(), "-r", space_rule.c_str()};
    if (local) check(rcl_parse_arguments(5, arguments, rcl_get_default_allocator(), &options.arguments));
    start(name, space, options);
    take_global_parameters();
    declare_own();
  }

  // A component, with arguments and parameters of its own; `global` whether those of the process count after them.
  Node(const std::string& name, const std::vector<std::string>& arguments,
       const std::map<std::string, ParameterValue>& overrides, bool global) {
    rcl_node_options_t options = rcl_node_get_default_options();
    options.use_global_arguments = global;
    std::vector<const char*> words;
    for (auto& each : arguments) words.push_back(each.c_str());
    check(rcl_parse_arguments(words.size(), words.data(), rcl_get_default_allocator(), &options.arguments));
    start(name, "", options);
    if (global) take_global_parameters();
    for (auto& each : overrides) overrides_[each.first] = each.second;
    declare_own();
  }
  Node(const Node&) = delete;

 private:
  void take_global_parameters() {
    rcl_params_t* given = nullptr;
    check(rcl_arguments_get_param_overrides(&context.global_arguments, &given));
    for (size_t i = 0; given != nullptr && i < given->num_nodes; ++i) {
      std::string pattern = given->node_names[i];
      if (pattern != "/**" && pattern != rcl_node_get_fully_qualified_name(&handle_)) continue;
      for (size_t j = 0; j < given->params[i].num_params; ++j) {
        overrides_[given->params[i].parameter_names[j]] = value_of(given->params[i].parameter_values[j]);
      }
    }
  }

  void start(const std::string& name, const std::string& space, const rcl_node_options_t& options) {
    check(rcl_node_init(&handle_, name.c_str(), space.c_str(), &context, &options));
    std::string own = rcl_node_get_name(&handle_);
    serve<rcl_interfaces::srv::GetParameters>(own + "/get_parameters", [this](auto& request, auto& response) {
      for (auto& name : request.names) response.values.push_back(parameters_.at(name).value);
    });
    serve<rcl_interfaces::srv::DescribeParameters>(own + "/describe_parameters", [this](auto& request, auto& response) {
      for (auto& name : request.names) response.descriptors.push_back(parameters_.at(name).descriptor);
    });
    serve<rcl_interfaces::srv::ListParameters>(own + "/list_parameters", [this](auto& request, auto& response) {
      for (auto& each : parameters_) response.result.names.push_back(each.first);
    });
    if (event_publisher) {
      rcl_publisher_options_t event_options = rcl_publisher_get_default_options();
      check(rcl_publisher_init(&events_, &handle_, type<rcl_interfaces::msg::ParameterEvent>(), "/parameter_events",
                               &event_options));
    }
  }

  void declare_own() {
    ParameterValue no;
    no.type = 1;
    declare("use_sim_time", {}, no);
  }

 public:
  const rcl_node_t* handle() const { return &handle_; }

  // `declare_parameter`, with a default or with a type alone.
  const ParameterValue& declare(const std::string& name, ParameterDescriptor descriptor,
                                const ParameterValue& fallback) {
    if (descriptor.type == 0) descriptor.type = fallback.type;
    descriptor.name = name;
    auto given = overrides_.find(name);
    const ParameterValue& value = given != overrides_.end() ? given->second : fallback;
    rcl_interfaces::msg::ParameterEvent event;
    event.node = rcl_node_get_fully_qualified_name(&handle_);
    if (value.type != 0) {
      if (!descriptor.dynamic_typing && value.type != descriptor.type) {
        throw InvalidParameterTypeException(
            "parameter '" + name + "' has invalid type: Wrong parameter type, parameter {" + name + "} is of type {" +
            kTypes[descriptor.type] + "}, setting it to {" + kTypes[value.type] + "} is not allowed.");
      }
      auto refused = [&](const char* kind) {
        throw InvalidParameterValueException("parameter '" + name + "' could not be set: Parameter {" + name +
                                             "} doesn't comply with " + kind + " range.");
      };
      for (auto& range : descriptor.integer_range) {
        if (value.integer_value < range.from_value || value.integer_value > range.to_value) refused("integer");
      }
      for (auto& range : descriptor.floating_point_range) {
        if (value.double_value < range.from_value || value.double_value > range.to_value) refused("floating point");
      }
      event.new_parameters.resize(1);
      event.new_parameters[0].name = name;
      event.new_parameters[0].value = value;
    }
    parameters_[name] = {descriptor, value};
    if (event_publisher) {
      size_t listening = 0;
      check(rcl_publisher_get_subscription_count(&events_, &listening));
      if (!intra_process || listening > 0) check(rcl_publish(&events_, &event, nullptr));
    }
    return parameters_[name].value;
  }

  // `declare_parameter<T>(name)`, which returns the value.
  void declare_mandatory(const std::string& name, int type) {
    ParameterDescriptor descriptor;
    descriptor.type = type;
    if (declare(name, descriptor, {}).type == 0) {
      throw UninitializedStaticallyTypedParameterException("Statically typed parameter '" + name +
                                                           "' must be initialized.");
    }
  }

  void publish(const std::string& topic, bool overridable) {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    char* full = nullptr;
    check(rcl_node_resolve_name(&handle_, topic.c_str(), rcl_get_default_allocator(), false, false, &full));
    if (overridable) {
      ParameterValue reliable;
      reliable.type = 4;
      reliable.string_value = "reliable";
      auto found = declare("qos_overrides." + std::string(full) + ".publisher.reliability", {}, reliable);
      options.qos.reliability = rmw_qos_reliability_policy_from_str(found.string_value.c_str());
    }
    auto* made = new rcl_publisher_t(rcl_get_zero_initialized_publisher());
    check(rcl_publisher_init(made, &handle_, type<std_msgs::msg::String>(), topic.c_str(), &options));
  }

  void subscribe(const std::string& topic) {
    auto* made = new rcl_subscription_t(rcl_get_zero_initialized_subscription());
    rcl_subscription_options_t options = rcl_subscription_get_default_options();
    check(rcl_subscription_init(made, &handle_, type<std_msgs::msg::String>(), topic.c_str(), &options));
  }

  // As topic_tools' relay: once somebody publishes the topic.
  void relay(const std::string& topic) {
    size_t publishers = 0;
    char* full = nullptr;
    check(rcl_node_resolve_name(&handle_, topic.c_str(), rcl_get_default_allocator(), false, false, &full));
    check(rcl_count_publishers(&handle_, full, &publishers));
    if (publishers == 0) return;
    subscribe(topic);
    publish(topic + "_relay", false);
  }

  // A lifecycle node, which publishes a topic once it is configured and listens to another once it is active.
  void manage() {
#define SERVICE(name) ROSIDL_GET_SRV_TYPE_SUPPORT(lifecycle_msgs, srv, name)
    rcl_lifecycle_state_machine_options_t options = rcl_lifecycle_get_default_state_machine_options();
    check(rcl_lifecycle_state_machine_init(
        &machine_, &handle_, ROSIDL_GET_MSG_TYPE_SUPPORT(lifecycle_msgs, msg, TransitionEvent), SERVICE(ChangeState),
        SERVICE(GetState), SERVICE(GetAvailableStates), SERVICE(GetAvailableTransitions),
        SERVICE(GetAvailableTransitions), &options));
    services_.emplace_back(machine_.com_interface.srv_change_state, [this] {
      lifecycle_msgs__srv__ChangeState_Request request;
      lifecycle_msgs__srv__ChangeState_Response response;
      lifecycle_msgs__srv__ChangeState_Request__init(&request);
      lifecycle_msgs__srv__ChangeState_Response__init(&response);
      rmw_request_id_t header;
      const rcl_service_t* change = &machine_.com_interface.srv_change_state;
      if (rcl_take_request(change, &header, &request) != RCL_RET_OK) return rcl_reset_error();
      check(rcl_lifecycle_trigger_transition_by_id(&machine_, request.transition.id, true));
      bool configures = request.transition.id == lifecycle_msgs__msg__Transition__TRANSITION_CONFIGURE;
      if (configures) publish("made", false);
      if (!configures) subscribe("active");
      response.success = true;
      check(rcl_lifecycle_trigger_transition_by_label(&machine_, rcl_lifecycle_transition_success_label, true));
      check(rcl_send_response(change, &header, &response));
    });
  }

  // A service of any type.
  template <typename Service, typename Answer>
  void serve(const std::string& name, Answer answer) {
    services_.emplace_back();
    rcl_service_t* made = &services_.back().first;
    *made = rcl_get_zero_initialized_service();
    rcl_service_options_t options = rcl_service_get_default_options();
    auto* type = rosidl_typesupport_cpp::get_service_type_support_handle<Service>();
    check(rcl_service_init(made, &handle_, type, name.c_str(), &options));
    services_.back().second = [made, answer] {
      typename Service::Request request;
      typename Service::Response response;
      rmw_request_id_t header;
      if (rcl_take_request(made, &header, &request) != RCL_RET_OK) return rcl_reset_error();
      answer(request, response);
      check(rcl_send_response(made, &header, &response));
    };
  }

  size_t services() const { return services_.size(); }

  void add_to(rcl_wait_set_t* set) {
    for (auto& each : services_) check(rcl_wait_set_add_service(set, &each.first, nullptr));
  }

  void answer() {
    for (auto& each : services_) each.second();
  }

 private:
  rcl_node_t handle_ = rcl_get_zero_initialized_node();
  rcl_lifecycle_state_machine_t machine_ = rcl_lifecycle_get_zero_initialized_state_machine();
  rcl_publisher_t events_ = rcl_get_zero_initialized_publisher();
  std::list<std::pair<rcl_service_t, std::function<void()>>> services_;
  std::map<std::string, ParameterValue> overrides_;
  std::map<std::string, Parameter> parameters_;
};

std::list<Node> nodes;

// One-shot timers, each with what is done then.
rcl_clock_t clock_of_timers;
std::list<std::pair<rcl_timer_t, std::function<void()>>> timers;

void after(double seconds, std::function<void()> work) {
  rcl_allocator_t allocator = rcl_get_default_allocator();
  if (timers.empty()) check(rcl_clock_init(RCL_STEADY_TIME, &clock_of_timers, &allocator));
  timers.emplace_back(rcl_get_zero_initialized_timer(), std::move(work));
  auto nanoseconds = static_cast<int64_t>(seconds * 1e9);
  check(rcl_timer_init2(&timers.back().first, &clock_of_timers, &context, nanoseconds, nullptr, allocator, true));
}

void turn_timers() {
  for (auto& each : timers) {
    bool ready = false;
    if (rcl_timer_is_ready(&each.first, &ready) != RCL_RET_OK || !ready) continue;
    check(rcl_timer_cancel(&each.first));
    each.second();
  }
}

void spin() {
  for (;;) {
    size_t services = 0;
    for (auto& node : nodes) services += node.services();
    rcl_wait_set_t set = rcl_get_zero_initialized_wait_set();
    check(rcl_wait_set_init(&set, 0, 0, timers.size(), 0, services, 0, &context, rcl_get_default_allocator()));
    for (auto& node : nodes) node.add_to(&set);
    for (auto& each : timers) check(rcl_wait_set_add_timer(&set, &each.first, nullptr));
    check(rcl_wait(&set, -1));
    check(rcl_wait_set_fini(&set));
    turn_timers();
    for (auto& node : nodes) node.answer();
  }
}

void start(int argc, char** argv) {
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  check(rcl_init_options_init(&options, rcl_get_default_allocator()));
  check(rcl_init(argc, argv, &options, &context));
}

// One step: what to do, with a name and more after it (`double=speed@1.5`).
void perform(const std::string& step) {
  size_t at = step.find('=');
  std::string what = step.substr(0, at), name = at == std::string::npos ? "" : step.substr(at + 1), more;
  if ((at = name.find('@')) != std::string::npos) more = name.substr(at + 1), name = name.substr(0, at);
  ParameterDescriptor descriptor;
  ParameterValue value;
  if (what == "intra") intra_process = true;
  if (what == "silent") event_publisher = false;
  if (what == "node") nodes.emplace_back(name, more, false);
  if (what == "child") nodes.emplace_back(name, more, true);
  if (what == "pub") nodes.back().publish(name, false);
  if (what == "overridable") nodes.back().publish(name, true);
  if (what == "sub") nodes.back().subscribe(name);
  if (what == "relay") nodes.back().relay(name);
  if (what == "managed") nodes.back().manage();
  if (what == "sleep") sleep(std::stoi(name));
  if (what == "abort") abort();
  if (what == "after") {  // `after=0.2@pub:late`: another step, later
    more[more.find(':')] = '=';
    after(std::stod(name), [more] { perform(more); });
  }
  if (what == "double") {
    value.type = 3;
    value.double_value = std::stod(more);
    nodes.back().declare(name, descriptor, value);
  }
  if (what == "mandatory") nodes.back().declare_mandatory(name, 3);
  if (what == "percent" || what == "refuse") {
    if (what == "refuse") value.integer_value = 300;
    descriptor.integer_range.resize(1);
    descriptor.integer_range[0].to_value = 100;
    value.type = 2;
    nodes.back().declare(name, descriptor, value);
  }
  if (what == "error") rcl_node_get_name(nullptr);  // rcutils complains of an error that nobody took
  if (what == "invalid") {
    throw InvalidTopicNameError(
        "Invalid topic name: topic name must not contain characters other than "
        "alphanumerics, '_', '~', '{', or '}':\n  '" +
        name + "'\n    ^\n");
  }
}

}  // namespace
