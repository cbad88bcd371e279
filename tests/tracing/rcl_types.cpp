// A node on rcl with the types of C++, as rclcpp has them.
#include <unistd.h>

#include <rcl/error_handling.h>
#include <rcl/graph.h>
#include <rcl/rcl.h>
#include <rcl_interfaces/msg/parameter_event.hpp>
#include <rosidl_typesupport_cpp/message_type_support.hpp>
#include <rosidl_typesupport_cpp/service_type_support.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/trigger.hpp>

void *PyExc_RuntimeError, *_Py_TrueStruct;  // as in rcl_node.c

namespace {

rcl_node_t node = rcl_get_zero_initialized_node();

void check(rcl_ret_t result) {
  if (result == RCL_RET_OK) return;
  fprintf(stderr, "error: %s\n", rcl_get_error_string().str);
  exit(3);
}

template <typename Message>
rcl_publisher_t* publish(const std::string& topic) {
  auto* made = new rcl_publisher_t(rcl_get_zero_initialized_publisher());
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  auto* type = rosidl_typesupport_cpp::get_message_type_support_handle<Message>();
  check(rcl_publisher_init(made, &node, type, topic.c_str(), &options));
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  rcl_init_options_t options = rcl_get_zero_initialized_init_options();
  check(rcl_init_options_init(&options, rcl_get_default_allocator()));
  rcl_context_t context = rcl_get_zero_initialized_context();
  check(rcl_init(argc, argv, &options, &context));
  rcl_node_options_t node_options = rcl_node_get_default_options();
  check(rcl_node_init(&node, "own", "", &context, &node_options));

  rcl_interfaces::msg::ParameterEvent event;
  event.new_parameters.resize(1);
  event.new_parameters[0].name = "frames";
  event.new_parameters[0].value.type = 9;
  event.new_parameters[0].value.string_array_value = {"map", "base"};
  check(rcl_publish(publish<rcl_interfaces::msg::ParameterEvent>("/parameter_events"), &event, nullptr));

  rcl_client_t client = rcl_get_zero_initialized_client();
  rcl_client_options_t client_options = rcl_client_get_default_options();
  auto* type = rosidl_typesupport_cpp::get_service_type_support_handle<std_srvs::srv::Trigger>();
  check(rcl_client_init(&client, &node, type, "start", &client_options));
  for (bool there = false; !there; usleep(50000)) check(rcl_service_server_is_available(&node, &client, &there));
  std_srvs::srv::Trigger::Request request;
  std_srvs::srv::Trigger::Response response;
  int64_t sequence;
  check(rcl_send_request(&client, &request, &sequence));
  rmw_request_id_t header;
  while (rcl_take_response(&client, &header, &response) != RCL_RET_OK) {
    rcl_reset_error();
    usleep(10000);
  }
  publish<std_msgs::msg::String>(response.success && response.message.empty() ? "after" : "refused");
  for (;;) usleep(50000);
}
